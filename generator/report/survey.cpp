// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/survey.hpp"

#include <fmt/format.h>

#include "report/json_output.hpp"

namespace dalembert {

namespace {

std::string table(const std::vector<SurveyRow>& rows) {
    std::size_t width = 14;
    for (const SurveyRow& row : rows) width = std::max(width, row.name().size());
    const auto line = [&](const auto&... cells) {
        return fmt::format("{:<{}}  {:>3}  {:>10}  {:>10}  {:>7}  {:>9}  {:>9}  {:>12}\n", cells...);
    };
    std::string text = line("system, scene", width, "dof", "operations", "generation", "proofs", "equations", "misprints", "energy error");
    text += line("", width, "", "of the rhs", "[ms]", "", "checked", "found", "of the run");
    for (const SurveyRow& row : rows)
        text += line(row.name(), width, row.degrees, row.operations, fmt::format("{:.1f}", 1000 * row.generation_seconds),
                     row.all_proven ? "proven" : "partly", fmt::format("{}/{}", row.as_expected, row.equations), row.misprints,
                     row.is_good ? fmt::format("{:.1e}", row.energy_error) : row.status);
    return text;
}

}  // namespace

std::string as_text(const SurveyResult& result) {
    std::string text = table(result.rows) + "\nheaders, CSV files and plots:\n";
    for (const SurveyRow& row : result.rows) {
        std::string endings;
        for (const std::filesystem::path& file : row.files) endings += (endings.empty() ? "" : ",") + file.extension().string().substr(1);
        text += fmt::format("  {}.{{{}}}\n", (result.folder / row.name()).string(), endings);
    }
    return text;
}

nlohmann::ordered_json as_json(const SurveyResult& result) {
    nlohmann::ordered_json json = json_result("survey");
    json["systems"] = nlohmann::ordered_json::array();
    for (const SurveyRow& row : result.rows)
        json["systems"].push_back({{"model", row.subject.model},
                                   {"scene", row.subject.scene},
                                   {"degrees_of_freedom", row.degrees},
                                   {"operations", row.operations},
                                   {"generation_seconds", row.generation_seconds},
                                   {"all_proven", row.all_proven},
                                   {"equations", row.equations},
                                   {"as_expected", row.as_expected},
                                   {"misprints", row.misprints},
                                   {"status", row.status},
                                   {"steps", row.steps},
                                   {"energy_error", row.energy_error}});
    return json;
}

}  // namespace dalembert
