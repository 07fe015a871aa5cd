// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy costs in time: work-precision diagrams of machines, and advice.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <ostream>

#include "report/budget.hpp"
#include "report/json_output.hpp"
#include "report/precision_plot.hpp"
#include "report/precision_table.hpp"
#include "run/shared.hpp"

namespace dalembert {

namespace {

/// A variant with what was measured of it.
struct Measured {
    Variant variant;
    std::vector<WorkPoint> points;
};

/// Rows are added as they are measured, so that a measurement that was stopped goes on where it was.
class Notes {
public:
    Notes(std::filesystem::path path, std::uint64_t fingerprint) : path_(std::move(path)), title_(fmt::format("{:016x}", fingerprint)) {
        std::ifstream file(path_);
        std::string line;
        if (!std::getline(file, line) || line != title_) return;
        while (std::getline(file, line)) {
            // Of a line that is not whole nothing is taken.
            const auto point = read_csv_line(line);
            if (!point || file.eof()) break;
            known_.push_back(*point);
        }
    }
    std::size_t count() const { return known_.size(); }
    const WorkPoint* find(const RunPlan& plan) const {
        for (const WorkPoint& p : known_)
            if (p.plan.arithmetic == plan.arithmetic && p.plan.method == plan.method && fmt::format("{:g} {:.9g}", p.plan.tolerance, p.plan.step) == fmt::format("{:g} {:.9g}", plan.tolerance, plan.step)) return &p;
        return nullptr;
    }
    /// All lines up to now; written whole, since a folder may be read by others.
    void write(const std::vector<WorkPoint>& points) const {
        std::string text = title_ + "\n";
        for (const WorkPoint& p : points) text += csv_line("", "", p);
        write_files({{path_, text}});
    }
    void remove() const { std::filesystem::remove(path_); }

private:
    std::filesystem::path path_;
    std::string title_;
    std::vector<WorkPoint> known_;
};

/// All curves, from coarse to fine; progress goes to err.
std::vector<WorkPoint> measure(const WorkPrecision& work, const Notes& notes, const Options& options, Streams streams) {
    const std::string& name = work.run().name;
    if (notes.count() > 0) streams.err << fmt::format("  {}: goes on behind {} runs that were measured before\n", name, notes.count());
    std::vector<WorkPoint> points;
    if (!work.run().settings.series && is_wanted(options.methods, "taylor")) streams.err << fmt::format("  {}: without taylor: {}\n", name, work.run().machine.no_series.empty() ? "an input has no series" : work.run().machine.no_series);
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
            streams.err << fmt::format("  {}: {} in {}: {} of {} runs came to the end\n", name, method, arithmetic, good, curve.size());
        }
    }
    return points;
}

nlohmann::ordered_json as_json(const Measured& m) {
    const Variant& v = m.variant;
    const ReferenceRun& reference = v.work->reference();
    nlohmann::ordered_json json{{"scene", v.scene}, {"size", v.size}, {"states", v.states}, {"from_fullest", v.from_fullest}};
    json["reference"] = {{"arithmetic", reference.plan.arithmetic}, {"method", reference.plan.method}, {"tolerance", reference.plan.tolerance}, {"error", reference.error}, {"closed_forms", reference.closed_forms}, {"growth", reference.growth ? nlohmann::ordered_json(*reference.growth) : nlohmann::ordered_json()}, {"counted_until", reference.until()}};
    json["runs"] = nlohmann::ordered_json::array();
    for (const WorkPoint& p : m.points)
        json["runs"].push_back({{"arithmetic", p.plan.arithmetic}, {"method", p.plan.method}, {"tolerance", p.plan.tolerance}, {"step", p.plan.step}, {"status", p.status}, {"good", p.is_good}, {"steps", p.steps}, {"rejected", p.rejected}, {"rhs_calls", p.rhs_calls},
                                {"microseconds", {{"median", p.microseconds}, {"lowest", p.fastest}, {"highest", p.slowest}}}, {"error_at_end", p.error_at_end}, {"error_on_the_way", p.error}, {"energy_error", p.energy_error}, {"constraint_error", p.constraint_error}});
    json["cheapest"] = nlohmann::ordered_json::array();
    for (const double error : wanted_errors)
        if (const WorkPoint* best = cheapest(m.points, error)) {
            const WorkPoint* usual = cheapest(m.points, error, "double", "dopri5");
            nlohmann::ordered_json row{{"error", error}, {"arithmetic", best->plan.arithmetic}, {"method", best->plan.method}, {"tolerance", best->plan.tolerance}, {"step", best->plan.step}, {"microseconds", best->fastest}};
            if (usual != nullptr) row["share_of_dopri5"] = best->fastest / usual->fastest;
            json["cheapest"].push_back(std::move(row));
        }
    return json;
}

/// One line a machine: the cheapest way to each accuracy, in units of dopri5 in double.
std::string summary_line(const Measured& m, std::size_t width) {
    const Variant& v = m.variant;
    std::string text = fmt::format("{:<{}}  {:>6}", v.name(), width, v.states);
    for (const double error : wanted_errors) {
        const WorkPoint* best = cheapest(m.points, error);
        const WorkPoint* usual = cheapest(m.points, error, "double", "dopri5");
        std::string cell = "not reached";
        if (best != nullptr) {
            cell = best->plan.method;
            if (best->plan.step <= 0) cell += fmt::format(" {:.0e}", best->plan.tolerance);
            if (best->plan.arithmetic != "double") cell += " in " + best->plan.arithmetic;
            if (usual != nullptr) cell += fmt::format(", {:.2f}", best->fastest / usual->fastest);
        }
        text += fmt::format("  {:<30}", cell);
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

std::string summary(const std::vector<Measured>& all) {
    std::size_t width = 8;
    for (const Measured& m : all) width = std::max(width, m.variant.name().size());
    std::string text = fmt::format("{:<{}}  {:>6}", "machine", width, "states");
    for (const double error : wanted_errors) text += fmt::format("  {:<30}", fmt::format("cheapest for {:.0e}", error));
    text = text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
    for (const Measured& m : all) text += summary_line(m, width);
    return text + "behind each method and tolerance: its time as a share of that of dopri5 in double for the same accuracy, where that was measured and reaches it\n";
}

}  // namespace

ExitCode cost_command(const Options& options, Streams streams) try {
    const auto budget = options.budget.empty() ? std::nullopt : std::optional(read_budget(options.budget));
    const bool is_one = options.models.size() == 1;
    if (!is_one && !options.choice.scene.empty()) throw Failure(Diagnostic{Id::bad_option, {}, "of several models no scene can be chosen; --every-scene takes all"});
    if (!is_one && budget) throw Failure(Diagnostic{Id::bad_option, {}, "a budget is asked for of one model"});
    std::vector<Measured> all;
    std::vector<Notes> notes;
    FileContents files;
    std::string text;
    const std::filesystem::path folder = options.output;
    for (const std::string& path : options.models) {
        Options one = options;
        one.choice.model = path;
        const auto model = loaded(one, streams);
        const bool every = options.every_scene || (is_one && options.choice.scene.empty());
        const std::string bound = scene_of_run(model->model, options.run);
        const auto scenes = every ? scene_names(model->model) : std::vector<std::string>{is_one ? options.choice.scene : bound.empty() ? resolve_scene(model->model, "") : bound};
        std::vector<Variant> variants = make_variants(model, scenes, every || !is_one, one, streams, [&](const PreparedRun& run) {
            if (budget) check_run(run, *budget);
        });
        if (budget && !variants.empty()) return budget_command(variants, *budget, one, streams);
        std::string csv = csv_titles();
        for (Variant& v : variants) {
            notes.emplace_back(folder / (v.name() + "_cost.unfinished"), v.work->fingerprint());
            const std::vector<WorkPoint> points = measure(*v.work, notes.back(), one, streams);
            for (const WorkPoint& p : points) csv += csv_line(v.scene, v.size, p);
            text += fmt::format("{}\n{}", v.name(), advice(*v.work, points));
            if (v.from_fullest > 0) text += fmt::format("off by {:.1e} from the fullest scene in the finest size, whatever the integrator\n", v.from_fullest);
            text += "\n";
            const std::string title = (model->model.title.empty() ? model->model.name : model->model.title) + " (" + v.scene + (v.size.empty() ? "" : ", " + v.size) + ")";
            if (!options.no_plot)
                for (auto& [ending, picture] : precision_plot(*v.work, points, {{"error of the reference", v.work->reference().error}, {"effects left out", v.from_fullest}}, title)) files.emplace_back(folder / (v.name() + "_cost" + ending), picture);
            all.push_back({std::move(v), points});
        }
        if (!variants.empty()) files.emplace_back(folder / (model->model.name + "_cost.csv"), csv);
    }
    write_files(files);
    for (const Notes& done : notes) done.remove();
    if (options.format == "json") {
        nlohmann::ordered_json json{{"schema", "dalembert/cost"}, {"version", json_version}, {"machines", nlohmann::ordered_json::array()}};
        for (const Measured& m : all) {
            nlohmann::ordered_json row{{"model", m.variant.work->run().machine.system->scene.model->name}};
            row.update(as_json(m));
            json["machines"].push_back(std::move(row));
        }
        json["files"] = nlohmann::ordered_json::array();
        for (const auto& [path, content] : files) json["files"].push_back(path.string());
        streams.out << printed(json);
    } else {
        streams.out << text << (all.size() > 1 ? summary(all) + "\n" : "");
        for (const auto& [path, content] : files) streams.out << path.string() << "\n";
    }
    return all.empty() ? ExitCode::run_stopped : ExitCode::good;
} catch (const RunStopped& stopped) {
    streams.err << fmt::format("dalembert: {}\n", stopped.what());
    return ExitCode::run_stopped;
}

}  // namespace dalembert
