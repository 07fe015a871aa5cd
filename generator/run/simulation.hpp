// SPDX-License-Identifier: GPL-3.0-or-later
// One simulation of a model: what is to be run, the run itself, and its results.
#pragma once

#include "run/controllers.hpp"
#include "run/options.hpp"
#include "run/plant_run.hpp"
#include "run/run_preparation.hpp"
#include "run/second_order.hpp"
#include "run/varied.hpp"
#include "form/system.hpp"
#include "text/files.hpp"
#include "text/process.hpp"

namespace dalembert {

/// A generated simulation that was not run yet. Preparing uses GiNaC, which knows one thread only; running does not.
struct PreparedSimulation {
    Machine machine;
    Header header;
    PlantSource plant;
    PlantRun run;
    std::vector<PreparedController> controllers;
    std::vector<MovedRuns> moved;  ///< for second derivatives
    PlantCache cache = PlantCache::used;
    std::string title;   ///< of plots
    std::vector<ShownUnit> units;  ///< that are declared and not SI
    std::string cost;    ///< the source that measures the right-hand side; where costs are asked for
    std::string name;    ///< of result files, without ending
    bool draw = true;
    SimulationSettings settings;
    std::string doubts;  ///< warnings of start values
    std::string without_slopes_of_outputs;  ///< why sensitivities have none, if so
};

/// A machine that was generated, and all that is to be known of its run.
struct PreparedRun {
    Machine machine;
    Header header;
    Values values;
    SimulationSettings settings;
    std::vector<VariedOfRun> varied;
    std::vector<MovedRuns> moved;  ///< for second derivatives, where they are asked for
    std::string without_slopes_of_outputs;  ///< why, if so
    std::string name;    ///< of result files, without ending
};

struct ReachOfSensitivities {
    double t = 0;        ///< s, up to which they exist
    std::string reason;  ///< why not further, if so
    std::string without_outputs;  ///< why those of outputs are left out, if so
};

struct SimulationReport {
    std::string status;      ///< "success", or why it stopped
    double t = 0;            ///< s, where it ended
    std::string constraint;  ///< the constraint that could not be held any more, if that was it
    std::string culprit;     ///< the state that is not finite, if that was it
    std::string guard;       ///< with an event: what is about to happen
    std::size_t events = 0;  ///< guards that changed their sign and were passed
    std::size_t steps = 0;
    std::size_t rejected = 0;
    std::size_t rhs_calls = 0;
    std::vector<std::pair<std::string, std::size_t>> methods;  ///< and their steps, where they were chosen by stiffness
    double energy_error = 0; ///< max |E - E(0) - work| / max(T + |V| + |internal energy|)
    std::optional<double>
        euler_step;  ///< s, of heat: up to which the explicit Euler method is stable at the start; nothing where it is not known
    std::optional<double> lost;        ///< J, of what switches: at events, as by impacts
    std::string message;               ///< of what switches: how the run ended, for people
    std::string mode;                  ///< of what switches: in which it ended
    double energy_limit = 0;           ///< up to which the energy error is what steps of this tolerance make
    bool ended = false;                ///< by an event that the model says ends a run
    bool keeps_energy() const { return energy_error <= energy_limit; }  // false for NaN
    bool is_good() const { return status == "success" || ended; }
    std::optional<ReachOfSensitivities> sensitivities;  ///< where they are asked for
    std::optional<SecondOrder> second_order;            ///< likewise
    bool drawn = false;
    FileContents files;      ///< to be written: header, CSV, plots
    PlantOrigin plant;
};

/// A run that did not come to its end, in words.
struct RunStopped : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The scene that a run belongs to; empty when it belongs to none, or there is no run.
std::string scene_of_run(const Model& model, const std::string& run);
/// The scene of the command line, or else the one that its run belongs to. Throws Failure where the two differ.
std::string scene_for_run(const Model& model, const Options& options);
/// What run and command line say of the start: values, and inputs at t = 0.
std::pair<Values, std::vector<GiNaC::ex>> start_of_run(const System& system, const Options& options);
/// Kinks at known times of a run in all its modes. Refers to both.
KinksOfRun kinks_of_run(const RunPreparation& preparation, const Machine& machine);
/// With the derivatives of outputs by parameters, where these can be made; else `without_outputs` says why not.
Header generate_with_slopes(Machine& machine, std::string& without_outputs, SeriesWish wish = SeriesWish::none);
/// Derives and generates, with series of the motion where the method needs them, or where `tries_series` and that is possible. `verb` is
/// named where nothing moves. Throws Failure.
PreparedRun prepare_run(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Options& options, const char* verb,
                        bool tries_series = false);
/// The same with the program of a simulation.
PreparedSimulation prepare_simulation(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Options& options);

/// The time of a call of the right-hand side in ns, in several rounds, and the bytes of its code.
class CostMeasurement {
public:
    /// Compiles. Throws Failure.
    explicit CostMeasurement(const PreparedSimulation& prepared);
    void measure();
    const std::vector<double>& nanoseconds() const { return nanoseconds_; }
    std::size_t bytes() const { return bytes_; }

private:
    std::unique_ptr<ScratchFolder> folder_;
    std::vector<double> nanoseconds_;
    std::size_t bytes_ = 0;
};

/// The flows like a root, whose slopes are infinite where they come to balance: "'a', 'b'", or empty.
std::string exact_roots(const Scene& scene);

/// What to think of a run that does not keep its energy: a sentence with the likely cause.
std::string energy_warning(const PreparedSimulation& prepared, const SimulationReport& report);
/// How a run of a plant went, but for what it calls by the names of a model, and without files.
SimulationReport report_of_run(const PlantRunResult& run, const dalembert_plant& plant, const SimulationSettings& settings);
/// Adds its files, NAME.csv and what belongs to it, and draws.
void add_results(SimulationReport& report, const PlantRunResult& run, const dalembert_plant& plant, const SimulationSettings& settings,
                 const std::vector<ShownUnit>& units, const std::string& title, const std::filesystem::path& folder,
                 const std::string& name);
/// Compiles and runs it. Throws Failure.
SimulationReport run_simulation(const PreparedSimulation& prepared, const std::filesystem::path& folder);

}  // namespace dalembert
