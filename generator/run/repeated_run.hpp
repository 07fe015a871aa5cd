// SPDX-License-Identifier: GPL-3.0-or-later
// The end of a run, with other values of one parameter.
#pragma once

#include "run/varied_runs.hpp"

namespace dalembert {

class RepeatedRun {
public:
    /// Derives and generates. `wanted` is an output, a state or another column of the recording. Throws Failure (unknown-name, ...).
    RepeatedRun(const std::shared_ptr<const LoadedModel>& model, const Options& options, const std::string& wanted);

    /// Once, before the first run. Throws Failure (tool-failed).
    void compile(const Variable& parameter);

    struct End {
        double value;  ///< of what is wanted, in SI
        double t;      ///< s, where the run ended
        double steps;
        std::string event;  ///< that ended it; empty: the end that the run names
    };
    /// How exactly a run is made: at ten times the tolerance and twice the largest step, it shows what both leave.
    enum class Care { usual, coarse };
    /// The end of the run with the parameter set to a number in SI. Throws RunStopped, Failure.
    End operator()(double value, Care care = Care::usual) const;

    const Machine& machine() const { return runs_.machine(); }

private:
    VariedRuns runs_;
    std::string parameter_;
    std::string wanted_;    ///< as the recording has it
    double tolerance_ = 0;  ///< that of the command line, else 1e-12 or what the run has, where that is finer
};

}  // namespace dalembert
