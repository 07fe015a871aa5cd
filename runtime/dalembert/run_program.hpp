// SPDX-License-Identifier: BSL-1.0
// What the programs share that `dalembert simulate` writes: options, the table that is recorded, and the lines that the verb reads.
#pragma once

#include <algorithm>
#include <cstdio>
#include <initializer_list>
#include <utility>
#include <vector>

#include "dalembert/recording.hpp"
#include "dalembert/scales.hpp"
#include "dalembert/status.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// The last state of a run is the work in J, which counts in units of the energy at the start.
template <class System, class Inputs, class Options>
void set_run(Options& options, const System& system, const Inputs& inputs, const typename System::State& start, double tolerance, double step, std::size_t intervals, double until, double energy) {
    const auto scale = state_scales(system, inputs, start, until, intervals, tolerance);
    std::copy(scale.begin(), scale.end(), options.scale.begin());
    if constexpr (can_be_singular<System>) {
        // Bringing velocities back to constraints leaves them about twelve digits of the largest one.
        const double least = std::min(1.0, 1e-12 / tolerance) * *std::max_element(scale.begin(), scale.end());
        for (auto& size : options.scale) size = std::max(size, least);
    }
    options.tolerance = tolerance;
    options.step = step;
    options.intervals = intervals;
    options.max_step = until / static_cast<double>(intervals);
    options.scale.back() = energy > 0 ? energy : 1.0;
}

/// Time, states as the model calls them, outputs, inputs, energies.
template <class System>
Recording recording_of(std::initializer_list<Column> states) {
    Recording recording;
    recording.columns.push_back({"t", "s"});
    recording.columns.insert(recording.columns.end(), states);
    for (const auto& quantity : System::output_table()) recording.columns.push_back({quantity.name, quantity.unit});
    for (const auto& quantity : System::input_table()) recording.columns.push_back({quantity.name, quantity.unit});
    for (const char* energy : {"kinetic_energy", "potential_energy", "internal_energy", "work"}) recording.columns.push_back({energy, "J"});
    return recording;
}

template <class Sample>
std::vector<double> row_of(const Sample& sample, std::initializer_list<double> states) {
    std::vector<double> row{sample.t};
    row.insert(row.end(), states);
    row.insert(row.end(), sample.y.begin(), sample.y.end());
    row.insert(row.end(), sample.u.begin(), sample.u.end());
    row.insert(row.end(), {sample.kinetic_energy, sample.potential_energy, sample.internal_energy, sample.work});
    return row;
}

/// Returns the exit code of the program.
inline int print_outcome(const Outcome& outcome, double energy_error, bool drawn) {
    std::printf("status=%s\nt=%.17g\nstate=%zu\nconstraint=%zu\nevents=%zu\nguard=%zu\nsteps=%zu\nrejected=%zu\nrhs_calls=%zu\nsteps_by=%zu %zu %zu\nenergy_error=%.3g\ndrawn=%d\n", to_string(outcome.status), outcome.t, outcome.state, outcome.constraint,
                outcome.events, outcome.guard, outcome.steps, outcome.rejected, outcome.rhs_calls, outcome.steps_by[0], outcome.steps_by[1], outcome.steps_by[2], energy_error, drawn ? 1 : 0);
    return outcome.status == Status::success ? 0 : 4;
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
