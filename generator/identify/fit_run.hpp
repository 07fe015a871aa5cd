// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of the model for each experiment, with given values of the unknowns.
#pragma once

#include <mutex>

#include "identify/experiment.hpp"
#include "run/run_preparation.hpp"
#include "run/simulation.hpp"

namespace dalembert {

/// What an experiment and its run differ by, and how that follows what is fitted.
struct RunBesideData {
    struct Column {
        std::vector<double> simulated;            ///< in SI, one a time of the experiment, with the offset of its sensor
        std::vector<std::vector<double>> slopes;  ///< by each that is fitted, likewise; empty where they were not asked for
    };
    std::vector<Column> columns;  ///< as Experiment::measured
    std::string failure;          ///< why the run did not come to its end; empty: it did
};

/// One of the unknowns of a fit: something fitted, of one experiment or of all.
struct FitUnknown {
    std::size_t fitted;                     ///< its number
    std::optional<std::size_t> experiment;  ///< of a start value
};

/// Where a fit begins, and the runs it is made of. Derives, generates and compiles when it is made. Several threads may ask for
/// comparisons.
class FitRun {
public:
    /// Throws Failure.
    FitRun(const std::shared_ptr<const LoadedModel>& model, const Options& options, const std::string& fitted,
           const std::vector<DataFile>& files);

    const Machine& machine() const { return machine_; }
    const Header& header() const { return header_; }
    const std::vector<Fitted>& fitted() const { return fitted_; }
    const std::vector<Experiment>& experiments() const { return experiments_; }
    const std::vector<FitUnknown>& unknowns() const { return unknowns_; }
    const Fitted& fitted(const FitUnknown& unknown) const { return fitted_[unknown.fitted]; }
    /// "d_R", "start(phi) of run1.csv"
    std::string name(const FitUnknown& unknown) const;
    /// Values in SI where the fit begins.
    const std::vector<double>& start() const { return start_; }
    const PlantOrigin& plant() const { return library_->origin(); }
    /// Warnings, as they are shown.
    const std::string& doubts() const { return doubts_; }

    /// Other values of a column, as many as before, in SI.
    void set_measured(std::size_t experiment, std::size_t column, std::vector<double> values) {
        experiments_.at(experiment).measured.at(column).values = std::move(values);
    }

    /// With one value an unknown. `with_slopes` asks for derivatives, too. The run ends where the experiment does, or after `samples` times
    /// of it, of two at least.
    RunBesideData compare(std::size_t experiment, const std::vector<double>& x, bool with_slopes,
                          std::optional<std::size_t> samples = {}) const;

private:
    void limit_steps();
    void differentiate_by_what_is_fitted();
    void take_data(const std::vector<DataFile>& files);
    void refuse_unknown_columns() const;
    double shortest_sample(const Variable& input) const;  ///< s, of its data
    void refuse_missing_slopes(const std::string& why) const;
    void refuse_without_data(const Fitted& one) const;
    void compile();
    void add_kinks(PlantRun& run) const;
    void set(Values& values, const System& system, std::size_t experiment, const std::vector<double>& x) const;
    Values values_at(std::size_t experiment, const std::vector<double>& x) const;
    PlantRun prepared(std::size_t experiment, const std::vector<double>& x) const;
    void check(std::size_t experiment) const;
    void add_experiment(PlantRun& run, std::size_t experiment) const;
    void end_at_sample(PlantRun& run, std::size_t experiment, std::size_t samples) const;
    double first_value(const FitUnknown& unknown) const;
    bool follows_nothing(std::size_t experiment) const;
    bool are_of_time_alone(const std::vector<GiNaC::ex>& inputs) const;
    PlantRun run_at(std::size_t experiment, const std::vector<double>& x, std::size_t samples) const;

    Options options_;
    RunPreparation preparation_;
    Machine machine_;
    Header header_;
    std::vector<Fitted> fitted_;
    std::vector<Experiment> experiments_;
    std::vector<FitUnknown> unknowns_;
    std::vector<double> start_;
    std::optional<PlantLibrary> library_;
    std::vector<std::optional<PlantRun>> ready_;  ///< one an experiment, where all but the numbers themselves stays as it is
    std::vector<std::size_t> max_steps_;          ///< likewise; none yet while the first run is made
    std::string doubts_;
    mutable std::mutex symbolic_;  ///< GiNaC knows one thread
};

}  // namespace dalembert
