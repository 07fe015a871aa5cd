// SPDX-License-Identifier: GPL-3.0-or-later
// Diagnostics are values: an id, a place, a sentence that names both sides, and where the other side stands.
#pragma once

#include <exception>
#include <span>
#include <string>
#include <vector>

#include "text/source.hpp"

namespace dalembert {

/// Everything that can be wrong with what a user hands in. The table in diagnostic_kinds.cpp gives names, meanings and examples.
enum class Id {
    unreadable_file,
    file_too_large,
    not_text,
    toml_syntax,
    unknown_format,
    unknown_key,
    missing_key,
    wrong_type,
    syntax,
    too_deep,
    too_long,
    number_too_large,
    bad_name,
    reserved_name,
    doubly_defined,
    unknown_name,
    wrong_arguments,
    not_indexed,
    index_missing,
    index_out_of_range,
    cyclic_definition,
    not_allowed_here,
    unknown_unit,
    unit_mismatch,
    size_mismatch,
    value_out_of_range,
    unknown_effect,
    unknown_scene,
    scene_needed,
    scene_contradiction,
    unknown_size,
    unknown_run,
    needs_absent,
    nothing_left,
    division_by_zero,
    singular_mass,
    not_affine,
    not_orthogonal,
    not_quadratic,
    not_integrable,
    cannot_integrate,
    wrong_integral,
    wrong_closed_form,
    inconsistent_medium,
    wrong_medium,
    wrong_enclosure,
    wrong_inertia,
    mass_not_balanced,
    wrong_modes,
    undetermined,
    no_equilibrium,
    no_series,
    doubly_determined,
    can_vanish,
    not_equal,
    unused,
    bad_option,
    bad_plant,
    tool_failed,
    too_large,
};

struct DiagnosticKind {
    Id id;
    const char* name;
    const char* meaning;  ///< a sentence
    const char* example;  ///< a message, or "tests/errors/NAME.txt"
};

/// The one table of ids, in the order of the enumeration.
std::span<const DiagnosticKind> diagnostic_kinds();
const char* name_of(Id id);
/// The message of the example, with the line of the model that it is about.
std::string example_of(const DiagnosticKind& kind);

struct Note {
    Span span;
    std::string message;
};

enum class Severity { error, warning };

struct Diagnostic {
    Id id;
    Span span;
    std::string message;
    std::vector<Note> notes = {};
    Severity severity = Severity::error;
};

/// `file:line:col: error[id]: message`, the source line with a caret, and the notes likewise.
std::string render(const Diagnostic& diagnostic);

/// Collects diagnostics, so that one run reports all that can be found at once.
class Diagnostics {
public:
    void error(Id id, Span span, std::string message, std::vector<Note> notes = {});
    void warning(Id id, Span span, std::string message, std::vector<Note> notes = {});

    bool has_errors() const;
    const std::vector<Diagnostic>& all() const { return all_; }
    /// Throws Failure when there is an error. Called at the end of each stage.
    void stop_on_errors() const;

private:
    std::vector<Diagnostic> all_;
};

/// Exit codes of the program.
enum class ExitCode : int { good = 0, check_failed = 1, bad_input = 2, tool_missing = 3, run_stopped = 4 };

struct ExitCodeSpec {
    ExitCode code;
    const char* meaning;
};
std::span<const ExitCodeSpec> exit_codes();

/// Carries diagnostics out of a stage that cannot go on.
class Failure : public std::exception {
public:
    explicit Failure(std::vector<Diagnostic> diagnostics, ExitCode exit_code = ExitCode::bad_input);
    explicit Failure(Diagnostic diagnostic, ExitCode exit_code = ExitCode::bad_input)
        : Failure(std::vector<Diagnostic>{std::move(diagnostic)}, exit_code) {}

    const char* what() const noexcept override { return what_.c_str(); }
    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
    ExitCode exit_code() const { return exit_code_; }

private:
    std::vector<Diagnostic> diagnostics_;
    ExitCode exit_code_;
    std::string what_;
};

/// Throws a Failure of one diagnostic.
[[noreturn]] inline void fail(Id id, const Span& span, std::string message, std::vector<Note> notes = {}) {
    throw Failure(Diagnostic{id, span, std::move(message), std::move(notes)});
}

}  // namespace dalembert
