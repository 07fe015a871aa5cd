// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes, links and rods: each key in one place.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

template <>
inline constexpr KindSpec kind_of<HeatNode>{"nodes", "node",
    "Places with one temperature: bodies that store heat, surfaces, ambient air.",
    "[nodes.plate]\ntemperature = \"T_B\"\ncapacity    = \"m_B*c_B\"\nheat        = \"P\""};

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

template <class Visitor, ElementOf<HeatNode> E>
void describe(Visitor& v, E& node) {
    v("temperature", node.temperature, {.dimension = Dimension::temperature(),
        .depends = node.capacity ? on_states : on_plain_states_and_inputs, .may_be_absent = node.capacity.has_value(),
        .doc = "with a capacity: the state that is its temperature; where a scene leaves it out, nothing is stored. Without: the "
               "temperature at which it is held. Left out: it follows from the balance"});
    v("capacity", node.capacity, {.dimension = Dimension::energy() / Dimension::temperature(),
        .depends = node.boiling ? on_parameters | on_states : on_parameters, .variables = {Dimension::temperature()},
        .doc = "its heat capacity; \"T -> ...\" where it depends on the temperature"});
    v.table("boiling", node.boiling, {.doc = "{ temperature, enthalpy, mass }: at that temperature heat evaporates what is left, a "
                                             "state, with an enthalpy of evaporation. The capacity may depend on that state. Brings the "
                                             "modes NAME_liquid, NAME_boiling, and NAME_dry where the capacity is not gone with the "
                                             "mass; else the run ends then"});
    v("heat", node.heat, {.dimension = Dimension::power(), .depends = on_state_and_inputs | on_losses,
        .doc = "heat flow into it from outside, or from dissipation as \"dissipated_power[friction]\""});
    v.item({.has_family = true});
}

template <>
inline constexpr KindSpec kind_of<Link>{"links", "link",
    "Heat between nodes, volumes, reservoirs and cells of rods and blocks.",
    "[links.paste]\nfrom       = \"plate\"\nto         = \"sink\"\nresistance = \"H/(lambda*A)\""};

template <class Visitor, ElementOf<Link> E>
void describe(Visitor& v, E& link) {
    v("from", link.from, {.required = true, .doc = "a node, volume, reservoir or cell of a rod; the heat counts positive from here"});
    v("to", link.to, {.required = true, .doc = "where it goes"});
    v.choice("law", {
        .doc = "\"conduction\" (4.64), \"convection\" (4.17), \"contact\" (4.25), \"radiation\" (4.53); none with conductance, "
               "resistance or heat"});
    v("heat", link.heat, {.dimension = Dimension::power(), .depends = on_state_and_inputs, .doc = "the heat flow, given"});
    v("conductance", link.conductance, {.dimension = dimension::heat_conductance(), .depends = on_state_and_inputs,
        .doc = "heat flow over temperature difference"});
    v("resistance", link.resistance, {.dimension = Dimension::none() / dimension::heat_conductance(), .depends = on_state_and_inputs,
        .doc = "instead: temperature difference over heat flow (4.103a)"});
    v("conductivity", link.conductivity, {.dimension = dimension::heat_conductivity(), .depends = on_parameters,
        .variables = {Dimension::temperature()},
        .doc = "of conduction; \"T -> ...\" where it depends on the temperature: its integral is what flows"});
    v("area", link.area, {.dimension = dimension::surface(), .depends = on_state_and_inputs, .doc = "across the flow of heat"});
    v("length", link.length, {.dimension = Dimension::length(), .depends = on_state_and_inputs,
        .doc = "of conduction, along the flow of heat"});
    v("coefficient", link.coefficient, {.dimension = dimension::heat_transfer(), .depends = on_state_and_inputs,
        .doc = "of convection or contact: alpha"});
    v("emissivity", link.emissivity, {.dimension = Dimension::none(), .depends = on_state_and_inputs,
        .doc = "of radiation: emissivity or exchange factor; area*emissivity*stefan_boltzmann*(T_1^4 - T_2^4)"});
    v.item({.has_family = true});
}

template <>
inline constexpr KindSpec kind_of<Rod>{"rods", "rod",
    "Bars, walls, pipes and shells in which heat flows in one direction (4.5), cut into cells. heat[NAME.first] and heat[NAME.last] are "
    "the heat into it through its ends.",
    "[rods.bar]\ntemperature   = \"T\"\nlength        = \"L\"\narea          = \"A\"\nconductivity  = \"lambda\"\ndensity       = "
    "\"rho\"\nheat_capacity = \"c_p\"\nfirst         = { temperature = \"T_0\" }\nlast          = { coefficient = \"alpha\", ambient = "
    "\"T_inf\" }"};

template <class Visitor, ElementOf<Boundary> End>
void describe(Visitor& v, End& end) {
    v("temperature", end.temperature, {.dimension = Dimension::temperature(), .depends = on_plain_states_and_inputs,
        .doc = "at which it is held; then nothing else is said"});
    v("flux", end.flux, {.dimension = dimension::heat_flux(), .depends = on_plain_states_and_inputs,
        .doc = "heat flow by area into the body"});
    v("coefficient", end.coefficient, {.dimension = dimension::heat_transfer(), .depends = on_plain_states_and_inputs,
        .doc = "convection to the ambient: alpha"});
    v("emissivity", end.emissivity, {.dimension = Dimension::none(), .depends = on_plain_states_and_inputs,
        .doc = "radiation to the ambient"});
    v("ambient", end.ambient, {.dimension = Dimension::temperature(), .depends = on_plain_states_and_inputs,
        .doc = "ambient temperature"});
}

template <class Visitor, ElementOf<Rod> E>
void describe(Visitor& v, E& rod) {
    v("temperature", rod.temperature, {.required = true,
        .doc = "the family of states that are its temperatures, from the first to the last"});
    v.choice("scheme", {
        .doc = "\"points\" (default): at points from end to end, half a cell at free ends, the finite differences of (4.96); \"cells\": "
               "means of cells, finite volumes"});
    v.choice("shape", {
        .doc = "\"bar\" (default), \"cylinder\" or \"sphere\" (4.5), with heat along the radius"});
    v("length", rod.length, {.dimension = Dimension::length(), .depends = on_parameters, .doc = "of a bar"});
    v("area", rod.area, {.dimension = dimension::surface(), .depends = on_parameters, .variables = {Dimension::length()},
        .doc = "of a bar: its cross section; \"x -> ...\" where it varies"});
    v("inner", rod.inner, {.dimension = Dimension::length(), .depends = on_parameters, .words = "inner radius",
        .doc = "of a cylinder or sphere: the radius where it begins; 0 for a solid one"});
    v("outer", rod.outer, {.dimension = Dimension::length(), .depends = on_parameters, .words = "outer radius",
        .doc = "of a cylinder or sphere: the radius where it ends"});
    v("height", rod.height, {.dimension = Dimension::length(), .depends = on_parameters, .doc = "of a cylinder, along its axis"});
    v("grid", rod.grid, {.dimension = Dimension::none(), .depends = on_parameters, .variables = {Dimension::none()},
        .doc = "\"s -> ...\", rising from 0 to 1: the cells are equal over s; \"s -> s^2\" makes them finer at the first end"});
    v("conductivity", rod.conductivity, {.required = true, .dimension = dimension::heat_conductivity(), .depends = on_parameters,
        .variables = {Dimension::temperature()},
        .doc = "\"T -> ...\" where it depends on the temperature"});
    v("density", rod.density, {.required = true, .dimension = dimension::density(), .depends = on_parameters, .doc = "mass by volume"});
    v("heat_capacity", rod.heat_capacity, {.required = true, .dimension = dimension::specific_heat(), .depends = on_parameters,
        .variables = {Dimension::temperature()},
        .doc = "specific heat capacity; \"T -> ...\" where it depends on the temperature"});
    v("source", rod.source, {.dimension = Dimension::power() / Dimension::volume(), .depends = on_plain_states_and_inputs,
        .variables = {Dimension::length()},
        .doc = "heat by volume and time (4.4); \"x -> ...\" where it varies along the rod"});
    v("perimeter", rod.perimeter, {.dimension = Dimension::length(), .depends = on_parameters,
        .doc = "of a bar: for what leaves through its side"});
    v("side_coefficient", rod.side_coefficient, {.dimension = dimension::heat_transfer(), .depends = on_plain_states_and_inputs,
        .doc = "convection through the side to the ambient"});
    v("side_emissivity", rod.side_emissivity, {.dimension = Dimension::none(), .depends = on_parameters,
        .doc = "radiation of the side to the ambient"});
    v("ambient", rod.ambient, {.dimension = Dimension::temperature(), .depends = on_plain_states_and_inputs,
        .doc = "temperature of what surrounds the side"});
    v("loops", rod.loops, {.doc = "true: the cells are computed in loops, whose code does not grow with their number; if left out, "
                                  "above 40 cells"});
    v.table("first", rod.first, {.words = "end", .noun = "end",
        .doc = "what holds at the first end: { temperature }, or some of flux (into the rod), coefficient and emissivity with ambient; "
               "insulated without (4.9)"});
    v.table("last", rod.last, {.words = "end", .noun = "end", .doc = "likewise at the last end"});
    v.item({.has_family = false});
}

}  // namespace dalembert
