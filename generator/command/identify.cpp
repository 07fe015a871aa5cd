// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/identify.hpp"

#include <fmt/format.h>

#include <dalembert/plot.hpp>

#include "check/written_values.hpp"
#include "command/write_result.hpp"
#include "language/parser.hpp"
#include "run/shared.hpp"

namespace dalembert {

namespace {

/// "d_R=normal(0.3, 5 %)"
class PriorReader {
public:
    explicit PriorReader(const FitRun& run) : run_(run), system_(*run.machine().system) {}

    std::vector<Prior> read(const std::vector<std::string>& lists) const {
        std::vector<Prior> priors;
        for (const std::string& list : lists)
            for (const Excerpt& part : parts_of_list(std::make_shared<const Source>("--prior", list))) read(part, priors);
        return priors;
    }

private:
    void read(const Excerpt& part, std::vector<Prior>& priors) const {
        constexpr std::string_view head = "=normal(";
        const auto begin = part.text.find(head), comma = part.text.rfind(',');
        if (begin == std::string::npos || comma == std::string::npos || comma < begin || !part.text.ends_with(")"))
            throw Failure(Diagnostic{Id::bad_option, part.whole(),
                                     fmt::format("'--prior {}' is not of the form NAME=normal(MEAN, DEVIATION)", part.text)});
        const std::string name = part.text.substr(0, begin);
        const Span mean = part.span(begin + head.size(), comma);
        Span deviation = part.span(comma + 1, part.text.size() - 1);
        bool found = false;
        for (std::size_t k = 0; k < run_.unknowns().size(); ++k) {
            const Fitted& one = run_.fitted(run_.unknowns()[k]);
            if (one.name != name && run_.name(run_.unknowns()[k]) != name) continue;
            found = true;
            const double middle = number(mean, one, false);
            const auto percent = deviation.text().find('%');
            Prior prior{k, middle, 0};
            if (percent != std::string_view::npos) {
                deviation.end = deviation.begin + percent;
                prior.deviation = std::fabs(middle) * number_alone(deviation) / 100;
            } else {
                prior.deviation = number(deviation, one, true);
            }
            if (!(prior.deviation > 0))
                throw Failure(Diagnostic{Id::value_out_of_range, deviation, fmt::format("the deviation of '{}' must be above zero", name)});
            priors.push_back(prior);
        }
        if (!found)
            throw Failure(Diagnostic{Id::unknown_name, part.whole(),
                                     fmt::format("'{}' is not fitted, so it has no prior; --fit names what is", name)});
    }
    double number_alone(const Span& place) const {
        const ExpressionPtr e = parse_expression(excerpt_of(place.source, place.begin, place.end));
        return double_of(system_.translate(*e, {}), place);
    }
    double number(const Span& place, const Fitted& one, bool is_difference) const {
        const ShownNumber& shown = one.shown;
        ExpressionPtr e = parse_expression(excerpt_of(place.source, place.begin, place.end));
        const std::string text = shown.declared_unit.empty() ? shown.unit : shown.declared_unit;
        Unit unit = text.empty() ? Unit{} : parse_unit(excerpt_of(std::make_shared<const Source>("unit", text)));
        if (is_difference) unit.offset = 0;
        e = in_si(e, unit, fmt::format("the prior of '{}'", one.name), system_.names);
        return double_of(system_.translate(*e, {}), place);
    }

    const FitRun& run_;
    const System& system_;
};

Loss loss_named(const std::string& name) { return name == "huber" ? Loss::huber : name == "cauchy" ? Loss::cauchy : Loss::none; }

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
    settings.loss = loss_named(options.loss);
    settings.priors = PriorReader(run).read(options.priors);
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
