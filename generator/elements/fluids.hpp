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
        .doc = "of an ideal gas: the specific gas constant R"});
    v("density", medium.density,
      {.dimension = dimension::density(),
       .depends = on_parameters,
       .variables = {Dimension::pressure(), Dimension::temperature()},
       .sign = above_zero("kg/m^3"),
       .doc = "density of a liquid at the reference state, or of an incompressible medium; a law of one's own: \"(p, T) -> ...\""});
    v("bulk_modulus", medium.bulk_modulus, {.dimension = Dimension::pressure(), .depends = on_parameters,
        .sign = above_zero("Pa"), .doc = "of a liquid: beta (3.41)"});
    v("expansion", medium.expansion, {.dimension = Dimension::none() / Dimension::temperature(), .depends = on_parameters,
        .needs = {{"reference_temperature", "has a thermal expansion and needs the reference_temperature from which it counts"}},
        .doc = "of a liquid: thermal expansion alpha (3.40); 0 if left out"});
    v("isochoric_heat", medium.isochoric_heat, {.dimension = dimension::specific_heat(), .depends = on_parameters,
        .variables = {Dimension::pressure(), Dimension::temperature()},
        .excludes = {{"energy", "has an energy and an isochoric_heat; the heat follows from the energy"}},
        .doc = "specific heat at constant volume; needed where a temperature varies"});
    v("energy", medium.energy, {.dimension = dimension::specific_energy(), .depends = on_parameters,
        .variables = {Dimension::pressure(), Dimension::temperature()},
        .doc = "given: the specific internal energy \"(p, T) -> ...\" instead of isochoric_heat"});
    v("pressure", medium.pressure, {.dimension = Dimension::pressure(), .depends = on_parameters,
        .variables = {dimension::density(), Dimension::temperature()},
        .doc = "given: the inverse of the density, \"(rho, T) -> ...\"; needed where density or mass is a state"});
    v("reference_pressure", medium.reference_pressure, {.dimension = Dimension::pressure(), .depends = on_parameters,
        .sign = above_zero("Pa"), .doc = "p_0: where the internal energy of a liquid is zero"});
    v("reference_temperature", medium.reference_temperature, {.dimension = Dimension::temperature(), .depends = on_parameters,
        .sign = above_zero("K"), .doc = "T_0; also the temperature of volumes and reservoirs that say none"});
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
    "Media at a state that the model does not change: ambient, supply.",
    "[reservoirs.ambient]\nmedium   = \"air\"\npressure = \"p_0\"", "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<Reservoir> E>
void describe(Visitor& v, E& reservoir) {
    v("medium", reservoir.medium, {.required = true, .refers = {"medium"}, .doc = "what it holds"});
    v("pressure", reservoir.pressure, {.required = true, .dimension = Dimension::pressure(), .depends = on_parameters | on_inputs | on_time,
        .sign = above_zero("Pa"), .doc = "its pressure, absolute; may depend on inputs and the time"});
    v("temperature", reservoir.temperature, {.dimension = Dimension::temperature(), .depends = on_parameters | on_inputs | on_time,
        .sign = above_zero("K"), .doc = "its temperature; that of the medium's reference if left out"});
    v("potential", reservoir.potential, {.dimension = dimension::specific_energy(), .depends = on_parameters | on_time,
        .doc = "specific potential energy, as \"g*z_1\"; where it differs between two ends of a flow, its height drives the flow as "
               "well as the pressure does"});
    v.item({.has_family = true});
}

/// A place where flows meet and nothing is stored: they sum up to zero, from which its pressure follows.
struct Junction : Item {
    Reference medium;
    ExpressionPtr potential;
};

template <>
inline constexpr KindSpec kind_of<Junction>{"junction",
    "Places where flows meet and nothing is stored. The pressure is such that the mass flows sum up to zero: solved exactly with "
    "orifices, laminar flows, switching check valves, pumps, pipes and given flows, of which at least one orifice, laminar flow or open "
    "valve must lead to where the pressure is known.",
    "[junctions.tee]\nmedium = \"water\"", "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<Junction> E>
void describe(Visitor& v, E& junction) {
    v("medium", junction.medium, {.required = true, .refers = {"medium"},
        .doc = "what flows through it, a liquid or what is incompressible; flows that end here have its reference density"});
    v("potential", junction.potential, {.dimension = dimension::specific_energy(), .depends = on_parameters,
        .doc = "specific potential energy, as \"g*z_1\"; where it differs between two ends of a flow, its height drives the flow as "
               "well as the pressure does"});
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
    "Control volumes. Balances of mass (3.98) and energy (3.165) determine the states that they name; the force p*dV/dq acts on the "
    "mechanics by itself.",
    "[volumes.chamber_1]\nmedium      = \"oil\"\nvolume      = \"A_1*s\"\npressure    = \"p_1\"\ntemperature = \"T_1\"",
    "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<Volume::Polytropic> Course>
void describe(Visitor& v, Course& course) {
    v("exponent", course.exponent, {.required = true, .dimension = Dimension::none(), .depends = on_parameters,
        .sign = above_zero("1"), .doc = "n: p*V^n stays as it is"});
    v("pressure", course.pressure, {.required = true, .dimension = Dimension::pressure(), .depends = on_parameters,
        .sign = above_zero("Pa"), .doc = "at one point of the course"});
    v("temperature", course.temperature, {.required = true, .dimension = Dimension::temperature(), .depends = on_parameters,
        .sign = above_zero("K"), .doc = "at the same point"});
}

template <class Visitor, ElementOf<Volume> E>
void describe(Visitor& v, E& volume) {
    // Where a filling is the state, the volume may be empty, and the pressure is an expression.
    const auto positive = [&](const char* unit) { return volume.filling ? std::nullopt : std::optional(above_zero(unit)); };
    v("medium", volume.medium, {.required = true, .refers = {"medium"}, .doc = "what it holds"});
    v("volume", volume.volume, {.required = true, .dimension = Dimension::volume(),
        .depends = volume.filling ? on_configuration | on_states : on_configuration, .sign = positive("m^3"), .words = "size",
        .doc = "its volume; may depend on coordinates, the time, and the filling"});
    v("pressure", volume.pressure, {.dimension = Dimension::pressure(), .depends = volume.filling ? on_plain_states_and_inputs : on_states,
        .sign = positive("Pa"), .doc = "the state that is its pressure; with filling: the pressure at the surface, an expression"});
    v("density", volume.density, {.dimension = dimension::density(), .depends = on_states, .sign = above_zero("kg/m^3"),
        .doc = "instead: the state that is its density"});
    v("mass", volume.mass, {.dimension = Dimension::mass(), .depends = on_states, .sign = above_zero("kg"),
        .doc = "instead: the state that is its mass"});
    v("filling", volume.filling, {.depends = on_states, .doc = "instead: the state that its volume follows, as the level of a tank"});
    v("temperature", volume.temperature, {.dimension = Dimension::temperature(), .depends = on_states, .may_be_absent = true,
        .sign = above_zero("K"), .doc = "the state that is its temperature; where a scene leaves it out, the temperature is not balanced"});
    v("isothermal", volume.isothermal, {.dimension = Dimension::temperature(), .depends = on_parameters, .sign = above_zero("K"),
        .words = "temperature",
        .doc = "the temperature at which it is held; that of the medium's reference if left out"});
    v.table("polytropic", volume.polytropic, {.words = "polytropic", .noun = "course",
        .excludes = {{"isothermal", "is isothermal and polytropic; both fix its temperature", Id::doubly_determined}},
        .doc = "instead: { exponent, pressure, temperature } of the course of an ideal gas (3.65)"});
    v("head", volume.head, {.dimension = Dimension::length(), .depends = on_parameters | on_states,
        .needs = {{"filling", "has a head, but no filling that it depends on"}, {"gravity", "has a head, but no gravity along it"}},
        .doc = "height of the surface above the outlets, with filling"});
    v("gravity", volume.gravity, {.dimension = Dimension::acceleration(), .depends = on_parameters,
        .needs = {{"head", "has a gravity, but no head along it"}},
        .doc = "acceleration of gravity along the head"});
    v("potential", volume.potential, {.dimension = dimension::specific_energy(), .depends = on_parameters,
        .doc = "specific potential energy, as \"g*z_1\"; where it differs between two ends of a flow, its height drives the flow as "
               "well as the pressure does"});
    v("heat", volume.heat, {.dimension = Dimension::power(), .depends = on_state_and_inputs | on_losses,
        .doc = "heat flow into it from outside; counts where its temperature is a state of the scene, else heat is what holds the "
               "temperature"});
    v("shaft_power", volume.shaft_power, {.dimension = Dimension::power(), .depends = on_state_and_inputs,
        .doc = "power of a shaft into it from outside"});
    v("smallest", volume.smallest, {.dimension = Dimension::volume(), .depends = on_parameters, .words = "smallest size",
        .doc = "the volume at which a run stops; 0 if left out"});
    v("empties", volume.empties,
      {.needs = {{"filling", "has no filling that could run out"}},
       .excludes = {no_family()},
       .doc =
           "true, with filling: at filling = 0 it is empty: what flows in flows out again, shared by what each outflow would take, until "
           "more flows in. Brings the modes NAME_filled and NAME_empty"});
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
    "Flows between volumes, reservoirs and junctions. What flows carries the enthalpy of the side that it comes from.",
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
        .doc = "the volume, reservoir or junction that it leaves; the flow counts positive this way"});
    v("to", flow.to,
      {.required = true, .refers = {"volume", "reservoir", "junction"}, .doc = "the volume, reservoir or junction that it enters"});
    v.choice("law", flow.law, {.doc = "; none if the flow is given"}, flow_laws());
    v("mass_flow", flow.mass_flow, {.dimension = Dimension::mass() / Dimension::time(), .depends = on_state_and_inputs,
        .doc = "the mass flow, given"});
    v("volume_flow", flow.volume_flow, {.dimension = dimension::volume_flow(), .depends = on_state_and_inputs,
        .doc = "the volume flow, given, at the density of the side that it comes from; also of a pump"});
    v("area", flow.area, {.dimension = dimension::surface(), .depends = flow.law == Flow::Law::pipe ? on_parameters : on_state_and_inputs,
        .sign = SignRule{flow.law == Flow::Law::pipe, "m^2"}, .doc = "of an orifice or pipe; of an orifice it may depend on inputs"});
    v("coefficient", flow.coefficient, {.dimension = Dimension::none(), .depends = on_state_and_inputs,
        .sign = not_below_zero("1"), .doc = "of an orifice: contraction coefficient (3.149)"});
    v("width", flow.width, {.dimension = Dimension::pressure(), .depends = on_parameters, .sign = above_zero("Pa"),
        .doc = "of an orifice, a pressure: instead of the root of dp, whose slope is infinite at zero, dp/(dp^2 + width^2)^(1/4); 16 % "
               "low at dp = width, 0.25 % at 10 widths"});
    v("conductance", flow.conductance, {.dimension = dimension::volume_flow() / Dimension::pressure(), .depends = on_state_and_inputs,
        .sign = not_below_zero("m^3/(s*Pa)"), .doc = "of a laminar leak or check valve: volume flow over pressure difference"});
    v("cracking_pressure", flow.cracking_pressure, {.dimension = Dimension::pressure(), .depends = on_state_and_inputs,
        .sign = SignRule{flow.law == Flow::Law::relief_valve, "Pa"},
        .doc = "of a check or relief valve: the pressure difference at which it opens; of a check valve 0 if left out"});
    v("override_pressure", flow.override_pressure, {.dimension = Dimension::pressure(), .depends = on_state_and_inputs,
        .sign = above_zero("Pa"), .doc = "of a relief valve: how far above the cracking pressure it is open with its whole area"});
    v("switches", flow.switches,
      {.excludes = {no_family(), {"width", "is smooth, and has no modes then"}},
       .doc =
           "true: what switches is a mode of the machine, else an edge that is located: of a check valve NAME_shut and NAME_open; of a "
           "pneumatic orifice NAME_subsonic, NAME_choked, NAME_subsonic_back, NAME_choked_back. With more than 64 combinations of modes in "
           "the file it is an edge again, unless a mode of it is named"});
    v("displacement", flow.displacement, {.dimension = Dimension::volume(), .depends = on_state_and_inputs,
        .doc = "of a pump: volume for each radian"});
    v("speed", flow.speed, {.dimension = Dimension::none() / Dimension::time(), .depends = on_state_and_inputs,
        .doc = "of a pump: its angular velocity; where it contains velocities the shaft acts on the mechanics"});
    v("velocity", flow.velocity, {.dimension = Dimension::speed(), .depends = on_states,
        .doc = "of a pipe: the state that is its velocity"});
    v("length", flow.length, {.dimension = Dimension::length(), .depends = on_parameters, .sign = above_zero("m"), .doc = "of a pipe"});
    v("loss", flow.loss, {.dimension = Dimension::pressure(), .depends = on_parameters, .variables = {Dimension::speed()},
        .doc = "of a pipe: loss of pressure over the velocity, \"v -> zeta*rho/2*v*abs(v)\""});
    v.item({.has_family = true});
}

}  // namespace dalembert
