// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "emit/mathml.hpp"
#include "report/json_output.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

std::string unit_of(const ShownNumber& shown) { return shown.declared_unit.empty() ? shown.unit : shown.declared_unit; }
std::string with_space(const std::string& unit) { return unit.empty() ? "" : " " + unit; }
double value_in(double value, const ShownNumber& shown) { return value / shown.of_declared - shown.offset; }
double difference_in(double value, const ShownNumber& shown) { return value / shown.of_declared; }

/// As many digits as an error has that is shown with two.
std::string to_digits_of(double value, double error) {
    if (!(error > 0) || !std::isfinite(error)) return fmt::format("{:.6g}", value);
    const auto decade = [](double x) { return static_cast<int>(std::floor(std::log10(x))); };
    return fmt::format("{:#.{}g}", value, std::clamp(decade(std::max(std::fabs(value), error)) - decade(error) + 2, 2, 15));
}

std::string with_error(const IdentifiedValue& one) {
    return to_digits_of(value_in(one.value, one.shown), difference_in(one.error, one.shown));
}

std::string error_text(const IdentifiedValue& one) {
    if (one.at_bound != 0) return fmt::format("at its {} bound", one.at_bound < 0 ? "lower" : "upper");
    if (!std::isfinite(one.error)) return "not identifiable";
    return fmt::format("{:.2g}", difference_in(one.error, one.shown));
}

std::string interval_text(const IdentifiedValue& one) {
    if (!std::isfinite(one.error)) return "";
    const double error = difference_in(one.error, one.shown);
    return fmt::format("{} to {}", to_digits_of(value_in(one.low_95, one.shown), error),
                       to_digits_of(value_in(one.high_95, one.shown), error));
}

std::string counted(std::size_t count, const char* word) { return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s"); }

/// Rows of texts as columns of one width, but for the last.
std::string table(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths(rows.front().size());
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("  {:<{}}", row[i], widths[i]);
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::vector<std::vector<std::string>> value_rows(const IdentifyResult& result) {
    std::vector<std::vector<std::string>> rows{{"name", "value", "standard error", "unit", "95 % interval", "began at"}};
    for (const IdentifiedValue& one : result.values)
        rows.push_back({one.name, with_error(one), error_text(one), unit_of(one.shown), interval_text(one),
                        fmt::format("{:.6g}", value_in(one.begin, one.shown))});
    return rows;
}

std::string white_text(double probability) {
    return std::isnan(probability) ? "too few values"
           : probability < 0.01    ? fmt::format("no ({:.1g})", probability)
                                   : fmt::format("yes ({:.2f})", probability);
}

std::vector<std::vector<std::string>> column_rows(const IdentifyResult& result) {
    std::vector<std::vector<std::string>> rows{
        {"data", "column", "values", "rms", "noise", "largest", "at t", "> 4 noise", "white", "unit"}};
    for (const ComparedColumn& one : result.columns)
        rows.push_back({one.experiment, one.column, std::to_string(one.residuals.count),
                        fmt::format("{:.3g}", difference_in(one.residuals.rms, one.shown)),
                        fmt::format("{:.3g}{}", difference_in(one.noise, one.shown), one.noise_is_given ? " (given)" : ""),
                        fmt::format("{:.3g}", difference_in(one.residuals.largest, one.shown)), fmt::format("{:.6g} s", one.residuals.at),
                        std::to_string(one.residuals.outliers), white_text(one.residuals.white), unit_of(one.shown)});
    return rows;
}

bool has_shares(const IdentifyResult& result) {
    return result.experiments.size() > 1 &&
           std::any_of(result.values.begin(), result.values.end(), [](const IdentifiedValue& one) { return one.is_common; });
}

/// Of which it is worth to speak.
std::vector<std::string> correlation_sentences(const IdentifyResult& result) {
    constexpr double worth = 0.95;
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < result.values.size(); ++i)
        for (std::size_t j = i + 1; j < result.values.size(); ++j)
            if (std::fabs(result.correlations[i][j]) > worth && std::isfinite(result.values[i].error) &&
                std::isfinite(result.values[j].error))
                sentences.push_back(fmt::format("'{}' and '{}' are hard to tell apart: their correlation is {:.3f}", result.values[i].name,
                                                result.values[j].name, result.correlations[i][j]));
    return sentences;
}

std::vector<std::string> remarks(const IdentifyResult& result) {
    std::vector<std::string> all = result.unseen;
    for (const IdentifiedValue& one : result.values)
        if (std::isfinite(one.error) && one.at_bound == 0 && one.name.find('(') == std::string::npos && one.error > std::fabs(one.value))
            all.push_back(fmt::format("the data hardly show '{}': its standard error is larger than its value", one.name));
    for (std::string& one : correlation_sentences(result)) all.push_back(std::move(one));
    for (const ComparedColumn& one : result.columns) {
        if (one.residuals.white < 0.01)
            all.push_back(
                fmt::format("the residuals of '{}' in '{}' are not white noise: the model lacks an effect, or the noise is correlated; "
                            "then the standard errors are too small",
                            one.column, one.experiment));
        if (one.residuals.outliers > 0)
            all.push_back(fmt::format("'{}' in '{}' has {} beyond four times the noise; --loss cauchy counts such values less", one.column,
                                      one.experiment, counted(one.residuals.outliers, "value")));
    }
    if (!result.converged)
        all.push_back("the search ended after its largest number of iterations; begin nearer with --parameter, or use --starts");
    if (result.starts > 1) all.push_back(fmt::format("{} of {} starts led to this fit", result.agreeing, result.starts));
    for (const std::string& note : result.notes) all.push_back(note);
    return all;
}

std::vector<std::vector<std::string>> share_rows(const IdentifyResult& result) {
    std::vector<std::vector<std::string>> rows{{"data"}};
    for (const IdentifiedValue& one : result.values)
        if (one.is_common) rows.front().push_back(one.name);
    for (std::size_t e = 0; e < result.experiments.size(); ++e) {
        rows.push_back({result.experiments[e]});
        for (std::size_t k = 0; k < result.values.size(); ++k)
            if (result.values[k].is_common) rows.back().push_back(fmt::format("{:.0f} %", 100 * result.shares[e][k]));
    }
    return rows;
}

std::string html_table(const std::vector<std::vector<std::string>>& rows) {
    std::string text = "<table>\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        text += "<tr>";
        const char* tag = i == 0 ? "th" : "td";
        for (const std::string& field : rows[i]) text += fmt::format("<{0}>{1}</{0}>", tag, html_text(field));
        text += "</tr>\n";
    }
    return text + "</table>\n";
}

nlohmann::ordered_json finite(double value) { return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(); }

}  // namespace

IdentifyResult result_of(const FitRun& run, const Fit& fit, const FitStatistics& statistics, const FitSettings& settings) {
    IdentifyResult result;
    result.subject = subject_of(run.machine().system->scene);
    result.subject.mode.clear();  // a run goes through all of them
    for (const Experiment& experiment : run.experiments()) {
        result.experiments.push_back(experiment.name);
        std::string unused;
        for (const std::string& column : experiment.unused) unused += fmt::format("{}'{}'", unused.empty() ? "" : ", ", column);
        if (!unused.empty()) result.notes.push_back(fmt::format("'{}' has columns that were not used: {}", experiment.name, unused));
    }
    for (std::size_t k = 0; k < fit.x.size(); ++k) {
        const Fitted& one = run.fitted(run.unknowns()[k]);
        result.values.push_back({run.name(run.unknowns()[k]), one.shown, fit.x[k], run.start()[k], one.low, one.high, statistics.errors[k],
                                 statistics.low[k], statistics.high[k], statistics.at_bound[k], !run.unknowns()[k].experiment});
    }
    for (const ResidualReport& report : statistics.residuals) {
        const Measured& measured = run.experiments()[report.experiment].measured[report.column];
        const bool is_given = std::count(fit.given_noise.begin(), fit.given_noise.end(), measured.column) > 0;
        result.columns.push_back(
            {result.experiments[report.experiment], measured.column, measured.shown, fit.noise.at(measured.column), is_given, report});
        result.columns.back().shown.offset = 0;
    }
    for (const Unseen& unseen : statistics.unseen) result.unseen.push_back(in_words(unseen, run));
    result.correlations = statistics.correlations;
    result.shares = statistics.shares;
    result.count = fit.residuals.size();
    result.unweighted = static_cast<std::size_t>(
        std::count_if(fit.residuals.begin(), fit.residuals.end(), [](const Residual& residual) { return residual.weight < 0.5; }));
    result.starts = settings.starts;
    result.agreeing = fit.agreeing;
    result.iterations = fit.iterations;
    result.runs = fit.runs;
    result.converged = fit.converged;
    return result;
}

std::string as_text(const IdentifyResult& result) {
    std::string text =
        fmt::format("{}: {} fitted to {} of {}, in {} with {}\n", result.subject.title(), counted(result.values.size(), "unknown"),
                    counted(result.count, "value"), counted(result.experiments.size(), "experiment"),
                    counted(static_cast<std::size_t>(result.iterations), "iteration"), counted(result.runs, "run"));
    text += table(value_rows(result));
    text += "residuals, measured - simulated:\n" + table(column_rows(result));
    if (has_shares(result)) text += "part of each experiment in what is known of each value:\n" + table(share_rows(result));
    if (result.unweighted > 0) text += fmt::format("{} values count less than half\n", result.unweighted);
    for (const std::string& remark : remarks(result)) text += "note: " + remark + "\n";
    for (const std::filesystem::path& file : result.files) text += file.string() + "\n";
    return text;
}

nlohmann::ordered_json as_json(const IdentifyResult& result) {
    nlohmann::ordered_json json = json_result("identify", result.subject);
    json["converged"] = result.converged;
    json["iterations"] = result.iterations;
    json["runs"] = result.runs;
    json["starts"] = result.starts;
    json["agreeing"] = result.agreeing;
    json["count"] = result.count;
    json["unweighted"] = result.unweighted;
    json["experiments"] = result.experiments;
    json["values"] = nlohmann::ordered_json::array();
    for (const IdentifiedValue& one : result.values)
        json["values"].push_back({{"name", one.name},
                                  {"unit", one.shown.unit},
                                  {"value", one.value},
                                  {"standard_error", finite(one.error)},
                                  {"low", finite(one.low_95)},
                                  {"high", finite(one.high_95)},
                                  {"begin", one.begin},
                                  {"at_bound", one.at_bound == 0  ? ""
                                               : one.at_bound < 0 ? "lower"
                                                                  : "upper"}});
    json["correlations"] = result.correlations;
    json["shares"] = result.shares;
    json["unseen"] = result.unseen;
    json["columns"] = nlohmann::ordered_json::array();
    for (const ComparedColumn& one : result.columns)
        json["columns"].push_back({{"experiment", one.experiment},
                                   {"column", one.column},
                                   {"unit", one.shown.unit},
                                   {"count", one.residuals.count},
                                   {"rms", one.residuals.rms},
                                   {"noise", one.noise},
                                   {"noise_is_given", one.noise_is_given},
                                   {"largest", one.residuals.largest},
                                   {"largest_at", one.residuals.at},
                                   {"outliers", one.residuals.outliers},
                                   {"white", finite(one.residuals.white)}});
    json["notes"] = remarks(result);
    json["files"] = json_list(result.files);
    return json;
}

std::string parameter_file(const IdentifyResult& result) {
    std::string text = fmt::format("# Parameters of {}, fitted to data. Use: dalembert simulate MODEL --parameters FILE\n[parameters]\n",
                                   result.subject.title());
    std::string others;
    for (const IdentifiedValue& one : result.values) {
        const std::string line =
            fmt::format("\"{}\" = \"{}{}\"  # standard error {}\n", one.name, one.value, with_space(one.shown.unit), error_text(one));
        if (one.name.find('(') == std::string::npos)
            text += line;
        else
            others += "# " + line;
    }
    return text + (others.empty() ? "" : "# Not parameters:\n" + others);
}

Recording comparison_table(const Experiment& experiment, const RunBesideData& comparison) {
    Recording recording;
    recording.columns.push_back({"t", "s"});
    for (const Measured& measured : experiment.measured)
        for (const char* part : {"", " measured", " residual"}) recording.columns.push_back({measured.column + part, measured.shown.unit});
    for (std::size_t i = 0; i < experiment.t.size(); ++i) {
        std::vector<double> row{experiment.t[i]};
        for (std::size_t c = 0; c < experiment.measured.size(); ++c) {
            const double simulated = comparison.columns[c].simulated[i], measured = experiment.measured[c].values[i];
            row.insert(row.end(), {simulated, measured, measured - simulated});
        }
        recording.rows.push_back(std::move(row));
    }
    return recording;
}

std::string identify_page(const IdentifyResult& result, const std::vector<std::string>& pictures) {
    std::string remarks_text, pictures_text;
    for (const std::string& remark : remarks(result)) remarks_text += "<li>" + html_text(remark) + "</li>\n";
    for (std::size_t e = 0; e < pictures.size(); ++e)
        if (!pictures[e].empty())
            pictures_text += fmt::format("<h2>{}</h2>\n<figure>{}</figure>\n", html_text(result.experiments[e]), pictures[e]);
    return fill_template(
        embedded_file("identify.html.in"),
        {{"TITLE", html_text(result.subject.title())},
         {"LEAD", html_text(counted(result.values.size(), "unknown") + " fitted to " + counted(result.count, "measured value") + ".")},
         {"VALUES", html_table(value_rows(result))},
         {"COLUMNS", html_table(column_rows(result))},
         {"SHARES",
          has_shares(result) ? "<h2>Part of each experiment in what is known of each value</h2>\n" + html_table(share_rows(result)) : ""},
         {"REMARKS", remarks_text.empty() ? "" : "<h2>Notes</h2>\n<ul>\n" + remarks_text + "</ul>\n"},
         {"PICTURES", pictures_text}});
}

}  // namespace dalembert
