// SPDX-License-Identifier: GPL-3.0-or-later
// The words of the model language that every model knows: functions, and the quantities that are derived.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace dalembert {

enum class UnitRule {
    dimensionless,    ///< arguments and result
    same,             ///< all arguments and the result
    square_root,
    sign,             ///< any argument, dimensionless result
    choice,           ///< any first argument; the others and the result
    ratio,            ///< equal arguments, dimensionless result
    ratio_and_angle,  ///< the same, but for the last argument, which is dimensionless
    fourth_power,     ///< equal arguments, result their fourth power
    root_excess,      ///< c and the result; s as its square
    radiant,          ///< a in 1/b^3, result as b
    plate,            ///< the first argument by the other two
    pipe,             ///< two equal arguments, result 1 by the other two
};

struct FunctionSpec {
    const char* name;
    std::string_view arguments;  ///< their names, separated by ", "
    UnitRule units;
    const char* doc;
    const char* latex = nullptr;  ///< the command of LaTeX; null: it has none

    std::size_t count() const { return static_cast<std::size_t>(std::count(arguments.begin(), arguments.end(), ',')) + 1; }
};

std::span<const FunctionSpec> functions();
/// Of the result and of the arguments: "all the same"
const char* describe(UnitRule rule);
const FunctionSpec* find_function(std::string_view name);
/// By its command, without the backslash, or by its name, of those that have a command.
const FunctionSpec* find_function_of_latex(std::string_view command);

/// What stands in the brackets behind a derived quantity.
enum class Subscript {
    nothing,
    body,
    optional_body,
    body_and_axis,
    body_and_two_axes,
    coordinate,
    two_coordinates,
    optional_damper,
    constraint,
    cut,
    body_and_line,         ///< a body and a coordinate that moves it
    body_and_three_lines,
    solid,
    solid_and_axis,
    solid_and_axes,
    load_and_axis,
    load_and_unknown,
    sticking,
    surface,          ///< an enclosure and the number of a surface
    two_surfaces,     ///< an enclosure and the numbers of two surfaces
    fluid,            ///< a volume or reservoir
    fluid_or_medium,  ///< a volume or reservoir, or a medium with pressure and temperature
    medium,           ///< a medium with pressure and temperature
    volume,
    flow,
    warm,             ///< what has a temperature: a volume, reservoir, node or cell of a rod or block
    heated,           ///< what heat flows into or through: a volume, node or link, an end of a rod or side of a block
    optional_store,   ///< a volume, node or branch
    branch,
    pin_or_branch,
};

struct SubscriptSpec {
    Subscript subscript;
    std::size_t count;      ///< of entries in the brackets, where they stand
    const char* reference;  ///< as `dalembert help quantities` shows it
    const char* words;      ///< as in "takes ... in square brackets"
    std::array<const char*, 5> kinds{};  ///< of elements, of which the first entry names one
};

const SubscriptSpec& subscript(Subscript which);

struct QuantitySpec {
    const char* name;
    Subscript subscript;
    const char* unit;  ///< null: it follows from the indices, as Units derives it
    const char* doc;
    bool is_property = false;  ///< known from the state: usable wherever states are
    bool is_place = false;     ///< known when the bodies are: usable in forces and constraints
    bool is_velocity = false;  ///< of a body: as well, where velocities are

    /// Of a medium at a pressure and a temperature, rather than of a volume or reservoir.
    bool is_of_medium(std::size_t entries) const {
        return (subscript == Subscript::medium || subscript == Subscript::fluid_or_medium) && entries == 3;
    }
};

/// kinetic_energy, mass_matrix[q, p], ...: usable in outputs and printed equations, properties also elsewhere.
std::span<const QuantitySpec> quantities();
const QuantitySpec* find_quantity(std::string_view name);
/// The kinds of elements of which the first of so many entries names one; of three a medium, where both may stand.
std::vector<const char*> kinds_of_first(const QuantitySpec& quantity, std::size_t entries);

/// Where a form may stand.
enum class FormPlace {
    everywhere,
    outputs,            ///< of models, and printed equations
    printed_equations,  ///< models may use its name otherwise
    matrices,           ///< of printed equations
};

/// A form with a grammar of its own, such as dot(x).
struct FormSpec {
    const char* name;
    const char* written;
    FormPlace place;
    const char* doc;
};

std::span<const FormSpec> forms();
bool is_special_form(std::string_view name);
/// Those of printed equations only, which models may use as names.
bool is_printed_form(std::string_view name);

/// A name that every model has without defining it.
struct ConstantSpec {
    const char* name;
    const char* doc;
};

std::span<const ConstantSpec> known_names();

}  // namespace dalembert
