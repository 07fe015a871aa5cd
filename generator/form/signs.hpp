// SPDX-License-Identifier: GPL-3.0-or-later
// What descriptions say about signs, at the values of a run and within declared ranges.
#pragma once

#include "elements/walk.hpp"
#include "form/start_values.hpp"

namespace dalembert {

/// Whether what a mere name stands for is in the scene.
bool is_in_scene(const Expression& name, const System& system);
/// Of a parameter alone: its whole declared range must keep the rule. Throws Failure (value-out-of-range).
void check_range(const Written& written, const System& system, const StartValues& value);

/// Throws Failure (value-out-of-range). What moves with inputs or the time has no value before a run, and a law none at all; nor has what
/// the scene leaves out. `name` is that of the member, "leak[2]".
template <class Described>
void check_signs(const Described& item, const std::string& name, const Indices& indices, const System& system, const StartValues& value) {
    const auto check = [&](const Written& written) {
        const Key& key = written.key;
        if (!key.sign || written.is_of_sizes || !written.bound.empty()) return;
        if (key.may_be_absent && !is_in_scene(written.expression, system)) return;
        if (key.sign->in_range) check_range(written, system, value);
        const GiNaC::ex e = system.translate(written.expression, indices);
        if (!value.depends_on_input(e) && !e.has(system.symbols.time())) value.check(*key.sign, e, written.expression.span, written.what);
    };
    walk(item, check, std::string(kind_of<Described>.word) + " '" + name + "'");
}

}  // namespace dalembert
