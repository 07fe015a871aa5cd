// SPDX-License-Identifier: GPL-3.0-or-later
#include "book/printed_verdicts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <utility>

#include "book/difference_text.hpp"
#include "elements/model.hpp"
#include "elements/runs.hpp"
#include "elements/verdict.hpp"
#include "emit/latex_mathml.hpp"
#include "emit/mathml.hpp"
#include "language/expression_text.hpp"
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

std::vector<std::string> point_of(const PrintedEquation& entry) {
    std::vector<std::string> texts;
    for (const AtPoint& point : entry.at)
        if (!point.is_letter) texts.push_back(fmt::format("{} = {}", in_model_language(*point.variable), point.value->written()));
    return texts;
}

std::vector<std::string> given_by(const PrintedEquation& entry) {
    std::vector<std::string> texts;
    for (const PrintedLetter& letter : entry.shown_letters)
        texts.push_back(fmt::format("{} = {}", letter.name, in_model_language(*letter.value)));
    return texts;
}

/// "vector(a, b)" of results that are entries of one equation; nothing where one of them has no value. A row that the text leaves out in
/// the plane is left out here, too.
std::string matrix_text(const Notation& write, std::span<const PrintedResult> entries) {
    std::vector<std::vector<std::string>> rows;
    std::string place;
    bool has_columns = false;
    for (const PrintedResult& entry : entries) {
        if (entry.is_left_out) continue;
        if (!entry.derived || entry.is_motion) return {};
        const std::size_t comma = entry.entry.find(", column");
        const bool is_single_row = entry.entry.starts_with("column");
        const std::string here = is_single_row ? "the row" : entry.entry.substr(0, comma);
        has_columns = has_columns || is_single_row || comma != std::string::npos;
        if (here != place) rows.emplace_back();
        place = here;
        rows.back().push_back(write(*entry.derived));
    }
    std::vector<std::string> texts;
    for (const std::vector<std::string>& cells : rows)
        texts.push_back(fmt::format(fmt::runtime(has_columns ? "row({})" : "{}"), fmt::join(cells, ", ")));
    return fmt::format("{}({})", has_columns ? "matrix" : "vector", fmt::join(texts, ", "));
}

/// What the derivation has in the place of each equation, if all of them have the verdict; else of the first one that has it.
std::vector<std::string> derived_texts(const System& system, const PrintedCheck& check, Verdict verdict) {
    const Notation write(system.symbols, Style::text);
    const std::vector<PrintedResult>& all = check.equations;
    const auto has_verdict = [&](const PrintedResult& result) { return result.comparison.verdict == verdict; };
    const bool is_all = std::all_of(all.begin(), all.end(), has_verdict);
    std::vector<std::string> texts;
    for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
        end = i + 1;
        const bool is_matrix = !all[i].entry.empty();
        const auto is_of_same = [&](const PrintedResult& other) { return other.written == all[i].written && other.entry != all[i].entry; };
        while (is_matrix && end < all.size() && !all[end].entry.empty() && is_of_same(all[end])) ++end;
        const std::span<const PrintedResult> group(all.begin() + static_cast<std::ptrdiff_t>(i), end - i);
        if (!is_all && std::none_of(group.begin(), group.end(), has_verdict)) continue;
        std::string text = is_matrix ? matrix_text(write, group) : "";
        if (!text.empty()) {
            texts.push_back(short_text(text));
        } else {
            for (const PrintedResult& one : group)
                if (one.derived && !one.is_left_out && (is_all || has_verdict(one)))
                    texts.push_back(short_text(write(*one.derived)) + (one.is_motion ? " = 0" : ""));
        }
        if (!is_all) break;
    }
    return texts;
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
    constexpr std::size_t longest_point = 60;
    const std::size_t refused = parts.refused.size();
    const std::string point = fmt::format("{}", fmt::join(at, ", "));
    const bool is_of_point = !at.empty() && verdict() != Verdict::dimensionally_wrong && verdict() != Verdict::not_checkable;
    const std::string where = !is_of_point ? "" : " at " + (point.size() <= longest_point ? point : "the point of 'at'");
    const std::string text = to_string(verdict()) + where;
    return refused == 0 ? text : fmt::format("{}; {} of {} equations are read", text, parts.equations - refused, parts.equations);
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
        row.at = point_of(entry);
        row.given = given_by(entry);
        for (const PrintedResult& result : check.equations) {
            if (result.comparison.verdict != verdict) continue;
            row.equation = result.written;
            row.reason = result.comparison.reason;
            row.difference = result.difference ? difference_text(system, *result.difference, is_of_cases(entry)) : "";
            row.counterexample = result.counterexample;
            row.hint = result.hint;
            break;
        }
        const bool is_wrong = verdict == Verdict::wrong || verdict == Verdict::dimensionally_wrong;
        row.suggestion = is_wrong ? suggest(system, member, text) : std::nullopt;
        if (for_pages_) show(row, system, check, text);
    }
}

void PrintedVerdicts::show(PrintedRow& row, const System& system, const PrintedCheck& check, const LatexText* text) const {
    const bool is_latex = text != nullptr && text->is_plain();
    const LatexMacros macros = is_latex ? text->macros() : LatexMacros();
    row.formulas.clear();
    for (const Equation& equation : check.entry.item->shown) {
        const std::string printed = is_latex ? mathml_of_latex(std::string(equation.span.text()), macros) : "";
        row.formulas += math_element(printed.empty() ? mathml(equation) : printed);
    }
    row.meant.clear();
    if (row.suggestion) {
        const std::string printed = is_latex ? mathml_of_latex(row.suggestion->printed, macros) : "";
        row.meant = math_element(printed.empty() ? mathml_of_text(row.suggestion->equation) : printed);
    }
    row.derived = derived_texts(system, check, row.verdict());
}

void PrintedVerdicts::add_unchecked(const PrintedEquation& entry, const std::string& reason) {
    PrintedRow& row = row_of(entry.name, entry);
    row.found = Verdict::not_checkable;
    row.reason = reason;
}

}  // namespace dalembert
