// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/printed_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "text/safe_text.hpp"
#include "elements/verdict.hpp"
#include "text/source.hpp"

namespace dalembert {

namespace {

std::string reason_of(const PrintedRow& row) { return row.found ? row.reason : "no scene that was checked contains it"; }

/// The mended equation with carets below what is different.
std::string suggestion_text(const Suggestion& suggestion) {
    const std::string_view shown = suggestion.shown();
    const std::string line = safe_line(suggestion.shown());
    const std::string text = fmt::format("      perhaps:    {}\n      corrected:  {}\n", safe_line(suggestion.words), line);
    if (line != shown) return text;
    const std::size_t before = character_count(shown.substr(0, suggestion.begin)),
                      changed = character_count(shown.substr(suggestion.begin, suggestion.end - suggestion.begin));
    return text + std::string(18 + before, ' ') + std::string(std::max<std::size_t>(1, changed), '^') + "\n";
}

}  // namespace

void VerdictCounts::add(Verdict verdict) {
    ++of[static_cast<std::size_t>(verdict)];
    ++entries;
}

void VerdictCounts::add(const VerdictCounts& other) {
    for (std::size_t i = 0; i < of.size(); ++i) of[i] += other.of[i];
    entries += other.entries;
}

std::string VerdictCounts::line(const char* what) const {
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i] > 0) parts.push_back(fmt::format("{} {}", of[i], verdict_names[i]));
    return fmt::format("{} {}{}{}", entries, what, parts.empty() ? "" : ": ", fmt::join(parts, ", "));
}

nlohmann::ordered_json VerdictCounts::json() const {
    nlohmann::ordered_json json{{"entries", entries}};
    for (std::size_t i = 0; i < of.size(); ++i) json[verdict_names[i]] = of[i];
    return json;
}

std::size_t column_width(const std::vector<std::string>& names) {
    constexpr std::size_t narrowest = 16, widest = 36;
    std::size_t width = narrowest;
    for (const std::string& name : names) width = std::max(width, character_count(name));
    return std::min(width, widest);
}

std::string report_text(const PrintedRow& row, std::size_t width) {
    const Verdict verdict = row.verdict();
    const std::string reason = reason_of(row);
    std::string text = fmt::format(
        "  {:<{}} {}{}\n", safe_line(row.id), width, row.verdict_text(),
        row.expected ? (row.as_expected() ? ", as expected" : fmt::format(", but '{}' was expected", to_string(*row.expected))) : "");
    const bool is_notable = verdict != Verdict::proven;
    if (is_notable && !row.doc.empty()) text += fmt::format("      {}\n", safe_line(row.doc));
    if (is_notable && !row.equation.empty()) text += fmt::format("      printed:    {}\n", safe_line(row.equation));
    if (is_notable && !reason.empty())
        text +=
            fmt::format("      {} {}\n", verdict == Verdict::proven_under_assumption ? "assuming:  " : "reason:    ", safe_line(reason));
    if (!row.difference.empty()) text += fmt::format("      difference: {}\n", row.difference);
    if (!row.hint.empty()) text += fmt::format("      hint:       {}\n", row.hint);
    if (row.suggestion) text += suggestion_text(*row.suggestion);
    for (const std::string& sentence : row.not_read()) text += fmt::format("      not read:   {}\n", safe_line(sentence));
    if (row.counterexample) {
        const CounterExample& c = *row.counterexample;
        std::vector<std::string> values;
        for (const auto& [name, value] : c.values) values.push_back(fmt::format("{} = {}", name, value));
        text += fmt::format("      example:    left {}, right {}{}{}\n", c.left, c.right, values.empty() ? "" : " at ",
                            fmt::join(values, ", "));
    }
    return text;
}

nlohmann::ordered_json report_json(const PrintedRow& row, const std::string& source) {
    const Verdict verdict = row.verdict();
    nlohmann::ordered_json assumptions = nlohmann::ordered_json::array();
    if (verdict == Verdict::proven_under_assumption) assumptions.push_back(row.reason);
    nlohmann::ordered_json json{
        {"id", row.id},
        {"source", row.source.empty() ? source : row.source},
        {"verdict", to_string(verdict)},
        {"expected", row.expected ? to_string(*row.expected) : ""},
        {"as_expected", row.as_expected()},
        {"scenes", row.scenes},
        {"equation", row.equation},
        {"reason", reason_of(row)},
        {"assumptions", assumptions},
        {"difference", row.difference},
        {"at", row.at},
        {"with", row.given},
        {"hint", row.hint},
        {"suggestion", row.suggestion ? row.suggestion->equation : ""},
        {"slip", row.suggestion ? row.suggestion->words : ""},
        {"suggestion_printed", row.suggestion ? row.suggestion->printed : ""},
        {"slip_printed", row.suggestion && !row.suggestion->printed.empty()
                             ? row.suggestion->printed.substr(row.suggestion->begin, row.suggestion->end - row.suggestion->begin)
                             : ""},
        {"counterexample", nullptr}};
    if (!row.parts.refused.empty()) json["equations"] = {{"printed", row.parts.equations}, {"not_read", row.not_read()}};
    if (row.counterexample) {
        const CounterExample& c = *row.counterexample;
        json["counterexample"] = {{"values", nlohmann::ordered_json::object()}, {"left", c.left}, {"right", c.right}};
        for (const auto& [name, value] : c.values) json["counterexample"]["values"][name] = value;
    }
    return json;
}

}  // namespace dalembert
