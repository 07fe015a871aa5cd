// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert generate`.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "report/rewritten.hpp"
#include "report/subject.hpp"

namespace dalembert {

struct GeneratedHeader {
    /// Of a rod or block whose cells are computed in a loop.
    struct Cells {
        std::string name;
        std::size_t count;
        int operations;  ///< of each
    };
    Subject subject;
    std::filesystem::path path;
    std::string name_space;
    std::size_t bytes, degrees;
    bool all_proven, samples;
    int main_operations;  ///< in the right-hand side, or in a sample of a controller
    std::vector<std::pair<std::string, OperationCount>> operations;  ///< of each function
    std::vector<Cells> cells;
    std::vector<StageReport> stages;
    std::vector<RewrittenPlaces> rewritten;
};

struct GenerateResult {
    std::vector<GeneratedHeader> headers;
    bool every_scene = false;  ///< was asked for
    bool explained = false;    ///< stages and rewritings are told, too
};

/// A line for each: its time, and what came of it.
std::string stage_table(const std::vector<StageReport>& stages);

std::string as_text(const GenerateResult& result);
/// Of every scene a list, else one object.
nlohmann::ordered_json as_json(const GenerateResult& result);

}  // namespace dalembert
