// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/derivatives_in_c.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "text/diagnostic.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

using Numbers = std::map<std::string, std::string>;

/// More entries are written as loops: straight code is faster, but it grows.
constexpr std::size_t most_written_out = 400;

bool uses_time(const PlantFunction& f) {
    return std::any_of(f.body.arguments.begin(), f.body.arguments.end(), [](const Argument& a) { return a.name == "t" && a.is_used; });
}

bool uses_time(const FieldColumn& column) {
    const auto is_there = [](const FunctionCode& f) {
        return std::any_of(f.results.begin(), f.results.end(), [&](NodeId id) { return !f.is_zero(id); });
    };
    const auto any = [&](const std::vector<FunctionCode>& laws) { return std::any_of(laws.begin(), laws.end(), is_there); };
    return column.by == By::time && (any(column.faces) || any(column.sides) || any(column.cells));
}

bool has_time(const ExportSubject& subject) {
    for (const PlantFunction& f : subject.plant.functions)
        if ((f.name == "rhs" || f.name == "output") && uses_time(f)) return true;
    if (subject.machine.fields == nullptr) return false;
    for (const FieldFunctions& field : subject.machine.fields->fields)
        for (const FieldColumn& column : field.columns)
            if (uses_time(column)) return true;
    return false;
}

/// "NAME_m_MODE, ", an argument; empty where the machine does not switch.
std::string mode_argument(const ExportSubject& subject, const ExportWish& wish, const char* tool) {
    if (!subject.plant.modes) return {};
    if (wish.mode.empty())
        throw Failure(Diagnostic{
            Id::bad_option, {},
            fmt::format("the scene '{}' of '{}' switches between modes, and {} takes functions without events; choose one with `--mode` "
                        "({}), export to `fmi2` or `fmi3`, or take a scene without switching",
                        subject.plant.scene, subject.plant.model, tool, fmt::join(subject.plant.modes->modes, ", "))});
    return fmt::format("{}_m_{}, ", subject.name, wish.mode);
}

/// Statements about the entries of a pattern.
class EntryPrinter {
public:
    EntryPrinter(const PlantPattern& pattern, const std::string& name, const char* by) : pattern_(pattern), name_(name), by_(by) {}

    /// `statement`: with {k} number, {r} row, {c} column, {s} place where it is stored.
    std::string each(const char* statement, std::initializer_list<const char*> arguments) const {
        if (pattern_.row_indices.empty()) {
            std::string unused;
            for (const char* argument : arguments) unused += fmt::format("    (void){};\n", argument);
            return unused;
        }
        const auto filled = [&](const auto& k, const auto& r, const auto& c, const auto& s) {
            return fmt::format(fmt::runtime(statement), fmt::arg("k", k), fmt::arg("r", r), fmt::arg("c", c), fmt::arg("s", s));
        };
        if (pattern_.row_indices.size() > most_written_out) {
            const std::string columns = fmt::format("{}_pattern_{} + 2", name_, by_);
            return fmt::format("    const {0}_int *const starts = {1}, *const rows = starts + {3};\n"
                               "    for (size_t c = 0; c < {2}; ++c)\n"
                               "        for (size_t k = (size_t)starts[c]; k < (size_t)starts[c + 1]; ++k) {{\n"
                               "            const size_t r = (size_t)rows[k];\n            (void)r;\n            {4}\n        }}\n",
                               name_, columns, pattern_.columns, pattern_.columns + 1,
                               filled("k", "r", "c", pattern_.is_sparse ? "k" : fmt::format("{} * c + r", pattern_.rows)));
        }
        std::string text;
        for (std::size_t c = 0; c < pattern_.columns; ++c)
            for (std::size_t k = pattern_.column_starts[c]; k < pattern_.column_starts[c + 1]; ++k) {
                const std::size_t r = pattern_.row_indices[k];
                text += "    " + filled(k, r, c, pattern_.is_sparse ? k : pattern_.rows * c + r) + "\n";
            }
        return text;
    }

private:
    const PlantPattern& pattern_;
    const std::string& name_;
    const char* by_;
};

std::string matrix(PlantPattern pattern, const std::string& name, const char* by) {
    if (pattern.columns == 0) pattern.column_starts = {0};
    std::vector<std::size_t> numbers{pattern.rows, pattern.columns};
    numbers.insert(numbers.end(), pattern.column_starts.begin(), pattern.column_starts.end());
    numbers.insert(numbers.end(), pattern.row_indices.begin(), pattern.row_indices.end());
    const EntryPrinter entries(pattern, name, by);
    return fill_template(embedded_file("pattern_of_entries.h.in"),
                         {{"NAME", name},
                          {"BY", by},
                          {"PATTERN", number_lines(numbers)},
                          {"ENTRIES", entries.each("out[{k}] = J[{s}];", {"J", "out"})},
                          {"SPREAD", entries.each(fmt::format("out[{} * {{c}} + {{r}}] = J[{{s}}];", pattern.rows).c_str(), {"J", "out"})},
                          {"PRODUCT", entries.each("out[{r}] += J[{s}] * v[{c}];", {"J", "v", "out"})},
                          {"TRANSPOSED", entries.each("out[{c}] += J[{s}] * w[{r}];", {"J", "w", "out"})}});
}

}  // namespace

std::string number_lines(const std::vector<std::size_t>& numbers) {
    constexpr std::size_t longest = 120;
    std::string text, line;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        line += std::to_string(numbers[i]) + (i + 1 < numbers.size() ? ", " : "");
        if (line.size() < longest) continue;
        text += line + "\n    ";
        line.clear();
    }
    return text + line;
}

DerivativesInC derivatives_in_c(const ExportSubject& subject, const ExportWish& wish, const char* tool) {
    const Plant& plant = subject.plant;
    DerivativesInC result;
    result.has_time = has_time(subject);
    const auto has = [&](Function function) { return subject.machine.wished.contains(function); };
    result.has_hessian = has(Function::hessian);
    result.has_outputs_by_parameter = has(Function::output_jacobian_p);
    result.has_outputs_by_time = has(Function::output_jacobian_t);
    const std::string mode = mode_argument(subject, wish, tool);
    const std::size_t n = plant.states.size(), m = plant.inputs.size(), l = plant.outputs.size(), p = plant.parameters.size();
    std::size_t entries = 0;
    for (const PlantPattern* pattern : {&plant.by_state, &plant.by_input, &plant.by_parameter}) entries += pattern->row_indices.size();
    const bool is_small = m > 0 && p > 0 && entries <= most_written_out && subject.machine.fields == nullptr;
    result.numbers = {{"NAME", subject.name},
                      {"TITLE", safe_line(plant.title) + (mode.empty() ? "" : fmt::format(", in the mode {}", wish.mode))},
                      {"STATES", std::to_string(n)},
                      {"INPUTS", std::to_string(m)},
                      {"OUTPUTS", std::to_string(l)},
                      {"PARAMETERS", std::to_string(p)},
                      {"HAS_TIME", result.has_time ? "1" : "0"},
                      {"IS_SMALL", is_small ? "1" : "0"}};
    const auto room = [](std::initializer_list<std::size_t> sizes) { return std::to_string(std::max({std::size_t{1}, std::max(sizes)})); };
    std::string guard = subject.name + "_derivatives_h";
    for (char& c : guard) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    result.file = {subject.name + "_derivatives.h",
                   fill_template(embedded_file("derivatives.h.in"),
                                 {{"NAME", subject.name},
                                  {"TITLE", result.numbers["TITLE"]},
                                  {"GUARD", guard},
                                  {"MODE", mode},
                                  {"HAS_HESSIAN", result.has_hessian ? "1" : "0"},
                                  {"HAS_BY_P", result.has_outputs_by_parameter ? "1" : "0"},
                                  {"HAS_BY_T", result.has_outputs_by_time ? "1" : "0"},
                                  {"PARAMETERS", std::to_string(p)},
                                  {"ROOM_X", room({n})},
                                  {"ROOM_U", room({m})},
                                  {"ROOM_P", room({p})},
                                  {"ROOM_Y", room({l})},
                                  {"NONZEROS_X", std::to_string(plant.by_state.row_indices.size())},
                                  {"NONZEROS_U", std::to_string(plant.by_input.row_indices.size())},
                                  {"NONZEROS_P", std::to_string(plant.by_parameter.row_indices.size())},
                                  {"ROOM_J", room({plant.by_state.size(), plant.by_input.size(), plant.by_parameter.size()})},
                                  {"ROOM_C", room({l, l * n, l * m, l * p})},
                                  {"ROOM_ZEROS", room({n, m, p, l})},
                                  {"MATRICES", matrix(plant.by_state, subject.name, "x") + matrix(plant.by_input, subject.name, "u") +
                                                   matrix(plant.by_parameter, subject.name, "p")}})};
    return result;
}

}  // namespace dalembert
