// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/error_page.hpp"

#include <fmt/format.h>

#include <map>

#include "emit/mathml.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// A message below its line, with a mark where it begins.
std::string note_below(const Diagnostic& diagnostic, std::size_t column) {
    return fmt::format("<p class=\"{}\"><code>{}^</code> {}: {}</p>\n", diagnostic.severity == Severity::error ? "bad" : "doubt",
                       std::string(column - 1, ' '), name_of(diagnostic.id), html_text(diagnostic.message));
}

}  // namespace

std::string error_page(const SourcePtr& model, const std::vector<Diagnostic>& diagnostics, const std::string& script) {
    std::multimap<std::size_t, std::string> below;
    std::string list;
    for (const Diagnostic& diagnostic : diagnostics) {
        const std::string message = html_text(diagnostic.message);
        if (diagnostic.span.source == nullptr || model == nullptr || diagnostic.span.source->name() != model->name()) {
            list += "<li><pre>" + html_text(render(diagnostic)) + "</pre></li>\n";
            continue;
        }
        const Position place = diagnostic.span.source->position(diagnostic.span.begin);
        below.emplace(place.line, note_below(diagnostic, place.column));
        list += fmt::format("<li><a href=\"#line-{0}\">line {0}</a>: {1}</li>\n", place.line, message);
        for (const Note& note : diagnostic.notes)
            if (note.span.source != nullptr && note.span.source->name() == model->name())
                below.emplace(note.span.source->position(note.span.begin).line,
                              fmt::format("<p class=\"doubt\">{}</p>\n", html_text(note.message)));
    }
    std::string text;
    for (std::size_t number = 1, at = 0; model != nullptr && at < model->text().size(); ++number) {
        const std::string_view line = model->line(number);
        text += fmt::format("<div id=\"line-{0}\"{2}><code><span>{0:>4}</span>  {1}</code></div>\n", number, html_text(line),
                            below.contains(number) ? " class=\"marked\"" : "");
        const auto [first, last] = below.equal_range(number);
        for (auto note = first; note != last; ++note) text += note->second;
        at = model->offset({number + 1, 1});
    }
    const std::string name = model == nullptr ? "The model" : html_text(model->name());
    const std::string title = diagnostics.empty() ? "The page is being made" : name + " has errors";
    return fill_template(
        embedded_file("report_errors.html.in"),
        {{"STYLE", std::string(embedded_file("report.css"))}, {"TITLE", title}, {"LIST", list}, {"TEXT", text}, {"SCRIPT", script}});
}

}  // namespace dalembert
