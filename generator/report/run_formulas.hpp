// SPDX-License-Identifier: GPL-3.0-or-later
// What a run makes of parameters, so that a page can let it follow them: its end, its start, kinks and jumps at known times, and what is
// asked of values.
#pragma once

#include "form/start_values.hpp"
#include "run/simulation.hpp"

namespace dalembert {

/// Expressions of parameters, and of whatever each of them names.
struct RunFormulas {
    std::optional<GiNaC::ex> end;      ///< s
    std::vector<GiNaC::ex> start;      ///< of all states, before constraints determine some
    std::vector<int> free_positions;   ///< for each degree of freedom the place in the state of what constraints may determine, or -1
    std::vector<int> free_rates;
    bool meets_constraints = false;    ///< at the start, before the run
    std::vector<bool> fixed_inputs;    ///< those that parameters alone determine
    ValueConditions conditions;        ///< of parameters and the start
    std::vector<std::vector<SwitchInTime>> switches;  ///< of the machine, then of its other modes
    std::vector<double> known_times;  ///< s, of further kinks and jumps that nothing moves, such as the knots of a curve over the time
};
RunFormulas formulas_of_run(const RunPreparation& preparation, const PreparedRun& run);

}  // namespace dalembert
