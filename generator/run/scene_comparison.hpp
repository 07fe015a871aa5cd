// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of one model beside each other: what each costs, and how far its results are from those of the fullest one.
#pragma once

#include "run/simulation.hpp"

namespace dalembert {

/// How far an output is from that of the scene that is compared with, over a run.
struct Deviation {
    std::string output;  ///< name with unit, as in the CSV
    double largest;      ///< in that unit
    double relative;     ///< to the largest magnitude in the scene compared with; not finite where that is zero
};

struct ComparedScene {
    std::string wish;       ///< "full", "full-drag"
    bool is_named = true;   ///< a scene of the model; else one with a single effect changed
    std::string same_as;    ///< a scene above with the same effects, which stands for this one
    std::string refused;    ///< why there is no such scene, or no such run
    std::size_t states = 0;
    std::size_t parameters = 0;
    int operations = 0;     ///< of the right-hand side
    std::vector<double> nanoseconds;  ///< of one call, in several rounds, sorted
    std::size_t bytes = 0;  ///< of its code
    std::string status;     ///< of the run
    double until = 0;       ///< s, where the run ended
    std::vector<Deviation> deviations;

    /// Whether it was measured and run.
    bool is_known() const { return same_as.empty() && refused.empty(); }
    double median() const { return nanoseconds.empty() ? 0 : nanoseconds[nanoseconds.size() / 2]; }
    /// The largest relative one, null where none is known.
    const Deviation* worst() const;
};

struct SceneComparison {
    std::size_t against = 0;  ///< which of the scenes the others are compared with
    std::vector<ComparedScene> scenes;
};

/// All scenes of the model, and those that differ from the fullest by one effect left out, and from the barest by one added. Derives,
/// generates, compiles and runs each; progress goes to err. Throws Failure where the scene compared with cannot be had.
SceneComparison compare_scenes(const std::shared_ptr<const LoadedModel>& model, const Options& options, Streams streams);

}  // namespace dalembert
