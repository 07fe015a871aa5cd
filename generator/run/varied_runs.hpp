// SPDX-License-Identifier: GPL-3.0-or-later
// A run whose plant is compiled once, made many times, with other values of parameters, start values and constant inputs.
#pragma once

#include <mutex>
#include <span>

#include "plant/library.hpp"
#include "run/run_preparation.hpp"
#include "run/simulation.hpp"

namespace dalembert {

/// The event that ended a run as the model says; null where something else did.
const EventEquation* event_that_ended(const Outcome& outcome, const System& system);
/// What it is that ended a run where the model does: what the guard belongs to, and what it says. Empty where none did.
struct EndOfModel {
    std::string name, doc;
};
EndOfModel end_of_model(const Outcome& outcome, const System& system);

class VariedRuns {
public:
    /// Derives and generates. Throws Failure.
    VariedRuns(const std::shared_ptr<const LoadedModel>& model, const Options& options, const char* verb);

    /// What runs differ in: parameters, coordinates, velocities, states and inputs of the machine. Finds out, with letters in their place,
    /// what is the same for all runs. Throws Failure (bad-option: an input varies, and others are no constants).
    void vary(std::vector<const Variable*> varied);

    /// Between these values: where every corner of the box is what a machine can have, runs inside it are not checked one by one. What is
    /// checked are signs and inequalities, in which nearly always each value counts in one direction.
    void stay_between(std::span<const double> low, std::span<const double> high);

    /// Once, before the first run and behind vary(). Throws Failure (tool-failed).
    void compile();
    const dalembert_plant& plant() const { return library_->table(); }

    /// The run with numbers in SI for what is varied, in its order. Threads may call it. Throws Failure (value-out-of-range, ...).
    PlantRun operator()(std::span<const double> values) const;

    const Machine& machine() const { return machine_; }
    /// Those that all runs have.
    const SimulationSettings& settings() const { return settings_; }
    /// Values of the model, the run and the command line, before constraints determine some.
    Values values() const { return values_of(*machine_.system); }
    /// Whether every run is prepared from the beginning, because constraints or known times depend on what is varied.
    bool is_made_anew() const { return is_made_anew_; }

private:
    /// A start value: the same for all runs, one that is varied, or made of such.
    struct Start {
        std::optional<std::size_t> varied = {};
        bool is_root = false;
        std::optional<GiNaC::ex> made_of = {};
    };

    Values values_of(const System& system) const;
    void set(Values& values, std::span<const double> numbers) const;
    SimulationSettings settings_with(const Values& values, std::span<const double> numbers) const;
    Values lettered(const System& system) const;
    void find_what_moves();
    void hold_inputs();
    bool controllers_have(const GiNaC::exset& letters) const;
    PlantRun anew(std::span<const double> numbers) const;

    const Options& options_;
    RunPreparation preparation_;
    Machine machine_;
    Header header_;
    SimulationSettings settings_;
    std::vector<const Variable*> varied_;
    std::vector<ExpressionPtr> names_;  ///< of them, as they are set
    GiNaC::exvector letters_;           ///< in their place
    bool holds_inputs_ = false;         ///< all inputs are numbers, so that the plant is compiled without
    bool is_made_anew_ = true, is_checked_ = true;
    PlantRun base_;
    std::vector<Start> starts_;    ///< as PlantRun::start
    mutable std::mutex symbolic_;  ///< GiNaC works in one thread at a time
    std::optional<PlantLibrary> library_;
    std::vector<PreparedController> prepared_controllers_;
    std::optional<LoadedControllers> controllers_;
};

}  // namespace dalembert
