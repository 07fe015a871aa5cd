// SPDX-License-Identifier: GPL-3.0-or-later
// What every JSON result starts with.
#pragma once

#include <nlohmann/json.hpp>

#include "scene/scene.hpp"

namespace dalembert {

inline constexpr int json_version = 1;

/// {"schema": "dalembert/VERB", "version": 1, "model": ..., ...}
inline nlohmann::ordered_json json_result(const std::string& verb, const Model& model) {
    return {{"schema", "dalembert/" + verb}, {"version", json_version}, {"model", model.name}};
}

inline nlohmann::ordered_json json_result(const std::string& verb, const Scene& scene) {
    nlohmann::ordered_json json = json_result(verb, *scene.model);
    json["scene"] = scene.name;
    json["sizes"] = nlohmann::ordered_json::object();
    for (const auto& [name, value] : scene.sizes) json["sizes"][name] = value;
    return json;
}

/// JSON as it is printed. Text from a model that is no valid UTF-8 is replaced, not an error.
inline std::string printed(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace dalembert
