// SPDX-License-Identifier: GPL-3.0-or-later
// What effects cost and what they change: the accuracy of the model itself against the time of its right-hand side.
#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "report/effects_plot.hpp"
#include "report/json_output.hpp"
#include "run/scene_comparison.hpp"
#include "run/shared.hpp"

namespace dalembert {

namespace {

std::string percent(double share) { return share < 1e-15 ? "0" : share < 1e-3 ? fmt::format("{:.1e}", share) : share < 0.1 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share); }

std::string deviation(const ComparedScene& scene, bool is_reference) {
    if (is_reference) return "compared with";
    for (const Deviation& d : scene.deviations)
        if (std::isnan(d.largest)) return d.output.substr(0, d.output.find(" [")) + " is not a number";
    const Deviation* worst = scene.worst();
    if (worst == nullptr) return scene.deviations.empty() ? "no output in common" : "outputs are zero there";
    const std::string text = worst->relative > 0 ? fmt::format("{} of {}", percent(worst->relative), worst->output.substr(0, worst->output.find(" ["))) : "none";
    return scene.status == "success" ? text : fmt::format("{}, up to t = {:.4g} s: {}", text, scene.until, scene.status);
}

std::string table(const SceneComparison& comparison) {
    std::size_t width = 5;
    for (const ComparedScene& s : comparison.scenes) width = std::max(width, s.wish.size());
    const auto line = [&](const auto&... cells) { return fmt::format("{:<{}}  {:>6}  {:>10}  {:>10}  {:>7}  {:>15}  {:>6}  {}\n", cells...); };
    std::string text = line("scene", width, "states", "parameters", "operations", "ns", "spread", "bytes", "largest deviation of an output");
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
                text += line(s.wish, width, s.states, s.parameters, s.operations, fmt::format("{:.1f}", s.median()), fmt::format("{:.1f} .. {:.1f}", s.nanoseconds.front(), s.nanoseconds.back()), s.bytes,
                             deviation(s, i == comparison.against));
        }
    }
    return text;
}

/// One line a scene and output; a scene without outputs in common has one line.
std::string csv(const SceneComparison& comparison) {
    std::string text = "scene,states,parameters,operations,ns,ns_lowest,ns_highest,bytes,output,largest_deviation,relative_deviation,status\n";
    for (const ComparedScene& s : comparison.scenes) {
        if (!s.is_known()) continue;
        const std::string cost = fmt::format("{},{},{},{},{:.4g},{:.4g},{:.4g},{}", s.wish, s.states, s.parameters, s.operations, s.median(), s.nanoseconds.front(), s.nanoseconds.back(), s.bytes);
        if (s.deviations.empty()) text += fmt::format("{},,,,{}\n", cost, s.status);
        for (const Deviation& d : s.deviations) text += fmt::format("{},{},{},{},{}\n", cost, d.output, d.largest, std::isfinite(d.relative) ? fmt::format("{}", d.relative) : "", s.status);
    }
    return text;
}

nlohmann::ordered_json as_json(const SceneComparison& comparison) {
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

ExitCode effects_command(const Options& options, Streams streams) {
    const auto model = loaded(options, streams);
    const SceneComparison comparison = compare_scenes(model, options, streams);
    const std::string& against = comparison.scenes[comparison.against].wish;
    const Scene scene = select_scene(model->model, model->names, against, options.choice.sizes);
    const std::filesystem::path base = std::filesystem::path(options.output) / (scene.sized_name() + "_effects");
    FileContents files{{base.string() + ".csv", csv(comparison)}};
    if (!options.no_plot)
        for (auto& [ending, picture] : effects_plot(comparison, model->model.title.empty() ? scene.sized_name() : model->model.title)) files.emplace_back(base.string() + ending, picture);
    write_files(files);
    if (options.format == "json") {
        nlohmann::ordered_json json = json_result("effects", model->model);
        json["against"] = against;
        json["scenes"] = as_json(comparison);
        json["files"] = nlohmann::ordered_json::array();
        for (const auto& [path, content] : files) json["files"].push_back(path.string());
        streams.out << printed(json);
    } else {
        streams.out << fmt::format("{}, compared with scene '{}'; ns and bytes are of the right-hand side\n\n", scene.sized_name(), against) << table(comparison) << "\n";
        for (const auto& [path, content] : files) streams.out << path.string() << "\n";
    }
    return ExitCode::good;
}

}  // namespace dalembert
