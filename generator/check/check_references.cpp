// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "check/checks.hpp"
#include "check/written_values.hpp"
#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"
#include "elements/references.hpp"
#include "language/parser.hpp"
#include "text/nearest.hpp"

namespace dalembert {

std::string with_article(const std::string& words) {
    return (std::string_view("aeiou").find(words.front()) == std::string_view::npos ? "a " : "an ") + words;
}

namespace {

/// References that are not expressions: to other elements, effects, scenes and what is plotted.
class ReferenceCheck {
public:
    ReferenceCheck(const Model& model, const Names& names, Diagnostics& diagnostics)
        : model_(model), names_(names), diagnostics_(diagnostics) {}

    void run() {
        for_each_kind(model_, [&](const char*, const auto& items) { for_each_item(items, [&](const auto& item) { elements(item); }); });
        for (const Body& item : model_.bodies) placement(item);
        for (const Damper& item : model_.dampers) has_position(item.on);
        for (const Force& item : model_.forces)
            if (!item.in_axes) has_position(item.on);
        for (const Jet& item : model_.jets) has_position(item.from);
        for (const Cut& item : model_.cuts)
            for (const Reference& freed : item.bodies)
                if (!item.about) has_position(freed);
        for (const Torque& item : model_.torques) {
            turns(item.on);
            turns(item.against);
        }
        if (model_.view) viewed(*model_.view);
        placement_cycles();
        effects();
        for (const Port& port : model_.ports) check(port);
    }

private:
    /// [view] names elements that the page draws. Only bodies can have a shape and a colour.
    void viewed(const View& view) {
        for (const ViewPart& part : view.parts) {
            element({{part.name, nullptr, part.span}, "parts", viewed_kinds(), true}, "the view");
            const OfKind found = names_.find_element(part.name, viewed_kinds());
            if (found.item == nullptr || names_.find_element<Body>(part.name) != nullptr) continue;
            const char* key = part.shape != ViewPart::Shape::usual ? "shape" : !part.colour.empty() ? "colour" : nullptr;
            if (key != nullptr)
                diagnostics_.error(Id::not_allowed_here, part.span,
                                   fmt::format("only bodies have a {} in the view, but '{}' is {}", key, part.name,
                                               with_article(found.kind->word)),
                                   {{found.item->span, "it is defined here"}});
        }
    }

    /// What an element brings along refers to what the element itself does.
    template <class Described>
    void elements(const Described& item) {
        if constexpr (requires { item.is_made; })
            if (item.is_made) return;
        visit_references(item, [&](const Referred& referred) { element(referred, owner_of(item)); });
    }

    void element(const Referred& referred, const std::string& owner) {
        const Reference& to = referred.to;
        const OfKind found = names_.find_element(to.name, referred.kinds);
        const std::string wanted = words_of(referred.kinds);
        if (found.item == nullptr) {
            const std::string hint = did_you_mean(to.name, names_.names_of(referred.kinds));
            const std::vector<OfKind>& others = names_.elements(to.name);
            if (others.empty())
                return diagnostics_.error(Id::unknown_name, to.span,
                                          fmt::format("there is no {} '{}' for '{}' of {}{}", wanted, to.name, referred.key, owner, hint));
            const std::string is = with_article(others.front().kind->word);
            return diagnostics_.error(Id::unknown_name, to.span,
                                      fmt::format("'{}' is {}, but '{}' of {} takes the name of {}{}", to.name, is, referred.key, owner,
                                                  with_article(wanted), hint),
                                      {{others.front().item->span, "it is defined here"}});
        }
        const std::string it = fmt::format("{} '{}'", found.kind->word, to.name);
        const std::vector<Note> defined{{found.item->span, "it is defined here"}};
        const bool is_several = found.kind->facts.has_cells || found.item->family;
        if (to.index && referred.all_members)
            diagnostics_.error(Id::not_indexed, to.span,
                               fmt::format("'{}' of {} takes all of '{}', without an index", referred.key, owner, to.name), defined);
        else if (to.index && !is_several)
            diagnostics_.error(Id::not_indexed, to.span, fmt::format("{} is not a family and has no index", it), defined);
        else if (!to.index && is_several && !referred.all_members)
            diagnostics_.error(
                Id::index_missing, to.span,
                fmt::format("{} {}, as in '{}[1]'", it,
                            found.kind->facts.has_cells ? "consists of cells and needs the index of one" : "is a family and needs an index",
                            to.name),
                defined);
    }

    void check(const Port& port) {
        for (const auto& [name, span] : port.alone)
            if (names_.elements(name).empty())
                diagnostics_.error(Id::unknown_name, span,
                                   fmt::format("nothing is called '{}', so port '{}' cannot have it alone", name, port.name));
        const Named* other = port.value ? names_.find(port.name) : nullptr;
        if (other != nullptr && port.kind == Port::Kind::signal && port.value->name != port.name)
            diagnostics_.error(Id::doubly_defined, port.span,
                               fmt::format("port '{0}' gives a value, but '{0}' is also {1}, which is something else", port.name,
                                           describe(other->kind)),
                               {{other->item->span, "it is defined here"}});
        const Coordinate* coordinate = port.coordinate ? names_.find_element<Coordinate>(port.coordinate->name) : nullptr;
        if (coordinate == nullptr) return;
        const bool is_shaft = port.kind == Port::Kind::shaft;
        if (coordinate->unit.dimension != (is_shaft ? Dimension::none() : Dimension::length()))
            diagnostics_.error(Id::unit_mismatch, port.coordinate->span,
                               fmt::format("port '{}' is a {}, but '{}' counts in {}", port.name,
                                           is_shaft ? "shaft, whose coordinate is an angle" : "flange, whose coordinate is a length",
                                           coordinate->name, coordinate->unit.written),
                               {{coordinate->span, "it is declared here"}});
        if (coordinate->family)
            diagnostics_.error(Id::not_indexed, port.coordinate->span,
                               fmt::format("'{}' is a family, and a port has one coordinate", coordinate->name),
                               {{coordinate->span, "it is declared here"}});
    }

    void has_position(const std::optional<Reference>& reference) {
        const Body* found = reference ? names_.find_element<Body>(reference->name) : nullptr;
        if (found != nullptr && !found->position && !found->has_axes())
            diagnostics_.error(Id::not_allowed_here, reference->span, fmt::format("body '{}' has no position", reference->name),
                               {{found->span, "it is defined here"}});
    }

    void turns(const std::optional<Reference>& reference) {
        const Body* found = reference ? names_.find_element<Body>(reference->name) : nullptr;
        if (found != nullptr && !found->rotation && !found->angular_velocity && !found->has_axes())
            diagnostics_.error(Id::not_allowed_here, reference->span, fmt::format("body '{}' does not turn", reference->name),
                               {{found->span, "it is defined here"}});
    }

    /// A body that turns by its angular velocity alone points nobody knows where.
    void placement(const Body& item) {
        const Body* base = item.on ? names_.find_element<Body>(item.on->name) : nullptr;
        if (base == nullptr || !base->angular_velocity || base->rotation) return;
        diagnostics_.error(Id::not_allowed_here, item.on->span,
                           fmt::format("body '{}' cannot be placed on '{}', which has only an angular velocity; give it a rotation",
                                       item.name, base->name),
                           {{base->angular_velocity->span, "its angular velocity stands here"}});
    }

    /// A chain of "on" that comes back to where it began; members of one family are ordered by their index instead.
    void placement_cycles() {
        for (const Body& start : model_.bodies) {
            std::set<std::string> seen{start.name};
            const Body* at = &start;
            while (at != nullptr && at->on && at->on->name != at->name) {
                if (!seen.insert(at->on->name).second) {
                    diagnostics_.error(Id::cyclic_definition, start.on->span,
                                       fmt::format("body '{}' is placed on a body that is placed on it", start.name));
                    break;
                }
                at = names_.find_element<Body>(at->on->name);
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
            diagnostics_.error(
                Id::unknown_effect, span,
                fmt::format("{} '{}'{}{}",
                            may_be_mode && !model_.modes.empty() ? "there is neither an effect nor a mode" : "[effects] does not declare",
                            name, did_you_mean(name, known), known.empty() ? "; there is no [effects] at all" : ""));
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
            if constexpr (requires { item.when; })
                condition(item.when, !std::is_same_v<std::remove_cvref_t<decltype(item)>, PrintedEquation>);
        };
        for_each_kind(model_, [&](const char*, const auto& items) { for_each_item(items, conditions); });
        const auto listed = [&](const std::vector<std::pair<std::string, Span>>& names) {
            for (const auto& [name, span] : names) effect(name, span);
        };
        for (const Effect& item : model_.effects) {
            listed(item.excludes);
            listed(item.implies);
            if (!carried_.contains(item.name) && item.implies.empty())
                diagnostics_.error(Id::unused, item.span,
                                   fmt::format("no component has when = \"{0}\" or \"not {0}\": scenes with and without the effect "
                                               "'{0}' are the same machine",
                                               item.name));
        }
        for (const SceneChoice& scene : model_.scenes) listed(scene.effects);
        for (const Measurement& measurement : model_.measurements) measured(measurement);
        for (const Run& run : model_.runs) {
            std::vector<std::string> known{model_.scenes.empty() ? "full" : ""};
            for (const SceneChoice& scene : model_.scenes) known.push_back(scene.name);
            plots(run);
            if (!run.scene.empty() && std::find(known.begin(), known.end(), run.scene) == known.end())
                diagnostics_.error(Id::unknown_scene, run.scene_span,
                                   fmt::format("there is no scene '{}'{}", run.scene, did_you_mean(run.scene, known)));
        }
    }

    /// What a column of data is said to be.
    void measured(const Measurement& measurement) {
        const std::string& name = measurement.quantity.empty() ? measurement.name : measurement.quantity;
        try {
            if (name == "t" || declared_unit(*parse_expression(excerpt_of(std::make_shared<const Source>("quantity", name))), names_))
                return;
        } catch (const Failure&) {  // told below
        }
        diagnostics_.error(
            Id::unknown_name, measurement.span,
            fmt::format("measurement '{}': '{}' is no output, coordinate, rate of one, state, input or parameter", measurement.name, name));
    }

    /// "speed_z": as they are recorded.
    std::vector<std::string> states_of_controllers() const {
        std::vector<std::string> names;
        for (const Sampler& sampler : model_.samplers)
            for (const State& state : sampler.controller->states) names.push_back(sampler.name + "_" + state.name);
        return names;
    }

    /// Names in plots: variables, members and rates of them, outputs, energies, states of controllers.
    void plots(const Run& run) {
        const auto check = [&](const std::string& name, const Span& span) {
            std::string base = name.starts_with("dot(") && name.ends_with(")") ? name.substr(4, name.size() - 5) : name;
            base = base.substr(0, base.find('['));
            const std::vector<std::string> energies{"t", "kinetic_energy", "potential_energy", "internal_energy", "work"};
            const Named* named = names_.find(base);
            if (named != nullptr && (named->kind == Named::Kind::definition || named->kind == Named::Kind::parameter ||
                                     named->kind == Named::Kind::size || named->kind == Named::Kind::mode))
                return diagnostics_.error(Id::not_allowed_here, span,
                                          fmt::format("run '{}' plots '{}', which is {} and not recorded; make it an output", run.name,
                                                      name, describe(named->kind)),
                                          {{named->item->span, fmt::format("'{}' is defined here", base)}});
            if (named != nullptr || std::find(energies.begin(), energies.end(), base) != energies.end()) return;
            const std::vector<std::string> of_controllers = states_of_controllers();
            if (std::find(of_controllers.begin(), of_controllers.end(), base) != of_controllers.end()) return;
            std::vector<std::string> known = names_.all();
            known.insert(known.end(), energies.begin(), energies.end());
            known.insert(known.end(), of_controllers.begin(), of_controllers.end());
            diagnostics_.error(Id::unknown_name, span,
                               fmt::format("run '{}' plots '{}', which is not defined{}", run.name, name, did_you_mean(name, known)));
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
