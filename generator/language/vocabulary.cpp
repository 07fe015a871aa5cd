// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/vocabulary.hpp"

#include <algorithm>
#include <array>

namespace dalembert {

namespace {

using U = UnitRule;

constexpr std::array function_table{
    FunctionSpec{"sin", "x", U::dimensionless, "sine"},
    FunctionSpec{"cos", "x", U::dimensionless, "cosine"},
    FunctionSpec{"tan", "x", U::dimensionless, "tangent"},
    FunctionSpec{"asin", "x", U::dimensionless, "arc sine"},
    FunctionSpec{"acos", "x", U::dimensionless, "arc cosine"},
    FunctionSpec{"atan", "x", U::dimensionless, "arc tangent"},
    FunctionSpec{"atan2", "y, x", U::ratio, "angle of the point (x, y)"},
    FunctionSpec{"sinh", "x", U::dimensionless, "hyperbolic sine"},
    FunctionSpec{"cosh", "x", U::dimensionless, "hyperbolic cosine"},
    FunctionSpec{"tanh", "x", U::dimensionless, "hyperbolic tangent"},
    FunctionSpec{"exp", "x", U::dimensionless, "exponential function"},
    FunctionSpec{"log", "x", U::dimensionless, "natural logarithm"},
    FunctionSpec{"sqrt", "x", U::square_root, "square root"},
    FunctionSpec{"abs", "x", U::same, "absolute value"},
    FunctionSpec{"sign", "x", U::sign, "-1, 0 or 1"},
    FunctionSpec{"min", "x, y", U::same, "the smaller one"},
    FunctionSpec{"max", "x, y", U::same, "the larger one"},
    FunctionSpec{"step", "x", U::sign, "1 for x >= 0, else 0"},
    FunctionSpec{"ramp", "x", U::same, "max(x, 0)"},
    FunctionSpec{"pulse", "x, width", U::ratio, "1 for 0 <= x < width, else 0"},
    FunctionSpec{"mod", "x, y", U::same, "x - y*(x/y rounded down), y positive: x again and again from 0 up to y"},
    FunctionSpec{"if", "condition, a, b", U::choice,
                 "a where the condition holds, else b; conditions are made of <, <=, >, >=, and, or, not"},
    FunctionSpec{"unlocated", "x", U::same,
                 "x; kinks and jumps inside are smooth enough for the control of steps, and no run looks for them"},
    FunctionSpec{"sinc", "x", U::dimensionless, "sin(x)/x, 1 at x = 0"},
    FunctionSpec{"expm1", "x", U::dimensionless, "exp(x) - 1"},
    FunctionSpec{"log1p", "x", U::dimensionless, "log(1 + x)"},
    FunctionSpec{"decay_mean", "z", U::dimensionless, "(1 - exp(-z))/z, 1 at z = 0: the mean of exp(-z*s) over s from 0 to 1"},
    FunctionSpec{"log_ratio", "a, b", U::ratio, "log(a/b), a and b positive, also where they are close"},
    FunctionSpec{"log_mean", "a, b", U::same, "logarithmic mean (a - b)/log(a/b) (4.86a), a at a = b"},
    FunctionSpec{"root_excess", "c, s", U::root_excess, "sqrt(c^2 + s) - c, s not negative"},
    FunctionSpec{"radiant_temperature", "a, b", U::radiant, "the T with a*T^4 + T = b, a and b not negative"},
    FunctionSpec{"fourth_power_difference", "a, b", U::fourth_power, "a^4 - b^4, also where they are close"},
    FunctionSpec{"plate_resistance", "L, lambda, A", U::plate, "resistance of a plane layer, L/(lambda*A) (4.63)"},
    FunctionSpec{"pipe_resistance", "r_1, r_2, lambda, L", U::pipe,
                 "resistance of a cylindrical layer from r_1 to r_2, log(r_2/r_1)/(2*pi*lambda*L) (4.68), also of thin ones"},
    FunctionSpec{"in_series", "a, b", U::same, "resistance of two resistances one behind the other, a + b (4.65), (4.108)"},
    FunctionSpec{"in_parallel", "a, b", U::same, "resistance of two resistances side by side, a*b/(a + b) (4.108)"},
    FunctionSpec{"sinh_ratio", "a, b", U::dimensionless, "sinh(a)/sinh(b), not negative, of any size"},
    FunctionSpec{"cosh_ratio", "a, b", U::dimensionless, "cosh(a)/cosh(b), not negative, of any size"},
    FunctionSpec{"fin_temperature", "mL, mx, h", U::dimensionless,
                 "excess temperature of a rod (4.76a), 1 at mx = 0; h = alpha_L/(lambda*m)"},
    FunctionSpec{"fin_heat", "mL, h", U::dimensionless, "heat into a rod (4.76b) over lambda*A*m*(T_0 - T_inf)"},
    FunctionSpec{"rod_heat", "mL, ratio", U::dimensionless,
                 "heat into a rod (4.78b) over lambda*A*m*(T_0 - T_inf); ratio = (T_L - T_inf)/(T_0 - T_inf)"},
    FunctionSpec{"effectiveness_parallel_flow", "N, c", U::dimensionless,
                 "heat over the largest possible (4.87); N = K/C_min, c = C_min/C_max"},
    FunctionSpec{"effectiveness_counter_flow", "N, c", U::dimensionless, "the same in counter flow, also where it is balanced, c = 1"},
    FunctionSpec{"plate_nusselt", "Re, Pr", U::dimensionless, "mean Nusselt number of a plate (4.24), laminar up to Re = 5e5"},
    FunctionSpec{"view_parallel_strips", "x, y, L_i, L_j", U::ratio,
                 "view factor of parallel strips from 0 to L_i and from x to x + L_j, y apart (table 4.1)"},
    FunctionSpec{"view_half_plane", "x, y, L_i", U::ratio,
                 "view factor of a strip from 0 to L_i to the half plane beyond x, y apart (table 4.1)"},
    FunctionSpec{"view_perpendicular_strips", "x, y, L_i, L_j", U::ratio,
                 "view factor of an upright surface from 0 to y, L_i long, to a strip from x to x + L_j (table 4.1)"},
    FunctionSpec{"view_wedge", "L_i, L_j, theta", U::ratio_and_angle,
                 "view factor of strips with a common edge, the angle theta between them (table 4.1)"},
    FunctionSpec{"view_groove", "x, y", U::ratio, "view factor of a right-angled groove with the sides x and y to itself (table 4.1)"},
};

using S = Subscript;

constexpr std::array subscript_table{
    SubscriptSpec{S::nothing, 0, "", "nothing"},
    SubscriptSpec{S::body, 1, "[body]", "a body"},
    SubscriptSpec{S::optional_body, 1, " or [body]", "nothing or a body"},
    SubscriptSpec{S::body_and_axis, 2, "[body, 1..3]", "a body and 1, 2 or 3"},
    SubscriptSpec{S::body_and_two_axes, 3, "[body, 1..3, 1..3]", "a body, the number of one of its axes and 1, 2 or 3"},
    SubscriptSpec{S::coordinate, 1, "[coordinate]", "a coordinate"},
    SubscriptSpec{S::two_coordinates, 2, "[coordinate, coordinate]", "two coordinates"},
    SubscriptSpec{S::optional_damper, 1, " or [damper]", "nothing or a damper"},
    SubscriptSpec{S::constraint, 1, "[constraint]", "a constraint"},
    SubscriptSpec{S::cut, 1, "[cut]", "a cut"},
    SubscriptSpec{S::body_and_line, 2, "[body, coordinate]", "a body and a coordinate"},
    SubscriptSpec{S::body_and_three_lines, 4, "[body, k, i, j]", "a body and three coordinates"},
    SubscriptSpec{S::solid, 1, "[solid]", "a solid"},
    SubscriptSpec{S::solid_and_axis, 2, "[solid, 1..3]", "a solid and 1, 2 or 3"},
    SubscriptSpec{S::solid_and_axes, 3, "[solid, 1..3, 1..3]", "a solid and two of 1, 2 and 3"},
    SubscriptSpec{S::load_and_axis, 2, "[load, 1..3]", "a load and 1, 2 or 3"},
    SubscriptSpec{S::load_and_unknown, 2, "[load, unknown]", "a load and one of its unknowns"},
    SubscriptSpec{S::sticking, 1, "[sticking]", "what may stick"},
    SubscriptSpec{S::surface, 2, "[enclosure, i]", "an enclosure and the number of a surface"},
    SubscriptSpec{S::two_surfaces, 3, "[enclosure, i, j]", "an enclosure and the numbers of two surfaces"},
    SubscriptSpec{S::fluid, 1, "[X]", "a volume, reservoir or junction"},
    SubscriptSpec{S::fluid_or_medium, 1, "[X] or [medium, p, T]",
                  "a volume, reservoir or junction, or a medium, a pressure and a temperature"},
    SubscriptSpec{S::medium, 3, "[medium, p, T]", "a medium, a pressure and a temperature"},
    SubscriptSpec{S::volume, 1, "[volume]", "a volume"},
    SubscriptSpec{S::flow, 1, "[flow]", "a flow"},
    SubscriptSpec{S::warm, 1, "[X], [node], [rod[k]], [block[k]]", "a volume, reservoir, node or cell of a rod or block"},
    SubscriptSpec{S::heated, 1, "[volume], [node], [link], [border]", "a volume, node or link, or an end of a rod or side of a block"},
    SubscriptSpec{S::optional_store, 1, " or [volume], [node]", "nothing, a volume or a node"},
};

constexpr std::array quantity_table{
    QuantitySpec{"kinetic_energy", S::optional_body, "kinetic energy of everything, or of one body"},
    QuantitySpec{"translational_energy", S::body, "kinetic energy of a body's centre of mass"},
    QuantitySpec{"rotational_energy", S::body, "kinetic energy of a body's rotation about its centre of mass"},
    QuantitySpec{"potential_energy", S::nothing, "potential energy of gravity, springs and potentials"},
    QuantitySpec{"supplied_power", S::nothing, "power of forces and torques"},
    QuantitySpec{"dissipated_power", S::optional_damper,
                 "power of all that is dissipated, or of one damper; not negative for laws that resist"},
    QuantitySpec{"constraint_force", S::constraint,
                 "force of a constraint along its rate, on the machine; of dry friction also where it slides"},
    QuantitySpec{"cut_force", S::cut, "what everything else exerts on the bodies of a cut, along its direction; with a point, the moment"},
    QuantitySpec{"solid_mass", S::solid, "mass of a solid (2.51)"},
    QuantitySpec{"centre_of_mass", S::solid_and_axis, "centre of mass of a solid (2.56), in the axes that it is placed in"},
    QuantitySpec{
        "inertia_about_centre", S::solid_and_axes,
        "tensor of inertia of a solid about its centre of mass (2.171); products of inertia as they stand in the matrix, -integral(x*y)"},
    QuantitySpec{"inertia_about_origin", S::solid_and_axes, "the same about the origin of the axes that it is placed in (2.167), (2.173)"},
    QuantitySpec{"resultant_force", S::load_and_axis, "sum of the forces of a load (2.28)"},
    QuantitySpec{"resultant_moment", S::load_and_axis, "sum of the moments of a load about its point of reference (2.38)"},
    QuantitySpec{"reaction", S::load_and_unknown,
                 "what the equilibrium of a load gives for one of its unknowns; the name of the unknown alone stands for it, too"},
    QuantitySpec{"sticks", S::sticking, "1 where friction holds, else 0"},
    QuantitySpec{"sticking_margin", S::sticking,
                 "how much more force friction could bear; negative where it slips: coefficient*normal - |tangential|; of a rope smaller "
                 "tension*exp(coefficient*angle) - larger"},
    QuantitySpec{"needed_coefficient", S::sticking,
                 "the coefficient that would just hold: |tangential|/normal (2.100); of a rope |log(tension/tension)|/angle"},
    QuantitySpec{"prescribed_power", S::nothing, "power of what moves the machine in a prescribed way"},
    QuantitySpec{"position", S::body_and_axis, "position of a body: position[ball, 1] is x", false, true},
    QuantitySpec{"axis", S::body_and_two_axes, "an axis of a body in those of the ground: axis[arm, 3, 1] is the x component of its z axis",
                 false, true},
    QuantitySpec{"velocity", S::body_and_axis, "velocity of a body", false, false, true},
    QuantitySpec{"angular_velocity", S::body_and_axis, "angular velocity of a body, about its own axes", false, false, true},
    QuantitySpec{"spin", S::body_and_axis, "angular momentum of a body about its centre of mass, in the axes of the ground"},
    QuantitySpec{"generalised_force", S::coordinate, "all that acts on a coordinate, -d(potential energy)/dq included (2.214)"},
    QuantitySpec{"nonpotential_force", S::coordinate, "what acts on a coordinate without a potential (2.215)"},
    QuantitySpec{"mass_matrix", S::two_coordinates, "entry of the mass matrix M"},
    QuantitySpec{
        "damping_matrix", S::two_coordinates,
        "d(bias - Q)/d(dot(q)) at the present state and inputs: damping_matrix[s, phi] is a row s and a column phi of D in (2.117)"},
    QuantitySpec{"stiffness_matrix", S::two_coordinates, "d(bias - Q)/dq at the present state and inputs: C in (2.117)"},
    QuantitySpec{"bias", S::coordinate, "entry of the bias in M*ddot(q) + bias = Q(u)"},
    QuantitySpec{"scale_factor", S::body_and_line,
                 "of a body's position r, |dr/dq| (2.18): length along the line of a coordinate by its change"},
    QuantitySpec{"velocity_along", S::body_and_line,
                 "component of a body's velocity along the line of a coordinate (2.19); the lines are at right angles"},
    QuantitySpec{"acceleration_along", S::body_and_line,
                 "component of a body's acceleration along the line of a coordinate (2.27), likewise"},
    QuantitySpec{
        "christoffel", S::body_and_three_lines,
        "Christoffel symbol of the second kind of a body's position: christoffel[p, k, i, j] is the part of d2r/(dq_i dq_j) along dr/dq_k"},
    QuantitySpec{"christoffel_first", S::body_and_three_lines, "of the first kind, dr/dq_k . d2r/(dq_i dq_j)"},
    QuantitySpec{"pressure", S::fluid, "pressure in a volume at its outlets, or of a reservoir or junction", true},
    QuantitySpec{"temperature", S::warm, "temperature of a volume, reservoir, node or cell of a rod or block", true},
    QuantitySpec{"density", S::fluid_or_medium,
                 "density in a volume, reservoir or junction: density[tank], or of a medium at a state: density[oil, p, T]", true},
    QuantitySpec{"specific_energy", S::fluid_or_medium, "specific internal energy", true},
    QuantitySpec{"specific_enthalpy", S::fluid_or_medium, "specific enthalpy (3.33)", true},
    QuantitySpec{"mass", S::volume, "mass in a volume", true},
    QuantitySpec{"volume", S::volume, "size of a volume", true},
    QuantitySpec{"expansion", S::medium, "isobaric thermal expansion (3.40)", true},
    QuantitySpec{"bulk_modulus", S::medium, "isothermal bulk modulus (3.41)", true},
    QuantitySpec{"pressure_coefficient", S::medium, "isochoric pressure coefficient (3.42)", true},
    QuantitySpec{"isochoric_heat", S::medium, "specific heat at constant volume (3.31)", true},
    QuantitySpec{"isobaric_heat", S::medium, "specific heat at constant pressure (3.37)", true},
    QuantitySpec{"mass_flow", S::flow, "mass flow, positive from `from` to `to`"},
    QuantitySpec{"volume_flow", S::flow, "mass flow over the density of the side that it comes from"},
    QuantitySpec{"inflow", S::fluid, "sum of the mass flows into a volume, reservoir or junction"},
    QuantitySpec{"surplus", S::volume, "mass flow into a volume less what flows out of it, or would if it were not empty"},
    QuantitySpec{"heat", S::heated,
                 "heat flow along a link; into a node; into a volume: given, or what holds its temperature or its course; through a border "
                 "into a rod, heat[bar.first], or a block, heat[plate.left]"},
    QuantitySpec{"shaft_power", S::flow, "power that the shaft of a pump puts into what flows"},
    QuantitySpec{"view_factor", S::two_surfaces, "of an enclosure: view_factor[furnace, 1, 2] (4.44)"},
    QuantitySpec{"exchange_factor", S::two_surfaces,
                 "of an enclosure: heat from one surface to another over stefan_boltzmann*(T_i^4 - T_j^4), an area"},
    QuantitySpec{"radiosity", S::surface, "of an enclosure: radiosity[furnace, 1], what leaves a surface by area (4.42)"},
    QuantitySpec{"irradiation", S::surface, "of an enclosure: irradiation[furnace, 1], what arrives at a surface by area (4.48)"},
    QuantitySpec{"internal_energy", S::optional_store, "energy stored in volumes, pipes, nodes, rods and blocks, or in one volume or node"},
    QuantitySpec{"exchanged_power", S::nothing, "power of enthalpy flows, heat and shafts across the border of the model"},
};

constexpr auto special_forms = std::to_array<std::string_view>({"dot", "ddot", "sum", "diff", "integral"});
constexpr auto printed_forms = std::to_array<std::string_view>({"limit", "at", "quantity"});

constexpr auto keywords = std::to_array<std::string_view>({
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
});

/// Macros of the headers that a generated header includes, and of compilers by themselves: no name survives them.
constexpr auto macros = std::to_array<std::string_view>({
    "NULL",
    "NAN",
    "INFINITY",
    "HUGE_VAL",
    "HUGE_VALF",
    "HUGE_VALL",
    "MATH_ERRNO",
    "MATH_ERREXCEPT",
    "FP_NAN",
    "FP_INFINITE",
    "FP_ZERO",
    "FP_SUBNORMAL",
    "FP_NORMAL",
    "FP_FAST_FMA",
    "FP_FAST_FMAF",
    "FP_FAST_FMAL",
    "FP_ILOGB0",
    "FP_ILOGBNAN",
    "M_E",
    "M_LOG2E",
    "M_LOG10E",
    "M_LN2",
    "M_LN10",
    "M_PI",
    "M_PI_2",
    "M_PI_4",
    "M_1_PI",
    "M_2_PI",
    "M_2_SQRTPI",
    "M_SQRT2",
    "M_SQRT1_2",
    "linux",
    "unix",
    "i386",
    "errno",
    "assert",
    "EOF",
    "MAXFLOAT",
    "SNAN",
    "SNANF",
    "SNANL",
    "RAND_MAX",
    "BIG_ENDIAN",
    "LITTLE_ENDIAN",
    "PDP_ENDIAN",
    "BYTE_ORDER",
    "EXIT_SUCCESS",
    "EXIT_FAILURE",
    "MB_CUR_MAX",
    "FD_SETSIZE",
    "NFDBITS",
    "WNOHANG",
    "WUNTRACED",
    "WSTOPPED",
    "WEXITED",
    "WCONTINUED",
    "WNOWAIT",
    "FP_INT_UPWARD",
    "FP_INT_DOWNWARD",
    "FP_INT_TOWARDZERO",
    "FP_INT_TONEAREST",
    "FP_INT_TONEARESTFROMZERO",
    "DOMAIN",
    "SING",
    "OVERFLOW",
    "UNDERFLOW",
    "TLOSS",
    "PLOSS",
});

/// Functions that C headers put outside of every namespace, of mathematics without their endings f and l.
constexpr auto global_functions = std::to_array<std::string_view>({
    "acos",     "acosh",   "asin",      "asinh",     "atan",        "atan2",     "atanh",     "cbrt",     "ceil",    "copysign", "cos",
    "cosh",     "drem",    "erf",       "erfc",      "exp",         "exp10",     "exp2",      "expm1",    "fabs",    "fdim",     "floor",
    "fma",      "fmax",    "fmin",      "fmod",      "frexp",       "gamma",     "hypot",     "ilogb",    "j0",      "j1",       "jn",
    "ldexp",    "lgamma",  "llrint",    "llround",   "log",         "log10",     "log1p",     "log2",     "logb",    "lrint",    "lround",
    "modf",     "nan",     "nearbyint", "nextafter", "nexttoward",  "pow",       "remainder", "remquo",   "rint",    "round",    "scalb",
    "scalbln",  "scalbn",  "signgam",   "signbit",   "significand", "sin",       "sincos",    "sinh",     "sqrt",    "tan",      "tanh",
    "tgamma",   "trunc",   "y0",        "y1",        "yn",          "abs",       "labs",      "llabs",    "div",     "ldiv",     "finite",
    "isinf",    "isnan",   "time",      "clock",     "index",       "link",      "pause",     "pipe",     "random",  "select",   "signal",
    "system",   "wait",    "exit",      "free",      "abort",       "malloc",    "calloc",    "realloc",  "rand",    "srand",    "getenv",
    "setenv",   "atoi",    "atof",      "atol",      "atoll",       "strtod",    "strtof",    "strtold",  "strtol",  "strtoll",  "strtoul",
    "strtoull", "qsort",   "bsearch",   "lldiv",     "size_t",      "double_t",  "float_t",   "div_t",    "ldiv_t",  "lldiv_t",  "int8_t",
    "int16_t",  "int32_t", "int64_t",   "uint",      "ushort",      "ulong",     "timeval",   "timespec", "fd_set",  "locale_t", "realpath",
    "drand48",  "erand48", "lrand48",   "mblen",     "wctomb",      "mbtowc",    "putenv",    "mktemp",   "pselect", "alloca",   "remove",
    "rename",   "printf",  "memcpy",    "memchr",    "memset",      "strlen",    "strcpy",    "strcmp",   "strchr",  "puts",     "read",
    "write",    "open",    "close",     "main",      "System",      "dalembert", "boost",     "Eigen",    "detail",
});

/// What every header defines itself, or takes from <cmath> by a using declaration.
constexpr auto header_names = std::to_array<std::string_view>({
    "System",
    "Parameters",
    "Scalar",
    "Quantity",
    "State",
    "Input",
    "Output",
    "Generalised",
    "MassMatrix",
    "JacobianX",
    "JacobianU",
    "JacobianP",
    "JacobianT",
    "OutputJacobianX",
    "OutputJacobianU",
    "PatternX",
    "PatternU",
    "PatternP",
    "Cached",
    "scalar_type",
    "state",
    "input",
    "output",
    "parameter",
    "name",
    "scene",
    "title",
    "api",
    "api_version",
    "degrees",
    "degrees_of_freedom",
    "state_count",
    "input_count",
    "output_count",
    "parameter_count",
    "start_values",
    "state_quantities",
    "input_quantities",
    "output_quantities",
    "parameter_quantities",
    "jacobian_x_pattern",
    "jacobian_u_pattern",
    "jacobian_p_pattern",
    "detail",
    "pow",
    "rhs",
    "rhs_and_jacobian",
    "jacobian_x",
    "jacobian_u",
    "jacobian_p",
    "jacobian_t",
    "update",
    "parameters",
    "start_state",
    "mode",
    "mass_factors",
    "Guard",
    "Guards",
    "guards",
    "guard",
    "guard_count",
    "guard_list",
    "Mode",
    "Modes",
    "Event",
    "Events",
    "Kinks",
    "kinks",
    "guard_rates",
    "holds",
    "reset",
    "settle",
    "is_watched",
    "next_modes",
    "after_accumulation",
    "mode_table",
    "event_table",
    "event",
    "event_count",
    "mode_count",
});

template <class Table>
auto find_in(const Table& table, std::string_view name) -> decltype(table.data()) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return name == entry.name; });
    return found == table.end() ? nullptr : &*found;
}

}  // namespace

std::span<const FunctionSpec> functions() { return function_table; }
const FunctionSpec* find_function(std::string_view name) { return find_in(function_table, name); }
const SubscriptSpec& subscript(Subscript which) {
    for (const SubscriptSpec& spec : subscript_table)
        if (spec.subscript == which) return spec;
    return subscript_table.front();
}

std::span<const QuantitySpec> quantities() { return quantity_table; }
const QuantitySpec* find_quantity(std::string_view name) { return find_in(quantity_table, name); }

bool is_special_form(std::string_view name) {
    return std::find(special_forms.begin(), special_forms.end(), name) != special_forms.end();
}

bool is_printed_form(std::string_view name) { return std::find(printed_forms.begin(), printed_forms.end(), name) != printed_forms.end(); }

bool is_cpp_keyword(std::string_view name) { return std::find(keywords.begin(), keywords.end(), name) != keywords.end(); }
bool is_cpp_macro(std::string_view name) {
    const auto has = [](std::string_view base) { return std::find(macros.begin(), macros.end(), base) != macros.end(); };
    if (has(name)) return true;
    // Limits of arithmetic, of <float.h>.
    if (name.starts_with("FLT_") || name.starts_with("DBL_") || name.starts_with("LDBL_") || name == "DECIMAL_DIG") return true;
    // M_PI also as M_PIf, M_PIl, M_PIf128, ...
    const auto suffixed = [&](std::string_view base) {
        return base.starts_with("M_") && name.starts_with(base) &&
               name.substr(base.size()).find_first_not_of("flx0123468") == std::string_view::npos &&
               (name[base.size()] == 'f' || name[base.size()] == 'l');
    };
    return std::any_of(macros.begin(), macros.end(), suffixed);
}

bool is_header_name(std::string_view name) { return std::find(header_names.begin(), header_names.end(), name) != header_names.end(); }

bool is_global_function(std::string_view name) {
    const auto has = [](std::string_view base) {
        return std::find(global_functions.begin(), global_functions.end(), base) != global_functions.end();
    };
    return has(name) || ((name.ends_with('f') || name.ends_with('l')) && has(name.substr(0, name.size() - 1)));
}

}  // namespace dalembert
