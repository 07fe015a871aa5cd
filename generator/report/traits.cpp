// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/traits.hpp"

#include <algorithm>

#include "elements/every_kind.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

/// Whether the scene has one of these elements of the model.
template <auto elements>
bool has(const TraitFacts& f) {
    const Scene& scene = f.system.scene;
    const auto& all = scene.model->*elements;
    return std::any_of(all.begin(), all.end(), [&](const auto& item) { return scene.holds(item.when); });
}

/// Whether the scene holds any.
template <auto members>
bool holds_any(const TraitFacts& f) {
    return !(f.system.scene.*members).empty();
}

bool has_medium(const TraitFacts& f, std::initializer_list<Medium::Law> laws) {
    const auto& media = f.system.scene.media;
    return std::any_of(media.begin(), media.end(),
                       [&](const auto& medium) { return std::find(laws.begin(), laws.end(), medium.item->law) != laws.end(); });
}

bool has_constraint(const TraitFacts& f) {
    const auto& all = f.system.scene.constraints;
    return std::any_of(all.begin(), all.end(), [](const auto& constraint) { return !constraint.item->is_made; });
}

bool has_impact(const TraitFacts& f) {
    const auto& events = f.system.scene.events;
    const auto strikes = [](const auto& event) { return event.item->meets && !event.item->is_made; };  // made ones: friction that stops
    return has<&Model::stops>(f) || std::any_of(events.begin(), events.end(), strikes);
}

bool has_radiation(const TraitFacts& f) {
    const Scene& scene = f.system.scene;
    return !scene.enclosures.empty() ||
           std::any_of(scene.links.begin(), scene.links.end(), [](const auto& link) { return link.item->law == Link::Law::radiation; });
}

bool has_heat(const TraitFacts& f) {
    const Scene& scene = f.system.scene;
    return !scene.nodes.empty() || !scene.links.empty() || !scene.rods.empty() || !scene.blocks.empty();
}

bool has_boiling(const TraitFacts& f) {
    const auto& nodes = f.system.scene.nodes;
    return std::any_of(nodes.begin(), nodes.end(), [](const auto& node) { return node.item->boiling.has_value(); });
}

bool has_orifice(const TraitFacts& f) {
    const auto& flows = f.system.scene.flows;
    return std::any_of(flows.begin(), flows.end(), [](const auto& flow) {
        return flow.item->law == Flow::Law::hydraulic_orifice || flow.item->law == Flow::Law::pneumatic_orifice;
    });
}

constexpr auto table_of_traits = std::to_array<Trait>({
    {"constraints", "positions or rates that are held at zero, with the forces that hold them", has_constraint},
    {"quaternion", "the attitude of a body as a unit quaternion", has<&Model::attitudes>},
    {"chain of bodies", "bodies that stand on each other, whose motion can be solved from body to body",
     [](const TraitFacts& f) { return f.system.chain.has_value(); }},
    {"modes", "a machine that switches between several sets of equations", holds_any<&Scene::modes>},
    {"events", "guards that change equations or values where they go through zero", holds_any<&Scene::events>},
    {"dry friction", "friction that sticks and slides", has<&Model::frictions>},
    {"end stops", "gaps that cannot become negative", has<&Model::stops>},
    {"impacts", "velocities that jump at a collision", has_impact},
    {"one-sided contact", "springs that only pull or only press", has<&Model::contacts>},
    {"saturation", "values within limits", has<&Model::saturations>},
    {"profile", "values that go through phases of time", has<&Model::profiles>},
    {"ejected mass", "mass that leaves with its momentum and energy", holds_any<&Scene::jets>},
    {"statics", "forces and moments in equilibrium", holds_any<&Scene::loads>},
    {"friction at rest", "the largest forces that static friction holds", holds_any<&Scene::stickings>},
    {"integrated solids", "centres of mass and tensors of inertia by integration", holds_any<&Scene::solids>},
    {"cut forces", "forces inside ropes and rods", has<&Model::cuts>},
    {"liquid", "a liquid, compressible or not",
     [](const TraitFacts& f) { return has_medium(f, {Medium::Law::liquid, Medium::Law::incompressible}); }},
    {"gas", "an ideal gas", [](const TraitFacts& f) { return has_medium(f, {Medium::Law::ideal_gas}); }},
    {"given medium", "a medium with a law of its own", [](const TraitFacts& f) { return has_medium(f, {Medium::Law::given}); }},
    {"volumes", "volumes of a liquid or gas with balances of mass and energy", holds_any<&Scene::volumes>},
    {"orifice", "flows with the root of a pressure difference, also choked ones", has_orifice},
    {"junction", "points without volume, whose pressures follow from the balance of flows", holds_any<&Scene::junctions>},
    {"heat", "parts that store and conduct heat", has_heat},
    {"radiation", "heat by radiation", has_radiation},
    {"boiling", "a liquid that evaporates", has_boiling},
    {"rod", "a rod, wall or shell in cells", holds_any<&Scene::rods>},
    {"cells in loops", "cells of a rod that the code computes in loops", holds_any<&Scene::fields>},
    {"circuit", "resistors, inductors, capacitors, sources or motors in an electric circuit", holds_any<&Scene::branches>},
    {"block", "a body in rows and columns of cells", holds_any<&Scene::blocks>},
    {"family of N", "a size that is chosen when the code is generated", holds_any<&Scene::sizes>},
    {"inputs", "inputs that the run drives", holds_any<&Scene::inputs>},
    {"effects", "effects that a scene may call for or leave out", has<&Model::effects>},
    {"stiff", "the method `automatic` used its implicit integrator for a part of the run",
     [](const TraitFacts& f) { return f.stiff_steps > 0; }},
    {"exact solution", "a run with closed forms to compare with",
     [](const TraitFacts& f) { return f.run != nullptr && !f.run->exact.empty(); }},
    {"printed equations", "equations of a text, checked against the derivation", [](const TraitFacts& f) { return f.printed.entries > 0; }},
    {"misprint", "a printed equation that is wrong, with numbers that show it",
     [](const TraitFacts& f) {
         const auto count = [&](Verdict verdict) { return f.printed.of[static_cast<std::size_t>(verdict)]; };
         return count(Verdict::wrong) + count(Verdict::dimensionally_wrong) > 0;
     }},
});

}  // namespace

std::span<const Trait> traits() { return table_of_traits; }

std::vector<const Trait*> traits_of(const TraitFacts& facts) {
    std::vector<const Trait*> shown;
    for (const Trait& trait : table_of_traits)
        if (trait.is_shown(facts)) shown.push_back(&trait);
    return shown;
}

}  // namespace dalembert
