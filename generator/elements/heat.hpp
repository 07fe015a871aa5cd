// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes, links and enclosures as they were written, each key in one place.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

/// Of a liquid: at a temperature, heat makes steam of it, which leaves.
struct Boiling {
    ExpressionPtr temperature;
    ExpressionPtr enthalpy;  ///< J/kg, of evaporation
    ExpressionPtr mass;      ///< the state that is what is left
};

template <class Visitor, ElementOf<Boiling> B>
void describe(Visitor& v, B& boiling) {
    v("temperature", boiling.temperature, {.required = true, .dimension = Dimension::temperature(), .depends = on_parameters,
        .words = "boiling temperature",
        .doc = "at which it boils"});
    v("enthalpy", boiling.enthalpy, {.required = true, .dimension = dimension::specific_energy(), .depends = on_parameters,
        .words = "enthalpy of evaporation",
        .doc = "of evaporation, by mass"});
    v("mass", boiling.mass, {.required = true, .dimension = Dimension::mass(), .depends = on_parameters | on_states,
        .doc = "the state that is what is left"});
}

/// A place with one temperature. With a capacity the temperature is a state, which a scene may leave out; without one it is held at
/// an expression, or, where none is given, follows from the balance of what flows in.
struct HeatNode : Item {
    ExpressionPtr temperature;
    std::optional<Property> capacity;  ///< J/K, or a law "T -> ..."
    std::optional<Boiling> boiling;
    ExpressionPtr heat;                ///< W into it, from outside

    bool is_held() const { return temperature && !capacity; }
};

template <>
inline constexpr KindSpec kind_of<HeatNode>{"node",
    "Places with one temperature: bodies that store heat, surfaces, ambient air.",
    "[nodes.plate]\ntemperature = \"T_B\"\ncapacity    = \"m_B*c_B\"\nheat        = \"P\"",
    "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<HeatNode> E>
void describe(Visitor& v, E& node) {
    v("temperature", node.temperature, {.dimension = Dimension::temperature(),
        .depends = node.capacity ? on_states : on_plain_states_and_inputs, .may_be_absent = node.capacity.has_value(),
        .doc = "with a capacity: the state that is its temperature; where a scene leaves it out, nothing is stored. Without: the "
               "temperature at which it is held. Left out: it follows from the balance"});
    v("capacity", node.capacity, {.dimension = Dimension::energy() / Dimension::temperature(),
        .depends = node.boiling ? on_parameters | on_states : on_parameters, .variables = {Dimension::temperature()},
        .needs = {{"temperature", "needs the key 'temperature': the state that its capacity belongs to"}},
        .doc = "its heat capacity; \"T -> ...\" where it depends on the temperature"});
    v.table(
        "boiling", node.boiling,
        {.needs = {{"capacity", "needs the key 'capacity', because it boils"}},
         .excludes = {no_family()},
         .doc =
             "{ temperature, enthalpy, mass }: at that temperature heat evaporates what is left, a state, with an enthalpy of evaporation. "
             "The capacity may depend on that state. Brings the modes NAME_liquid, NAME_boiling, and NAME_dry where the capacity is not "
             "gone with the mass; else the run ends then"});
    v("heat", node.heat, {.dimension = Dimension::power(), .depends = on_state_and_inputs | on_losses,
        .doc = "heat flow into it from outside, or from dissipation as \"dissipated_power[friction]\""});
    v.item({.has_family = true});
}

/// Heat from one node, volume, reservoir or cell of a rod or block to another.
struct Link : Item {
    enum class Law { given, linear, conduction, convection, radiation };
    Law law = Law::given;
    Reference from;
    Reference to;
    ExpressionPtr heat;
    ExpressionPtr conductance;
    ExpressionPtr resistance;
    std::optional<Property> conductivity;  ///< W/(m K), or a law "T -> ..."
    ExpressionPtr area;
    ExpressionPtr length;
    ExpressionPtr coefficient;
    ExpressionPtr emissivity;
};

template <>
inline constexpr KindSpec kind_of<Link>{"link",
    "Heat between nodes, volumes, reservoirs and cells of rods and blocks.",
    "[links.paste]\nfrom       = \"plate\"\nto         = \"sink\"\nresistance = \"H/(lambda*A)\"", "", {.naming = Naming::parts}};

inline const KeyChoices<Link::Law>& link_laws() {
    using L = Link::Law;
    static const KeyChoices<L> choices{
        {"conduction", L::conduction, {"conductivity", "area", "length"}, {}, " (4.64)"},
        {"convection", L::convection, {"coefficient", "area"}, {}, " (4.17)"},
        {"contact", L::convection, {"coefficient", "area"}, {}, " (4.25)"},
        {"radiation", L::radiation, {"emissivity", "area"}, {}, " (4.53)"},
        {"", L::given, {}, {"heat", "conductance", "resistance"}},
    };
    return choices;
}

template <class Visitor, ElementOf<Link> E>
void describe(Visitor& v, E& link) {
    v("from", link.from,
      {.required = true,
       .refers = {"node", "rod", "block", "volume", "reservoir"},
       .doc = "a node, volume, reservoir or cell of a rod; the heat counts positive from here"});
    v("to", link.to, {.required = true, .refers = {"node", "rod", "block", "volume", "reservoir"}, .doc = "where it goes"});
    v.choice("law", link.law, {.doc = "; none with conductance, resistance or heat"}, link_laws());
    v("heat", link.heat, {.dimension = Dimension::power(), .depends = on_state_and_inputs, .doc = "the heat flow, given"});
    v("conductance", link.conductance, {.dimension = dimension::heat_conductance(), .depends = on_state_and_inputs,
        .sign = SignRule{link.law == Link::Law::linear, "W/K"}, .doc = "heat flow over temperature difference"});
    v("resistance", link.resistance, {.dimension = Dimension::none() / dimension::heat_conductance(), .depends = on_state_and_inputs,
        .sign = SignRule{link.law == Link::Law::linear, "K/W"}, .doc = "instead: temperature difference over heat flow (4.103a)"});
    v("conductivity", link.conductivity,
      {.dimension = dimension::heat_conductivity(),
       .depends = on_parameters,
       .variables = {Dimension::temperature()},
       .sign = SignRule{link.law == Link::Law::linear, "W/(m*K)"},
       .doc = "of conduction; \"T -> ...\" where it depends on the temperature: its integral is what flows"});
    v("area", link.area,
      {.dimension = dimension::surface(),
       .depends = on_state_and_inputs,
       .sign = SignRule{link.law == Link::Law::linear, "m^2"},
       .doc = "across the flow of heat"});
    v("length", link.length, {.dimension = Dimension::length(), .depends = on_state_and_inputs,
        .sign = SignRule{link.law == Link::Law::linear, "m"}, .doc = "of conduction, along the flow of heat"});
    v("coefficient", link.coefficient, {.dimension = dimension::heat_transfer(), .depends = on_state_and_inputs,
        .sign = SignRule{link.law == Link::Law::linear, "W/(m^2*K)"}, .doc = "of convection or contact: alpha"});
    v("emissivity", link.emissivity,
      {.dimension = Dimension::none(),
       .depends = on_state_and_inputs,
       .sign = SignRule{link.law == Link::Law::linear, "1"},
       .doc = "of radiation: emissivity or exchange factor; area*emissivity*stefan_boltzmann*(T_1^4 - T_2^4)"});
    v.item({.has_family = true});
}

/// Grey diffuse surfaces that see each other and nothing else. Their view factors are given, or follow from the cross section of a
/// prism: surface i goes from corner i to corner i + 1.
struct Enclosure : Item {
    std::vector<Reference> surfaces;
    Listed<ExpressionPtr> emissivities, areas;
    Listed<std::vector<ExpressionPtr>> view_factors;  ///< null: to be completed
    Listed<std::array<ExpressionPtr, 2>> polygon;
    ExpressionPtr height;

    bool is_prism() const { return !polygon.empty(); }
};

template <>
inline constexpr KindSpec kind_of<Enclosure>{"enclosure",
    "Radiation between grey diffuse surfaces that see each other, all reflections counted (4.42)-(4.51). Surface i gives the heat "
    "exchange_factor[NAME, i, j]*stefan_boltzmann*(T_i^4 - T_j^4) to surface j; a node with neither capacity nor temperature re-radiates "
    "what it takes up.",
    "[enclosures.furnace]\nsurfaces     = [\"floor\", \"wall\", \"roof\"]\nareas        = [\"A\", \"A\", \"A\"]\n"
    "emissivities = [\"eps\", 0.8, 1]\nview_factors = [[0, \"?\", \"?\"], [\"?\", 0, \"?\"], [\"?\", \"?\", 0]]",
    "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<Enclosure> E>
void describe(Visitor& v, E& enclosure) {
    v("surfaces", enclosure.surfaces, {.required = true, .refers = {"node", "rod", "block"},
        .doc = "the nodes or cells of rods and blocks that radiate, up to 32; a flat body of one temperature may stand there twice"});
    v("emissivities", enclosure.emissivities, {.required = true, .dimension = Dimension::none(), .depends = on_plain_states_and_inputs,
        .sign = from_zero_to_one(), .words = "emissivity",
        .doc = "of each surface, from 0 (reflects everything) to 1 (black); where one depends on states or inputs, up to 3 surfaces"});
    v("areas", enclosure.areas, {.dimension = dimension::surface(), .depends = on_plain_states_and_inputs, .sign = above_zero("m^2"),
        .words = "area",
        .doc = "of each surface; with view_factors"});
    v("view_factors", enclosure.view_factors,
      {.type = ValueType::matrix,
       .dimension = Dimension::none(),
       .depends = on_plain_states_and_inputs,
       .words = "view factor",
       .doc =
           "row i, column j: the share of what leaves surface i that arrives at j (4.44). \"?\" for what follows from reciprocity (4.45) "
           "and the sum 1 of each row (4.47). An opening is a black surface too, held at the temperature of what is outside"});
    v("polygon", enclosure.polygon,
      {.dimension = Dimension::length(),
       .depends = constant_only,
       .words = "corner",
       .doc = "instead: the corners of the cross section of a prism without ends, in order, convex or not; surface i goes from corner i to "
              "corner i + 1. The view factors follow from crossed strings; which corners the strings touch is decided at the default "
              "parameters, and holds for others while no string takes another course"});
    v("height", enclosure.height, {.dimension = Dimension::length(), .depends = constant_only, .sign = above_zero("m"),
        .doc = "with polygon: the length of the prism along its axis"});
    v.either("polygon", "view_factors", "the polygon of its cross section or its view_factors");
    v.item({});
}

}  // namespace dalembert
