// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/identify.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <dalembert/plot.hpp>

#include "command/write_result.hpp"
#include "identify/priors.hpp"
#include "run/shared.hpp"

namespace dalembert {

namespace {

/// Simulated values as lines, measured ones as points, in declared units.
std::string picture_of(const Experiment& experiment, const RunBesideData& comparison, const System& system) {
    Recording recording = comparison_table(experiment, comparison);
    std::vector<Panel> panels;
    std::vector<ShownUnit> units;
    for (const ShownUnit& unit : shown_units(system))
        for (const char* part : {"", " measured"}) units.push_back({unit.column + part, unit.unit, unit.factor, unit.offset});
    for (const Measured& measured : experiment.measured) panels.push_back({"", "", {measured.column}, {measured.column + " measured"}});
    const ScratchFolder scratch;
    const std::string base = (std::filesystem::path(scratch.path()) / "fit").string();
    if (!draw(for_plots(recording, units), panels, experiment.name, base)) return "";
    const std::string svg = read_file(base + ".svg");
    return svg.substr(svg.find("<svg"));
}

}  // namespace

ExitCode identify_command(const Options& options, Streams streams) {
    std::vector<DataFile> files;
    for (const std::string& file : options.data) files.push_back(read_data_file(file));
    const FitRun run(loaded(options, streams), options, options.fit, files);
    show_warnings(run.machine(), streams);
    streams.err << run.doubts();
    FitSettings settings;
    settings.loss = static_cast<Loss>(std::find(loss_names.begin(), loss_names.end(), options.loss) - loss_names.begin());
    settings.priors = read_priors(options.priors, run);
    settings.starts = options.starts;
    settings.seed = options.seed;
    std::optional<Fit> found;
    try {
        found = fit(run, settings);
    } catch (const RunStopped& stopped) {
        streams.err << fmt::format("dalembert: {}: {}; begin with other values, as by --parameter NAME=VALUE\n",
                                   subject_of(run.machine().system->scene).title(), stopped.what());
        return ExitCode::run_stopped;
    }
    const System& system = *run.machine().system;
    IdentifyResult result = result_of(run, *found, statistics_of(run, *found, settings), settings);
    const std::filesystem::path folder = options.output;
    const std::string name = fmt::format("{}_{}", system.scene.sized_name(), system.scene.name);
    FileContents contents{{folder / (name + "_identified.toml"), parameter_file(result)}};
    std::vector<std::string> pictures;
    for (std::size_t e = 0; e < run.experiments().size(); ++e) {
        const Experiment& experiment = run.experiments()[e];
        const std::string stem = std::filesystem::path(experiment.name).stem().string();
        contents.emplace_back(folder / fmt::format("{}_fit_{}_{}.csv", name, e + 1, stem),
                              csv_text(comparison_table(experiment, found->comparisons[e])));
        pictures.push_back(options.no_plot ? "" : picture_of(experiment, found->comparisons[e], system));
    }
    contents.emplace_back(folder / (name + "_identified.html"), identify_page(result, pictures));
    write_files(contents);
    result.files = paths_of(contents);
    write_result(result, options, streams);
    explain(run.machine().stages, run.plant(), options, streams);
    const bool lacks_picture =
        !options.no_plot && std::any_of(pictures.begin(), pictures.end(), [](const std::string& p) { return p.empty(); });
    if (lacks_picture) {
        streams.err
            << "dalembert: no plot: gnuplot is missing or failed (on Debian: apt-get install gnuplot-nox); --no-plot leaves it out\n";
        return ExitCode::tool_missing;
    }
    return result.converged ? ExitCode::good : ExitCode::check_failed;
}

}  // namespace dalembert
