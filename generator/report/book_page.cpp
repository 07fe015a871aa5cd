// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/book_page.hpp"

#include <fmt/format.h>

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

std::string entry(const PrintedRow& row) {
    const Verdict verdict = row.verdict();
    std::string text = fmt::format("<section class=\"entry {}\">\n<h3>{} <span class=\"verdict\">{}</span></h3>\n", style_of(verdict),
                                   html_text(row.id), html_text(row.verdict_text()));
    std::string columns = column("printed", row.formulas);
    columns += column("derived", math_element(mathml_of_text(row.derived)));
    if (is_wrong(row)) columns += column("difference, printed left minus right", math_element(mathml_of_text(row.difference)));
    if (row.suggestion) columns += column("perhaps meant", math_element(mathml_of_text(row.suggestion->equation)));
    text += "<div class=\"columns\">\n" + columns + "</div>\n";
    if (verdict != Verdict::proven) text += paragraph(row.doc);
    if (!row.reason.empty() && verdict != Verdict::proven)
        text += paragraph((verdict == Verdict::proven_under_assumption ? "Assuming " : "Reason: ") + row.reason);
    for (const std::string& sentence : row.not_read()) text += paragraph("Not read: " + sentence);
    if (row.suggestion) text += paragraph("Likely slip: " + row.suggestion->words) + marked(*row.suggestion);
    return text + example(row) + "</section>\n";
}

/// What has no verdict, with the reason.
std::string entry(const BookProblem& problem) {
    return fmt::format("<section class=\"entry unchecked\">\n<h3>{} <span class=\"verdict\">{}</span></h3>\n{}</section>\n",
                       html_text(problem.id), html_text(problem.verdict), paragraph(problem.reason));
}

std::string table(const VerdictCounts& counts) {
    std::string text = fmt::format("<table class=\"summary\"><tr><th>entries</th><td>{}</td></tr>\n", counts.entries);
    for (std::size_t i = 0; i < counts.of.size(); ++i)
        text += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", verdict_names[i], counts.of[i]);
    return text + "</table>\n";
}

std::string page(const std::vector<BookPart>& parts, bool only_errata) {
    std::string body;
    VerdictCounts counts;
    for (const BookPart& part : parts) {
        counts.add(part.counts);
        std::string inside;
        for (const PrintedRow& row : part.rows)
            if (!only_errata || is_wrong(row)) inside += entry(row);
        if (!only_errata)
            for (const BookProblem& problem : part.problems) inside += entry(problem);
        if (inside.empty()) continue;
        body += fmt::format("<h2>{}</h2>\n{}{}", html_text(part.title), paragraph(part.about), inside);
    }
    if (only_errata && body.empty()) body = "<p>None of the equations that were checked is wrong.</p>\n";
    const std::string other = only_errata ? "<a href=\"book.html\">Every equation</a>, with its verdict."
                                          : "<a href=\"errata.html\">The errata</a> by themselves.";
    const std::string lead = only_errata
                                 ? "Printed equations that contradict the derivation. Each comes with numbers that show it, in SI units. "
                                 : "Printed equations compared with the derivation, by symbolic proof. ";
    return fill_template(embedded_file("book.html.in"), {{"TITLE", only_errata ? "Errata" : "Is the book right?"},
                                                         {"LEAD", lead + other},
                                                         {"BODY", (only_errata ? "" : table(counts)) + body}});
}

}  // namespace

FileContents book_pages(const std::vector<BookPart>& parts, const std::filesystem::path& folder) {
    return {{folder / "book.html", page(parts, false)}, {folder / "errata.html", page(parts, true)}};
}

}  // namespace dalembert
