// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/value_checks.hpp"

#include <fmt/format.h>

#include "form/circuit_validity.hpp"
#include "form/fluid_validity.hpp"
#include "form/heat_validity.hpp"
#include "form/sampling.hpp"
#include "prove/body_validity.hpp"
#include "prove/statics_validity.hpp"
#include "prove/switching_validity.hpp"
#include "prove/view_validity.hpp"

namespace dalembert {

namespace {

/// What a formula of parameters says of a start may be a root of a negative number.
void check_numbers(const System& system, const Values& values) {
    const std::vector<const Variable*> states = system.symbols.state_variables();
    const std::vector<GiNaC::ex> starts = values.state();
    for (std::size_t i = 0; i < states.size(); ++i)
        if (!value_at(starts[i], {}, 40))
            throw Failure(Diagnostic{
                Id::division_by_zero, states[i]->declared != nullptr ? states[i]->declared->span : Span{},
                fmt::format("the start value of '{}' is no real number with these parameters", states[i]->recorded_name())});
}

}  // namespace

void check_values(const System& system, const Values& values, ValueConditions* conditions) {
    check_numbers(system, values);
    check_switching_values(system, values, conditions);
    check_body_values(system, values, conditions);
    check_solid_values(system, values, conditions);
    check_fluid_values(system, values, conditions);
    check_heat_values(system, values, conditions);
    check_view_values(system, values, conditions);
    check_circuit_values(system, values, conditions);
    if (system.scene.sampling != nullptr) sample_times(system, values);
}

}  // namespace dalembert
