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

/// Of the curves in a law, which has no value of its own.
void check_law(const Written& written, const Indices& indices, const System& system, const StartValues& value,
               const Bounds& of_temperature);

/// Throws Failure (value-out-of-range). What moves with inputs or the time has no value before a run, and a law none at all, so that only
/// curves in them are checked; what the scene leaves out is not. `name` is that of the member, "leak[2]"; `of_temperature` bounds what its
/// laws depend on.
template <class Described>
void check_signs(const Described& item, const std::string& name, const Indices& indices, const System& system, const StartValues& value,
                 const Bounds& of_temperature = {}) {
    const auto check = [&](const Written& written) {
        const Key& key = written.key;
        if (!key.sign || written.is_of_sizes) return;
        if (!written.bound.empty()) return check_law(written, indices, system, value, of_temperature);
        if (key.may_be_absent && !is_in_scene(written.expression, system)) return;
        if (key.sign->in_range) check_range(written, system, value);
        const GiNaC::ex e = system.translate(written.expression, indices);
        if (!value.depends_on_input(e) && !e.has(system.symbols.time())) value.check(*key.sign, e, written.expression.span, written.what);
        else value.check_curves(*key.sign, e, written.expression.span, written.what);
    };
    walk(item, check, std::string(kind_of<Described>.word) + " '" + name + "'");
}

}  // namespace dalembert
