// SPDX-License-Identifier: GPL-3.0-or-later
// What a [runs.NAME] of the model and the command line together say of a run.
#pragma once

#include "form/input_kinks.hpp"
#include "run/options.hpp"
#include "emit/runner.hpp"

namespace dalembert {

/// The run that is meant: the one named, else `reference`, else the only one; null when the model has none. Throws Failure (unknown-run).
const Run* find_run(const Model& model, const std::string& wanted);

/// Refers to the model and the options that it is made of.
class RunPreparation {
public:
    RunPreparation(const Model& model, const Options& options)
        : options_(options), model_name_(model.name), run_(find_run(model, options.run)) {}

    /// The scene: the one asked for, or the one that the run belongs to.
    std::string scene(const std::string& wanted) const;
    /// The method of integration.
    std::string method() const;
    /// Parameters and start values. Throws Failure (value-out-of-range, unknown-name, ...).
    void set_values(Values& values, const System& system) const;
    /// The inputs where the run begins.
    std::vector<GiNaC::ex> inputs_at_start(const Values& values, const System& system) const;
    /// Everything else, with values that are set. Throws Failure (bad-option, division-by-zero, ...).
    SimulationSettings make_settings(const Values& values, const System& system) const;
    /// The end of the run as a formula of parameters; nothing where the model gives none.
    std::optional<GiNaC::ex> end(const System& system) const;
    /// Kinks and jumps of the run at times that follow from parameters.
    std::vector<SwitchInTime> switches(const Values& values, const System& system, const GiNaC::exset& letters) const;
    /// Whether these may change with letters that stand in `values` in the place of numbers.
    bool settings_move(const Values& values, const System& system, const GiNaC::exset& letters) const;

private:
    /// Of a run those that controllers set are zero, and are not given; a point at rest has them as all others.
    std::vector<GiNaC::ex> inputs(const Values& values, const System& system, bool is_run = true) const;

    const Options& options_;
    const std::string& model_name_;
    const Run* run_;
};

}  // namespace dalembert
