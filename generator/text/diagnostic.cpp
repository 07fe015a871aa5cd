// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dalembert {

namespace {

constexpr std::array kinds{
    DiagnosticKind{Id::unreadable_file, "unreadable-file", "a file is missing or cannot be read"},
    DiagnosticKind{Id::file_too_large, "file-too-large", "a model file is larger than any description of a machine"},
    DiagnosticKind{Id::not_text, "not-text", "a model file is not UTF-8 text"},
    DiagnosticKind{Id::toml_syntax, "toml-syntax", "a model file is not valid TOML"},
    DiagnosticKind{Id::unknown_format, "unknown-format", "the file's format number is not one this program reads"},
    DiagnosticKind{Id::unknown_key, "unknown-key", "a key that the model language does not have"},
    DiagnosticKind{Id::missing_key, "missing-key", "a key that must be there"},
    DiagnosticKind{Id::wrong_type, "wrong-type", "a value of another kind than the key takes"},
    DiagnosticKind{Id::syntax, "syntax", "an expression, unit or condition that cannot be read"},
    DiagnosticKind{Id::too_deep, "too-deep", "an expression nested deeper than is useful"},
    DiagnosticKind{Id::too_long, "too-long", "an expression longer than is useful"},
    DiagnosticKind{Id::number_too_large, "number-too-large", "a number or power beyond what can be written exactly"},
    DiagnosticKind{Id::bad_name, "bad-name", "a name that is not letters, digits and single underscores"},
    DiagnosticKind{Id::reserved_name, "reserved-name", "a name that means something else already"},
    DiagnosticKind{Id::doubly_defined, "doubly-defined", "two things with one name"},
    DiagnosticKind{Id::unknown_name, "unknown-name", "a name that nothing defines"},
    DiagnosticKind{Id::wrong_arguments, "wrong-arguments", "a function with the wrong number or kind of arguments"},
    DiagnosticKind{Id::not_indexed, "not-indexed", "an index behind something that is not a family"},
    DiagnosticKind{Id::index_missing, "index-missing", "a family used without an index"},
    DiagnosticKind{Id::index_out_of_range, "index-out-of-range", "a member that the family does not have"},
    DiagnosticKind{Id::cyclic_definition, "cyclic-definition", "a definition that needs itself"},
    DiagnosticKind{Id::not_allowed_here, "not-allowed-here", "an expression that depends on what it must not depend on"},
    DiagnosticKind{Id::unknown_unit, "unknown-unit", "a unit that is not known"},
    DiagnosticKind{Id::unit_mismatch, "unit-mismatch", "two sides whose units do not agree"},
    DiagnosticKind{Id::size_mismatch, "size-mismatch", "matrices whose sizes do not fit"},
    DiagnosticKind{Id::value_out_of_range, "value-out-of-range", "a value outside its declared range"},
    DiagnosticKind{Id::unknown_effect, "unknown-effect", "an effect that [effects] does not declare"},
    DiagnosticKind{Id::unknown_scene, "unknown-scene", "a scene that [scenes] does not name"},
    DiagnosticKind{Id::scene_needed, "scene-needed", "several scenes and none chosen"},
    DiagnosticKind{Id::scene_contradiction, "scene-contradiction", "effects that cannot stand in one scene"},
    DiagnosticKind{Id::unknown_size, "unknown-size", "a size that [sizes] does not declare"},
    DiagnosticKind{Id::unknown_run, "unknown-run", "a run that [runs] does not name"},
    DiagnosticKind{Id::needs_absent, "needs-absent", "something in the scene that needs something left out of it"},
    DiagnosticKind{Id::nothing_left, "nothing-left", "a scene without coordinates, states and statics"},
    DiagnosticKind{Id::division_by_zero, "division-by-zero", "a division or function value that does not exist"},
    DiagnosticKind{Id::singular_mass, "singular-mass", "a coordinate whose motion no mass resists"},
    DiagnosticKind{Id::not_affine, "not-affine", "a rate that is not linear in the velocities, or a balance that is not in its unknowns"},
    DiagnosticKind{Id::not_orthogonal, "not-orthogonal", "components along lines that are not at right angles"},
    DiagnosticKind{Id::not_quadratic, "not-quadratic", "a kinetic energy that is not quadratic in the velocities"},
    DiagnosticKind{Id::not_integrable, "not-integrable", "forces given as a potential that have none"},
    DiagnosticKind{Id::cannot_integrate, "cannot-integrate", "a law whose integral must be given, or a density that is no polynomial"},
    DiagnosticKind{Id::wrong_integral, "wrong-integral", "an energy whose derivative is not the force"},
    DiagnosticKind{Id::wrong_closed_form, "wrong-closed-form", "a closed form that is not what the run gives"},
    DiagnosticKind{Id::inconsistent_medium, "inconsistent-medium", "a medium whose laws contradict each other"},
    DiagnosticKind{Id::wrong_medium, "wrong-medium", "a flow or volume whose law does not fit the medium"},
    DiagnosticKind{Id::wrong_enclosure, "wrong-enclosure", "surfaces that cannot see each other as the model says"},
    DiagnosticKind{Id::wrong_inertia, "wrong-inertia", "an inertia that no body can have"},
    DiagnosticKind{Id::mass_not_balanced, "mass-not-balanced", "a mass that changes otherwise than its jets say"},
    DiagnosticKind{Id::wrong_modes, "wrong-modes", "modes and events that cannot work together"},
    DiagnosticKind{Id::undetermined, "undetermined", "a state, volume or unknown force that nothing determines"},
    DiagnosticKind{Id::no_equilibrium, "no-equilibrium", "forces that no unknown can hold in equilibrium"},
    DiagnosticKind{Id::no_series, "no-series", "a function of which no Taylor series is known"},
    DiagnosticKind{Id::doubly_determined, "doubly-determined", "two things that fix the same quantity"},
    DiagnosticKind{Id::can_vanish, "can-vanish", "a volume that can become zero within the declared ranges"},
    DiagnosticKind{Id::not_equal, "not-equal", "two derivations that disagree: a defect of this program"},
    DiagnosticKind{Id::unused, "unused", "something defined that nothing uses"},
    DiagnosticKind{Id::bad_option, "bad-option", "an argument of the command line that cannot be used"},
    DiagnosticKind{Id::bad_plant, "bad-plant", "a library that is no plant of this version"},
    DiagnosticKind{Id::tool_failed, "tool-failed", "a compiler or plot program that is missing or failed"},
    DiagnosticKind{Id::too_large, "too-large", "a model too large to be derived"},
};

static_assert(static_cast<std::size_t>(Id::too_large) + 1 == kinds.size());

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

std::string place(const Span& span) {
    if (!span) return "dalembert: ";
    const Position position = span.source->position(span.begin);
    return fmt::format("{}:{}:{}: ", printable(span.source->name()), position.line, position.column);
}

}  // namespace

std::span<const DiagnosticKind> diagnostic_kinds() { return kinds; }

const char* name_of(Id id) { return kinds[static_cast<std::size_t>(id)].name; }

std::string render(const Diagnostic& diagnostic) {
    const char* severity = diagnostic.severity == Severity::error ? "error" : "warning";
    std::string text =
        fmt::format("{}{}[{}]: {}\n", place(diagnostic.span), severity, name_of(diagnostic.id), printable(diagnostic.message));
    if (diagnostic.span) text += excerpt(diagnostic.span);
    for (const Note& note : diagnostic.notes) {
        text += fmt::format("{}note: {}\n", place(note.span), printable(note.message));
        if (note.span) text += excerpt(note.span);
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
