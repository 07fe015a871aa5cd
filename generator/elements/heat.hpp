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
        .doc = "boiling temperature"});
    v("enthalpy", boiling.enthalpy, {.required = true, .dimension = dimension::specific_energy(), .depends = on_parameters,
        .words = "enthalpy of evaporation",
        .doc = "specific enthalpy of evaporation"});
    v("mass", boiling.mass, {.required = true, .dimension = Dimension::mass(), .depends = on_parameters | on_states,
        .doc = "the state that is the mass of the liquid"});
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
    "Points with one temperature: bodies that store heat, surfaces, ambient air.",
    "[nodes.plate]\ntemperature = \"T_B\"\ncapacity    = \"m_B*c_B\"\nheat        = \"P\"",
    "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<HeatNode> E>
void describe(Visitor& v, E& node) {
    v("temperature", node.temperature, {.dimension = Dimension::temperature(),
        .depends = node.capacity ? on_states : on_plain_states_and_inputs, .may_be_absent = node.capacity.has_value(),
        .doc = "with a capacity: the state that is the temperature; a scene without this state stores no heat here. Without a "
               "capacity: the given temperature. If left out, the heat balance determines the temperature"});
    v("capacity", node.capacity, {.dimension = Dimension::energy() / Dimension::temperature(),
        .depends = node.boiling ? on_parameters | on_states : on_parameters, .variables = {Dimension::temperature()},
        .needs = {{"temperature", "needs the key 'temperature': the state that its capacity belongs to"}},
        .doc = "heat capacity; \"T -> ...\" if it depends on the temperature"});
    v.table(
        "boiling", node.boiling,
        {.needs = {{"capacity", "needs the key 'capacity', because it boils"}},
         .excludes = {no_family()},
         .doc = "{ temperature, enthalpy, mass }: at this temperature, heat evaporates the liquid, whose mass is a state. The "
               "capacity may depend on this state. Adds the modes NAME_liquid and NAME_boiling, and NAME_dry if some capacity "
               "remains without liquid; else the run ends when the liquid is gone"});
    v("heat", node.heat, {.dimension = Dimension::power(), .depends = on_state_and_inputs | on_losses,
        .doc = "heat flow into the node from outside, or from dissipation: \"dissipated_power[friction]\""});
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
    "Heat flows between nodes, volumes, reservoirs and cells of rods and blocks.",
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
       .doc = "node, volume, reservoir or cell of a rod or block at the beginning; the heat flow is positive away from it"});
    v("to", link.to, {.required = true, .refers = {"node", "rod", "block", "volume", "reservoir"}, .doc = "the same at the end"});
    v.choice("law", link.law, {.doc = "none with conductance, resistance or heat"}, link_laws());
    v("heat", link.heat, {.dimension = Dimension::power(), .depends = on_state_and_inputs, .doc = "given heat flow"});
    v("conductance", link.conductance, {.dimension = dimension::heat_conductance(), .depends = on_state_and_inputs,
        .sign = SignRule{link.law == Link::Law::linear, "W/K"}, .doc = "heat flow divided by temperature difference"});
    v("resistance", link.resistance, {.dimension = Dimension::none() / dimension::heat_conductance(), .depends = on_state_and_inputs,
        .sign = SignRule{link.law == Link::Law::linear, "K/W"},
        .doc = "instead of conductance: temperature difference divided by heat flow (4.103a)"});
    v("conductivity", link.conductivity,
      {.dimension = dimension::heat_conductivity(),
       .depends = on_parameters,
       .variables = {Dimension::temperature()},
       .sign = SignRule{link.law == Link::Law::linear, "W/(m*K)"},
       .doc = "of conduction: thermal conductivity; \"T -> ...\" if it depends on the temperature, whose integral then gives "
               "the heat flow"});
    v("area", link.area,
      {.dimension = dimension::surface(),
       .depends = on_state_and_inputs,
       .sign = SignRule{link.law == Link::Law::linear, "m^2"},
       .doc = "area across the heat flow"});
    v("length", link.length, {.dimension = Dimension::length(), .depends = on_state_and_inputs,
        .sign = SignRule{link.law == Link::Law::linear, "m"}, .doc = "of conduction: length along the heat flow"});
    v("coefficient", link.coefficient, {.dimension = dimension::heat_transfer(), .depends = on_state_and_inputs,
        .sign = SignRule{link.law == Link::Law::linear, "W/(m^2*K)"}, .doc = "of convection or contact: heat transfer coefficient alpha"});
    v("emissivity", link.emissivity,
      {.dimension = Dimension::none(),
       .depends = on_state_and_inputs,
       .sign = SignRule{link.law == Link::Law::linear, "1"},
       .doc = "of radiation: emissivity or exchange factor in area*emissivity*stefan_boltzmann*(T_1^4 - T_2^4)"});
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
    "Radiation between grey diffuse surfaces that see each other, with all reflections (4.42)-(4.51). The heat from "
    "surface i to surface j is exchange_factor[NAME, i, j]*stefan_boltzmann*(T_i^4 - T_j^4). A node with neither "
    "capacity nor temperature re-radiates the heat that it absorbs.",
    "[enclosures.furnace]\nsurfaces     = [\"floor\", \"wall\", \"roof\"]\nareas        = [\"A\", \"A\", \"A\"]\n"
    "emissivities = [\"eps\", 0.8, 1]\nview_factors = [[0, \"?\", \"?\"], [\"?\", 0, \"?\"], [\"?\", \"?\", 0]]",
    "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<Enclosure> E>
void describe(Visitor& v, E& enclosure) {
    v("surfaces", enclosure.surfaces, {.required = true, .refers = {"node", "rod", "block"},
        .doc = "nodes or cells of rods and blocks, up to 32; a flat body with one temperature may be listed twice"});
    v("emissivities", enclosure.emissivities, {.required = true, .dimension = Dimension::none(), .depends = on_plain_states_and_inputs,
        .sign = from_zero_to_one(), .words = "emissivity",
        .doc = "emissivity of each surface, from 0 (reflects everything) to 1 (black); if one depends on states or inputs, up "
               "to 3 surfaces"});
    v("areas", enclosure.areas, {.dimension = dimension::surface(), .depends = on_plain_states_and_inputs, .sign = above_zero("m^2"),
        .words = "area",
        .doc = "with view_factors: area of each surface"});
    v("view_factors", enclosure.view_factors,
      {.type = ValueType::matrix,
       .dimension = Dimension::none(),
       .depends = on_plain_states_and_inputs,
       .words = "view factor",
       .doc = "row i, column j: fraction of the radiation leaving surface i that arrives at surface j (4.44). \"?\" for "
               "factors that follow from reciprocity (4.45) and from the sum 1 of each row (4.47). An opening is a black "
               "surface at the temperature outside"});
    v("polygon", enclosure.polygon,
      {.dimension = Dimension::length(),
       .depends = constant_only,
       .words = "corner",
       .doc = "instead of view_factors: corners of the cross section of a long prism, in order, convex or not. Surface i goes "
               "from corner i to corner i + 1. The view factors follow by crossed strings; the default parameters decide the "
               "corners that the strings touch, and this holds for other parameters as long as no string changes its path"});
    v("height", enclosure.height, {.dimension = Dimension::length(), .depends = constant_only, .sign = above_zero("m"),
        .doc = "with polygon: length of the prism"});
    v.either("polygon", "view_factors", "the polygon of its cross section or its view_factors");
    v.item({});
}

}  // namespace dalembert
