// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"
#include "elements/key_list.hpp"

namespace dalembert {

namespace {

using T = ValueType;

const std::array model_keys{
    KeySpec{"format", T::whole_number, true, "version of the model language: 1"},
    KeySpec{"name", T::text, true, "name of files and namespaces"},
    KeySpec{"title", T::text, false, "one line for reports and plots"},
    KeySpec{"doc", T::text, false, "a sentence for the gallery: what the model shows"},
    KeySpec{"source", T::text, false, "the text the model comes from, with equation numbers"},
};
const std::vector<SectionSpec>& table() {
    static const std::vector<SectionSpec> rows{
        SectionSpec{"model", false, "What the file is about.",
                    "[model]\nformat = 1\nname   = \"cart_pendulum\"\ntitle  = \"Cart with a pendulum rod\"", model_keys, ""},
#define DALEMBERT_SECTION(name, member, Type) section_of<Type>(name),
        DALEMBERT_KINDS(DALEMBERT_SECTION)
#undef DALEMBERT_SECTION
    };
    return rows;
}

constexpr std::array value_table{
    ValueWord{T::text, "text", "text in quotes"},
    ValueWord{T::whole_number, "whole number", "a number without decimals"},
    ValueWord{T::number, "number", "a number"},
    ValueWord{T::constant, "number or expression",
              "a number in the unit of the key, a text with a unit as \"5 bar\", or an expression of parameters"},
    ValueWord{T::constants, "number(s) or expression", "one such value, or a list of them"},
    ValueWord{T::unit, "unit", "a unit in quotes: \"kg\", \"N/m\", \"1\""},
    ValueWord{T::range, "[low, high]", "two numbers; inf and -inf are allowed"},
    ValueWord{T::expression, "expression", "a number, or a formula in quotes: \"m*g*sin(phi)\""},
    ValueWord{T::vector, "[x, y] or [x, y, z]", "a list of two or three expressions; z is 0 if left out"},
    ValueWord{T::law, "law \"e -> ...\"", "a formula of one variable, which has any name: \"e -> c*e + d*e^3\""},
    ValueWord{T::property, "expression or \"(p, T) -> ...\"", "an expression of parameters, or a formula of two variables"},
    ValueWord{T::dependent, "expression or \"T -> ...\"", "an expression of parameters, or a formula of one variable"},
    ValueWord{T::field, "expression or \"(x, y) -> ...\"", "an expression, or a formula of the place"},
    ValueWord{T::equation, "equation", "an equation in quotes: \"left = right\""},
    ValueWord{T::equations, "list of equations", "several equations in quotes"},
    ValueWord{T::family, "\"k = 1..N\"", "an index with its first and last value"},
    ValueWord{T::condition, "condition", "names of effects or modes, joined by and, or, not and brackets"},
    ValueWord{T::comparison, "comparison",
              "values compared by <, <=, > or >=, joined by and, or, not and brackets: \"t < t_1 and u >= u_0\""},
    ValueWord{T::effects, "list of names", "names of other elements in quotes, in brackets: [\"a\", \"b\"]"},
    ValueWord{T::modes, "mode or list of modes", "conditions, each made of names of modes"},
    ValueWord{T::part, "name", "the name of another element, in quotes; with an index if it is a family: \"body[k]\""},
    ValueWord{T::parts, "list of names", ""},
    ValueWord{T::expressions, "list of expressions", "expressions in brackets"},
    ValueWord{T::matrix, "list of rows", "rows of expressions, or \"?\" for entries that follow from the others"},
    ValueWord{T::grid, "list of rows", "rows of numbers in brackets: [[0, 50], [10, 1.5, 1.2], [20, 3.1, 2.6]]"},
    ValueWord{T::points, "list of [x, y]", "points of the plane"},
    ValueWord{T::turns, "list of [\"x\", \"y\" or \"z\", angle]", "turns one after the other, each about an axis of the turned body"},
    ValueWord{T::tensor, "expression, [Jx, Jy, Jz] or three rows", "a moment of inertia, three principal moments, or a symmetric matrix"},
    ValueWord{T::torque, "expression or [x, y, z]", "a torque about z, or a vector"},
    ValueWord{T::pieces, "list of [length, cells]", "lengths, each with the number of its cells"},
    ValueWord{T::table, "expression or list of lists", "one expression for all, or a list for each column"},
    ValueWord{T::coordinate, "coordinate", "the name of a coordinate, with an index if it is a family"},
    ValueWord{T::expressions_by_name, "{ NAME = expression }", "an inline table that gives names an expression"},
    ValueWord{T::values_by_name, "{ NAME = expression(s) }", "an inline table that gives names an expression or a list of them"},
    ValueWord{T::choice, "one of", "one of the words below the key, in quotes"},
    ValueWord{T::plots, "list of plots", "lists of names, or tables { x = \"x\", y = [\"z\"] }"},
    ValueWord{T::tables, "list of { KEY = ... }", "inline tables with the keys below"},
    ValueWord{T::named_tables, "{ NAME = { KEY = ... } }", "inline tables with a name each, with the keys below"},
    ValueWord{T::one_or_two, "expression or list of two", "one expression, or a list of two"},
    ValueWord{T::boolean, "true or false", "without quotes"},
};

constexpr std::array domain_table{
    Domain{"quantities", "Quantities of a model", "The head of the file, and the names that formulas are made of.", "model"},
    Domain{"mechanics", "Mechanics", "Bodies, forces and energies.", "gravity"},
    Domain{"fluids", "Fluids", "Media, volumes and the flows between them.", "media"},
    Domain{"heat", "Heat", "Nodes, links, rods, blocks and enclosures.", "nodes"},
    Domain{"circuits", "Circuits", "Pins and branches of electric circuits, motors.", "pins"},
    Domain{"switching", "Modes and events", "Elements that switch, constraints and events.", "frictions"},
    Domain{"runs", "Effects, scenes and runs", "Variants of a model, equations to be checked, and simulations.", "effects"},
    Domain{"parts", "Parts", "Machines made of other files.", "use"},
};

}  // namespace

std::span<const SectionSpec> sections() { return table(); }

const SectionSpec* find_section(std::string_view name) {
    const auto found = std::find_if(table().begin(), table().end(), [&](const SectionSpec& s) { return name == s.name; });
    return found == table().end() ? nullptr : &*found;
}

const KeySpec* find_key(const SectionSpec& section, std::string_view name) {
    const auto found = std::find_if(section.keys.begin(), section.keys.end(), [&](const KeySpec& k) { return name == k.name; });
    return found == section.keys.end() ? nullptr : &*found;
}

std::span<const ValueWord> value_words() { return value_table; }

const char* describe(ValueType type) {
    return std::find_if(value_table.begin(), value_table.end(), [&](const ValueWord& row) { return row.type == type; })->word;
}

std::span<const Domain> domains() { return domain_table; }

std::vector<const SectionSpec*> sections_of(const Domain& domain) {
    std::vector<const SectionSpec*> found;
    std::string_view now;
    for (const SectionSpec& section : table()) {
        for (const Domain& one : domain_table)
            if (section.name == std::string_view(one.first)) now = one.name;
        if (now == domain.name) found.push_back(&section);
    }
    return found;
}

}  // namespace dalembert
