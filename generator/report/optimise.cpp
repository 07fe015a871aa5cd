// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/optimise.hpp"

#include <fmt/format.h>

#include "report/json_output.hpp"

namespace dalembert {

namespace {

const char* name_of(Optimum::Place place) {
    return place == Optimum::Place::inside ? "inside" : place == Optimum::Place::at_low ? "low" : "high";
}

const char* superlative(const OptimiseResult& result) { return result.is_largest ? "largest" : "smallest"; }

}  // namespace

std::string with_units(double value, const VariedParameter& parameter, int digits) {
    const std::string text = fmt::format("{:.{}g}{}{}", value, digits, parameter.unit.empty() ? "" : " ", parameter.unit);
    if (parameter.declared_unit.empty()) return text;
    return text + fmt::format(" ({:.{}g} {})", value / parameter.of_declared, digits, parameter.declared_unit);
}

std::string warnings_of(const OptimiseResult& result) {
    std::string text;
    if (result.place != Optimum::Place::inside)
        text += fmt::format("dalembert: warning: '{}' is {} at the {} end of the range of '{}'; there may be better values beyond it\n",
                            result.output, superlative(result), result.place == Optimum::Place::at_low ? "lower" : "upper",
                            result.parameter.name);
    for (const Optimum& other : result.others)
        text += fmt::format("dalembert: warning: '{}' has another local optimum, {:.6g} at {} = {}\n", result.output, other.value,
                            result.parameter.name, with_units(other.at, result.parameter, 6));
    return text;
}

std::string as_text(const OptimiseResult& result) {
    const VariedParameter& parameter = result.parameter;
    std::string text =
        fmt::format("{}, scene {}: {} is {} with\n", result.subject.sized_name, result.subject.scene, result.output, superlative(result));
    text += fmt::format("  {:<12} {}, {}\n", parameter.name, with_units(result.at, parameter, 10),
                        result.at_error > 0 ? fmt::format("within {:.1e}", result.at_error) : "an end of the range");
    text += fmt::format("  {:<12} {:.15g}{}{}, within {:.1e}; at t = {:.6g} s, {}\n", result.output, result.value,
                        result.unit.empty() ? "" : " ", result.unit, result.value_error, result.t,
                        result.event.empty() ? "the end of the run" : fmt::format("where '{}' ends the run", result.event));
    if (result.second_derivative)
        text += fmt::format("  {:<12} its second derivative by {} is {:.6g}; {} away, it is a percent worse\n", "", parameter.name,
                            *result.second_derivative, with_units(*result.loses_a_percent, parameter, 3));
    return text + fmt::format("  {:<12} {} runs, {} of them at steps from {} to {}\n", "", result.evaluations, result.points,
                              with_units(result.low, parameter, 6), with_units(result.high, parameter, 6));
}

nlohmann::ordered_json as_json(const OptimiseResult& result) {
    nlohmann::ordered_json json = json_result("optimise", result.subject);
    json["goal"] = result.is_largest ? "maximise" : "minimise";
    json["output"] = result.output;
    json["parameter"] = result.parameter.name;
    json["low"] = result.low;
    json["high"] = result.high;
    json["value"] = result.value;
    json["value_error"] = result.value_error;
    json["at"] = result.at;
    json["at_error"] = result.at_error;
    json["place"] = name_of(result.place);
    json["second_derivative"] = result.second_derivative ? nlohmann::ordered_json(*result.second_derivative) : nlohmann::ordered_json();
    json["t"] = result.t;
    json["event"] = result.event;
    json["evaluations"] = result.evaluations;
    json["others"] = nlohmann::ordered_json::array();
    for (const Optimum& other : result.others)
        json["others"].push_back({{"at", other.at}, {"value", other.value}, {"place", name_of(other.place)}});
    return json;
}

}  // namespace dalembert
