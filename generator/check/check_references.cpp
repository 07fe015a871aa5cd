// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "check/checks.hpp"
#include "elements/kinds.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// References that are not expressions: bodies, coordinates, effects.
class ReferenceCheck {
public:
    ReferenceCheck(const Model& model, const Names& names, Diagnostics& diagnostics) : model_(model), names_(names), diagnostics_(diagnostics) {}

    void run() {
        for (const Body& item : model_.bodies) {
            body(item.on, false, false);
            placement(item);
            attitude(item);
        }
        for (const Damper& item : model_.dampers) body(item.on, true, false);
        for (const Force& item : model_.forces) body(item.on, !item.in_axes, false);
        for (const Jet& item : model_.jets) body(item.from, true, false);
        for (const Torque& item : model_.torques) {
            body(item.on, false, true);
            body(item.against, false, true);
        }
        for (const Cut& item : model_.cuts)
            for (const Reference& freed : item.bodies) body(freed, !item.about, false);
        placement_cycles();
        for (const PotentialTerm& item : model_.potentials) {
            for (const CoordinateEntry& entry : item.forces) coordinate(entry);
            for (const CoordinateEntry& entry : item.reference) coordinate(entry);
        }
        for (const GeneralisedForce& item : model_.generalised_forces) coordinate(item.coordinate);
        for (const Constraint& item : model_.constraints)
            if (item.eliminates) coordinate({item.eliminates->name, item.eliminates->index, nullptr, item.eliminates->span});
        effects();
    }

private:
    void body(const std::optional<Reference>& reference, bool needs_position, bool needs_rotation) {
        if (!reference) return;
        const Body* found = names_.find_body(reference->name);
        if (found == nullptr) {
            std::vector<std::string> known;
            for (const Body& item : model_.bodies) known.push_back(item.name);
            diagnostics_.error(Id::unknown_name, reference->span, fmt::format("there is no body '{}'{}", reference->name, did_you_mean(reference->name, known)));
            return;
        }
        if (found->family.has_value() != (reference->index != nullptr))
            diagnostics_.error(found->family ? Id::index_missing : Id::not_indexed, reference->span,
                               fmt::format("body '{}' is {} family", reference->name, found->family ? "a" : "not a"), {{found->span, "it is defined here"}});
        if (needs_position && !found->position && !found->has_axes())
            diagnostics_.error(Id::not_allowed_here, reference->span, fmt::format("body '{}' has no position", reference->name), {{found->span, "it is defined here"}});
        if (needs_rotation && !found->rotation && !found->angular_velocity && !found->has_axes())
            diagnostics_.error(Id::not_allowed_here, reference->span, fmt::format("body '{}' does not turn", reference->name), {{found->span, "it is defined here"}});
    }

    void attitude(const Body& item) {
        if (!item.attitude) return;
        std::vector<std::string> known;
        for (const Attitude& attitude : model_.attitudes) known.push_back(attitude.name);
        if (std::find(known.begin(), known.end(), item.attitude->name) == known.end())
            diagnostics_.error(Id::unknown_name, item.attitude->span, fmt::format("there is no attitude '{}'{}", item.attitude->name, did_you_mean(item.attitude->name, known)));
        else if (item.attitude->index)
            diagnostics_.error(Id::not_indexed, item.attitude->span, fmt::format("attitude '{}' has no index", item.attitude->name));
    }

    /// A body that turns by its angular velocity alone points nobody knows where.
    void placement(const Body& item) {
        const Body* base = item.on ? names_.find_body(item.on->name) : nullptr;
        if (base == nullptr || !base->angular_velocity || base->rotation) return;
        diagnostics_.error(Id::not_allowed_here, item.on->span,
                           fmt::format("body '{}' cannot be placed on '{}', of which only the angular velocity is given; give its rotation", item.name, base->name),
                           {{base->angular_velocity->span, "it turns like this"}});
    }

    void coordinate(const CoordinateEntry& entry) {
        const Named* named = names_.find(entry.coordinate);
        if (named == nullptr || named->kind != Named::Kind::coordinate) {
            std::vector<std::string> known;
            for (const Coordinate& item : model_.coordinates) known.push_back(item.name);
            diagnostics_.error(Id::unknown_name, entry.span, fmt::format("there is no coordinate '{}'{}", entry.coordinate, did_you_mean(entry.coordinate, known)));
        } else if (named->item->family.has_value() != (entry.index != nullptr)) {
            diagnostics_.error(named->item->family ? Id::index_missing : Id::not_indexed, entry.span,
                               fmt::format("coordinate '{}' is {} family", entry.coordinate, named->item->family ? "a" : "not a"));
        }
    }

    /// A chain of "on" that comes back to where it began; members of one family are ordered by their index instead.
    void placement_cycles() {
        for (const Body& start : model_.bodies) {
            std::set<std::string> seen{start.name};
            const Body* at = &start;
            while (at != nullptr && at->on && at->on->name != at->name) {
                if (!seen.insert(at->on->name).second) {
                    diagnostics_.error(Id::cyclic_definition, start.on->span, fmt::format("body '{}' is placed on a body that is placed on it", start.name));
                    break;
                }
                at = names_.find_body(at->on->name);
            }
            if (start.on && start.on->name == start.name && !start.family)
                diagnostics_.error(Id::cyclic_definition, start.on->span, fmt::format("body '{}' is placed on itself", start.name));
        }
    }

    void effect(const std::string& name, const Span& span, bool may_be_mode = false) {
        std::vector<std::string> known;
        for (const Effect& item : model_.effects) known.push_back(item.name);
        if (may_be_mode)
            for (const ModeGroup& group : model_.modes)
                for (const Mode& mode : group.modes) known.push_back(mode.name);
        if (std::find(known.begin(), known.end(), name) == known.end())
            diagnostics_.error(Id::unknown_effect, span,
                               fmt::format("{} '{}'{}{}", may_be_mode && !model_.modes.empty() ? "there is neither an effect nor a mode" : "[effects] does not declare", name, did_you_mean(name, known),
                                           known.empty() ? "; there is no [effects] at all" : ""));
    }

    /// A printed equation says when it holds, and carries nothing.
    void condition(const std::optional<Condition>& when, bool carries) {
        std::vector<std::pair<std::string, Span>> named;
        if (when) when->collect(named);
        for (const auto& [name, span] : named) {
            effect(name, span, true);
            if (carries) carried_.insert(name);
        }
    }

    void effects() {
        const auto conditions = [&](const auto& item) {
            if constexpr (requires { item.is_made; })
                if (item.is_made) return;  // by an item that says the same
            condition(item.when, !std::is_same_v<std::remove_cvref_t<decltype(item)>, PrintedEquation>);
        };
        for_each_kind(model_, [&](const char*, const auto& items) {
            for_each_item(items, conditions);
        });
        const auto listed = [&](const std::vector<std::pair<std::string, Span>>& names) {
            for (const auto& [name, span] : names) effect(name, span);
        };
        for (const Effect& item : model_.effects) {
            listed(item.excludes);
            listed(item.implies);
            if (!carried_.contains(item.name) && item.implies.empty())
                diagnostics_.error(Id::unused, item.span, fmt::format("no component carries the effect '{0}': nothing says when = \"{0}\" or \"not {0}\", so that scenes with and without it are the same machine", item.name));
        }
        for (const SceneChoice& scene : model_.scenes) listed(scene.effects);
        for (const Run& run : model_.runs) {
            std::vector<std::string> known{model_.scenes.empty() ? "full" : ""};
            for (const SceneChoice& scene : model_.scenes) known.push_back(scene.name);
            plots(run);
            if (!run.scene.empty() && std::find(known.begin(), known.end(), run.scene) == known.end())
                diagnostics_.error(Id::unknown_scene, run.scene_span, fmt::format("there is no scene '{}'{}", run.scene, did_you_mean(run.scene, known)));
        }
    }

    /// Names in plots: variables, members and rates of them, outputs, energies.
    void plots(const Run& run) {
        const auto check = [&](const std::string& name, const Span& span) {
            std::string base = name.starts_with("dot(") && name.ends_with(")") ? name.substr(4, name.size() - 5) : name;
            base = base.substr(0, base.find('['));
            const std::vector<std::string> energies{"t", "kinetic_energy", "potential_energy", "internal_energy", "work"};
            const Named* named = names_.find(base);
            if (named != nullptr && (named->kind == Named::Kind::definition || named->kind == Named::Kind::parameter || named->kind == Named::Kind::size || named->kind == Named::Kind::mode))
                return diagnostics_.error(Id::not_allowed_here, span, fmt::format("run '{}' plots '{}', which is {} and not recorded; make it an output", run.name, name, describe(named->kind)),
                                          {{named->item->span, fmt::format("'{}' is defined here", base)}});
            if (named != nullptr || std::find(energies.begin(), energies.end(), base) != energies.end()) return;
            std::vector<std::string> known = names_.all();
            known.insert(known.end(), energies.begin(), energies.end());
            diagnostics_.error(Id::unknown_name, span, fmt::format("run '{}' plots '{}', which is not defined{}", run.name, name, did_you_mean(name, known)));
        };
        for (const Plot& plot : run.plots) {
            if (!plot.x.empty()) check(plot.x, plot.span);
            for (const std::string& name : plot.y) check(name, plot.span);
        }
    }

    const Model& model_;
    const Names& names_;
    Diagnostics& diagnostics_;
    std::set<std::string> carried_;  ///< effects that some condition names
};

}  // namespace

void check_references(const Model& model, Diagnostics& diagnostics) {
    const Names names(model);
    ReferenceCheck(model, names, diagnostics).run();
}

}  // namespace dalembert
