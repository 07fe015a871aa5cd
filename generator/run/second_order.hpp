// SPDX-License-Identifier: GPL-3.0-or-later
// Second derivatives of a run, by differences of the first ones: runs with one value moved.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <dalembert/sensitivities/extrapolation.hpp>

#include "emit/runner.hpp"
#include "plant/simulation.hpp"
#include "run/varied.hpp"

namespace dalembert {

/// Runs with one that is varied moved to either side, in steps that are halved.
struct MovedRuns {
    struct Pair {
        double distance = 0;                    ///< between both
        std::optional<PlantRun> behind, ahead;  ///< nothing where the model has no such run
    };
    std::array<Pair, detail::steps_of_extrapolation> pairs;
};

/// `values` are those of the run before constraints determine some.
std::vector<MovedRuns> moved_runs(const std::vector<NamedVariable>& named, const System& system, const Values& values,
                                  const SimulationSettings& settings, const KinksOfRun& kinks);

/// Second derivatives along a run, and an estimate of their error.
struct SecondOrder {
    Recording recording;       ///< time, and d2(state or output)/(d(varied) d(varied)), in SI; what does not exist is not a number
    std::size_t left_out = 0;  ///< numbers that do not exist, or of which hardly a digit is certain
    std::size_t numbers = 0;   ///< the others
    double doubt = 0;          ///< the largest of these, as a part of the largest number of the column, if that is not next to nothing
};

/// `result` is that of the run itself, `moved` holds the moved runs of each that is varied, in the same order.
SecondOrder second_order_of(const dalembert_plant& plant, const std::vector<VariedOfRun>& varied, const PlantRunResult& result,
                            const std::vector<MovedRuns>& moved);

}  // namespace dalembert
