// SPDX-License-Identifier: GPL-3.0-or-later
// The table of everything a model file may contain. The reader takes its keys from it and `dalembert help` prints it, so that
// the two cannot drift apart.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

enum class ValueType {
    text,
    whole_number,
    number,
    constant,    ///< a number in the entry's unit, or a constant expression
    constants,   ///< a constant or a list of them
    unit,
    range,
    expression,
    vector,
    law,
    property,    ///< an expression of parameters, or a law of two variables
    dependent,   ///< an expression, or a law of one variable
    field,       ///< an expression, or a law of two places
    equation,
    equations,
    family,
    condition,
    comparison,  ///< a condition on values
    effects,
    modes,       ///< conditions, one or a list
    part,        ///< the name of another element
    parts,
    expressions,
    matrix,      ///< of expressions, or "?" for what is left out
    grid,        ///< rows of numbers
    points,      ///< in the plane
    turns,       ///< about axes, by angles
    tensor,      ///< an expression, a list of three, or three rows
    torque,      ///< an expression, or a vector
    pieces,      ///< of a length, each with the number of its cells
    table,       ///< of expressions, or one for all
    coordinate,
    expressions_by_name,
    values_by_name,  ///< expressions, or lists of them
    choice,
    plots,
    tables,      ///< each with keys of its own
    named_tables,
    one_or_two,  ///< expressions
    boolean,
};

struct KeySpec {
    const char* name;
    ValueType type;
    bool required;
    std::string doc;
    std::span<const KeySpec> (*parts)() = nullptr;  ///< the keys of a table that stands for the value
    std::string refers = {};                        ///< of a name: the kinds of elements that it may name
    std::vector<std::string> lines = {};            ///< further ones of the reference, as one for each choice
    std::string unit = {};                          ///< "kg"; with U for the unit of the element itself
    std::string start = {};                         ///< the value when it is left out
    std::string bounds = {};                        ///< "above zero"
    unsigned depends = 0;                           ///< bits of Dependence
    std::string choices = {};                       ///< the words that it takes, with what follows them in short
};

struct SectionSpec;

/// Sections that are described on one page of the reference, from one section on up to the next domain.
struct Domain {
    const char* name;
    const char* title;
    const char* doc;
    const char* first;
};
std::span<const Domain> domains();
/// In their order.
std::vector<const SectionSpec*> sections_of(const Domain& domain);

struct SectionSpec {
    const char* name;
    bool is_collection;      ///< [name.ENTRY] rather than [name]
    const char* doc;
    const char* example;     ///< TOML
    std::span<const KeySpec> keys;
    const char* short_form;  ///< the key that a bare value stands for: `m_S = "rho*V"`; empty when there is none
    std::span<const std::string> rules = {};  ///< between keys, in words
};

std::span<const SectionSpec> sections();
const SectionSpec* find_section(std::string_view name);
const KeySpec* find_key(const SectionSpec& section, std::string_view name);
const char* describe(ValueType type);

struct ValueWord {
    ValueType type;
    const char* word;
    const char* meaning;  ///< empty where the same word stands above
};
std::span<const ValueWord> value_words();

}  // namespace dalembert
