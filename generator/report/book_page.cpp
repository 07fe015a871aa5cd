// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/book_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "emit/mathml.hpp"
#include "text/template.hpp"
#include "elements/verdict.hpp"

namespace dalembert {

namespace {

bool is_wrong(const PrintedRow& row) { return row.verdict() == Verdict::wrong || row.verdict() == Verdict::dimensionally_wrong; }

const char* style_of(Verdict verdict) {
    static constexpr std::array<const char*, 6> styles{"proven", "assumed", "numerical", "wrong", "wrong", "unchecked"};
    return styles[static_cast<std::size_t>(verdict)];
}

std::string column(const char* label, const std::string& inside) {
    return inside.empty() ? "" : fmt::format("<div><p class=\"label\">{}</p><div class=\"formula\">{}</div></div>\n", label, inside);
}

std::string paragraph(const std::string& text) { return text.empty() ? "" : "<p>" + html_text(text) + "</p>\n"; }

std::string example(const PrintedRow& row) {
    if (!row.counterexample) return {};
    const CounterExample& c = *row.counterexample;
    std::string text;
    for (const auto& [name, value] : c.values)
        text += fmt::format("{}<math>{}<mo>=</mo><mn>{}</mn></math>", text.empty() ? "" : ", ", mathml_of_text(name), html_text(value));
    return fmt::format("<p>{} left side is {}, the right side {}.</p>\n", text.empty() ? "The" : "With " + text + " the", html_text(c.left),
                       html_text(c.right));
}

/// The mended LaTeX with the slip marked.
std::string marked(const Suggestion& s) {
    if (s.printed.empty()) return {};
    return fmt::format("<p><code>{}<mark>{}</mark>{}</code></p>\n", html_text(s.printed.substr(0, s.begin)),
                       html_text(s.printed.substr(s.begin, s.end - s.begin)), html_text(s.printed.substr(s.end)));
}

std::string formulas(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) all += math_element(mathml_of_text(text));
    return all;
}

/// "at phi = 0; with r_S = ...": what the entry says besides the equation.
std::string given(const PrintedRow& row) {
    std::string text;
    for (const auto& [word, list] : {std::pair("at", &row.at), std::pair("with", &row.given)}) {
        std::string all;
        for (const std::string& one : *list) all += fmt::format("{}<math>{}</math>", all.empty() ? "" : ", ", mathml_of_text(one));
        if (!all.empty()) text += fmt::format("{}{} {}", text.empty() ? "" : "; ", word, all);
    }
    return text.empty() ? "" : "<p class=\"given\">" + text + "</p>\n";
}

std::string entry(const PrintedRow& row) {
    const Verdict verdict = row.verdict();
    std::string text = fmt::format("<section class=\"entry {}\">\n<h3>{} <span class=\"verdict\">{}</span></h3>\n", style_of(verdict),
                                   html_text(row.id), html_text(row.verdict_text()));
    std::string columns = column("printed", row.formulas);
    columns += column("derived", formulas(row.derived));
    if (is_wrong(row)) columns += column("difference, printed left minus right", math_element(mathml_of_text(row.difference)));
    if (row.suggestion) columns += column("perhaps meant", row.meant);
    text += "<div class=\"columns\">\n" + columns + "</div>\n" + given(row);
    if (verdict != Verdict::proven) text += paragraph(row.doc);
    if (!row.reason.empty() && verdict != Verdict::proven)
        text += paragraph((verdict == Verdict::proven_under_assumption ? "Assuming " : "Reason: ") + row.reason);
    for (const std::string& sentence : row.not_read()) text += paragraph("Not read: " + sentence);
    if (!row.hint.empty()) text += paragraph("It " + row.hint + ".");
    if (row.suggestion) text += paragraph("Likely slip: " + row.suggestion->words) + marked(*row.suggestion);
    return text + example(row) + "</section>\n";
}

/// What has no verdict, with the reason.
std::string entry(const BookProblem& problem) {
    return fmt::format("<section class=\"entry unchecked\">\n<h3>{} <span class=\"verdict\">{}</span></h3>\n{}</section>\n",
                       html_text(problem.id), html_text(problem.verdict), paragraph(problem.reason));
}

/// Rows and what has no verdict, in the order of the text.
std::string entries(const BookPart& part, bool only_errata) {
    std::string text;
    std::size_t next = 0;
    const auto problems_before = [&](std::size_t row) {
        for (; next < part.problems.size() && part.problems[next].rows_before <= row; ++next)
            if (!only_errata) text += entry(part.problems[next]);
    };
    for (std::size_t i = 0; i < part.rows.size(); ++i) {
        problems_before(i);
        if (!only_errata || is_wrong(part.rows[i])) text += entry(part.rows[i]);
    }
    problems_before(part.rows.size());
    return text;
}

std::string table(const std::vector<BookPart>& parts) {
    VerdictCounts counts;
    std::map<std::string, int> without;  // a verdict, by reason
    for (const BookPart& part : parts) {
        counts.add(part.counts);
        for (const BookProblem& problem : part.problems) ++without[problem.verdict], ++counts.entries;
    }
    std::string text = fmt::format("<table class=\"summary\"><tr><th>entries</th><td>{}</td></tr>\n", counts.entries);
    const auto line = [&](const std::string& name, int count) { text += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, count); };
    for (std::size_t i = 0; i < counts.of.size(); ++i) line(verdict_names[i], counts.of[i]);
    for (const auto& [name, count] : without) line(name, count);
    return text + "</table>\n";
}

/// The one text, or two; of more of them what they have in common.
std::string title_of(const std::vector<BookPart>& parts) {
    std::vector<std::string> titles;
    for (const BookPart& part : parts)
        if (!part.title.empty() && std::find(titles.begin(), titles.end(), part.title) == titles.end()) titles.push_back(part.title);
    return titles.empty() || titles.size() > 2 ? "Printed equations" : fmt::format("{}", fmt::join(titles, " and "));
}

std::string page(const std::vector<BookPart>& parts, bool only_errata) {
    std::string body;
    const std::string title = title_of(parts);
    for (const BookPart& part : parts) {
        const std::string inside = entries(part, only_errata);
        if (inside.empty()) continue;
        if (part.title != title || parts.size() > 1) body += fmt::format("<h2>{}</h2>\n", html_text(part.title));
        body += paragraph(part.about) + inside;
    }
    if (only_errata && body.empty()) body = "<p>None of the equations that were checked is wrong.</p>\n";
    const std::string other = only_errata ? "<a href=\"book.html\">Every equation</a>, with its verdict."
                                          : "<a href=\"errata.html\">The errata</a> by themselves.";
    const std::string lead = only_errata
                                 ? "Printed equations that contradict the derivation. Each comes with numbers that show it, in SI units. "
                                 : "Printed equations compared with the derivation, by symbolic proof. ";
    return fill_template(embedded_file("book.html.in"), {{"TITLE", html_text(only_errata ? "Errata: " + title : title)},
                                                         {"LEAD", lead + other},
                                                         {"BODY", (only_errata ? "" : table(parts)) + body}});
}

}  // namespace

FileContents book_pages(const std::vector<BookPart>& parts, const std::filesystem::path& folder) {
    return {{folder / "book.html", page(parts, false)}, {folder / "errata.html", page(parts, true)}};
}

}  // namespace dalembert
