// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "report/json_output.hpp"

namespace dalembert {

namespace {

struct EvaluatedGroup {
    const char* key;
    const char* title;
    EvaluateResult::Numbers EvaluateResult::*numbers;
};

constexpr std::array evaluated_groups{
    EvaluatedGroup{"parameter", "parameters", &EvaluateResult::parameters},
    EvaluatedGroup{"state", "state x", &EvaluateResult::states},
    EvaluatedGroup{"input", "inputs u", &EvaluateResult::inputs},
    EvaluatedGroup{"state_derivative", "state derivative dx/dt", &EvaluateResult::rates},
    EvaluatedGroup{"output", "outputs y", &EvaluateResult::outputs},
};

std::string lines(const char* title, const EvaluateResult::Numbers& numbers) {
    std::size_t width = 0;
    for (const auto& one : numbers) width = std::max(width, one.value.size());
    std::string text = numbers.empty() ? "" : fmt::format("{}\n", title);
    for (const auto& [name, number, unit] : numbers)
        text += fmt::format("  {:<20} {:<{}}{}\n", name, number, unit.empty() ? 0 : width, unit.empty() ? "" : " " + unit);
    return text;
}

}  // namespace

std::string as_text(const EvaluateResult& result) {
    std::string text = result.subject.title() + "\n";
    if (result.time_given) text += fmt::format("t = {} s\n", result.time);
    for (const EvaluatedGroup& group : evaluated_groups) text += lines(group.title, result.*group.numbers);
    text += lines("unknowns of loads", result.unknowns);
    if (!result.frictions.empty()) text += "friction at rest\n";
    for (const EvaluateResult::AtRest& one : result.frictions)
        text += fmt::format("  {:<20} {}: margin {} N, needs a coefficient of {}\n", one.name, one.sticks ? "yes" : "no", one.margin,
                            one.needed_coefficient);
    return text + lines("energies and powers", result.energies_and_powers);
}

nlohmann::ordered_json as_json(const EvaluateResult& result) {
    // Up to 17 digits are numbers; more would be lost there and are texts.
    const auto number = [&](const std::string& decimal) {
        return result.digits <= 17 ? nlohmann::ordered_json(std::strtod(decimal.c_str(), nullptr)) : nlohmann::ordered_json(decimal);
    };
    nlohmann::ordered_json json = json_result("evaluate", result.subject);
    json["digits"] = result.digits;
    json["t"] = number(result.time);
    if (!result.subject.mode.empty()) json["mode"] = result.subject.mode;
    const auto add = [&](const char* key, const EvaluateResult::Numbers& numbers) {
        json[key] = nlohmann::ordered_json::object();
        for (const auto& [name, value, unit] : numbers) json[key][name] = number(value);
    };
    for (const EvaluatedGroup& group : evaluated_groups) add(group.key, result.*group.numbers);
    if (!result.unknowns.empty()) add("unknown", result.unknowns);
    for (const EvaluateResult::AtRest& one : result.frictions)
        json["sticking"][one.name] = {
            {"sticks", one.sticks}, {"margin", number(one.margin)}, {"needed_coefficient", number(one.needed_coefficient)}};
    for (const auto& [name, value, unit] : result.energies_and_powers) json[name] = number(value);
    return json;
}

}  // namespace dalembert
