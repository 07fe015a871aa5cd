// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/choose_effects.hpp"
#include "scene/choose_fields.hpp"
#include "scene/choose_modes.hpp"
#include "language/vocabulary.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// Names that anything reads in any scene. Definitions read for others; printed equations and runs are no part of the machine.
std::set<std::string> names_read(const Model& model, const Names& names) {
    Model readers = model;
    readers.definitions.clear();
    readers.printed.clear();
    readers.runs.clear();
    std::set<std::string> read;
    const std::function<void(const Site&)> note = [&](const Site& site) {
        for_each(*site.expression, [&](const Expression& e) {
            if (e.kind != Kind::name || !read.insert(e.name).second) return;
            const Named* named = names.find(e.name);
            if (named != nullptr && named->kind == Named::Kind::definition) visit(named->definition(), note);
        });
    };
    visit(readers, note);
    return read;
}

class Selection {
public:
    Selection(const Model& model, const Names& names, const std::string& name) : model_(model), names_(names), fields_(scene_) {
        scene_.model = &model;
        const SceneWish wish(name);
        scene_.name = wish.name();
        scene_.base = wish.base;
        scene_.wish = name;
        if (const SceneChoice* choice = find_choice(model, wish.base)) scene_.doc = choice->doc;
        for (const auto& [effect, is_added] : wish.changes)
            scene_.doc += fmt::format("{}{} '{}'", scene_.doc.empty() ? "" : ", ", is_added ? "with" : "without", effect);
        effects_ = effects_of(model, wish);
        for (const Effect& effect : model.effects)
            (effects_.contains(effect.name) ? scene_.effects_in : scene_.effects_out).push_back(&effect);
    }

    void set_sizes(const std::map<std::string, int>& wanted) {
        for (const auto& [name, value] : wanted)
            if (std::none_of(model_.sizes.begin(), model_.sizes.end(), [&, key = name](const Size& s) { return s.name == key; })) {
                std::vector<std::string> known;
                for (const Size& size : model_.sizes) known.push_back(size.name);
                fail(Id::unknown_size, model_.name_span,
                     fmt::format("the model has no size '{}'{}", name, known.empty() ? "; it has none at all" : did_you_mean(name, known)));
            }
        for (const Size& size : model_.sizes) {
            const auto given = wanted.find(size.name);
            const int value = given != wanted.end() ? given->second : index_value(*size.value, scene_, {});
            scene_.sizes[size.name] = value;
            if (value < 0)
                fail(Id::value_out_of_range, size.span, fmt::format("size '{}' is {}; a size is not negative", size.name, value));
            if (!size.range) continue;
            const bool too_small = size.range->low && value < index_value(*size.range->low, scene_, {});
            const bool too_large = size.range->high && value > index_value(*size.range->high, scene_, {});
            if (too_small || too_large)
                fail(Id::value_out_of_range, size.range->span,
                     fmt::format("size '{}' is {}, {} its range", size.name, value, too_small ? "below" : "above"));
        }
    }

    Scene take() {
        choose_modes(scene_);
        choose(model_.coordinates, scene_.coordinates);
        choose(model_.outputs, scene_.outputs);
        choose(model_.bodies, scene_.bodies);
        choose(model_.springs, scene_.springs);
        choose(model_.dampers, scene_.dampers);
        choose(model_.forces, scene_.forces);
        choose(model_.torques, scene_.torques);
        choose(model_.jets, scene_.jets);
        choose(model_.kinetic, scene_.kinetic);
        choose(model_.potentials, scene_.potentials);
        choose(model_.generalised_forces, scene_.generalised_forces);
        choose(model_.reservoirs, scene_.reservoirs);
        choose(model_.junctions, scene_.junctions);
        choose(model_.volumes, scene_.volumes);
        choose(model_.flows, scene_.flows);
        choose(model_.nodes, scene_.nodes);
        choose(model_.links, scene_.links);
        choose(model_.rods, scene_.rods);
        choose(model_.blocks, scene_.blocks);
        choose(model_.enclosures, scene_.enclosures);
        choose(model_.constraints, scene_.constraints);
        choose(model_.events, scene_.events);
        for (const Load& load : model_.loads)
            if (scene_.holds(load.when)) scene_.loads.push_back(&load);
        for (const Sticking& sticking : model_.stickings)
            if (scene_.holds(sticking.when)) scene_.stickings.push_back(&sticking);
        complete_modes(scene_);
        const bool any_mass =
            std::any_of(scene_.bodies.begin(), scene_.bodies.end(), [](const auto& body) { return body.item->mass != nullptr; });
        if (model_.gravity && any_mass && scene_.holds(model_.gravity->when)) scene_.gravity = &*model_.gravity;

        const auto use_all = [&](const auto& members, const char* kind) {
            for (const auto& member : members) {
                owner_ = fmt::format("{} '{}'", kind, member.item->name);
                visit(*member.item, [&](const Site& site) { use(site); });
            }
        };
        if (scene_.modes.empty()) fields_.find_all(names_);
        for (const auto& member : scene_.coordinates) used_.insert(member.item->name);
        for (const State& state : model_.states)  // a quaternion is there as a whole
            if (state.quaternion_part && scene_.holds(state.when)) use_name(state.name, state.span);
        use_all(scene_.coordinates, "coordinate");
        use_all(scene_.bodies, "body");
        use_all(scene_.springs, "spring");
        use_all(scene_.dampers, "damper");
        use_all(scene_.forces, "force");
        use_all(scene_.torques, "torque");
        use_all(scene_.jets, "jet");
        for (const Load* load : scene_.loads) use_load(*load);
        for (const Sticking* sticking : scene_.stickings) {
            owner_ = fmt::format("sticking '{}'", sticking->name);
            visit(*sticking, [&](const Site& site) { use(site); });
        }
        use_all(scene_.kinetic, "kinetic term");
        use_all(scene_.potentials, "potential");
        use_all(scene_.generalised_forces, "generalised force");
        use_all(scene_.reservoirs, "reservoir");
        use_all(scene_.junctions, "junction");
        use_volumes();
        use_all(scene_.flows, "flow");
        use_nodes();
        use_all(scene_.links, "link");
        use_cells(scene_.rods, "rod");
        use_cells(scene_.blocks, "block");
        for (const auto& member : scene_.links)
            for (const Reference& end : {member.item->from, member.item->to}) needs_part(end, fmt::format("link '{}'", member.item->name));
        for (const auto& member : scene_.blocks)
            for (const auto* side : {&member.item->left, &member.item->right, &member.item->bottom, &member.item->top})
                if (*side && (*side)->node) needs_part(*(*side)->node, fmt::format("block '{}'", member.item->name));
        fields_.tap_ends();
        use_all(scene_.enclosures, "enclosure");
        for (const auto& member : scene_.enclosures)
            for (const Reference& surface : member.item->surfaces) needs_part(surface, fmt::format("enclosure '{}'", member.item->name));
        use_all(scene_.constraints, "constraint");
        use_all(scene_.events, "event");
        is_output_ = true;
        use_all(scene_.outputs, "output");
        is_output_ = false;
        use_media();
        if (scene_.gravity != nullptr) {
            owner_ = "gravity";
            visit(*scene_.gravity, [&](const Site& site) { use(site); });
        }
        use_declared();

        use_in_runs();
        choose_used(model_.parameters, scene_.parameters);
        choose_used(model_.inputs, scene_.inputs);
        choose_states();
        for (const Definition& definition : model_.definitions)
            if (used_.contains(definition.name) && (dependence(*definition.value, names_) & ~on_parameters) == 0)
                add_members(definition, scene_.definitions);
        for (const Solid& solid : model_.solids)
            if (solids_.contains(solid.name)) scene_.solids.push_back(&solid);
        check_referred_bodies();
        check_determined();
        const bool is_at_rest =
            !scene_.loads.empty() || !scene_.solids.empty() || !scene_.stickings.empty();  // statics need nothing that moves
        if (scene_.coordinates.empty() && scene_.states.empty() && !is_at_rest)
            fail(Id::nothing_left, model_.name_span,
                 fmt::format("scene '{}' has neither a coordinate nor a state that anything uses", scene_.name));
        return std::move(scene_);
    }

private:
    template <class T>
    void add_members(const T& item, std::vector<Member<T>>& members) {
        if (!item.family) {
            members.push_back({&item});
            return;
        }
        const auto [from, to] = bounds(*item.family, scene_);
        for (int index = from; index <= to; ++index) members.push_back({&item, index});
    }

    template <class T>
    void choose(const std::vector<T>& items, std::vector<Member<T>>& members) {
        for (const T& item : items)
            if (scene_.holds(item.when)) add_members(item, members);
    }

    template <class T>
    void choose_used(const std::vector<T>& items, std::vector<Member<T>>& members) {
        for (const T& item : items)
            if (used_.contains(item.name)) add_members(item, members);
    }

    void choose_states() {
        for (const State& state : model_.states) {
            if (!used_.contains(state.name)) continue;
            const Field* field = fields_.find(state.name);
            if (field == nullptr) add_members(state, scene_.states);
            else for (const int index : field->tapped) scene_.states.push_back({&state, index});
        }
    }

    void use(const Site& site) {
        if (site.may_be_absent && !holds(*site.expression)) return;
        if (is_output_) fields_.tap_output(*site.expression);
        for_each(*site.expression, [&](const Expression& e) {
            const bool bound = std::find(site.bound.begin(), site.bound.end(), e.name) != site.bound.end();
            if (e.kind != Kind::name || bound) return;
            if (!is_output_) fields_.tap(e);
            const QuantitySpec* quantity = find_quantity(e.name);
            if (quantity != nullptr && !e.children.empty() && quantity->subscript >= Subscript::solid &&
                quantity->subscript <= Subscript::solid_and_axes)
                use_solid(e.children[0]->name);
            if (quantity != nullptr && quantity->is_of_medium(e.children.size())) {  // a property of a medium, at any temperature
                media_.insert(e.children[0]->name);
                scene_.thermal_media.insert(e.children[0]->name);
            }
            use_name(e.name, e.span);
        });
    }

    void use_solid(const std::string& name) {
        if (!solids_.insert(name).second) return;
        const Solid& solid = *names_.find_solid(name);
        visit(solid, [&](const Site& site) { use(site); });
        for (const auto* parts : {&solid.of, &solid.without})
            for (const Reference& part : *parts) use_solid(part.name);
    }

    /// Its unknowns are letters in it, and belong to the scene where something else uses them.
    void use_load(const Load& load) {
        owner_ = fmt::format("load '{}'", load.name);
        visit(load, [&](Site site) {
            for (const Unknown& unknown : load.unknowns) site.bound.push_back(unknown.name);
            use(site);
        });
    }

    /// Whether what a mere name stands for is in the scene.
    bool holds(const Expression& name) const {
        const Named* named = names_.find(name.name);
        return named == nullptr || scene_.holds(named->item->when);
    }

    /// A volume whose temperature is held takes the heat that this needs; what was given as heat is not asked for.
    void use_volumes() {
        for (const auto& member : scene_.volumes) {
            owner_ = fmt::format("volume '{}'", member.item->name);
            Volume used = *member.item;
            if (!scene_.has_temperature(used, names_)) used.heat = nullptr;
            visit(used, [&](const Site& site) { use(site); });
        }
    }

    /// A node whose temperature the scene leaves out stores nothing.
    void use_nodes() {
        for (const auto& member : scene_.nodes) {
            owner_ = fmt::format("node '{}'", member.item->name);
            HeatNode used = *member.item;
            if (used.capacity && !scene_.has_capacity(used, names_)) used.capacity.reset(), used.temperature.reset();
            visit(used, [&](const Site& site) { use(site); });
        }
    }

    /// Rods and blocks, with all the states that are their temperatures.
    template <class T>
    void use_cells(const std::vector<Member<T>>& members, const char* kind) {
        for (const auto& member : members) {
            owner_ = fmt::format("{} '{}'", kind, member.item->name);
            use_name(member.item->temperature.name, member.item->temperature.span);
            visit(*member.item, [&](const Site& site) { use(site); });
        }
    }

    void needs_part(const Reference& end, const std::string& owner) const {
        const Part& part = *names_.find_part(end.name);
        if (!scene_.holds(part.item->when))
            fail(Id::needs_absent, end.span, fmt::format("{} needs '{}', which scene '{}' leaves out", owner, end.name, scene_.name),
                 {{part.item->span, "it is defined here"}});
    }

    /// Media that something holds; where the temperature is everywhere the same, what depends on it is not asked for.
    void use_media() {
        const auto hold = [&](const Reference& medium, const Item& item, bool is_thermal) {
            const Item& held = *names_.find_part(medium.name)->item;
            if (!scene_.holds(held.when))
                fail(Id::needs_absent, medium.span,
                     fmt::format("'{}' holds '{}', which scene '{}' leaves out", item.name, held.name, scene_.name),
                     {{held.span, "the medium is defined here"}});
            media_.insert(medium.name);
            if (is_thermal) scene_.thermal_media.insert(medium.name);
        };
        for (const auto& member : scene_.volumes) {
            const Volume& volume = *member.item;
            hold(volume.medium, volume, scene_.has_temperature(volume, names_) || volume.isothermal || volume.polytropic);
        }
        for (const auto& member : scene_.reservoirs) hold(member.item->medium, *member.item, member.item->temperature != nullptr);
        for (const auto& member : scene_.junctions) hold(member.item->medium, *member.item, false);
        for (const auto& member : scene_.flows)
            for (const Reference& end : {member.item->from, member.item->to}) needs_part(end, fmt::format("flow '{}'", member.item->name));
        std::set<std::string> orifices;  // the ratio of specific heats is needed at any temperature
        for (const auto& member : scene_.flows)
            if (member.item->law == Flow::Law::pneumatic_orifice) orifices.insert(member.item->from.name);
        for (const Medium& medium : model_.media) {
            if (!media_.contains(medium.name)) continue;
            scene_.media.push_back({&medium});
            owner_ = fmt::format("medium '{}'", medium.name);
            Medium used = medium;
            if (!scene_.thermal_media.contains(medium.name)) {
                const bool for_orifice =
                    std::any_of(orifices.begin(), orifices.end(), [&](const std::string& name) { return medium_of(name) == medium.name; });
                if (!for_orifice && medium.law != Medium::Law::given) used.isochoric_heat.reset();
            }
            visit(used, [&](const Site& site) { use(site); });
        }
    }

    const std::string& medium_of(const std::string& name) const {
        const Part& part = *names_.find_part(name);
        if (part.kind == Part::Kind::junction) return static_cast<const Junction*>(part.item)->medium.name;
        return part.kind == Part::Kind::volume ? static_cast<const Volume*>(part.item)->medium.name
                                               : static_cast<const Reservoir*>(part.item)->medium.name;
    }

    /// Each state without a derivative is determined once.
    void check_determined() {
        std::map<std::pair<std::string, int>, std::pair<std::string, Span>> by;
        const auto claim = [&](const ExpressionPtr& state, const auto& member) {
            if (!state) return;
            const Indices indices = member.item->family ? Indices{{member.item->family->index, member.index}} : Indices{};
            const int index = state->children.empty() ? 0 : index_value(*state->children[0], scene_, indices);
            const auto [first, is_new] = by.emplace(std::pair(state->name, index), std::pair(member.name(), member.item->span));
            if (!is_new)
                fail(Id::doubly_determined, state->span,
                     fmt::format("scene '{}': '{}' and '{}' both determine state '{}'", scene_.name, first->second.first, member.name(),
                                 state->written()),
                     {{first->second.second, fmt::format("'{}' is defined here", first->second.first)}});
        };
        for (const auto& member : scene_.volumes) {
            const Volume& volume = *member.item;
            for (const ExpressionPtr& state : {volume.filling ? nullptr : volume.pressure, volume.density, volume.mass, volume.filling,
                                               scene_.has_temperature(volume, names_) ? volume.temperature : nullptr})
                claim(state, member);
        }
        for (const auto& member : scene_.flows) claim(member.item->velocity, member);
        for (const auto& member : scene_.nodes) {
            if (!scene_.has_capacity(*member.item, names_)) continue;
            claim(member.item->temperature, member);
            if (member.item->boiling) claim(member.item->boiling->mass, member);
        }
        const auto claim_cells = [&](const auto& members) {
            for (const auto& member : members)
                for (const auto& state : scene_.states) {
                    if (state.item->name != member.item->temperature.name) continue;
                    const auto [first, is_new] =
                        by.emplace(std::pair(state.item->name, state.index), std::pair(member.name(), member.item->span));
                    if (!is_new)
                        fail(Id::doubly_determined, member.item->temperature.span,
                             fmt::format("scene '{}': '{}' and '{}' both determine state '{}'", scene_.name, first->second.first,
                                         member.name(), state.name()),
                             {{first->second.second, fmt::format("'{}' is defined here", first->second.first)}});
                }
        };
        claim_cells(scene_.rods);
        claim_cells(scene_.blocks);
        for (const auto& member : scene_.states) {
            if (member.item->derivative || by.contains({member.item->name, member.index})) continue;
            const bool is_any =
                std::any_of(by.begin(), by.end(), [&](const auto& determined) { return determined.first.first == member.item->name; });
            fail(Id::undetermined, member.item->span,
                 fmt::format("nothing in scene '{}' determines state '{}'{}", scene_.name, member.name(),
                             is_any ? "" : "; where what determines it is left out, it needs the same 'when'"));
        }
    }

    void use_name(const std::string& name, const Span& span) {
        const Named* named = names_.find(name);
        if (named == nullptr) return;
        if (!scene_.holds(named->item->when))
            fail(Id::needs_absent, span,
                 fmt::format("{} needs '{}', which scene '{}' leaves out; give it a 'when' of its own", owner_, name, scene_.name),
                 {{named->item->span, fmt::format("'{}' is defined here", name)}});
        if (!used_.insert(name).second) return;
        const auto follow = [&](const Site& site) { use(site); };
        if (named->kind == Named::Kind::definition) visit(named->definition(), follow);
        if (named->kind == Named::Kind::state) visit(static_cast<const State&>(*named->item), follow);
    }

    /// What is declared and no effect takes out stays, whether or not anything reads it: every state, and parameters and inputs that
    /// nothing in the model reads. Those that something reads go where all that reads them is left out.
    void use_declared() {
        for (const State& state : model_.states)
            if (scene_.holds(state.when)) use_name(state.name, state.span);
        const std::set<std::string> read = names_read(model_, names_);
        const auto use_unread = [&](const auto& items) {
            for (const auto& item : items)
                if (!read.contains(item.name) && scene_.holds(item.when)) use_name(item.name, item.span);
        };
        use_unread(model_.parameters);
        use_unread(model_.inputs);
    }

    /// Parameters that the runs of this scene need for its inputs.
    void use_in_runs() {
        const auto use_parameters = [&](const ExpressionPtr& expression) {
            if (!expression) return;
            for_each(*expression, [&](const Expression& e) {
                const Named* named = e.kind == Kind::name ? names_.find(e.name) : nullptr;
                const bool is_constant = named != nullptr && (dependence(e, names_) & ~on_parameters) == 0;
                if (is_constant && scene_.holds(named->item->when)) use_name(e.name, e.span);
            });
        };
        for (const Run& run : model_.runs) {
            if (!run.scene.empty() && run.scene != scene_.base) continue;
            owner_ = fmt::format("run '{}'", run.name);
            for (const ExpressionPtr& e : {run.until, run.period, run.step}) use_parameters(e);
            for (const Plot& plot : run.plots)
                for (const std::string& name : plot.y) fields_.tap_plotted(name);
            for (const RunEntry& entry : run.inputs)
                if (used_.contains(entry.variable->name)) use_parameters(entry.value);
            for (const RunEntry& entry : run.exact) use_parameters(entry.value);
        }
    }

    void check_referred_bodies() {
        const auto check = [&](const std::optional<Reference>& reference, const std::string& owner) {
            if (!reference) return;
            const Body& body = *names_.find_body(reference->name);
            if (!scene_.holds(body.when))
                fail(Id::needs_absent, reference->span,
                     fmt::format("'{}' needs body '{}', which scene '{}' leaves out", owner, body.name, scene_.name),
                     {{body.span, "the body is defined here"}});
        };
        for (const auto& member : scene_.bodies) check(member.item->on, member.item->name);
        for (const auto& member : scene_.dampers) check(member.item->on, member.item->name);
        for (const auto& member : scene_.forces) check(member.item->on, member.item->name);
        for (const auto& member : scene_.jets) check(member.item->from, member.item->name);
        for (const auto& member : scene_.torques) {
            check(member.item->on, member.item->name);
            check(member.item->against, member.item->name);
        }
    }

    const Model& model_;
    const Names& names_;
    Scene scene_;
    FieldChoice fields_;
    bool is_output_ = false;  ///< what is used is used by an output
    std::set<std::string> effects_;
    std::set<std::string> used_;
    std::set<std::string> solids_;
    std::set<std::string> media_;  ///< held by a volume or reservoir, or asked for
    std::string owner_;
};

}  // namespace

Scene select_scene(const Model& model, const Names& names, const std::string& scene, const std::map<std::string, int>& sizes) {
    Selection selection(model, names, scene);
    selection.set_sizes(sizes);
    return selection.take();
}

}  // namespace dalembert
