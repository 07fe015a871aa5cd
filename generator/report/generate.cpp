// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/generate.hpp"

#include <fmt/format.h>

#include "report/json_output.hpp"

namespace dalembert {

namespace {

nlohmann::ordered_json as_json(const GeneratedHeader& header) {
    nlohmann::ordered_json json = json_result("generate", header.subject);
    json["header"] = header.path.string();
    json["namespace"] = header.name_space;
    json["bytes"] = header.bytes;
    json["all_proven"] = header.all_proven;
    json["operations"] = nlohmann::ordered_json::object();
    for (const auto& [function, c] : header.operations)
        json["operations"][function] = {{"additions", c.additions}, {"multiplications", c.multiplications}, {"divisions", c.divisions},
                                        {"trigonometric", c.trigonometric}, {"other", c.other}, {"total", c.total()}};
    json["cells"] = nlohmann::ordered_json::array();
    for (const GeneratedHeader::Cells& cells : header.cells)
        json["cells"].push_back({{"name", cells.name}, {"count", cells.count}, {"operations", cells.operations}});
    json["seconds"] = nlohmann::ordered_json::object();
    for (const StageReport& stage : header.stages) json["seconds"][stage.stage] = stage.seconds;
    return json;
}

}  // namespace

std::string stage_table(const std::vector<StageReport>& stages) {
    std::string text;
    for (const StageReport& stage : stages)
        text += fmt::format("  {:<11} {:>8.1f} ms  {}\n", stage.stage, 1000 * stage.seconds, stage.result);
    return text;
}

std::string as_text(const GenerateResult& result) {
    std::string text;
    for (const GeneratedHeader& header : result.headers) {
        std::string cells;
        for (const GeneratedHeader::Cells& one : header.cells)
            cells += fmt::format(" and {} for each of the {} cells of {}", one.operations, one.count, one.name);
        const char* proofs = header.all_proven ? "everything proven" : "some parts only numerically equal";
        if (header.samples)
            text += fmt::format("{}: a controller, {} operations in a sample, {}\n", header.path.string(), header.main_operations, proofs);
        else
            text += fmt::format("{}: {} degrees of freedom, {} operations in the right-hand side{}, {}\n", header.path.string(),
                                header.degrees, header.main_operations, cells, proofs);
        if (result.explained) text += stage_table(header.stages) + rewritten_text(header.rewritten);
    }
    return text;
}

nlohmann::ordered_json as_json(const GenerateResult& result) {
    if (!result.every_scene) return as_json(result.headers.front());
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const GeneratedHeader& header : result.headers) all.push_back(as_json(header));
    return all;
}

}  // namespace dalembert
