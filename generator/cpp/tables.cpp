// SPDX-License-Identifier: GPL-3.0-or-later
#include "cpp/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cpp/print.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"
#include "text/wrap.hpp"

namespace dalembert {

namespace {

using Texts = std::map<std::string, std::string>;

/// " enum : std::size_t { phi = 0, ... }; "; a long list is broken at its commas.
std::string index_list(const std::vector<std::string>& identifiers) {
    if (identifiers.empty()) return {};
    std::string indices;
    for (std::size_t i = 0; i < identifiers.size(); ++i) indices += fmt::format("{}{} = {}", i == 0 ? "" : ", ", identifiers[i], i);
    std::string text = wrapped("enum : std::size_t { " + indices + " };", 0);
    text.pop_back();
    for (std::size_t at = 100, last = 0; at < text.size(); at = last + 110) {
        const std::size_t comma = text.find(", ", at);
        if (comma == std::string::npos) break;
        text.replace(comma, 2, ",\n    ");
        last = comma;
    }
    return " " + text + " ";
}

std::string rows_of(const std::string& rows) { return rows.empty() ? "" : "\n" + rows; }

/// ", low, high", as far as they are declared.
std::string range_text(const PlantQuantity& q) {
    if (!q.low && !q.high) return {};
    return (q.low ? fmt::format(", {}", *q.low) : ", -std::numeric_limits<double>::infinity()") +
           (q.high ? fmt::format(", {}", *q.high) : "");
}

void quantities(Texts& texts, const std::string& name, const std::vector<PlantQuantity>& list) {
    std::vector<std::string> identifiers;
    std::string rows;
    for (const PlantQuantity& q : list) {
        identifiers.push_back(q.identifier);
        rows += fmt::format("    Quantity{{{}, {}, {}{}}},\n", cpp_string(q.name), cpp_string(q.unit), cpp_string(q.doc), range_text(q));
    }
    texts[name + "_INDICES"] = index_list(identifiers);
    texts[name + "_TABLE"] = rows_of(rows);
}

/// The entries that a factorisation of the matrix must read. Empty where it must read all of them.
std::string nonzero(const PlantPattern& p) {
    if (p.row_indices.size() == p.rows * p.columns) return {};
    std::vector<std::string> columns;
    for (std::size_t j = 0; j < p.columns; ++j) {
        unsigned bits = 0;
        for (std::size_t k = p.column_starts[j]; k < p.column_starts[j + 1]; ++k) bits |= 1U << p.row_indices[k];
        columns.push_back(fmt::format("{:#x}", bits));
    }
    return fmt::format(
        "    /// Bit i of number j: whether entry (i, j) can be other than zero.\n    static constexpr std::array<unsigned, "
        "{}> nonzero{{{}}};\n",
        p.columns, fmt::join(columns, ", "));
}

std::string pattern_text(const PlantPattern& p, char letter) {
    std::string text =
        fmt::format("/// df/d{}: {}\nstruct jacobian_{}_pattern {{\n    static constexpr bool is_sparse = {};\n", letter,
                    p.is_sparse ? "entries that are not zero for every motion, in compressed columns (CSC)." : "all entries are stored.",
                    letter, p.is_sparse);
    const auto list = [&](const char* name, const std::vector<std::size_t>& numbers) {
        text += fmt::format("    static constexpr std::array<std::size_t, {}> {}{{\n", numbers.size(), name);
        for (std::size_t i = 0; i < numbers.size(); i += 24)
            text += fmt::format("        {},\n",
                                fmt::join(numbers.begin() + static_cast<std::ptrdiff_t>(i),
                                          numbers.begin() + static_cast<std::ptrdiff_t>(std::min(i + 24, numbers.size())), ", "));
        text += "    };\n";
    };
    if (p.is_sparse) {
        list("column_starts", p.column_starts);
        list("row_indices", p.row_indices);
    } else if (letter == 'x') {
        text += nonzero(p);
    }
    return text + "};\n\n";
}

std::string transitions(const PlantModes& modes) {
    const auto list = [&](const std::vector<std::size_t>& to) {
        std::vector<std::string> parts;
        for (const std::size_t i : to) parts.push_back("Mode::" + modes.modes[i]);
        return parts.empty() ? std::string("{}") : fmt::format("{{{{{{{}}}}}, {}}}", fmt::join(parts, ", "), to.size());
    };
    std::string rows;
    for (std::size_t e = 0; e < modes.events.size(); ++e) {
        rows += fmt::format("    std::array<Transition, mode_count>{{{{  // {}\n", modes.events[e].name);
        for (const PlantTransition& to : modes.transitions[e])
            rows += fmt::format("        {{{}, {}, {}, {}}},\n", to.is_watched, list(to.next), list(to.beside), list(to.rest));
        rows += "    }},\n";
    }
    return rows.empty() ? "" : "{\n" + rows + "}";
}

std::string mode_tables(const PlantModes& modes) {
    std::vector<std::string> mode_names, indices, names;
    for (const std::string& mode : modes.modes) mode_names.push_back(cpp_string(mode));
    for (std::size_t e = 0; e < modes.events.size(); ++e) {
        indices.push_back(fmt::format("{} = {}", modes.events[e].identifier, e));
        names.push_back(cpp_string(modes.events[e].name));
    }
    return fill_template(embedded_file("mode_tables.hpp.in"),
                         {{"MODES", fmt::format("{}", fmt::join(modes.modes, ", "))},
                          {"MODE_COUNT", std::to_string(modes.modes.size())},
                          {"MODE_NAMES", fmt::format("{}", fmt::join(mode_names, ", "))},
                          {"EVENT_INDICES", indices.empty() ? "" : fmt::format(" enum : std::size_t {{ {} }}; ", fmt::join(indices, ", "))},
                          {"EVENT_COUNT", std::to_string(names.size())},
                          {"EVENT_NAMES", fmt::format("{}", fmt::join(names, ", "))},
                          {"MOST_MODES", std::to_string(modes.most_modes())},
                          {"TRANSITIONS", transitions(modes)}});
}

/// Of frictions with states in place of modes: which events happen at once, and which at the start of a run. Nothing if there are none.
std::string events_apart(const PlantModes& modes) {
    std::vector<bool> at_once, at_start;
    for (const PlantEvent& event : modes.events) {
        at_once.push_back(event.at_once);
        at_start.push_back(event.at_start);
    }
    if (std::find(at_once.begin(), at_once.end(), true) == at_once.end()) return {};
    return fill_template(embedded_file("mode_events_apart.hpp.in"), {{"AT_ONCE", fmt::format("{}", fmt::join(at_once, ", "))},
                                                                     {"AT_START", fmt::format("{}", fmt::join(at_start, ", "))}});
}

std::string constraint_table(const PlantConstraints& constraints) {
    std::vector<std::string> identifiers;
    std::string rows;
    for (const PlantConstraint& c : constraints.list) {
        identifiers.push_back(c.identifier);
        rows +=
            fmt::format("    Constraint{{{}, {}, {}, {}}},\n", cpp_string(c.name), cpp_string(c.unit), cpp_string(c.doc), c.has_position);
    }
    return fill_template(embedded_file("constraint_tables.hpp.in"), {{"CONSTRAINTS", std::to_string(constraints.list.size())},
                                                                     {"CONSTRAINT_INDICES", index_list(identifiers)},
                                                                     {"CONSTRAINT_TABLE", rows_of(rows)}});
}

}  // namespace

std::string cpp_curves(const std::vector<PlantCurve>& curves) {
    std::string text;
    for (const PlantCurve& curve : curves) {
        text += fmt::format("/// {}\ntemplate <class Scalar>\ninline const std::array<Scalar, {}> {}{{\n", curve.header(),
                            curve.size(), curve.table);
        for (const std::vector<Value>& row : curve.rows) {
            std::vector<std::string> numbers;
            for (const Value& value : row) numbers.push_back(cpp_text(value));
            text += wrapped_list(numbers, 4) + (&row == &curve.rows.back() ? "};\n\n" : ",\n");
        }
    }
    return text;
}

std::map<std::string, std::string> cpp_tables(const Plant& plant, const std::string& name_space) {
    Texts texts;
    texts["NAME"] = cpp_string(plant.model);
    texts["SCENE"] = cpp_string(plant.scene);
    texts["TITLE"] = cpp_string(plant.title);
    quantities(texts, "STATE", plant.states);
    quantities(texts, "INPUT", plant.inputs);
    quantities(texts, "OUTPUT", plant.outputs);
    quantities(texts, "PARAMETER", plant.parameters);
    const auto number = [&](const char* name, std::size_t value) { texts[name] = std::to_string(value); };
    number("DEGREES", plant.degrees);
    number("PLAIN_STATES", plant.plain_states);
    number("STATES", plant.states.size());
    number("INPUTS", plant.inputs.size());
    number("OUTPUTS", plant.outputs.size());
    number("PARAMETERS", plant.parameters.size());
    number("GUARDS_COUNT", plant.guards.size());
    number("SIZE_X", plant.by_state.size());
    number("SIZE_U", plant.by_input.size());
    number("SIZE_P", plant.by_parameter.size());
    std::string guards;
    for (const PlantGuard& guard : plant.guards)
        guards += fmt::format("    Guard{{{}, {}, {}}},\n", cpp_string(guard.name), cpp_string(guard.doc), guard.ends);
    texts["GUARD_TABLE"] = rows_of(guards);
    texts["SEPARABLE"] =
        plant.is_separable ? "    static constexpr bool is_separable = true;  // accelerations depend on coordinates alone\n" : "";
    texts["START_VALUES"] = fmt::format("{}", fmt::join(plant.start_values, ", "));
    texts["PATTERNS"] = pattern_text(plant.by_state, 'x') + pattern_text(plant.by_input, 'u') + pattern_text(plant.by_parameter, 'p');
    texts["MODE_TABLES"] = plant.modes ? mode_tables(*plant.modes) : "";
    texts["MODE_TYPES"] =
        plant.modes ? fill_template(embedded_file("mode_types.hpp.in"), {{"NAMESPACE", name_space}, {"APART", events_apart(*plant.modes)}})
                    : "";
    texts["CONSTRAINT_TABLES"] = plant.constraints ? constraint_table(*plant.constraints) : "";
    texts["CONSTRAINT_TYPES"] = plant.constraints ? std::string(embedded_file("constraint_types.hpp.in")) : "";
    return texts;
}

}  // namespace dalembert
