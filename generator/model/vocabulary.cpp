// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/vocabulary.hpp"

#include <algorithm>
#include <array>

namespace dalembert {

namespace {

using U = UnitRule;

constexpr std::array function_table{
    FunctionSpec{"sin", 1, U::dimensionless},   FunctionSpec{"cos", 1, U::dimensionless},  FunctionSpec{"tan", 1, U::dimensionless},
    FunctionSpec{"asin", 1, U::dimensionless},  FunctionSpec{"acos", 1, U::dimensionless}, FunctionSpec{"atan", 1, U::dimensionless},
    FunctionSpec{"atan2", 2, U::angle_of},      FunctionSpec{"sinh", 1, U::dimensionless}, FunctionSpec{"cosh", 1, U::dimensionless},
    FunctionSpec{"tanh", 1, U::dimensionless},  FunctionSpec{"exp", 1, U::dimensionless},  FunctionSpec{"log", 1, U::dimensionless},
    FunctionSpec{"sqrt", 1, U::square_root},    FunctionSpec{"abs", 1, U::same},           FunctionSpec{"sign", 1, U::sign},
    FunctionSpec{"min", 2, U::same},            FunctionSpec{"max", 2, U::same},
};

using S = Subscript;

constexpr std::array quantity_table{
    QuantitySpec{"kinetic_energy", S::optional_body, "kinetic energy of everything, or of one body"},
    QuantitySpec{"translational_energy", S::body, "kinetic energy of a body's centre of mass"},
    QuantitySpec{"rotational_energy", S::body, "kinetic energy of a body's rotation about its centre of mass"},
    QuantitySpec{"potential_energy", S::nothing, "potential energy of gravity, springs and potentials"},
    QuantitySpec{"supplied_power", S::nothing, "power of forces and torques"},
    QuantitySpec{"dissipated_power", S::nothing, "power of dampers, not negative for laws that resist"},
    QuantitySpec{"prescribed_power", S::nothing, "power of what moves the machine in a prescribed way"},
    QuantitySpec{"position", S::body_and_axis, "position of a body: position[ball, 1] is x"},
    QuantitySpec{"velocity", S::body_and_axis, "velocity of a body"},
    QuantitySpec{"generalised_force", S::coordinate, "all that acts on a coordinate, -d(potential energy)/dq included (2.214)"},
    QuantitySpec{"nonpotential_force", S::coordinate, "what acts on a coordinate without a potential (2.215)"},
    QuantitySpec{"mass_matrix", S::two_coordinates, "entry of the mass matrix M"},
    QuantitySpec{"bias", S::coordinate, "entry of the bias in M*ddot(q) + bias = Q(u)"},
};

constexpr std::array<std::string_view, 5> special_forms{"dot", "ddot", "sum", "diff", "integral"};

constexpr std::array<std::string_view, 92> keywords{
    "alignas",   "alignof",   "and",        "and_eq",       "asm",          "auto",      "bitand",    "bitor",        "bool",
    "break",     "case",      "catch",      "char",         "char8_t",      "char16_t",  "char32_t",  "class",        "compl",
    "concept",   "const",     "consteval",  "constexpr",    "constinit",    "const_cast", "continue", "co_await",     "co_return",
    "co_yield",  "decltype",  "default",    "delete",       "do",           "double",    "dynamic_cast", "else",      "enum",
    "explicit",  "export",    "extern",     "false",        "float",        "for",       "friend",    "goto",         "if",
    "inline",    "int",       "long",       "mutable",      "namespace",    "new",       "noexcept",  "not",          "not_eq",
    "nullptr",   "operator",  "or",         "or_eq",        "private",      "protected", "public",    "register",     "reinterpret_cast",
    "requires",  "return",    "short",      "signed",       "sizeof",       "static",    "static_assert", "static_cast", "struct",
    "switch",    "template",  "this",       "thread_local", "throw",        "true",      "try",       "typedef",      "typeid",
    "typename",  "union",     "unsigned",   "using",        "virtual",      "void",      "volatile",  "wchar_t",      "while",
    "xor",       "xor_eq",
};

template <class Table>
auto find_in(const Table& table, std::string_view name) -> decltype(table.data()) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return name == entry.name; });
    return found == table.end() ? nullptr : &*found;
}

}  // namespace

std::span<const FunctionSpec> functions() { return function_table; }
const FunctionSpec* find_function(std::string_view name) { return find_in(function_table, name); }
std::span<const QuantitySpec> quantities() { return quantity_table; }
const QuantitySpec* find_quantity(std::string_view name) { return find_in(quantity_table, name); }

bool is_special_form(std::string_view name) {
    return std::find(special_forms.begin(), special_forms.end(), name) != special_forms.end();
}

bool is_cpp_keyword(std::string_view name) { return std::find(keywords.begin(), keywords.end(), name) != keywords.end(); }

}  // namespace dalembert
