// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/template.hpp"

namespace dalembert {

namespace {

constexpr std::size_t widest_line = 140;

/// A line fit for a terminal: control bytes shown as '?', tabs as blanks.
std::string printable(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c == '\t') c = ' ';
        if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) c = '?';
    }
    return result;
}

/// The source line of a span and a row of carets below it. Long lines are cut to a window around the place.
std::string excerpt(const Span& span) {
    const Position begin = span.source->position(span.begin);
    std::string_view line = span.source->line(begin.line);
    std::size_t at = span.begin - span.source->offset({begin.line, 1});
    at = std::min(at, line.size());
    std::size_t length = std::min(span.end > span.begin ? span.end - span.begin : 1, std::max<std::size_t>(line.size() - at, 1));

    std::string_view before_mark;
    std::string_view after_mark;
    if (line.size() > widest_line) {
        const auto is_inside_character = [&](std::size_t i) {
            return i < line.size() && (static_cast<unsigned char>(line[i]) & 0xC0U) == 0x80U;
        };
        std::size_t from = at > widest_line / 2 ? at - widest_line / 2 : 0;
        while (from < at && is_inside_character(from)) ++from;
        std::size_t to = std::min(from + widest_line, line.size());
        while (is_inside_character(to)) ++to;
        if (from > 0) before_mark = "... ";
        if (to < line.size()) after_mark = " ...";
        line = line.substr(from, to - from);
        at -= from;
        length = std::min(length, line.size() - at);
    }
    const std::size_t column = before_mark.size() + character_count(line.substr(0, at));
    const std::size_t carets = std::max<std::size_t>(1, character_count(line.substr(at, length)));
    return fmt::format("{:>5} | {}{}{}\n      | {:>{}}{:^>{}}\n", begin.line, before_mark, printable(line), after_mark, "", column, "",
                       carets);
}

/// Of a place in a part: the places that use it, from the inside out.
std::vector<Note> way_in(const Span& span) {
    std::vector<Note> notes;
    for (const WayIn* way = span ? span.source->way_in() : nullptr; way != nullptr; way = way->place.source->way_in())
        notes.push_back({way->place, fmt::format("used here as '{}'", way->name)});
    return notes;
}

std::string place(const Span& span) {
    if (!span) return "dalembert: ";
    const Position position = span.source->position(span.begin);
    return fmt::format("{}:{}:{}: ", printable(span.source->name()), position.line, position.column);
}

}  // namespace

std::string example_of(const DiagnosticKind& kind) {
    const std::string_view example = kind.example;
    if (!example.starts_with("tests/")) return std::string(example) + "\n";
    // Of all that the program said there, the message with this id and the source line below it.
    const std::string_view said = embedded_file(example);
    const std::size_t id = said.find(fmt::format("[{}]", kind.name));
    if (id == std::string_view::npos) return {};
    const std::size_t begin = said.rfind('\n', id) + 1;
    std::size_t end = said.find('\n', id) + 1;
    while (end < said.size() && said[end] == ' ') end = said.find('\n', end) + 1;
    return std::string(said.substr(begin, end - begin));
}

std::string render(const Diagnostic& diagnostic) {
    const char* severity = diagnostic.severity == Severity::error ? "error" : "warning";
    std::string text =
        fmt::format("{}{}[{}]: {}\n", place(diagnostic.span), severity, name_of(diagnostic.id), printable(diagnostic.message));
    if (diagnostic.span) text += excerpt(diagnostic.span);
    const auto add = [&](const Note& note) {
        text += fmt::format("{}note: {}\n", place(note.span), printable(note.message));
        if (note.span) text += excerpt(note.span);
    };
    for (const Note& way : way_in(diagnostic.span)) add(way);
    for (const Note& note : diagnostic.notes) {
        add(note);
        if (note.span && diagnostic.span && note.span.source != diagnostic.span.source)
            for (const Note& way : way_in(note.span)) add(way);
    }
    return text;
}

void Diagnostics::error(Id id, Span span, std::string message, std::vector<Note> notes) {
    all_.push_back({id, std::move(span), std::move(message), std::move(notes), Severity::error});
}

void Diagnostics::warning(Id id, Span span, std::string message, std::vector<Note> notes) {
    all_.push_back({id, std::move(span), std::move(message), std::move(notes), Severity::warning});
}

bool Diagnostics::has_errors() const {
    return std::any_of(all_.begin(), all_.end(), [](const Diagnostic& d) { return d.severity == Severity::error; });
}

void Diagnostics::stop_on_errors() const {
    if (has_errors()) throw Failure(all_);
}

Failure::Failure(std::vector<Diagnostic> diagnostics, ExitCode exit_code)
    : diagnostics_(std::move(diagnostics)), exit_code_(exit_code) {
    for (const Diagnostic& diagnostic : diagnostics_) what_ += render(diagnostic);
}

}  // namespace dalembert
