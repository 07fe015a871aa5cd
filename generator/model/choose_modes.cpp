// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/choose_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace dalembert {

namespace {

constexpr std::size_t most_modes = 64;

bool leads_to(const std::vector<Condition>& next, const std::string& mode) {
    std::vector<std::pair<std::string, Span>> named;
    for (const Condition& condition : next) condition.collect(named);
    return std::any_of(named.begin(), named.end(), [&](const auto& n) { return n.first == mode; });
}

bool leads_to(const Event& event, const std::string& mode) { return leads_to(event.next, mode) || leads_to(event.rest, mode); }

bool asks_for_force(const Expression& guard) {
    bool result = false;
    for_each(guard, [&](const Expression& e) { result = result || (e.kind == Expression::Kind::name && e.name == "constraint_force"); });
    return result;
}

bool holds_a_rate(const Scene& scene, const ModeGroup& group) {
    return std::any_of(scene.constraints.begin(), scene.constraints.end(), [&](const auto& c) {
        std::vector<std::pair<std::string, Span>> named;
        if (c.item->rate && c.item->when) c.item->when->collect(named);
        return std::any_of(named.begin(), named.end(), [&](const auto& n) { return std::any_of(group.modes.begin(), group.modes.end(), [&](const Mode& mode) { return mode.name == n.first; }); });
    });
}

/// The first mode of a group may be where a run starts. A mode that is not final is left by some event that is watched in it.
void check_group(const Scene& scene, const ModeGroup& group) {
    for (const Mode& mode : group.modes) {
        const bool is_first = &mode == &group.modes.front();
        const bool is_reached = std::any_of(scene.events.begin(), scene.events.end(), [&](const auto& e) { return leads_to(*e.item, mode.name); });
        if (!is_first && !is_reached)
            throw Failure(Diagnostic{Id::wrong_modes, mode.span, fmt::format("no event leads to the mode '{}'; only the first mode of '{}' may be one that a run starts in and never comes back to", mode.name, group.name)});
        const auto leaves = [&](const Event& event) {
            const bool is_elsewhere = std::any_of(group.modes.begin(), group.modes.end(), [&](const Mode& other) { return &other != &mode && leads_to(event, other.name); });
            if (!event.ends && !is_elsewhere) return false;
            for (std::size_t i = 0; i < scene.modes.size(); ++i)
                if (scene.modes[i].is_in(mode.name) && scene.holds(event.when, i)) return true;
            return false;
        };
        if (!mode.is_final && std::none_of(scene.events.begin(), scene.events.end(), [&](const auto& e) { return leaves(*e.item); }))
            throw Failure(Diagnostic{Id::wrong_modes, mode.span, fmt::format("no event leaves the mode '{0}' or ends a run there; if that is meant, list it: final = [\"{0}\"]", mode.name)});
    }
}

}  // namespace

bool SceneMode::is_in(const std::string& part) const {
    return std::any_of(parts.begin(), parts.end(), [&](const Mode* mode) { return mode->name == part; });
}

void choose_modes(Scene& scene) {
    for (const ModeGroup& group : scene.model->modes)
        if (scene.holds(group.when)) scene.mode_groups.push_back(&group);
    if (scene.mode_groups.empty()) return;
    scene.modes = {{}};
    for (const ModeGroup* group : scene.mode_groups) {
        std::vector<SceneMode> longer;
        for (const SceneMode& mode : scene.modes)
            for (const Mode& part : group->modes) {
                longer.push_back({mode.name.empty() ? part.name : mode.name + "_and_" + part.name, mode.parts});
                longer.back().parts.push_back(&part);
            }
        if (longer.size() > most_modes)
            throw Failure(Diagnostic{Id::too_large, group->span, fmt::format("scene '{}' has {} modes or more, this version derives at most {}: each of '{}' goes with each of the other groups", scene.name, longer.size(), most_modes, group->name)});
        scene.modes = std::move(longer);
    }
    std::set<std::string> names;
    for (const SceneMode& mode : scene.modes)
        if (!names.insert(mode.name).second)
            throw Failure(Diagnostic{Id::doubly_defined, mode.parts.front()->span, fmt::format("two combinations of modes are called '{}'; give their modes other names", mode.name)});
}

void complete_modes(Scene& scene) {
    if (scene.modes.empty() && !scene.events.empty()) scene.modes = {{"always", {}}};
    for (const ModeGroup* group : scene.mode_groups) check_group(scene, *group);
}

std::vector<std::size_t> Scene::modes_after(const std::vector<Condition>& next, std::size_t from) const {
    if (next.empty()) return {from};
    std::vector<std::size_t> result;
    for (const Condition& condition : next) {
        std::vector<std::pair<std::string, Span>> named;
        condition.collect(named);
        std::vector<const Mode*> parts = modes[from].parts;
        bool is_there = true;
        for (const auto& [part, span] : named) {
            const auto group = std::find_if(mode_groups.begin(), mode_groups.end(), [&, wanted = part](const ModeGroup* g) { return std::any_of(g->modes.begin(), g->modes.end(), [&](const Mode& m) { return m.name == wanted; }); });
            is_there = is_there && group != mode_groups.end();
            if (group == mode_groups.end()) continue;
            parts[static_cast<std::size_t>(group - mode_groups.begin())] = &*std::find_if((*group)->modes.begin(), (*group)->modes.end(), [&, wanted = part](const Mode& m) { return m.name == wanted; });
        }
        if (!is_there) continue;
        const auto found = std::find_if(modes.begin(), modes.end(), [&](const SceneMode& candidate) { return candidate.parts == parts; });
        if (found != modes.end()) result.push_back(static_cast<std::size_t>(found - modes.begin()));
    }
    return result.empty() ? std::vector<std::size_t>{from} : result;
}

std::vector<std::size_t> Scene::modes_beside(const Event& event, std::size_t from) const {
    // What changes no velocity needs no other part of the machine to change; but where friction lets go, another one on the same rate may hold.
    const bool changes_velocities = event.meets || !event.reset.empty();
    if (!changes_velocities && !asks_for_force(*event.guard)) return {};
    const std::vector<std::size_t> direct = modes_after(event.next, from);
    std::vector<std::size_t> result;
    for (const std::size_t to : direct)
        for (std::size_t i = 0; i < modes.size(); ++i) {
            // The parts that the event itself changes, or may leave as they are, are those of a direct one.
            bool is_beside = true;
            for (std::size_t group = 0; group < modes[i].parts.size(); ++group) {
                const bool is_of_event = std::any_of(direct.begin(), direct.end(), [&](std::size_t d) { return modes[d].parts[group] != modes[from].parts[group]; });
                const bool may_differ = !is_of_event && (changes_velocities || holds_a_rate(*this, *mode_groups[group]));
                is_beside = is_beside && (may_differ || modes[i].parts[group] == modes[to].parts[group]);
            }
            const auto is_in = [&](const std::vector<std::size_t>& list) { return std::find(list.begin(), list.end(), i) != list.end(); };
            if (is_beside && !is_in(direct) && !is_in(result)) result.push_back(i);
        }
    return result;
}

Scene in_mode(const Scene& scene, std::size_t mode) {
    Scene one = scene;
    one.mode = mode;
    const auto keep = [&](auto& members) { std::erase_if(members, [&](const auto& member) { return !one.holds(member.item->when); }); };
    keep(one.bodies);
    keep(one.springs);
    keep(one.dampers);
    keep(one.forces);
    keep(one.torques);
    keep(one.jets);
    keep(one.kinetic);
    keep(one.potentials);
    keep(one.generalised_forces);
    keep(one.flows);
    keep(one.links);
    if (one.gravity != nullptr && !one.holds(one.gravity->when)) one.gravity = nullptr;
    return one;
}

}  // namespace dalembert
