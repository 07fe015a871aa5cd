// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/choose_modes.hpp"
#include "elements/bodies.hpp"
#include "elements/circuits.hpp"
#include "elements/fluids.hpp"
#include "elements/forces.hpp"
#include "elements/heat.hpp"
#include "elements/mentioned.hpp"
#include "text/budgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

namespace dalembert {

namespace {

bool leads_to(const std::vector<Condition>& next, const std::string& mode) {
    std::vector<std::pair<std::string, Span>> named;
    for (const Condition& condition : next) condition.collect(named);
    return std::any_of(named.begin(), named.end(), [&](const auto& n) { return n.first == mode; });
}

bool leads_to(const Event& event, const std::string& mode) { return leads_to(event.next, mode) || leads_to(event.rest, mode); }

/// Whether an expression, or a definition that it mentions, is another one in another mode: by the name of a mode, by a force,
/// or by a voltage or current of a circuit that switches.
bool jumps_with_modes(const Expression& e, const Scene& scene) {
    return mentions(e, *scene.model, [&](const Expression& part) {
        const auto has_it = [&](const ModeGroup* group) {
            return std::any_of(group->modes.begin(), group->modes.end(), [&](const Mode& mode) { return mode.name == part.name; });
        };
        if (part.kind == Expression::Kind::call) return part.name == "ddot";
        return part.kind == Expression::Kind::name &&
               (part.name == "constraint_force" || part.name == "voltage" || part.name == "current" ||
                std::any_of(scene.mode_groups.begin(), scene.mode_groups.end(), has_it));
    });
}

/// Whether a part of the machine may be driven out of its mode where another one changes its own. Of switches one input or one time may
/// drive several.
bool may_be_driven_out(const Scene& scene, const ModeGroup& group) {
    const auto& branches = scene.model->branches;
    if (std::any_of(branches.begin(), branches.end(),
                    [&](const Branch& branch) { return branch.law == Branch::Law::switching && branch.name == group.name; }))
        return true;
    return std::any_of(scene.events.begin(), scene.events.end(), [&](const auto& event) {
        return std::any_of(group.modes.begin(), group.modes.end(), [&](const Mode& mode) { return leads_to(*event.item, mode.name); }) &&
               jumps_with_modes(*event.item->guard, scene);
    });
}

/// The part of each group that a condition asks for, null where it asks for none; nothing where a part is not in the scene.
std::optional<std::vector<const Mode*>> wanted_parts(const Scene& scene, const Condition& condition) {
    std::vector<std::pair<std::string, Span>> named;
    condition.collect(named);
    std::vector<const Mode*> parts(scene.mode_groups.size(), nullptr);
    for (const auto& [name, span] : named) {
        bool is_there = false;
        for (std::size_t group = 0; group < parts.size(); ++group)
            for (const Mode& mode : scene.mode_groups[group]->modes)
                if (mode.name == name) {
                    parts[group] = &mode;
                    is_there = true;
                }
        if (!is_there) return std::nullopt;
    }
    return parts;
}

/// The mode that has what is wanted, and else is as before; or those that have it and differ from that mode in the fewest groups.
std::vector<std::size_t> nearest_modes(const Scene& scene, const std::vector<const Mode*>& wanted, std::size_t from) {
    std::vector<std::size_t> nearest;
    std::size_t fewest = wanted.size();
    for (std::size_t i = 0; i < scene.modes.size(); ++i) {
        const std::vector<const Mode*>& parts = scene.modes[i].parts;
        std::size_t different = 0;
        bool is_wanted = true;
        for (std::size_t group = 0; group < parts.size(); ++group) {
            is_wanted = is_wanted && (wanted[group] == nullptr || wanted[group] == parts[group]);
            if (wanted[group] == nullptr && parts[group] != scene.modes[from].parts[group]) ++different;
        }
        if (!is_wanted || different > fewest) continue;
        if (different < fewest) nearest.clear();
        fewest = different;
        nearest.push_back(i);
    }
    return nearest;
}

/// The first mode of a group may be where a run starts. A mode that is not final is left by some event that is watched in it.
void check_group(const Scene& scene, const ModeGroup& group) {
    for (const Mode& mode : group.modes) {
        const bool is_first = &mode == &group.modes.front();
        const bool is_reached =
            std::any_of(scene.events.begin(), scene.events.end(), [&](const auto& e) { return leads_to(*e.item, mode.name); });
        if (!is_first && !is_reached)
            throw Failure(Diagnostic{
                Id::wrong_modes, mode.span,
                fmt::format("no event leads to the mode '{}'; only the first mode of '{}', in which a run starts, needs no such event",
                            mode.name, group.name)});
        const auto leaves = [&](const Event& event) {
            const bool is_elsewhere = std::any_of(group.modes.begin(), group.modes.end(),
                                                  [&](const Mode& other) { return &other != &mode && leads_to(event, other.name); });
            if (!event.ends && !is_elsewhere) return false;
            for (std::size_t i = 0; i < scene.modes.size(); ++i)
                if (scene.modes[i].is_in(mode.name) && scene.holds(event.when, i)) return true;
            return false;
        };
        if (!mode.is_final && std::none_of(scene.events.begin(), scene.events.end(), [&](const auto& e) { return leaves(*e.item); }))
            throw Failure(Diagnostic{
                Id::wrong_modes, mode.span,
                fmt::format("no event leaves the mode '{0}' or ends a run there; if this is intended, list it: final = [\"{0}\"]",
                            mode.name)});
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
        if (longer.size() > budget::mode_combinations)
            throw Failure(Diagnostic{Id::too_large, group->span,
                                     fmt::format("scene '{}' has {} or more combinations of modes, but this version examines at most {}: "
                                                 "each mode of '{}' combines with each mode of the other groups",
                                                 scene.name, longer.size(), budget::mode_combinations, group->name)});
        scene.modes = std::move(longer);
    }
    std::set<std::string> names;
    for (const SceneMode& mode : scene.modes)
        if (!names.insert(mode.name).second)
            throw Failure(Diagnostic{Id::doubly_defined, mode.parts.front()->span,
                                     fmt::format("two combinations of modes are called '{}'; give their modes other names", mode.name)});
}

void complete_modes(Scene& scene) {
    if (scene.modes.empty() && !scene.events.empty()) scene.modes = {{"always", {}}};
    for (const ModeGroup* group : scene.mode_groups) check_group(scene, *group);
}

std::vector<std::size_t> Scene::modes_after(const std::vector<Condition>& next, std::size_t from) const {
    if (next.empty()) return {from};
    std::vector<std::size_t> result;
    for (const Condition& condition : next)
        if (const auto wanted = wanted_parts(*this, condition))
            for (const std::size_t to : nearest_modes(*this, *wanted, from))
                if (std::find(result.begin(), result.end(), to) == result.end()) result.push_back(to);
    return result.empty() ? std::vector<std::size_t>{from} : result;
}

std::vector<std::size_t> Scene::modes_beside(const Event& event, const std::vector<Condition>& next, std::size_t from) const {
    const bool changes_velocities = event.meets || !event.reset.empty();
    const std::vector<std::size_t> direct = modes_after(next, from);
    // What changes no velocity may change forces: what friction or a stop has to hold.
    std::vector<bool> is_named(mode_groups.size(), false), may_follow;
    for (const ModeGroup* group : mode_groups) may_follow.push_back(changes_velocities || may_be_driven_out(*this, *group));
    for (const Condition& condition : next)
        if (const auto wanted = wanted_parts(*this, condition))
            for (std::size_t group = 0; group < mode_groups.size(); ++group)
                is_named[group] = is_named[group] || (*wanted)[group] != nullptr;
    std::vector<std::size_t> result;
    for (const std::size_t to : direct)
        for (std::size_t i = 0; i < modes.size(); ++i) {
            // The parts that the event itself changes, or may leave as they are, are those of a direct one.
            bool is_beside = true;
            for (std::size_t group = 0; group < modes[i].parts.size(); ++group) {
                const bool is_of_event = is_named[group] && std::any_of(direct.begin(), direct.end(), [&](std::size_t d) {
                                             return modes[d].parts[group] != modes[from].parts[group];
                                         });
                const bool may_differ = !is_of_event && may_follow[group];
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
