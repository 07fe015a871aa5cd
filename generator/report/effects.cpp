// SPDX-License-Identifier: GPL-3.0-or-later
// What effects cost and what they change: the accuracy of the model itself against the time of its right-hand side.
#include "report/effects.hpp"

#include <fmt/format.h>

#include <cmath>

#include "report/json_output.hpp"

namespace dalembert {

namespace {

std::string percent(double share) {
    if (share < 1e-15) return "0";
    if (share < 1e-3) return fmt::format("{:.1e}", share);
    return share < 0.1 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

std::string deviation(const ComparedScene& scene, bool is_reference) {
    if (is_reference) return "compared with";
    for (const Deviation& d : scene.deviations)
        if (std::isnan(d.largest)) return d.output.substr(0, d.output.find(" [")) + " is not a number";
    const Deviation* worst = scene.worst();
    if (worst == nullptr) return scene.deviations.empty() ? "no output in common" : "outputs are zero there";
    const std::string name = worst->output.substr(0, worst->output.find(" ["));
    const std::string text = worst->relative > 0 ? fmt::format("{} of {}", percent(worst->relative), name) : "none";
    return scene.status == "success" ? text : fmt::format("{}, up to t = {:.4g} s: {}", text, scene.until, scene.status);
}

std::string effects_table(const SceneComparison& comparison) {
    std::size_t width = 5;
    for (const ComparedScene& s : comparison.scenes) width = std::max(width, s.wish.size());
    const auto line = [&](const auto&... cells) {
        return fmt::format("{:<{}}  {:>6}  {:>10}  {:>10}  {:>7}  {:>15}  {:>6}  {}\n", cells...);
    };
    std::string text =
        line("scene", width, "states", "parameters", "operations", "ns", "spread", "bytes", "largest deviation of an output");
    for (const bool is_named : {true, false}) {
        bool is_first = true;
        for (std::size_t i = 0; i < comparison.scenes.size(); ++i) {
            const ComparedScene& s = comparison.scenes[i];
            if (s.is_named != is_named) continue;
            if (!is_named && is_first) text += "one effect changed\n";
            is_first = false;
            if (!s.same_as.empty()) text += fmt::format("{:<{}}  has the effects of '{}'\n", s.wish, width, s.same_as);
            else if (!s.refused.empty()) text += fmt::format("{:<{}}  {}\n", s.wish, width, s.refused);
            else
                text += line(s.wish, width, s.states, s.parameters, s.operations, fmt::format("{:.1f}", s.median()),
                             fmt::format("{:.1f} .. {:.1f}", s.nanoseconds.front(), s.nanoseconds.back()), s.bytes,
                             deviation(s, i == comparison.against));
        }
    }
    return text;
}

nlohmann::ordered_json scenes_json(const SceneComparison& comparison) {
    nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
    for (const ComparedScene& s : comparison.scenes) {
        nlohmann::ordered_json row{{"scene", s.wish}, {"named", s.is_named}};
        if (!s.is_known()) {
            row[s.same_as.empty() ? "refused" : "same_as"] = s.same_as.empty() ? s.refused : s.same_as;
            scenes.push_back(std::move(row));
            continue;
        }
        row["states"] = s.states;
        row["parameters"] = s.parameters;
        row["operations"] = s.operations;
        row["nanoseconds"] = {{"median", s.median()}, {"lowest", s.nanoseconds.front()}, {"highest", s.nanoseconds.back()}};
        row["bytes"] = s.bytes;
        row["status"] = s.status;
        row["t"] = s.until;
        row["deviations"] = nlohmann::ordered_json::array();
        for (const Deviation& d : s.deviations) {
            nlohmann::ordered_json one{{"output", d.output}, {"largest", d.largest}};
            if (std::isfinite(d.relative)) one["relative"] = d.relative;
            row["deviations"].push_back(std::move(one));
        }
        scenes.push_back(std::move(row));
    }
    return scenes;
}

}  // namespace

std::string effects_csv(const SceneComparison& comparison) {
    std::string text =
        "scene,states,parameters,operations,ns,ns_lowest,ns_highest,bytes,output,largest_deviation,relative_deviation,status\n";
    for (const ComparedScene& s : comparison.scenes) {
        if (!s.is_known()) continue;
        const std::string cost = fmt::format("{},{},{},{},{:.4g},{:.4g},{:.4g},{}", s.wish, s.states, s.parameters, s.operations,
                                             s.median(), s.nanoseconds.front(), s.nanoseconds.back(), s.bytes);
        if (s.deviations.empty()) text += fmt::format("{},,,,{}\n", cost, s.status);
        for (const Deviation& d : s.deviations)
            text += fmt::format("{},{},{},{},{}\n", cost, d.output, d.largest,
                                std::isfinite(d.relative) ? fmt::format("{}", d.relative) : "", s.status);
    }
    return text;
}

std::string as_text(const EffectsResult& result) {
    std::string text =
        fmt::format("{}, compared with scene '{}'; ns and bytes are of the right-hand side\n\n", result.sized_name, result.against());
    text += effects_table(result.comparison) + "\n";
    for (const std::filesystem::path& file : result.files) text += file.string() + "\n";
    return text;
}

nlohmann::ordered_json as_json(const EffectsResult& result) {
    nlohmann::ordered_json json = json_result("effects", result.model);
    json["against"] = result.against();
    json["scenes"] = scenes_json(result.comparison);
    json["files"] = json_list(result.files);
    return json;
}

}  // namespace dalembert
