// SPDX-License-Identifier: GPL-3.0-or-later
// What descriptions say about signs, at the default parameters and the start.
#pragma once

#include "elements/walk.hpp"
#include "form/start_values.hpp"

namespace dalembert {

/// Throws Failure (value-out-of-range). What moves with inputs or the time has no value before a run, and a law none at all.
/// `name` is that of the member, "leak[2]".
template <class Described>
void check_signs(const Described& item, const std::string& name, const Indices& indices, const System& system, const StartValues& value) {
    const auto check = [&](const Written& written) {
        const std::optional<SignRule>& sign = written.key.sign;
        if (!sign || written.is_of_sizes || !written.bound.empty()) return;
        const GiNaC::ex e = system.translate(written.expression, indices);
        if (value.depends_on_input(e) || e.has(system.symbols.time())) return;
        sign->is_above_zero ? value.positive(e, written.expression.span, written.what, sign->unit)
                            : value.at_least_zero(e, written.expression.span, written.what, sign->unit);
    };
    walk(item, check, std::string(kind_of<Described>.word) + " '" + name + "'");
}

}  // namespace dalembert
