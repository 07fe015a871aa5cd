// SPDX-License-Identifier: GPL-3.0-or-later
// What every JSON result starts with, and parts that several have.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "report/subject.hpp"

namespace dalembert {

inline constexpr int json_version = 1;

/// {"schema": "dalembert/VERB", "version": 1}
inline nlohmann::ordered_json json_result(const std::string& verb) { return {{"schema", "dalembert/" + verb}, {"version", json_version}}; }

/// With "model".
inline nlohmann::ordered_json json_result(const std::string& verb, const std::string& model) {
    nlohmann::ordered_json json = json_result(verb);
    json["model"] = model;
    return json;
}

/// With "scene" and "sizes", too.
inline nlohmann::ordered_json json_result(const std::string& verb, const Subject& subject) {
    nlohmann::ordered_json json = json_result(verb, subject.model);
    json["scene"] = subject.scene;
    json["sizes"] = nlohmann::ordered_json::object();
    for (const auto& [name, value] : subject.sizes) json["sizes"][name] = value;
    return json;
}

inline nlohmann::ordered_json json_object(const std::vector<ResultValue>& values) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const ResultValue& one : values) json[one.name] = one.value;
    return json;
}

inline nlohmann::ordered_json json_list(const std::vector<std::filesystem::path>& files) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const std::filesystem::path& file : files) json.push_back(file.string());
    return json;
}

/// JSON as it is printed. Text from a model that is no valid UTF-8 is replaced, not an error.
inline std::string printed(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace dalembert
