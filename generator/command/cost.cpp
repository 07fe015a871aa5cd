// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy costs in time: work-precision diagrams of machines, and advice.
#include "report/cost.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "command/cost_budget.hpp"
#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "report/measurement_notes.hpp"
#include "report/precision_plot.hpp"
#include "report/precision_table.hpp"
#include "run/shared.hpp"

namespace dalembert {

namespace {

/// All curves, from coarse to fine; progress goes to err.
std::vector<WorkPoint> measure(const WorkPrecision& work, const MeasurementNotes& notes, const Options& options, Streams streams) {
    const std::string& name = work.run().name;
    if (notes.count() > 0) streams.err << fmt::format("  {}: continues after {} runs measured before\n", name, notes.count());
    std::vector<WorkPoint> points;
    if (!work.run().settings.series && is_wanted(options.methods, "taylor")) {
        const std::string& reason = work.run().machine.no_series;
        streams.err << fmt::format("  {}: without taylor: {}\n", name, reason.empty() ? "an input has no series" : reason);
    }
    for (const char* arithmetic : arithmetics) {
        if (!is_wanted(options.arithmetics, arithmetic)) continue;
        for (const std::string& method : measured_methods(options.methods, work.run())) {
            std::vector<WorkPoint> curve;
            while (const auto plan = work.next(arithmetic, method, curve)) {
                const WorkPoint* known = notes.find(*plan);
                curve.push_back(known != nullptr ? *known : work.measure(*plan));
                points.push_back(curve.back());
                if (known == nullptr) notes.write(points);
            }
            const auto good = std::count_if(curve.begin(), curve.end(), [](const WorkPoint& p) { return p.is_good; });
            streams.err << fmt::format("  {}: {} in {}: {} of {} runs reached the end\n", name, method, arithmetic, good, curve.size());
        }
    }
    return points;
}

/// With everything that is known of a variant but what is measured.
MeasuredMachine described(const Variant& v) {
    const PreparedRun& run = v.work->run();
    const Model& model = *run.machine.system->scene.model;
    return {model.name,          model.title,         v.name(), v.scene, v.size, v.states, v.from_fullest, run.settings.until,
            run.settings.method, v.work->reference(), {}};
}

FileContents plots(const MeasuredMachine& m, const std::filesystem::path& folder) {
    const std::string title = (m.title.empty() ? m.model : m.title) + " (" + m.scene + (m.size.empty() ? "" : ", " + m.size) + ")";
    FileContents files;
    for (auto& [ending, picture] :
         precision_plot(m.points, m.until, {{"error of the reference", m.reference.error}, {"effects left out", m.from_fullest}}, title))
        files.emplace_back(folder / (m.name + "_cost" + ending), picture);
    return files;
}

bool takes_every_scene(const Options& options) {
    return options.every_scene || (options.models.size() == 1 && options.choice.scene.empty());
}

/// Those of one model that are measured.
std::vector<std::string> wanted_scenes(const Model& model, const Options& options) {
    const std::string bound = scene_of_run(model, options.run);
    if (takes_every_scene(options)) return scene_names(model);
    if (options.models.size() == 1) return {options.choice.scene};
    return {bound.empty() ? resolve_scene(model, "") : bound};
}

/// All of one model, ready to be measured.
std::vector<Variant> variants_of(const std::shared_ptr<const LoadedModel>& model, const Options& options,
                                 const std::optional<Budget>& budget, Streams streams) {
    const bool may_leave_out = takes_every_scene(options) || options.models.size() > 1;
    return make_variants(model, wanted_scenes(model->model, options), may_leave_out, options, streams, [&](const PreparedRun& run) {
        if (budget) check_run(run, *budget);
    });
}

void check_options(const Options& options, const std::optional<Budget>& budget) {
    if (options.models.size() == 1) return;
    if (!options.choice.scene.empty())
        throw Failure(Diagnostic{Id::bad_option, {}, "--scene needs a single model; --every-scene takes all scenes of several models"});
    if (budget) throw Failure(Diagnostic{Id::bad_option, {}, "--budget needs a single model"});
}

}  // namespace

ExitCode cost_command(const Options& options, Streams streams) try {
    const auto budget = options.budget.empty() ? std::nullopt : std::optional(read_budget(options.budget));
    check_options(options, budget);
    CostResult result;
    std::vector<MeasurementNotes> notes;
    FileContents files;
    const std::filesystem::path folder = options.output;
    for (const std::string& path : options.models) {
        Options one = options;
        one.choice.model = path;
        const auto model = loaded(one, streams);
        const std::vector<Variant> variants = variants_of(model, one, budget, streams);
        if (variants.empty()) continue;
        if (budget) {
            const BudgetResult found = within_budget(variants, *budget, one, streams);
            write_result(found, options, streams);
            return found.best ? ExitCode::good : ExitCode::check_failed;
        }
        std::string csv = csv_titles();
        for (const Variant& v : variants) {
            notes.emplace_back(folder / (v.name() + "_cost.unfinished"), v.work->fingerprint());
            MeasuredMachine machine = described(v);
            machine.points = measure(*v.work, notes.back(), one, streams);
            for (const WorkPoint& p : machine.points) csv += csv_line(v.scene, v.size, p);
            const FileContents pictures = options.no_plot ? FileContents{} : plots(machine, folder);
            files.insert(files.end(), pictures.begin(), pictures.end());
            result.machines.push_back(std::move(machine));
        }
        files.emplace_back(folder / (model->model.name + "_cost.csv"), csv);
    }
    write_files(files);
    for (const MeasurementNotes& done : notes) done.remove();
    result.files = paths_of(files);
    write_result(result, options, streams);
    return result.machines.empty() ? ExitCode::run_stopped : ExitCode::good;
} catch (const RunStopped& stopped) {
    streams.err << fmt::format("dalembert: {}\n", stopped.what());
    return ExitCode::run_stopped;
}

}  // namespace dalembert
