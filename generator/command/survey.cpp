// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <future>
#include <numeric>
#include <ostream>
#include <thread>

#include "report/json_output.hpp"
#include "book/printed_verdicts.hpp"
#include "run/shared.hpp"
#include "run/simulation.hpp"

namespace dalembert {

namespace {

struct SurveyRow {
    std::string name;
    std::size_t degrees = 0;
    int operations = 0;
    double generation_seconds = 0;
    std::size_t equations = 0;
    std::size_t as_expected = 0;
    std::size_t misprints = 0;
    bool all_proven = false;
    PreparedSimulation simulation;
    SimulationReport report = {};
};

/// Everything that needs GiNaC: derived, proven, generated, checked against the printed equations.
SurveyRow prepare_row(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Options& options) {
    SurveyRow row;
    row.simulation = prepare_simulation(model, scene, options);
    const Machine& machine = row.simulation.machine;
    row.name = fmt::format("{}, {}", machine.system->scene.sized_name(), machine.system->scene.name);
    row.degrees = machine.system->symbols.degrees();
    row.operations = operations(machine, Function::rhs).total();
    for (const StageReport& stage : machine.stages) row.generation_seconds += stage.seconds;
    PrintedVerdicts verdicts;
    verdicts.add(*machine.system);
    for (const Machine& other : machine.other_modes) verdicts.add(*other.system);
    // Only what one scene runs is shown, so its row answers for what the book prints of the others too.
    for (const std::string& other : options.every_scene ? std::vector<std::string>() : scene_names(model->model))
        if (other != scene) verdicts.add(*derive_machine(model, other, options.choice.sizes).system);
    for (const PrintedRow& printed : verdicts.rows()) {
        if (!printed.found) continue;
        ++row.equations;
        row.as_expected += printed.as_expected() ? 1 : 0;
        row.misprints += printed.verdict() == Verdict::wrong || printed.verdict() == Verdict::dimensionally_wrong ? 1 : 0;
    }
    row.all_proven = proofs_of(machine).all_proven();
    return row;
}

/// Compiles and runs on all processors; progress goes to err.
void run_all(std::vector<SurveyRow>& rows, const Options& options, Streams streams) {
    const std::size_t workers = std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::future<SimulationReport>> running;
    std::size_t started = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (; started < rows.size() && started < i + workers; ++started) {
            const PreparedSimulation& simulation = rows[started].simulation;
            running.push_back(std::async(std::launch::async, [&simulation, folder = options.output] { return run_simulation(simulation, folder); }));
        }
        rows[i].report = running[i].get();
        streams.err << fmt::format("  [{:>2}/{}] {}: compiled and run\n", i + 1, rows.size(), rows[i].name);
    }
}

std::string table(const std::vector<SurveyRow>& rows) {
    std::size_t width = 14;
    for (const SurveyRow& row : rows) width = std::max(width, row.name.size());
    const auto line = [&](const auto&... cells) { return fmt::format("{:<{}}  {:>3}  {:>10}  {:>10}  {:>7}  {:>9}  {:>9}  {:>12}\n", cells...); };
    std::string text = line("system, scene", width, "dof", "operations", "generation", "proofs", "equations", "misprints", "energy error");
    text += line("", width, "", "of the rhs", "[ms]", "", "checked", "found", "of the run");
    for (const SurveyRow& row : rows)
        text += line(row.name, width, row.degrees, row.operations, fmt::format("{:.1f}", 1000 * row.generation_seconds), row.all_proven ? "proven" : "partly",
                     fmt::format("{}/{}", row.as_expected, row.equations), row.misprints,
                     row.report.is_good() ? fmt::format("{:.1e}", row.report.energy_error) : row.report.status);
    return text;
}

}  // namespace

ExitCode survey_command(const Options& options, Streams streams) {
    std::vector<std::shared_ptr<const LoadedModel>> models;
    std::vector<SurveyRow> rows;
    for (const std::string& path : options.models) {
        Options one = options;
        one.choice.model = path;
        const auto model = loaded(one, streams);
        // A size is meant for the models that have it.
        std::erase_if(one.choice.sizes, [&](const auto& size) {
            return std::none_of(model->model.sizes.begin(), model->model.sizes.end(), [&](const Size& s) { return s.name == size.first; });
        });
        // A run that belongs to one scene is a row of that scene alone.
        const std::string bound = scene_of_run(model->model, options.run);
        const auto scenes = !bound.empty() ? std::vector<std::string>{bound} : options.every_scene ? scene_names(model->model) : std::vector<std::string>{resolve_scene(model->model, "")};
        for (const std::string& scene : scenes) {
            rows.push_back(prepare_row(model, scene, one));
            streams.err << fmt::format("  {}: derived, proven, generated\n", rows.back().name);
        }
    }
    run_all(rows, options, streams);
    FileContents files;
    for (const SurveyRow& row : rows) files.insert(files.end(), row.report.files.begin(), row.report.files.end());
    write_files(files);

    bool failed = false;
    bool stopped = false;
    nlohmann::ordered_json json{{"schema", "dalembert/survey"}, {"version", json_version}, {"systems", nlohmann::ordered_json::array()}};
    for (const SurveyRow& row : rows) {
        failed = failed || row.as_expected != row.equations || (row.report.is_good() && !row.report.keeps_energy());
        if (row.report.is_good() && !row.report.keeps_energy()) streams.err << fmt::format("dalembert: warning: {}: {}\n", row.name, energy_warning(row.simulation, row.report));
        stopped = stopped || !row.report.is_good();
        json["systems"].push_back({{"model", row.simulation.machine.system->scene.model->name},
                                   {"scene", row.simulation.machine.system->scene.name},
                                   {"degrees_of_freedom", row.degrees},
                                   {"operations", row.operations},
                                   {"generation_seconds", row.generation_seconds},
                                   {"all_proven", row.all_proven},
                                   {"equations", row.equations},
                                   {"as_expected", row.as_expected},
                                   {"misprints", row.misprints},
                                   {"status", row.report.status},
                                   {"steps", row.report.steps},
                                   {"energy_error", row.report.energy_error}});
    }
    if (options.format == "json") {
        streams.out << printed(json);
    } else {
        streams.out << table(rows) << "\nheaders, CSV files and plots:\n";
        for (const SurveyRow& row : rows) {
            std::string endings;
            for (const auto& [path, content] : row.report.files) endings += (endings.empty() ? "" : ",") + path.extension().string().substr(1);
            streams.out << fmt::format("  {}.{{{}}}\n", (std::filesystem::path(options.output) / row.simulation.name).string(), endings);
        }
    }
    return failed ? ExitCode::check_failed : stopped ? ExitCode::run_stopped : ExitCode::good;
}

}  // namespace dalembert
