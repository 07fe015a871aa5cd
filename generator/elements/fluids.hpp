// SPDX-License-Identifier: GPL-3.0-or-later
// Media, reservoirs, junctions, volumes and flows as they were written, each key in one place.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

struct Medium : Item {
    enum class Law { ideal_gas, liquid, incompressible, given };
    Law law = Law::liquid;
    ExpressionPtr gas_constant;
    std::optional<Property> density;
    ExpressionPtr bulk_modulus;
    ExpressionPtr expansion;
    std::optional<Property> isochoric_heat;
    std::optional<Property> energy;
    std::optional<Property> pressure;  ///< (rho, T) -> p
    ExpressionPtr reference_pressure;
    ExpressionPtr reference_temperature;
};

template <>
inline constexpr KindSpec kind_of<Medium>{"medium",
    "Gases and liquids.",
    "[media.air]\nlaw            = \"ideal_gas\"\ngas_constant   = \"R_s\"\nisochoric_heat = \"c_v\"",
    "", {.in_all_modes = true, .naming = Naming::parts}};

inline const KeyChoices<Medium::Law>& medium_laws() {
    using L = Medium::Law;
    static const KeyChoices<L> choices{
        {"ideal_gas", L::ideal_gas, {"gas_constant"}, {"isochoric_heat", "reference_temperature"}, ": density = p/(R*T)"},
        {"liquid",
         L::liquid,
         {"density", "bulk_modulus", "reference_pressure"},
         {"expansion", "reference_temperature", "isochoric_heat"},
         ": rho_0*exp((p - p_0)/beta - alpha*(T - T_0)) (3.76)"},
        {"incompressible", L::incompressible, {"density"}, {"reference_temperature", "isochoric_heat"}},
        {"given",
         L::given,
         {"density"},
         {"isochoric_heat", "energy", "pressure", "reference_pressure", "reference_temperature"},
         ": by density"},
    };
    return choices;
}

template <class Visitor, ElementOf<Medium> E>
void describe(Visitor& v, E& medium) {
    v.choice("law", medium.law, {.required = true}, medium_laws());
    v("gas_constant", medium.gas_constant, {.dimension = dimension::specific_heat(), .depends = on_parameters,
        .doc = "of an ideal gas: specific gas constant R"});
    v("density", medium.density,
      {.dimension = dimension::density(),
       .depends = on_parameters,
       .variables = {Dimension::pressure(), Dimension::temperature()},
       .sign = above_zero("kg/m^3"),
       .doc = "density of a liquid at the reference state, or of an incompressible medium; of `given`: a law \"(p, T) -> ...\""});
    v("bulk_modulus", medium.bulk_modulus, {.dimension = Dimension::pressure(), .depends = on_parameters,
        .sign = above_zero("Pa"), .doc = "of a liquid: bulk modulus beta (3.41)"});
    v("expansion", medium.expansion, {.dimension = Dimension::none() / Dimension::temperature(), .depends = on_parameters,
        .needs = {{"reference_temperature", "has a thermal expansion and needs the reference_temperature from which it counts"}},
        .doc = "of a liquid: thermal expansion coefficient alpha (3.40); 0 if left out"});
    v("isochoric_heat", medium.isochoric_heat, {.dimension = dimension::specific_heat(), .depends = on_parameters,
        .variables = {Dimension::pressure(), Dimension::temperature()},
        .excludes = {{"energy", "has an energy and an isochoric_heat; the heat follows from the energy"}},
        .doc = "specific heat capacity at constant volume; needed if a temperature varies"});
    v("energy", medium.energy, {.dimension = dimension::specific_energy(), .depends = on_parameters,
        .variables = {Dimension::pressure(), Dimension::temperature()},
        .doc = "of `given`, instead of isochoric_heat: specific internal energy \"(p, T) -> ...\""});
    v("pressure", medium.pressure, {.dimension = Dimension::pressure(), .depends = on_parameters,
        .variables = {dimension::density(), Dimension::temperature()},
        .doc = "of `given`: inverse of the density law, \"(rho, T) -> ...\"; needed if density or mass is a state"});
    v("reference_pressure", medium.reference_pressure, {.dimension = Dimension::pressure(), .depends = on_parameters,
        .sign = above_zero("Pa"), .doc = "reference pressure p_0, where the internal energy of a liquid is zero"});
    v("reference_temperature", medium.reference_temperature, {.dimension = Dimension::temperature(), .depends = on_parameters,
        .sign = above_zero("K"), .doc = "reference temperature T_0; also the temperature of volumes and reservoirs that give none"});
    v.item({.has_family = false});
}

/// A medium at a state that nothing in the model changes: ambient, supply, tank.
struct Reservoir : Item {
    Reference medium;
    ExpressionPtr pressure;
    ExpressionPtr temperature;
    ExpressionPtr potential;
};

template <>
inline constexpr KindSpec kind_of<Reservoir>{"reservoir",
    "Media at a state that the model does not change: ambient air, a supply.",
    "[reservoirs.ambient]\nmedium   = \"air\"\npressure = \"p_0\"", "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<Reservoir> E>
void describe(Visitor& v, E& reservoir) {
    v("medium", reservoir.medium, {.required = true, .refers = {"medium"}, .doc = "medium in the reservoir"});
    v("pressure", reservoir.pressure, {.required = true, .dimension = Dimension::pressure(), .depends = on_parameters | on_inputs | on_time,
        .sign = above_zero("Pa"), .doc = "absolute pressure; may depend on inputs and the time"});
    v("temperature", reservoir.temperature, {.dimension = Dimension::temperature(), .depends = on_parameters | on_inputs | on_time,
        .sign = above_zero("K"), .doc = "temperature; the reference temperature of the medium if left out"});
    v("potential", reservoir.potential, {.dimension = dimension::specific_energy(), .depends = on_parameters | on_time,
        .doc = "specific potential energy, as \"g*z_1\". If it differs between the two ends of a flow, the difference of height "
               "drives the flow in addition to the pressure"});
    v.item({.has_family = true});
}

/// A place where flows meet and nothing is stored: they sum up to zero, from which its pressure follows.
struct Junction : Item {
    Reference medium;
    ExpressionPtr potential;
};

template <>
inline constexpr KindSpec kind_of<Junction>{"junction",
    "Points where flows meet and nothing is stored. The pressure makes the sum of the mass flows zero. It is solved "
    "exactly for orifices, laminar flows, switching check valves, pumps, pipes and given flows. At least one "
    "orifice, laminar flow or open valve must lead to a known pressure.",
    "[junctions.tee]\nmedium = \"water\"", "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<Junction> E>
void describe(Visitor& v, E& junction) {
    v("medium", junction.medium, {.required = true, .refers = {"medium"},
        .doc = "medium in the junction: liquid or incompressible; flows that end here have its reference density"});
    v("potential", junction.potential, {.dimension = dimension::specific_energy(), .depends = on_parameters,
        .doc = "specific potential energy, as \"g*z_1\". If it differs between the two ends of a flow, the difference of height "
               "drives the flow in addition to the pressure"});
    v.item({.has_family = true});
}

/// A control volume with one medium in one state.
struct Volume : Item {
    Reference medium;
    ExpressionPtr volume;
    ExpressionPtr pressure;     ///< a state; with `filling` any expression
    ExpressionPtr density;      ///< a state
    ExpressionPtr mass;         ///< a state
    ExpressionPtr filling;      ///< a state that the volume follows
    ExpressionPtr temperature;  ///< a state, which a scene may leave out
    ExpressionPtr isothermal;
    struct Polytropic {
        ExpressionPtr exponent, pressure, temperature;
        Span span;
    };
    std::optional<Polytropic> polytropic;
    ExpressionPtr head;
    ExpressionPtr gravity;
    ExpressionPtr potential;
    ExpressionPtr heat;
    ExpressionPtr shaft_power;
    ExpressionPtr smallest;
    bool empties = false;  ///< being filled or empty is a mode
};

template <>
inline constexpr KindSpec kind_of<Volume>{"volume",
    "Control volumes. The balances of mass (3.98) and energy (3.165) determine the states that a volume names. The "
    "force p*dV/dq acts on the mechanics automatically.",
    "[volumes.chamber_1]\nmedium      = \"oil\"\nvolume      = \"A_1*s\"\npressure    = \"p_1\"\ntemperature = \"T_1\"",
    "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<Volume::Polytropic> Course>
void describe(Visitor& v, Course& course) {
    v("exponent", course.exponent, {.required = true, .dimension = Dimension::none(), .depends = on_parameters,
        .sign = above_zero("1"), .doc = "exponent n: p*V^n is constant"});
    v("pressure", course.pressure, {.required = true, .dimension = Dimension::pressure(), .depends = on_parameters,
        .sign = above_zero("Pa"), .doc = "pressure at one point of the change"});
    v("temperature", course.temperature, {.required = true, .dimension = Dimension::temperature(), .depends = on_parameters,
        .sign = above_zero("K"), .doc = "temperature at the same point"});
}

template <class Visitor, ElementOf<Volume> E>
void describe(Visitor& v, E& volume) {
    // Where a filling is the state, the volume may be empty, and the pressure is an expression.
    const auto positive = [&](const char* unit) { return volume.filling ? std::nullopt : std::optional(above_zero(unit)); };
    v("medium", volume.medium, {.required = true, .refers = {"medium"}, .doc = "medium in the volume"});
    v("volume", volume.volume, {.required = true, .dimension = Dimension::volume(),
        .depends = volume.filling ? on_configuration | on_states : on_configuration, .sign = positive("m^3"), .words = "size",
        .doc = "size of the volume; may depend on coordinates, the time and the filling"});
    v("pressure", volume.pressure, {.dimension = Dimension::pressure(), .depends = volume.filling ? on_plain_states_and_inputs : on_states,
        .sign = positive("Pa"), .doc = "the state that is the pressure; with filling: pressure at the surface, an expression"});
    v("density", volume.density, {.dimension = dimension::density(), .depends = on_states, .sign = above_zero("kg/m^3"),
        .doc = "instead of pressure: the state that is the density"});
    v("mass", volume.mass, {.dimension = Dimension::mass(), .depends = on_states, .sign = above_zero("kg"),
        .doc = "instead of pressure: the state that is the mass"});
    v("filling", volume.filling, {.depends = on_states,
        .doc = "instead of pressure: the state that determines the volume, such as the level of a tank"});
    v("temperature", volume.temperature, {.dimension = Dimension::temperature(), .depends = on_states, .may_be_absent = true,
        .sign = above_zero("K"),
        .doc = "the state that is the temperature; in a scene without this state, the energy balance is left out"});
    v("isothermal", volume.isothermal, {.dimension = Dimension::temperature(), .depends = on_parameters, .sign = above_zero("K"),
        .words = "temperature",
        .doc = "constant temperature; the reference temperature of the medium if left out"});
    v.table("polytropic", volume.polytropic, {.words = "polytropic", .noun = "course",
        .excludes = {{"isothermal", "is isothermal and polytropic; both fix its temperature", Id::doubly_determined}},
        .doc = "instead of isothermal: { exponent, pressure, temperature } of a polytropic change of an ideal gas (3.65)"});
    v("head", volume.head, {.dimension = Dimension::length(), .depends = on_parameters | on_states,
        .needs = {{"filling", "has a head, but no filling that it depends on"}, {"gravity", "has a head, but no gravity along it"}},
        .doc = "with filling: height of the surface above the outlets"});
    v("gravity", volume.gravity, {.dimension = Dimension::acceleration(), .depends = on_parameters,
        .needs = {{"head", "has a gravity, but no head along it"}},
        .doc = "gravitational acceleration along the head"});
    v("potential", volume.potential, {.dimension = dimension::specific_energy(), .depends = on_parameters,
        .doc = "specific potential energy, as \"g*z_1\". If it differs between the two ends of a flow, the difference of height "
               "drives the flow in addition to the pressure"});
    v("heat", volume.heat, {.dimension = Dimension::power(), .depends = on_state_and_inputs | on_losses,
        .doc = "heat flow into the volume from outside. It counts if the temperature is a state of the scene; else the heat "
               "flow follows from the given temperature"});
    v("shaft_power", volume.shaft_power, {.dimension = Dimension::power(), .depends = on_state_and_inputs,
        .doc = "power of a shaft into the volume from outside"});
    v("smallest", volume.smallest, {.dimension = Dimension::volume(), .depends = on_parameters, .words = "smallest size",
        .doc = "size at which a run stops; 0 if left out"});
    v("empties", volume.empties,
      {.needs = {{"filling", "has no filling that could run out"}},
       .excludes = {no_family()},
       .doc = "true, with filling: the volume can be empty. At filling = 0 the inflow leaves at once, shared in proportion to "
               "the outflows, until the inflow is larger. Adds the modes NAME_filled and NAME_empty"});
    v.item({.has_family = true});
}

/// What goes from one volume, reservoir or junction to another.
struct Flow : Item {
    enum class Law { given_mass, given_volume, hydraulic_orifice, pneumatic_orifice, laminar, check_valve, relief_valve, pump, pipe };
    Law law = Law::given_mass;
    Reference from;
    Reference to;
    ExpressionPtr mass_flow;
    ExpressionPtr volume_flow;
    ExpressionPtr area;
    ExpressionPtr coefficient;
    ExpressionPtr width;
    ExpressionPtr conductance;
    ExpressionPtr cracking_pressure;
    ExpressionPtr override_pressure;
    bool switches = false;   ///< of a check valve being open or shut, of a pneumatic orifice being choked and the direction, are modes
    ExpressionPtr displacement;
    ExpressionPtr speed;
    ExpressionPtr velocity;  ///< a state
    ExpressionPtr length;
    std::optional<::dalembert::Law> loss;
};

template <>
inline constexpr KindSpec kind_of<Flow>{"flow",
    "Flows between volumes, reservoirs and junctions. A flow carries the enthalpy of the side that it comes from.",
    "[flows.leak]\nfrom        = \"chamber_1\"\nto          = \"chamber_2\"\nlaw         = \"laminar\"\nconductance = \"c_L\"",
    "", {.naming = Naming::parts}};

inline const KeyChoices<Flow::Law>& flow_laws() {
    using L = Flow::Law;
    static const KeyChoices<L> choices{
        {"hydraulic_orifice", L::hydraulic_orifice, {"area", "coefficient"}, {"width"}, " (3.150)"},
        {"pneumatic_orifice", L::pneumatic_orifice, {"area", "coefficient"}, {"width", "switches"}, " (3.156)"},
        {"laminar", L::laminar, {"conductance"}},
        {"check_valve", L::check_valve, {}, {"conductance", "area", "coefficient", "width", "cracking_pressure", "switches"}},
        {"relief_valve", L::relief_valve, {"area", "coefficient", "cracking_pressure", "override_pressure"}, {},
            " (3.150), with an area that grows linearly with the pressure difference"},
        {"pump", L::pump, {}, {"volume_flow", "displacement", "speed"}},
        {"pipe", L::pipe, {"velocity", "area", "length"}, {"loss"}},
        {"", L::given_mass, {}, {"mass_flow", "volume_flow"}},
    };
    return choices;
}

template <class Visitor, ElementOf<Flow> E>
void describe(Visitor& v, E& flow) {
    v("from", flow.from, {.required = true, .refers = {"volume", "reservoir", "junction"},
        .doc = "volume, reservoir or junction at the beginning; the flow is positive away from it"});
    v("to", flow.to,
      {.required = true, .refers = {"volume", "reservoir", "junction"}, .doc = "volume, reservoir or junction at the end"});
    v.choice("law", flow.law, {.doc = "none if the flow is given"}, flow_laws());
    v("mass_flow", flow.mass_flow, {.dimension = Dimension::mass() / Dimension::time(), .depends = on_state_and_inputs,
        .doc = "given mass flow"});
    v("volume_flow", flow.volume_flow, {.dimension = dimension::volume_flow(), .depends = on_state_and_inputs,
        .doc = "given volume flow, at the density of the side that it comes from; also of a pump"});
    v("area", flow.area, {.dimension = dimension::surface(), .depends = flow.law == Flow::Law::pipe ? on_parameters : on_state_and_inputs,
        .sign = SignRule{flow.law == Flow::Law::pipe, "m^2"}, .doc = "area of an orifice or pipe; of an orifice it may depend on inputs"});
    v("coefficient", flow.coefficient, {.dimension = Dimension::none(), .depends = on_state_and_inputs,
        .sign = not_below_zero("1"), .doc = "of an orifice: contraction coefficient (3.149)"});
    v("width", flow.width, {.dimension = Dimension::pressure(), .depends = on_parameters, .sign = above_zero("Pa"),
        .doc = "of an orifice: pressure difference below which the square root of dp, whose slope is infinite at zero, is "
               "rounded: dp/(dp^2 + width^2)^(1/4) replaces it. 16 % low at dp = width, 0.25 % at 10 widths"});
    v("conductance", flow.conductance, {.dimension = dimension::volume_flow() / Dimension::pressure(), .depends = on_state_and_inputs,
        .sign = not_below_zero("m^3/(s*Pa)"), .doc = "of a laminar leak or check valve: volume flow divided by pressure difference"});
    v("cracking_pressure", flow.cracking_pressure, {.dimension = Dimension::pressure(), .depends = on_state_and_inputs,
        .sign = SignRule{flow.law == Flow::Law::relief_valve, "Pa"},
        .doc = "of a check or relief valve: pressure difference at which it opens; of a check valve 0 if left out"});
    v("override_pressure", flow.override_pressure, {.dimension = Dimension::pressure(), .depends = on_state_and_inputs,
        .sign = above_zero("Pa"), .doc = "of a relief valve: pressure above the cracking pressure at which the whole area is open"});
    v("switches", flow.switches,
      {.excludes = {no_family(), {"width", "has a width, so its law is smooth and it has no modes"}},
       .doc = "true: the states of the valve are modes of the machine: NAME_shut and NAME_open of a check valve; "
              "NAME_subsonic, NAME_choked, NAME_subsonic_back, NAME_choked_back of a pneumatic orifice. Else the transition is "
              "a located kink. In a file with more than 64 combinations of modes it is a kink, too, unless an expression names "
              "one of these modes"});
    v("displacement", flow.displacement, {.dimension = Dimension::volume(), .depends = on_state_and_inputs,
        .doc = "of a pump: volume per radian"});
    v("speed", flow.speed, {.dimension = Dimension::none() / Dimension::time(), .depends = on_state_and_inputs,
        .doc = "of a pump: angular velocity; if it contains velocities, the shaft acts on the mechanics"});
    v("velocity", flow.velocity, {.dimension = Dimension::speed(), .depends = on_states,
        .doc = "of a pipe: the state that is the velocity of the medium"});
    v("length", flow.length, {.dimension = Dimension::length(), .depends = on_parameters, .sign = above_zero("m"),
        .doc = "of a pipe: length"});
    v("loss", flow.loss, {.dimension = Dimension::pressure(), .depends = on_parameters, .variables = {Dimension::speed()},
        .doc = "of a pipe: pressure loss as a function of the velocity: \"v -> zeta*rho/2*v*abs(v)\""});
    v.item({.has_family = true});
}

}  // namespace dalembert
