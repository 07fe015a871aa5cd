// SPDX-License-Identifier: GPL-3.0-or-later
// One model in several scenes and sizes, each ready to be measured.
#pragma once

#include "run/work_precision.hpp"

namespace dalembert {

/// A scene in one size.
struct Variant {
    std::unique_ptr<WorkPrecision> work;
    std::string scene, size;  ///< "N=20", empty where there is none
    std::size_t effects = 0, states = 0;
    double from_fullest = 0;  ///< how far its reference is from that of the fullest scene in the finest size: what no integrator mends
    const std::string& name() const { return work->run().name; }
};

/// Derives, generates, compiles, and finds the references; progress goes to err. Scenes that cannot be run are left out, and told, where
/// others may be taken instead. `check` sees each run before it is compiled. Throws Failure, RunStopped.
std::vector<Variant> make_variants(const std::shared_ptr<const LoadedModel>& model, const std::vector<std::string>& scenes,
                                   bool may_leave_out, const Options& options, Streams streams,
                                   const std::function<void(const PreparedRun&)>& check);

}  // namespace dalembert
