// SPDX-License-Identifier: GPL-3.0-or-later
// A study: many runs of a model with varied quantities, a row for each.
#pragma once

#include <functional>

#include "run/varied_runs.hpp"
#include "study/observable.hpp"
#include "study/run_file.hpp"
#include "study/varied_quantity.hpp"

namespace dalembert {

/// Everything that the command line says of a study, read and checked.
class Study {
public:
    /// Throws Failure.
    Study(const std::shared_ptr<const LoadedModel>& model, const Options& options);

    void compile() { runs_.compile(); }

    /// Lines of the file for some runs that follow each other. Threads may call it.
    std::string lines(std::size_t first, std::size_t count) const;
    RowOfRun row(std::size_t run) const;
    /// One run as `simulate` makes it.
    PlantRunResult simulated(std::size_t run) const;

    const VariedRuns& runs() const { return runs_; }
    const Design& design() const { return design_; }
    /// Comment and titles of the file.
    const RunTable& head() const { return head_; }
    /// "cart_pendulum_lab_study.csv", with the part of a shard
    std::string file_name() const;

private:
    void read_design(const Options& options);
    void bound_values();
    RowOfRun row_of(std::size_t run, std::vector<double> values) const;

    VariedRuns runs_;
    std::vector<VariedQuantity> varied_;
    Observables observables_;
    Design design_;
    RunTable head_;
};

/// "2/3". Empty: what the variables of SLURM's job arrays say, else the whole. Throws Failure (bad-option).
Shard shard_of(const std::string& text, std::size_t runs);

/// Who makes the runs `first` to behind `last` and gives their lines, in order, to `take`.
using MakeRuns =
    std::function<void(const Study& study, std::size_t first, std::size_t last, const std::function<void(const std::string&)>& take)>;

/// In so many threads, 0: one a processor.
MakeRuns by_threads(std::size_t threads);

/// Runs that are made and written together: few enough that little is lost, many enough that threads need not wait for each other.
inline constexpr std::size_t runs_of_block = 16;

}  // namespace dalembert
