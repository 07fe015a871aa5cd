// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/survey.hpp"

#include <fmt/format.h>

#include "book/printed_verdicts.hpp"
#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "run/in_parallel.hpp"
#include "run/shared.hpp"
#include "run/simulation.hpp"

namespace dalembert {

namespace {

/// A row with what is run for it.
struct SurveyedRun {
    SurveyRow row;
    PreparedSimulation simulation;
    SimulationReport report = {};
};

void count_printed(SurveyRow& row, const PrintedVerdicts& verdicts) {
    for (const PrintedRow& printed : verdicts.rows()) {
        if (!printed.found) continue;
        ++row.equations;
        row.as_expected += printed.as_expected() ? 1 : 0;
        row.misprints += printed.verdict() == Verdict::wrong || printed.verdict() == Verdict::dimensionally_wrong ? 1 : 0;
    }
}

/// Everything that needs GiNaC: derived, proven, generated, checked against the printed equations.
SurveyedRun prepare_row(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Options& options) {
    PreparedSimulation simulation = prepare_simulation(model, scene, options);
    const Machine& machine = simulation.machine;
    SurveyRow row{.subject = subject_of(machine.system->scene)};
    row.subject.mode.clear();  // of all modes
    row.degrees = machine.system->symbols.degrees();
    row.operations = operations(machine, Function::rhs).total();
    for (const StageReport& stage : machine.stages) row.generation_seconds += stage.seconds;
    PrintedVerdicts verdicts;
    verdicts.add(*machine.system);
    for (const Machine& other : machine.other_modes) verdicts.add(*other.system);
    // Only what one scene runs is shown, so its row answers for what the book prints of the others too.
    for (const std::string& other : options.every_scene ? std::vector<std::string>() : scene_names(model->model))
        if (other != scene) verdicts.add(*derive_machine(model, other, options.choice.sizes).system);
    count_printed(row, verdicts);
    row.all_proven = proofs_of(machine).all_proven();
    return {std::move(row), std::move(simulation)};
}

/// All rows of one model.
void prepare_model(const std::string& path, const Options& options, std::vector<SurveyedRun>& runs, Streams streams) {
    Options one = options;
    one.choice.model = path;
    const auto model = loaded(one, streams);
    // A size is meant for the models that have it.
    std::erase_if(one.choice.sizes, [&](const auto& size) {
        return std::none_of(model->model.sizes.begin(), model->model.sizes.end(), [&](const Size& s) { return s.name == size.first; });
    });
    // A run that belongs to one scene is a row of that scene alone.
    std::vector<std::string> scenes{scene_of_run(model->model, options.run)};
    if (scenes[0].empty())
        scenes = options.every_scene ? scene_names(model->model) : std::vector<std::string>{resolve_scene(model->model, "")};
    for (const std::string& scene : scenes) {
        runs.push_back(prepare_row(model, scene, one));
        streams.err << fmt::format("  {}: derived, proven, generated\n", runs.back().row.name());
    }
}

/// Compiles and runs on all processors; progress goes to err.
void run_all(std::vector<SurveyedRun>& runs, const Options& options, Streams streams) {
    in_parallel(
        runs.size(), [&](std::size_t i) { return run_simulation(runs[i].simulation, options.output); },
        [&](std::size_t i, SimulationReport report) {
            runs[i].report = std::move(report);
            streams.err << fmt::format("  [{:>2}/{}] {}: compiled and run\n", i + 1, runs.size(), runs[i].row.name());
        });
}

SurveyRow with_run(SurveyRow row, const SimulationReport& report) {
    row.status = report.status;
    row.is_good = report.is_good();
    row.keeps_energy = report.keeps_energy();
    row.steps = report.steps;
    row.energy_error = report.energy_error;
    row.files = paths_of(report.files);
    return row;
}

}  // namespace

ExitCode survey_command(const Options& options, Streams streams) {
    std::vector<SurveyedRun> runs;
    for (const std::string& path : options.models) prepare_model(path, options, runs, streams);
    run_all(runs, options, streams);
    SurveyResult result{options.output, {}};
    FileContents files;
    for (const SurveyedRun& run : runs) {
        result.rows.push_back(with_run(run.row, run.report));
        files.insert(files.end(), run.report.files.begin(), run.report.files.end());
    }
    write_files(files);
    bool failed = false, stopped = false;
    for (const SurveyedRun& run : runs) {
        if (run.report.is_good() && !run.report.keeps_energy())
            streams.err << fmt::format("dalembert: warning: {}: {}\n", run.row.name(), energy_warning(run.simulation, run.report));
        stopped = stopped || !run.report.is_good();
    }
    for (const SurveyRow& row : result.rows) failed = failed || row.failed();
    write_result(result, options, streams);
    return failed ? ExitCode::check_failed : stopped ? ExitCode::run_stopped : ExitCode::good;
}

}  // namespace dalembert
