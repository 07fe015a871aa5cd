// SPDX-License-Identifier: GPL-3.0-or-later
// The one list of kinds of elements, in the order of sections, reading and walks. Who only holds pointers to elements needs no more of
// them than this file.
#pragma once

/// KIND(section, member of the model, type)
#define DALEMBERT_KINDS(KIND) \
    KIND("sizes", sizes, Size) \
    KIND("parameters", parameters, Parameter) \
    KIND("definitions", definitions, Definition) \
    KIND("coordinates", coordinates, Coordinate) \
    KIND("inputs", inputs, Input) \
    KIND("states", states, State) \
    KIND("outputs", outputs, Output) \
    KIND("curves", curves, Curve) \
    KIND("gravity", gravity, Gravity) \
    KIND("bodies", bodies, Body) \
    KIND("solids", solids, Solid) \
    KIND("attitudes", attitudes, Attitude) \
    KIND("joints", joints, Joint) \
    KIND("springs", springs, Spring) \
    KIND("dampers", dampers, Damper) \
    KIND("forces", forces, Force) \
    KIND("torques", torques, Torque) \
    KIND("jets", jets, Jet) \
    KIND("cuts", cuts, Cut) \
    KIND("loads", loads, Load) \
    KIND("sticking", stickings, Sticking) \
    KIND("kinetic", kinetic, KineticTerm) \
    KIND("potentials", potentials, PotentialTerm) \
    KIND("generalised_forces", generalised_forces, GeneralisedForce) \
    KIND("media", media, Medium) \
    KIND("reservoirs", reservoirs, Reservoir) \
    KIND("junctions", junctions, Junction) \
    KIND("volumes", volumes, Volume) \
    KIND("flows", flows, Flow) \
    KIND("nodes", nodes, HeatNode) \
    KIND("links", links, Link) \
    KIND("rods", rods, Rod) \
    KIND("blocks", blocks, Block) \
    KIND("enclosures", enclosures, Enclosure) \
    KIND("pins", pins, Pin) \
    KIND("branches", branches, Branch) \
    KIND("frictions", frictions, Friction) \
    KIND("stops", stops, Stop) \
    KIND("contacts", contacts, Contact) \
    KIND("saturations", saturations, Saturation) \
    KIND("profiles", profiles, Profile) \
    KIND("modes", modes, ModeGroup) \
    KIND("constraints", constraints, Constraint) \
    KIND("events", events, Event) \
    KIND("effects", effects, Effect) \
    KIND("scenes", scenes, SceneChoice) \
    KIND("printed", printed, PrintedEquation) \
    KIND("runs", runs, Run) \
    KIND("view", view, View) \
    KIND("measurements", measurements, Measurement) \
    KIND("sampling", sampling, ControllerSampling) \
    KIND("samplers", samplers, Sampler) \
    KIND("use", uses, Use) \
    KIND("ports", ports, Port)

namespace dalembert {

#define DALEMBERT_DECLARE(section, member, Type) struct Type;
DALEMBERT_KINDS(DALEMBERT_DECLARE)
#undef DALEMBERT_DECLARE
struct Model;

/// Calls visit(section, items) for each kind of which `holder`, a model or a scene, has items.
template <class Holder, class Visit>
void for_each_kind(Holder& holder, const Visit& visit) {
#define DALEMBERT_KIND(section, member, Type) \
    if constexpr (requires { holder.member; }) visit(section, holder.member);
    DALEMBERT_KINDS(DALEMBERT_KIND)
#undef DALEMBERT_KIND
}

/// Calls visit(items of one, items of the other) for each kind of which both holders have items.
template <class One, class Other, class Visit>
void for_each_common_kind(One& one, Other& other, const Visit& visit) {
#define DALEMBERT_KIND(section, member, Type) \
    if constexpr (requires { one.member; other.member; }) visit(one.member, other.member);
    DALEMBERT_KINDS(DALEMBERT_KIND)
#undef DALEMBERT_KIND
}

/// The items of a kind; there is one gravity or view, or none.
template <class Items, class Visit>
void for_each_item(Items& items, const Visit& visit) {
    if constexpr (requires { items.has_value(); }) {
        if (items) visit(*items);
    } else {
        for (auto& item : items) visit(item);
    }
}

}  // namespace dalembert
