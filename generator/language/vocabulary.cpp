// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/vocabulary.hpp"

#include <algorithm>
#include <array>

namespace dalembert {

namespace {

using U = UnitRule;

constexpr std::array function_table{
    FunctionSpec{"sin", "x", U::dimensionless, "sine", "\\sin"},
    FunctionSpec{"cos", "x", U::dimensionless, "cosine", "\\cos"},
    FunctionSpec{"tan", "x", U::dimensionless, "tangent", "\\tan"},
    FunctionSpec{"asin", "x", U::dimensionless, "arc sine", "\\arcsin"},
    FunctionSpec{"acos", "x", U::dimensionless, "arc cosine", "\\arccos"},
    FunctionSpec{"atan", "x", U::dimensionless, "arc tangent", "\\arctan"},
    FunctionSpec{"atan2", "y, x", U::ratio, "angle of the point (x, y)"},
    FunctionSpec{"sinh", "x", U::dimensionless, "hyperbolic sine", "\\sinh"},
    FunctionSpec{"cosh", "x", U::dimensionless, "hyperbolic cosine", "\\cosh"},
    FunctionSpec{"tanh", "x", U::dimensionless, "hyperbolic tangent", "\\tanh"},
    FunctionSpec{"exp", "x", U::dimensionless, "exponential function", "\\exp"},
    FunctionSpec{"log", "x", U::dimensionless, "natural logarithm", "\\ln"},
    FunctionSpec{"sqrt", "x", U::square_root, "square root"},
    FunctionSpec{"abs", "x", U::same, "absolute value"},
    FunctionSpec{"sign", "x", U::sign, "-1, 0 or 1: the sign of x"},
    FunctionSpec{"min", "x, y", U::same, "the smaller argument", "\\min"},
    FunctionSpec{"max", "x, y", U::same, "the larger argument", "\\max"},
    FunctionSpec{"step", "x", U::sign, "1 for x >= 0, else 0"},
    FunctionSpec{"ramp", "x", U::same, "max(x, 0)"},
    FunctionSpec{"pulse", "x, width", U::ratio, "1 for 0 <= x < width, else 0"},
    FunctionSpec{"mod", "x, y", U::same, "remainder x - y*floor(x/y), y positive"},
    FunctionSpec{"if", "condition, a, b", U::choice,
                 "a where the condition holds, else b; conditions are made of <, <=, >, >=, and, or, not"},
    FunctionSpec{"unlocated", "x", U::same, "x; a run does not locate the kinks and jumps in it"},
    FunctionSpec{"sinc", "x", U::dimensionless, "sin(x)/x, 1 at x = 0"},
    FunctionSpec{"expm1", "x", U::dimensionless, "exp(x) - 1"},
    FunctionSpec{"log1p", "x", U::dimensionless, "log(1 + x)"},
    FunctionSpec{"decay_mean", "z", U::dimensionless, "(1 - exp(-z))/z, 1 at z = 0: the mean of exp(-z*s) over s from 0 to 1"},
    FunctionSpec{"log_ratio", "a, b", U::ratio, "log(a/b), accurate also for a close to b; a and b positive"},
    FunctionSpec{"log_mean", "a, b", U::same, "logarithmic mean (a - b)/log(a/b) (4.86a), a at a = b"},
    FunctionSpec{"root_excess", "c, s", U::root_excess, "sqrt(c^2 + s) - c; s not negative"},
    FunctionSpec{"radiant_temperature", "a, b", U::radiant, "the solution T of a*T^4 + T = b; a and b not negative"},
    FunctionSpec{"fourth_power_difference", "a, b", U::fourth_power, "a^4 - b^4, accurate also for a close to b"},
    FunctionSpec{"plate_resistance", "L, lambda, A", U::plate, "thermal resistance of a plane layer, L/(lambda*A) (4.63)"},
    FunctionSpec{"pipe_resistance", "r_1, r_2, lambda, L", U::pipe,
                 "thermal resistance of a cylindrical layer from r_1 to r_2, log(r_2/r_1)/(2*pi*lambda*L) (4.68), accurate also "
                 "for thin layers"},
    FunctionSpec{"in_series", "a, b", U::same, "resistance of two resistances in series, a + b (4.65), (4.108)"},
    FunctionSpec{"in_parallel", "a, b", U::same, "resistance of two resistances in parallel, a*b/(a + b) (4.108)"},
    FunctionSpec{"sinh_ratio", "a, b", U::dimensionless, "sinh(a)/sinh(b), without overflow; a and b not negative"},
    FunctionSpec{"cosh_ratio", "a, b", U::dimensionless, "cosh(a)/cosh(b), without overflow; a and b not negative"},
    FunctionSpec{"fin_temperature", "mL, mx, h", U::dimensionless,
                 "excess temperature of a rod (4.76a), 1 at mx = 0; h = alpha_L/(lambda*m)"},
    FunctionSpec{"fin_heat", "mL, h", U::dimensionless, "heat flow into a rod (4.76b) divided by lambda*A*m*(T_0 - T_inf)"},
    FunctionSpec{"rod_heat", "mL, ratio", U::dimensionless,
                 "heat flow into a rod (4.78b) divided by lambda*A*m*(T_0 - T_inf); ratio = (T_L - T_inf)/(T_0 - T_inf)"},
    FunctionSpec{"effectiveness_parallel_flow", "N, c", U::dimensionless,
                 "effectiveness of a heat exchanger with parallel flow (4.87): heat divided by the largest possible heat; N = "
                 "K/C_min, c = C_min/C_max"},
    FunctionSpec{"effectiveness_counter_flow", "N, c", U::dimensionless,
                 "effectiveness of a heat exchanger with counter flow, also for c = 1"},
    FunctionSpec{"plate_nusselt", "Re, Pr", U::dimensionless, "mean Nusselt number of a plate (4.24), laminar up to Re = 5e5"},
    FunctionSpec{"view_parallel_strips", "x, y, L_i, L_j", U::ratio,
                 "view factor of two parallel strips at distance y: from 0 to L_i and from x to x + L_j (table 4.1)"},
    FunctionSpec{"view_half_plane", "x, y, L_i", U::ratio,
                 "view factor from a strip from 0 to L_i to the parallel half plane beyond x at distance y (table 4.1)"},
    FunctionSpec{"view_perpendicular_strips", "x, y, L_i, L_j", U::ratio,
                 "view factor of an upright surface from 0 to y, L_i long, to a strip from x to x + L_j (table 4.1)"},
    FunctionSpec{"view_wedge", "L_i, L_j, theta", U::ratio_and_angle,
                 "view factor of two strips with a common edge and the angle theta between them (table 4.1)"},
    FunctionSpec{"view_groove", "x, y", U::ratio, "view factor of a right-angled groove with sides x and y to itself (table 4.1)"},
};

using S = Subscript;

constexpr std::array subscript_table{
    SubscriptSpec{S::nothing, 0, "", "nothing"},
    SubscriptSpec{S::body, 1, "[body]", "a body", {"body"}},
    SubscriptSpec{S::optional_body, 1, " or [body]", "nothing or a body", {"body"}},
    SubscriptSpec{S::body_and_axis, 2, "[body, 1..3]", "a body and 1, 2 or 3", {"body"}},
    SubscriptSpec{S::body_and_two_axes, 3, "[body, 1..3, 1..3]", "a body, the number of one of its axes and 1, 2 or 3", {"body"}},
    SubscriptSpec{S::coordinate, 1, "[coordinate]", "a coordinate", {"coordinate"}},
    SubscriptSpec{S::two_coordinates, 2, "[coordinate, coordinate]", "two coordinates", {"coordinate"}},
    SubscriptSpec{S::optional_damper, 1, " or [damper], [branch]", "nothing, a damper or a branch", {"damper", "friction", "branch"}},
    SubscriptSpec{S::constraint, 1, "[constraint]", "a constraint", {"constraint"}},
    SubscriptSpec{S::cut, 1, "[cut]", "a cut", {"cut"}},
    SubscriptSpec{S::body_and_line, 2, "[body, coordinate]", "a body and a coordinate", {"body"}},
    SubscriptSpec{S::body_and_three_lines, 4, "[body, k, i, j]", "a body and three coordinates", {"body"}},
    SubscriptSpec{S::solid, 1, "[solid]", "a solid", {"solid"}},
    SubscriptSpec{S::solid_and_axis, 2, "[solid, 1..3]", "a solid and 1, 2 or 3", {"solid"}},
    SubscriptSpec{S::solid_and_axes, 3, "[solid, 1..3, 1..3]", "a solid and two of 1, 2 and 3", {"solid"}},
    SubscriptSpec{S::load_and_axis, 2, "[load, 1..3]", "a load and 1, 2 or 3", {"load"}},
    SubscriptSpec{S::load_and_unknown, 2, "[load, unknown]", "a load and one of its unknowns", {"load"}},
    SubscriptSpec{S::sticking, 1, "[sticking]", "what may stick", {"sticking"}},
    SubscriptSpec{S::surface, 2, "[enclosure, i]", "an enclosure and the number of a surface", {"enclosure"}},
    SubscriptSpec{S::two_surfaces, 3, "[enclosure, i, j]", "an enclosure and the numbers of two surfaces", {"enclosure"}},
    SubscriptSpec{S::fluid, 1, "[X]", "a volume, reservoir or junction", {"volume", "reservoir", "junction"}},
    SubscriptSpec{S::fluid_or_medium, 1, "[X] or [medium, p, T]",
                  "a volume, reservoir or junction, or a medium, a pressure and a temperature", {"volume", "reservoir", "junction"}},
    SubscriptSpec{S::medium, 3, "[medium, p, T]", "a medium, a pressure and a temperature", {"medium"}},
    SubscriptSpec{S::volume, 1, "[volume]", "a volume", {"volume"}},
    SubscriptSpec{S::flow, 1, "[flow]", "a flow", {"flow"}},
    SubscriptSpec{S::warm, 1, "[X], [node], [rod[k]], [block[k]]", "a volume, reservoir, node or cell of a rod or block",
                  {"volume", "reservoir", "node", "rod", "block"}},
    SubscriptSpec{S::heated, 1, "[volume], [node], [link], [border]", "a volume, node or link, or an end of a rod or side of a block",
                  {"volume", "node", "link", "border of a rod or block"}},
    SubscriptSpec{S::optional_store, 1, " or [volume], [node], [branch]", "nothing, a volume, a node or a branch",
                  {"volume", "node", "branch"}},
    SubscriptSpec{S::branch, 1, "[branch]", "a branch of a circuit", {"branch"}},
    SubscriptSpec{S::pin_or_branch, 1, "[pin], [branch]", "a pin or a branch of a circuit", {"pin", "branch"}},
};

constexpr std::array quantity_table{
    QuantitySpec{"kinetic_energy", S::optional_body, "J", "kinetic energy of the model, or of one body"},
    QuantitySpec{"translational_energy", S::body, "J", "kinetic energy of the translation of a body"},
    QuantitySpec{"rotational_energy", S::body, "J", "kinetic energy of the rotation of a body about its centre of mass"},
    QuantitySpec{"potential_energy", S::nothing, "J", "potential energy of gravity, springs and potentials"},
    QuantitySpec{"supplied_power", S::nothing, "W", "power of forces, torques, and sources of circuits"},
    QuantitySpec{"dissipated_power", S::optional_damper, "W",
                 "total dissipated power, or that of one damper or resistor; not negative if the laws resist motion"},
    QuantitySpec{"constraint_force", S::constraint, nullptr,
                 "constraint force along its rate, on the machine; of dry friction also while it slides"},
    QuantitySpec{"cut_force", S::cut, nullptr,
                 "force that everything else exerts on the bodies of a cut, along its direction; with a point, the moment"},
    QuantitySpec{"solid_mass", S::solid, "kg", "mass of a solid (2.51)"},
    QuantitySpec{"centre_of_mass", S::solid_and_axis, "m", "centre of mass of a solid (2.56), in the axes that the solid is placed in"},
    QuantitySpec{"inertia_about_centre", S::solid_and_axes, "kg*m^2",
                 "inertia tensor of a solid about its centre of mass (2.171); products of inertia as in the matrix, -integral(x*y)"},
    QuantitySpec{"inertia_about_origin", S::solid_and_axes, "kg*m^2",
                 "inertia tensor about the origin of the axes that the solid is placed in (2.167), (2.173)"},
    QuantitySpec{"resultant_force", S::load_and_axis, "N", "sum of the forces of a load (2.28)"},
    QuantitySpec{"resultant_moment", S::load_and_axis, "N*m", "sum of the moments of a load about its reference point (2.38)"},
    QuantitySpec{"reaction", S::load_and_unknown, nullptr,
                 "value of an unknown of a load in equilibrium; the name of the unknown alone means the same"},
    QuantitySpec{"sticks", S::sticking, "1", "1 if static friction holds, else 0"},
    QuantitySpec{"sticking_margin", S::sticking, nullptr,
                 "friction force left before slipping, coefficient*normal - |tangential|; negative if it slips. Of a rope: "
                 "smaller tension*exp(coefficient*angle) - larger tension"},
    QuantitySpec{"needed_coefficient", S::sticking, "1",
                 "smallest coefficient that holds: |tangential|/normal (2.100); of a rope |log(tension/tension)|/angle"},
    QuantitySpec{"prescribed_power", S::nothing, "W", "power of prescribed motions"},
    QuantitySpec{"position", S::body_and_axis, "m", "position of a body: `position[ball, 1]` is x", false, true},
    QuantitySpec{"axis", S::body_and_two_axes, "1",
                 "an axis of a body in the axes of the ground: `axis[arm, 3, 1]` is the x component of its z axis", false, true},
    QuantitySpec{"velocity", S::body_and_axis, "m/s", "velocity of a body", false, false, true},
    QuantitySpec{"angular_velocity", S::body_and_axis, "1/s", "angular velocity of a body in its own axes", false, false, true},
    QuantitySpec{"spin", S::body_and_axis, "J*s", "angular momentum of a body about its centre of mass, in the axes of the ground"},
    QuantitySpec{"generalised_force", S::coordinate, nullptr,
                 "total generalised force on a coordinate, with -d(potential energy)/dq (2.214)"},
    QuantitySpec{"nonpotential_force", S::coordinate, nullptr,
                 "generalised force on a coordinate without the part from potentials (2.215)"},
    QuantitySpec{"mass_matrix", S::two_coordinates, nullptr, "entry of the mass matrix M"},
    QuantitySpec{"damping_matrix", S::two_coordinates, nullptr,
                 "d(bias - Q)/d(dot(q)) at the present state and inputs: `damping_matrix[s, phi]` is row s, column phi of D in (2.117)"},
    QuantitySpec{"stiffness_matrix", S::two_coordinates, nullptr, "d(bias - Q)/dq at the present state and inputs: C in (2.117)"},
    QuantitySpec{"bias", S::coordinate, nullptr, "entry of the bias in M*ddot(q) + bias = Q(u)"},
    QuantitySpec{"scale_factor", S::body_and_line, nullptr,
                 "|dr/dq| of the position r of a body (2.18): length along a coordinate line divided by the change of the coordinate"},
    QuantitySpec{"velocity_along", S::body_and_line, "m/s",
                 "component of the velocity of a body along a coordinate line (2.19); the lines must be orthogonal"},
    QuantitySpec{"acceleration_along", S::body_and_line, "m/s^2",
                 "component of the acceleration of a body along a coordinate line (2.27); the lines must be orthogonal"},
    QuantitySpec{"christoffel", S::body_and_three_lines, nullptr,
                 "Christoffel symbol of the second kind of the position of a body: `christoffel[p, k, i, j]` is the component "
                 "of d2r/(dq_i dq_j) along dr/dq_k"},
    QuantitySpec{"christoffel_first", S::body_and_three_lines, nullptr, "Christoffel symbol of the first kind, dr/dq_k . d2r/(dq_i dq_j)"},
    QuantitySpec{"pressure", S::fluid, "Pa", "pressure in a volume at its outlets, or of a reservoir or junction", true},
    QuantitySpec{"temperature", S::warm, "K", "temperature of a volume, reservoir, node or cell of a rod or block", true},
    QuantitySpec{"density", S::fluid_or_medium, "kg/m^3",
                 "density in a volume, reservoir or junction: `density[tank]`, or of a medium at a state: `density[oil, p, T]`", true},
    QuantitySpec{"specific_energy", S::fluid_or_medium, "J/kg", "specific internal energy", true},
    QuantitySpec{"specific_enthalpy", S::fluid_or_medium, "J/kg", "specific enthalpy (3.33)", true},
    QuantitySpec{"mass", S::volume, "kg", "mass in a volume", true},
    QuantitySpec{"volume", S::volume, "m^3", "size of a volume", true},
    QuantitySpec{"expansion", S::medium, "1/K", "isobaric thermal expansion coefficient (3.40)", true},
    QuantitySpec{"bulk_modulus", S::medium, "Pa", "isothermal bulk modulus (3.41)", true},
    QuantitySpec{"pressure_coefficient", S::medium, "1/K", "isochoric pressure coefficient (3.42)", true},
    QuantitySpec{"isochoric_heat", S::medium, "J/(kg*K)", "specific heat capacity at constant volume (3.31)", true},
    QuantitySpec{"isobaric_heat", S::medium, "J/(kg*K)", "specific heat capacity at constant pressure (3.37)", true},
    QuantitySpec{"mass_flow", S::flow, "kg/s", "mass flow, positive from `from` to `to`"},
    QuantitySpec{"volume_flow", S::flow, "m^3/s", "mass flow divided by the density of the side that it comes from"},
    QuantitySpec{"inflow", S::fluid, "kg/s", "sum of the mass flows into a volume, reservoir or junction"},
    QuantitySpec{"surplus", S::volume, "kg/s", "mass flow into a volume minus the mass flow out of it, also of a volume that is empty"},
    QuantitySpec{"heat", S::heated, "W",
                 "heat flow along a link, into a node, or into a volume. Through a boundary into a rod: `heat[bar.first]`, or "
                 "into a block: `heat[plate.left]`"},
    QuantitySpec{"shaft_power", S::flow, "W", "power that the shaft of a pump transfers to the flow"},
    QuantitySpec{"view_factor", S::two_surfaces, "1", "view factor in an enclosure: `view_factor[furnace, 1, 2]` (4.44)"},
    QuantitySpec{"exchange_factor", S::two_surfaces, "m^2",
                 "heat flow from one surface of an enclosure to another, divided by stefan_boltzmann*(T_i^4 - T_j^4); an area"},
    QuantitySpec{"radiosity", S::surface, "W/m^2",
                 "radiation that leaves a surface of an enclosure, by area: `radiosity[furnace, 1]` (4.42)"},
    QuantitySpec{"irradiation", S::surface, "W/m^2",
                 "radiation that arrives at a surface of an enclosure, by area: `irradiation[furnace, 1]` (4.48)"},
    QuantitySpec{"internal_energy", S::optional_store, "J",
                 "energy stored in volumes, pipes, nodes, rods, blocks, capacitors and inductors, or in one volume, node or branch"},
    QuantitySpec{"voltage", S::pin_or_branch, "V",
                 "potential of a pin, or voltage of a branch: of a source from `from` up to `to`, else from `from` down to `to`"},
    QuantitySpec{"current", S::branch, "A", "current through a branch, positive from `from` to `to`"},
    QuantitySpec{"exchanged_power", S::nothing, "W", "power of enthalpy flows, heat and shafts across the border of the model"},
};

using F = FormPlace;

constexpr std::array form_table{
    FormSpec{"dot", "dot(x)", F::everywhere, "total time derivative of x"},
    FormSpec{"ddot", "ddot(x)", F::everywhere, "second time derivative of x"},
    FormSpec{"sum", "sum(k, 1, N, term)", F::everywhere, "sum of the term for k from 1 to N"},
    FormSpec{"diff", "diff(expression, variable)", F::outputs, "partial derivative of the expression with respect to the variable"},
    FormSpec{"integral", "integral(function, x, from, to)", F::outputs,
             "integral of the function over x; a bound may be `infinity` or `-infinity`"},
    FormSpec{"limit", "limit(expression, x, place)", F::printed_equations,
             "limit of the expression where x approaches the place, which may be `infinity` or `-infinity`; a fourth argument 1 means from "
             "above, -1 from below"},
    FormSpec{"at", "at(expression, x, place)", F::printed_equations, "value of the expression at x = place"},
    FormSpec{"quantity", "quantity(9.81, m/s^2)", F::printed_equations, "number with a unit"},
    FormSpec{"vector", "vector(a, b, c)", F::matrices, "column vector"},
    FormSpec{"matrix", "matrix(row(a, b), row(c, d))", F::matrices, "matrix, row by row"},
    FormSpec{"diag", "diag(a, b)", F::matrices, "diagonal matrix"},
    FormSpec{"transpose", "transpose(A)", F::matrices, "transpose"},
    FormSpec{"det", "det(A)", F::matrices, "determinant"},
    FormSpec{"trace", "trace(A)", F::matrices, "trace"},
    FormSpec{"inverse", "inverse(A)", F::matrices, "inverse"},
    FormSpec{"cross", "cross(v, w)", F::matrices, "cross product of two vectors"},
};

constexpr std::array constant_table{
    ConstantSpec{"t", "the time"},
    ConstantSpec{"pi", "ratio of a circle's circumference to its diameter"},
    ConstantSpec{"stefan_boltzmann", "Stefan-Boltzmann constant (4.35), 5.670374419e-8 W/(m^2*K^4)"},
};

template <class Table>
auto find_in(const Table& table, std::string_view name) -> decltype(table.data()) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return name == entry.name; });
    return found == table.end() ? nullptr : &*found;
}

}  // namespace

std::span<const FunctionSpec> functions() { return function_table; }
const FunctionSpec* find_function(std::string_view name) { return find_in(function_table, name); }
const FunctionSpec* find_function_of_latex(std::string_view command) {
    const auto found = std::find_if(function_table.begin(), function_table.end(), [&](const FunctionSpec& one) {
        return one.latex != nullptr && (one.latex + 1 == command || one.name == command);
    });
    return found == function_table.end() ? nullptr : &*found;
}
const SubscriptSpec& subscript(Subscript which) {
    for (const SubscriptSpec& spec : subscript_table)
        if (spec.subscript == which) return spec;
    return subscript_table.front();
}

std::vector<const char*> kinds_of_first(const QuantitySpec& quantity, std::size_t entries) {
    std::vector<const char*> kinds;
    for (const char* kind : subscript(quantity.is_of_medium(entries) ? Subscript::medium : quantity.subscript).kinds)
        if (kind != nullptr) kinds.push_back(kind);
    return kinds;
}

std::span<const QuantitySpec> quantities() { return quantity_table; }
const QuantitySpec* find_quantity(std::string_view name) { return find_in(quantity_table, name); }

std::span<const FormSpec> forms() { return form_table; }
std::span<const ConstantSpec> known_names() { return constant_table; }

bool is_special_form(std::string_view name) {
    const FormSpec* form = find_in(form_table, name);
    return form != nullptr && (form->place == FormPlace::everywhere || form->place == FormPlace::outputs);
}

bool is_printed_form(std::string_view name) {
    const FormSpec* form = find_in(form_table, name);
    return form != nullptr && form->place == FormPlace::printed_equations;
}

const char* describe(UnitRule rule) {
    switch (rule) {
        case U::dimensionless: return "1";
        case U::same: return "all the same";
        case U::square_root: return "root of that of x";
        case U::sign: return "any; result 1";
        case U::choice: return "that of a and b";
        case U::ratio: return "all the same; result 1";
        case U::ratio_and_angle: return "the same, theta 1; result 1";
        case U::fourth_power: return "the same; result its fourth power";
        case U::root_excess: return "that of c; s its square";
        case U::radiant: return "that of b; a 1/b^3";
        case U::plate: return "that of L/(lambda*A)";
        case U::pipe: break;
    }
    return "that of 1/(lambda*L)";
}

}  // namespace dalembert
