// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/python.hpp"

#include <dalembert/plant.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "export/c_library.hpp"
#include "export/example_run.hpp"
#include "export/plant_texts.hpp"
#include "language/unit_reference.hpp"
#include "run/plant_run.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// What cannot be the attribute of a parameter: keywords of Python, and names of the class Plant. tests/export/python.py compares it with
/// both.
// clang-format off
constexpr std::array taken{
    "False", "None", "True", "and", "as", "assert", "async", "await", "break", "class", "continue", "def", "del", "elif", "else",
    "except", "finally", "for", "from", "global", "if", "import", "in", "is", "lambda", "nonlocal", "not", "or", "pass", "raise",
    "return", "try", "while", "with", "yield", "attributes", "constraint_jacobian", "constraint_positions", "constraint_rates",
    "constraints", "copy", "degrees", "energies", "events", "guard_rates", "guard_table", "guards", "holds", "input", "inputs", "ivp",
    "jacobian_p", "jacobian_t", "jacobian_u", "jacobian_x", "kinks", "linearise", "mass_matrix", "mode_number", "modes", "name", "output",
    "output_jacobian_p", "output_jacobian_t", "output_jacobian_u", "output_jacobian_x",
    "outputs", "parameters", "pattern_p", "pattern_u", "pattern_x", "powers", "rhs",
    "rhs_and_jacobian", "scene", "sensitivities", "set", "simulate", "state", "states", "title", "values", "velocity_place", "x0"};
// clang-format on

/// Text within """ of Python.
std::string in_docstring(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\' || c == '"') result += '\\';
        result += c;
    }
    return result;
}

/// The attribute of a parameter, as _plant.py finds it.
std::string attribute(const PlantParameter& parameter) {
    const bool is_taken = std::find(taken.begin(), taken.end(), parameter.identifier) != taken.end();
    return parameter.identifier + (is_taken ? "_" : "");
}

std::string table_of_parameters(const Plant& plant) {
    std::string text = plant.parameter_members.empty() ? "" : "\nParameters, as attributes\n";
    for (const PlantParameter& p : plant.parameter_members) {
        const std::string number = p.is_array ? fmt::format("an array of {}", p.defaults.size()) : "";
        text += fmt::format("  {} [{}]  {}{}{}\n", attribute(p), p.unit, p.doc, p.is_array && !p.doc.empty() ? "; " : "", number);
    }
    return text;
}

std::string units() {
    std::string text;
    for (const UnitRow& row : unit_rows()) {
        const Unit& unit = row.unit;
        std::vector<std::string> exponents;
        for (std::size_t i = 0; i < Dimension::count; ++i) {
            const Fraction e = unit.dimension.exponent(i);
            exponents.push_back(e.denominator == 1 ? fmt::format("\"{}\"", e.numerator)
                                                   : fmt::format("\"{}/{}\"", e.numerator, e.denominator));
        }
        text += fmt::format("    \"{}\": ({}, {}, ({}), {}),\n", row.name,
                            cln::double_approx(unit.factor) * std::pow(std::numbers::pi, unit.pi_power), cln::double_approx(unit.offset),
                            fmt::join(exponents, ", "), row.takes_prefix ? "True" : "False");
    }
    return text;
}

std::string prefixes() {
    std::string text;
    for (const UnitRow& row : prefix_rows()) text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ", ", row.name, row.doc);
    return text;
}

/// {"phi": 0.5, "dot(phi)": 0.0}, or None.
std::string dictionary(const NamedNumbers& numbers) {
    std::string text;
    for (const auto& [name, value] : numbers) text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ", ", name, value);
    return text.empty() ? "None" : "{" + text + "}";
}

/// As _library.py counts it: the texts by their names, one after the other.
std::uint32_t checksum(FileContents files) {
    std::sort(files.begin(), files.end());
    std::uint32_t sum = 0xFFFFFFFF;
    for (const auto& [path, content] : files)
        for (const char c : content) {
            sum ^= static_cast<unsigned char>(c);
            for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320U : 0U);
        }
    return ~sum;
}

FileContents c_texts(const ExportSubject& subject) {
    FileContents texts = subject.c_files;
    for (auto& text : texts_of_runs()) texts.push_back(std::move(text));
    for (const char* name : {"many_points.h", "recorded_run.h"}) texts.emplace_back(name, embedded_file(name));
    texts.emplace_back("python.c", embedded_file("python/python.c"));
    texts.emplace_back("plant.c", fill_template(embedded_file("python/plant.c.in"), {{"NAME", subject.name}}));
    return texts;
}

std::string package_text(const ExportSubject& subject) {
    const Plant& plant = subject.plant;
    const std::string title = in_docstring(plant.title.empty() ? plant.model : plant.title);
    return fill_template(embedded_file("python/__init__.py.in"),
                         {{"NAME", subject.name},
                          {"TITLE", title},
                          {"SCENE", plant.scene},
                          {"TABLES", in_docstring(table_text("States x", plant.states) + table_text("Inputs u", plant.inputs) +
                                                  table_text("Outputs y", plant.outputs) + table_of_parameters(plant))},
                          {"EQUATIONS", in_docstring(equations_text(subject.machine))}});
}

std::string example_text(const ExportSubject& subject) {
    const ExampleRun run = example_run(subject);
    return fill_template(embedded_file("python/example.py.in"),
                         {{"NAME", subject.name},
                          {"PARAMETERS", run.parameters.empty() ? "" : fmt::format("plant.set({})\n", dictionary(run.parameters))},
                          {"START", dictionary(run.start)},
                          {"INPUTS", dictionary(run.inputs)},
                          {"UNTIL", fmt::format("{}", run.until)}});
}

}  // namespace

Exported python_files(const ExportSubject& subject, const ExportWish& wish) {
    const std::filesystem::path package = subject.name;
    const FileContents texts = c_texts(subject);
    Exported result;
    const auto put = [&](const char* name, std::string text) { result.files.emplace_back(package / name, std::move(text)); };
    put("__init__.py", package_text(subject));
    for (const char* name : {"_plant.py", "_tables.py", "_ivp.py", "_sensitivities.py", "_simulate.py", "py.typed"})
        put(name, std::string(embedded_file(fmt::format("python/{}", name))));
    put("_library.py", fill_template(embedded_file("python/_library.py.in"),
                                     {{"PLANT_VERSION", std::to_string(DALEMBERT_PLANT_VERSION)},
                                      {"OPTIONS", fmt::format("\"{}\"", fmt::join(c_library_options(), "\", \""))}}));
    put("_units.py", fill_template(embedded_file("python/_units.py.in"), {{"UNITS", units()}, {"PREFIXES", prefixes()}}));
    put("example.py", example_text(subject));
    for (const auto& [path, text] : texts) result.files.emplace_back(package / "c" / path, text);
    if (!wish.sources_only)
        for (std::vector<std::string> compiler : c_compilers()) {
            const std::string library = fmt::format("plant-{}.so", machine_of(compiler));
            compiler.push_back(fmt::format("-DDALEMBERT_TEXTS={}u", checksum(texts)));
            result.files.emplace_back(package / "c" / library, c_library(texts, "plant.c", std::move(compiler)));
        }
    for (const PlantParameter& p : subject.plant.parameter_members)
        if (attribute(p) != p.identifier)
            result.notes.push_back(fmt::format("Python or the class Plant has the name '{}' already: the parameter is the attribute '{}'",
                                               p.identifier, attribute(p)));
    return result;
}

}  // namespace dalembert
