// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "book/printed_verdicts.hpp"
#include "command/report.hpp"
#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "elements/runs.hpp"
#include "report/small_plot.hpp"
#include "run/plant_run.hpp"
#include "run/run_preparation.hpp"
#include "run/shared.hpp"

namespace dalembert {

namespace {

/// The run of a scene where nobody asks for one: that of `simulate`, or else the first that belongs to the scene.
std::string usual_run(const Model& model, const std::string& scene) {
    const Run* usual = find_run(model, "");
    if (usual == nullptr || usual->scene.empty() || usual->scene == scene) return "";
    for (const Run& run : model.runs)
        if (run.scene == scene) return run.name;
    return "";
}

/// What is missing for a run of a scene; nothing where there is one, or nothing moves.
std::optional<std::string> missing_run(const Model& model, const std::string& run, const Scene& scene) {
    if (scene.coordinates.empty() && scene.states.empty()) return std::nullopt;
    const Run* found = find_run(model, run);
    if (found == nullptr)
        return model.runs.empty() ? "the model has no run; a table [runs.reference], with the length of the run in s as `until`, makes one"
                                  : "none of the runs of the model is called `reference`, so --run must name one";
    if (found->scene.empty() || found->scene == scene.base) return std::nullopt;
    return fmt::format(
        "the model has no run of it; a table [runs.{0}], with scene = \"{0}\" and the length of the run in s as `until`, makes one",
        scene.base);
}

/// The scene with the run that `simulate` would make of it, or without one and the reason.
ScenePage prepare_scene(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, Options options) {
    ScenePage page;
    if (options.run.empty()) options.run = usual_run(model->model, scene);
    page.named_run = options.run;
    try {
        page.run.emplace(prepare_run(model, scene, options, "report"));
        if (page.run->machine.fields) {
            page.reason = "cells of its rods or blocks are computed in loops, which the JavaScript of a page does not have yet.";
            page.machine = std::move(page.run->machine);
            page.run.reset();
        }
        if (page.run) page.formulas = formulas_of_run(RunPreparation(model->model, options), *page.run);
    } catch (const Failure& failure) {
        page.run.reset();
        page.machine = derive_machine(model, scene, options.choice.sizes);
        page.reason =
            missing_run(model->model, options.run, page.machine->system->scene).value_or(failure.diagnostics().front().message) + ".";
        generate(*page.machine);
    }
    page.proofs = checked_scene(page.derived());
    return page;
}

/// A small plot of the run as `simulate` makes it; empty where there is none, as without a compiler.
std::string picture_of(const PreparedRun& run, const Options& options) {
    if (run.settings.plots.empty()) return {};
    const Plot& plot = run.settings.plots.front();
    try {
        const PlantLibrary library(source_of_plant(*run.machine.code, run.header, run.settings), plant_cache(options));
        const PlantRunResult result = simulate_plant(library.table(), run_of_plant(*run.machine.system, run.values, run.settings));
        const std::string svg = small_plot(for_plots(result.recording, shown_units(*run.machine.system)), {plot.title, plot.x, plot.y});
        return svg.substr(svg.find("<svg"));  // without the licence of a file
    } catch (const Failure&) {
        return {};
    }
}

}  // namespace

MadePage make_page(const Options& options, Streams streams, bool with_picture, const std::string& watching) {
    const auto model = loaded(options, streams);
    const std::vector<std::string> names = options.choice.scene.empty()
                                               ? scene_names(model->model)
                                               : std::vector<std::string>{resolve_scene(model->model, options.choice.scene)};
    std::vector<ScenePage> scenes;
    PrintedVerdicts printed(true);
    for (const std::string& name : names) {
        scenes.push_back(prepare_scene(model, name, options));
        const Machine& machine = scenes.back().derived();
        show_warnings(machine, streams);
        // Checks may take longer than all else.
        if (!model->model.printed.empty())
            streams.err << fmt::format("  {}, scene {}: derived and proven; checking printed equations\n", model->model.name, name);
        printed.add(*machine.system);
        for (const Machine& other : machine.other_modes) printed.add(*other.system);
    }
    MadePage made;
    ReportResult::Page& told = made.told;
    told.model = model->model.name;
    const Run* usual = find_run(model->model, options.run);
    told.first_scene = usual != nullptr && !usual->scene.empty() ? usual->scene : model->model.default_scene;
    told.page = std::filesystem::path(options.output) / (model->model.name + ".html");
    const std::string file = std::filesystem::path(options.choice.model).filename().string();
    made.html = machine_page(model->model, file, scenes, printed.rows(), told, watching);
    if (!with_picture) return made;
    const auto shown = std::find_if(scenes.begin(), scenes.end(), [&](const ScenePage& scene) {
        return scene.run && (scenes.size() == 1 || scene.run->machine.system->scene.name == told.first_scene);
    });
    if (shown != scenes.end()) told.picture = picture_of(*shown->run, options);
    return made;
}

ExitCode report_command(const Options& options, Streams streams) {
    ReportResult result;
    FileContents files;
    const bool has_index = options.models.size() > 1;
    if (has_index) result.index = std::filesystem::path(options.output) / "index.html";
    std::map<std::filesystem::path, std::string> taken;
    for (const std::string& path : options.models) {
        Options one = options;
        one.choice.model = path;
        MadePage made = make_page(one, streams, has_index);
        if (made.told.page == result.index)
            throw Failure(
                Diagnostic{Id::bad_option,
                           {},
                           fmt::format("{} is a model called 'index', and its page would take the place of the list of pages", path)});
        const auto [same, is_new] = taken.emplace(made.told.page, path);
        if (!is_new)
            throw Failure(Diagnostic{Id::bad_option,
                                     {},
                                     fmt::format("{} and {} are models called '{}', and their pages would have the same name; "
                                                 "give them to two calls with different folders",
                                                 same->second, path, made.told.model)});
        if (has_index)
            streams.err << fmt::format("  [{:>2}/{}] {}: {} kB\n", result.pages.size() + 1, options.models.size(), made.told.model,
                                       (made.html.size() + 500) / 1000);
        files.emplace_back(made.told.page, std::move(made.html));
        result.pages.push_back(std::move(made.told));
    }
    if (has_index) files.emplace_back(result.index, index_page(result));
    write_files(files);
    write_result(result, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert
