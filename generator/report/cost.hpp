// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert cost`: what accuracy costs in time.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "run/work_precision.hpp"

namespace dalembert {

/// A scene in one size, with what was measured of it.
struct MeasuredMachine {
    std::string model, title;  ///< name and title of the model; either may stand for the other
    std::string name;          ///< of the run and its files
    std::string scene, size;   ///< "N=20", empty where there is none
    std::size_t states = 0;
    double from_fullest = 0;   ///< how far its reference is from that of the fullest scene in the finest size: what no integrator mends
    double until = 0;          ///< s, end of the run
    std::string usual_method;  ///< that the run has
    ReferenceRun reference;
    std::vector<WorkPoint> points;
};

struct CostResult {
    std::vector<MeasuredMachine> machines;
    std::vector<std::filesystem::path> files;  ///< that were written
};

std::string as_text(const CostResult& result);
nlohmann::ordered_json as_json(const CostResult& result);

}  // namespace dalembert
