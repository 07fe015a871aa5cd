// SPDX-License-Identifier: GPL-3.0-or-later
#include "book/printed_verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "book/difference_text.hpp"
#include "elements/model.hpp"
#include "elements/runs.hpp"
#include "elements/verdict.hpp"
#include "emit/mathml.hpp"
#include "read/cases.hpp"

namespace dalembert {

namespace {

/// Higher is more important to report.
int weight(Verdict verdict) {
    static constexpr int weights[]{1, 2, 3, 5, 6, 0};  // what one scene cannot check, another may
    return weights[static_cast<std::size_t>(verdict)];
}

/// Beyond a few lines nobody reads on.
std::string short_text(const std::string& text) {
    constexpr std::size_t longest = 1500;
    return text.size() <= longest ? text : std::string("too long to be shown");
}

bool is_of_cases(const PrintedEquation& entry) {
    return std::any_of(entry.shown.begin(), entry.shown.end(), [](const Equation& equation) {
        return std::any_of(equation.sides.begin(), equation.sides.end(), [](const ExpressionPtr& side) { return has_cases(*side); });
    });
}

}  // namespace

bool PrintedRow::as_expected() const {
    if (expected) return verdict() == *expected;
    return verdict() != Verdict::wrong && verdict() != Verdict::dimensionally_wrong;
}

std::string PrintedRow::verdict_text() const {
    const std::size_t refused = parts.refused.size();
    return refused == 0 ? to_string(verdict())
                        : fmt::format("{}; {} of {} equations are read", to_string(verdict()), parts.equations - refused, parts.equations);
}

std::vector<std::string> PrintedRow::not_read() const {
    std::vector<std::string> sentences;
    for (const RefusedEquation& one : parts.refused) sentences.push_back(fmt::format("equation {}: {}", one.number, one.why.message));
    return sentences;
}

PrintedRow& PrintedVerdicts::row_of(const std::string& id, const PrintedEquation& entry) {
    for (PrintedRow& row : rows_)
        if (row.id == id) return row;
    rows_.push_back({id, entry.source, entry.doc, entry.expected});
    return rows_.back();
}

void PrintedVerdicts::add(const System& system) {
    for (const PrintedEquation& entry : system.scene.model->printed) add(system, entry);
}

void PrintedVerdicts::add(const System& system, const PrintedEquation& entry, const LatexText* text) {
    const Notation write(system.symbols, Style::text);
    const auto [from, to] = entry.family ? bounds(*entry.family, system.scene) : std::pair(0, 0);
    for (int k = from; k <= to; ++k) {
        const Member<PrintedEquation> member{&entry, k};
        PrintedRow& row = row_of(member.name(), entry);
        if (!system.scene.holds(entry.when)) continue;
        const PrintedCheck check = check_printed(system, member);
        if (row.scenes.empty() || row.scenes.back() != system.scene.name) row.scenes.push_back(system.scene.name);
        const Verdict verdict = check.verdict();
        if (row.found && weight(*row.found) >= weight(verdict)) continue;
        row.found = verdict;
        row.formulas.clear();
        if (for_pages_)
            for (const Equation& equation : entry.shown) row.formulas += math_element(mathml(equation));
        for (const PrintedResult& result : check.equations) {
            if (result.comparison.verdict != verdict) continue;
            row.equation = result.written;
            row.reason = result.comparison.reason;
            row.difference = result.difference ? difference_text(system, *result.difference, is_of_cases(entry)) : "";
            row.counterexample = result.counterexample;
            if (for_pages_ && result.derived) row.derived = short_text(write(*result.derived)) + (result.is_motion ? " = 0" : "");
            break;
        }
        const bool is_wrong = verdict == Verdict::wrong || verdict == Verdict::dimensionally_wrong;
        row.suggestion = is_wrong ? suggest(system, member, text) : std::nullopt;
    }
}

void PrintedVerdicts::add_unchecked(const PrintedEquation& entry, const std::string& reason) {
    PrintedRow& row = row_of(entry.name, entry);
    row.found = Verdict::not_checkable;
    row.reason = reason;
}

}  // namespace dalembert
