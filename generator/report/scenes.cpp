// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/scenes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "elements/runs.hpp"
#include "report/json_output.hpp"
#include "text/safe_text.hpp"

namespace dalembert {

std::string as_text(const ScenesResult& result) {
    const auto listed = [](const std::vector<std::string>& names) {
        return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
    };
    std::string text;
    for (const ScenesResult::Row& row : result.scenes) {
        text += fmt::format("{}{}{}\n", row.name, row.name == result.default_scene ? " (default)" : "",
                            row.doc.empty() ? "" : ": " + safe_line(row.doc));
        text += fmt::format("  effects in:  {}\n", listed(row.effects_in));
        text += fmt::format("  effects out: {}\n", listed(row.effects_out));
        text += fmt::format("  {} coordinates, {} plain states, {} inputs, {} outputs, {} parameters; header {}\n", row.coordinates,
                            row.plain_states, row.inputs, row.outputs, row.parameters, row.header);
    }
    return text;
}

nlohmann::ordered_json as_json(const ScenesResult& result) {
    nlohmann::ordered_json json = json_result("scenes", result.model);
    json["default"] = result.default_scene;
    json["scenes"] = nlohmann::ordered_json::array();
    for (const ScenesResult::Row& row : result.scenes)
        json["scenes"].push_back({{"scene", row.name},
                                  {"doc", row.doc},
                                  {"effects_in", row.effects_in},
                                  {"effects_out", row.effects_out},
                                  {"coordinates", row.coordinates},
                                  {"states", row.states()},
                                  {"inputs", row.inputs},
                                  {"outputs", row.outputs},
                                  {"parameters", row.parameters},
                                  {"header", row.header}});
    return json;
}

}  // namespace dalembert
