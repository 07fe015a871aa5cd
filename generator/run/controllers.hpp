// SPDX-License-Identifier: GPL-3.0-or-later
// The controllers of a machine, prepared for its runs.
#pragma once

#include <memory>

#include "pipeline.hpp"
#include "plant/library.hpp"
#include "plant/simulation.hpp"
#include "symbolic/values.hpp"

namespace dalembert {

/// A controller as code, and its part in a run.
struct PreparedController {
    const Sampler* sampler;
    std::shared_ptr<const Machine> machine;  ///< the controller
    PlantSource source;
    ControllerOfRun run;  ///< without its table
};

/// Derives, proves and generates them. Throws Failure, as set_parameters().
std::vector<PreparedController> prepare_controllers(const System& machine, const Values& values, double until);
/// Parameters and times of a controller at values of its machine. Throws Failure: (value-out-of-range), and (bad-option) where a run until
/// then has too many samples.
void set_parameters(ControllerOfRun& run, const PreparedController& controller, const System& machine, const Values& values, double until);

/// Libraries of the controllers, which stay loaded as long as it lives, and what a run needs.
class LoadedControllers {
public:
    LoadedControllers(const std::vector<PreparedController>& prepared, PlantCache cache);
    const std::vector<ControllerOfRun>& of_run() const { return of_run_; }

private:
    std::vector<std::unique_ptr<PlantLibrary>> libraries_;
    std::vector<ControllerOfRun> of_run_;
};

}  // namespace dalembert
