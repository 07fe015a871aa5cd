// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/used_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "elements/every_kind.hpp"
#include "elements/references.hpp"
#include "language/vocabulary.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// Names that anything reads in any scene. Definitions read for others; printed equations and runs are no part of the machine.
std::set<std::string> names_read(const Model& model, const Names& names) {
    Model readers = model;
    readers.definitions.clear();
    readers.printed.clear();
    readers.runs.clear();
    readers.view.reset();
    readers.measurements.clear();
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

/// An element as far as the scene asks for what it says.
template <class Element>
const Element& as_used(const Element& item, const Scene&, const Names&) { return item; }

/// A volume whose temperature is held takes the heat that this needs; what was given as heat is not asked for.
Volume as_used(const Volume& item, const Scene& scene, const Names& names) {
    Volume used = item;
    if (!scene.has_temperature(used, names)) used.heat = nullptr;
    return used;
}

/// A node whose temperature the scene leaves out stores nothing.
HeatNode as_used(const HeatNode& item, const Scene& scene, const Names& names) {
    HeatNode used = item;
    if (used.capacity && !scene.has_capacity(used, names)) used.capacity.reset(), used.temperature.reset();
    return used;
}

}  // namespace

void UsedNames::find_all() {
    for (const auto& member : scene_.coordinates) used_.insert(member.item->name);
    for (const State& state : scene_.model->states)  // a quaternion is there as a whole
        if (state.quaternion_part && scene_.holds(state.when)) use_name(state.name, state.span);
    use_elements();
    fields_.tap_ends();
    use_outputs();
    use_media();
    if (scene_.gravity != nullptr) {
        owner_ = "gravity";
        use_expressions(*scene_.gravity);
    }
    for (const Sampler* sampler : scene_.samplers) {
        owner_ = owner_of(*sampler);
        for (const RunEntry& entry : sampler->of_machine) use({.expression = entry.value.get(), .allowed = constant_only, .what = owner_});
    }
    if (scene_.sampling != nullptr) {
        owner_ = owner_of(*scene_.sampling);
        use_expressions(*scene_.sampling);
    }
    use_declared();
    use_in_runs();
}

void UsedNames::use_elements() {
    for_each_kind(scene_, [&]<class Members>(const char*, const Members& members) {
        if constexpr (requires { typename Members::value_type; })
            for (const auto& member : members) {
                if constexpr (requires { *member.item; }) use_element(*member.item);
                else if constexpr (requires { *member; }) use_element(*member);
            }
    });
}

template <class Element>
void UsedNames::use_element(const Element& item) {
    // What nothing uses is not in the scene, and outputs come last.
    if constexpr (!std::same_as<Element, Output> && !is_there_where_used<Element>) {
        owner_ = owner_of(item);
        visit_references(item, [&](const Referred& referred) { use_references(referred.to, referred.kinds, referred.all_members); });
        use_expressions(item);
    }
}

template <class Element>
void UsedNames::use_expressions(const Element& item) {
    std::vector<std::string> letters;
    if constexpr (std::same_as<Element, Load>)  // its unknowns, which belong to the scene where something else uses them
        for (const Unknown& unknown : item.unknowns) letters.push_back(unknown.name);
    visit(as_used(item, scene_, names_), [&](Site site) {
        site.bound.insert(site.bound.end(), letters.begin(), letters.end());
        use(site);
    });
}

void UsedNames::use_references(const Reference& to, const std::vector<const char*>& kinds, bool all_members) {
    const OfKind found = names_.find_element(to.name, kinds);
    if (!scene_.holds(found.item->when))
        fail(Id::needs_absent, to.span,
             fmt::format("{} needs {} '{}', which scene '{}' leaves out; give it a 'when' of its own", owner_, found.kind->word, to.name,
                         scene_.name),
             {{found.item->span, fmt::format("the {} is defined here", found.kind->word)}});
    if (all_members) use_name(to.name, to.span);
}

void UsedNames::use_outputs() {
    is_output_ = true;
    for (const auto& member : scene_.outputs) {
        owner_ = owner_of(*member.item);
        use_expressions(*member.item);
    }
    is_output_ = false;
}

/// Media that something holds; where the temperature is everywhere the same, what depends on it is not asked for.
void UsedNames::use_media() {
    const auto hold = [&](const Reference& medium, bool is_thermal) {
        media_.insert(medium.name);
        if (is_thermal) scene_.thermal_media.insert(medium.name);
    };
    for (const auto& member : scene_.volumes) {
        const Volume& volume = *member.item;
        hold(volume.medium, scene_.has_temperature(volume, names_) || volume.isothermal || volume.polytropic);
    }
    for (const auto& member : scene_.reservoirs) hold(member.item->medium, member.item->temperature != nullptr);
    for (const auto& member : scene_.junctions) hold(member.item->medium, false);
    for (const Medium& medium : scene_.model->media) {
        if (!media_.contains(medium.name)) continue;
        scene_.media.push_back({&medium});
        owner_ = owner_of(medium);
        Medium used = medium;
        if (!scene_.thermal_media.contains(medium.name) && !is_of_orifice(medium) && medium.law != Medium::Law::given)
            used.isochoric_heat.reset();
        use_expressions(used);
    }
}

/// Whether it flows through a pneumatic orifice, which needs the ratio of specific heats at any temperature.
bool UsedNames::is_of_orifice(const Medium& medium) const {
    const auto comes_from = [&](const auto& members, const Reference& from) {
        return std::any_of(members.begin(), members.end(), [&](const auto& member) {
            return member.item->name == from.name && member.item->medium.name == medium.name;
        });
    };
    return std::any_of(scene_.flows.begin(), scene_.flows.end(), [&](const auto& member) {
        const Reference& from = member.item->from;
        return member.item->law == Flow::Law::pneumatic_orifice &&
               (comes_from(scene_.volumes, from) || comes_from(scene_.reservoirs, from) || comes_from(scene_.junctions, from));
    });
}

/// What is declared and no effect takes out stays, whether or not anything reads it: every state, and parameters and inputs that
/// nothing in the model reads. Those that something reads go where all that reads them is left out.
void UsedNames::use_declared() {
    const Model& model = *scene_.model;
    for (const State& state : model.states)
        if (scene_.holds(state.when)) use_name(state.name, state.span);
    const std::set<std::string> read = names_read(model, names_);
    const auto use_unread = [&](const auto& items) {
        for (const auto& item : items)
            if (!read.contains(item.name) && scene_.holds(item.when)) use_name(item.name, item.span);
    };
    use_unread(model.parameters);
    use_unread(model.inputs);
}

/// Parameters that the runs of this scene need for its inputs.
void UsedNames::use_in_runs() {
    const auto use_parameters = [&](const Expression* expression) {
        if (!expression) return;
        for_each(*expression, [&](const Expression& e) {
            const Named* named = e.kind == Kind::name ? names_.find(e.name) : nullptr;
            const bool is_constant = named != nullptr && (dependence(e, names_) & ~on_parameters) == 0;
            if (is_constant && scene_.holds(named->item->when)) use_name(e.name, e.span);
        });
    };
    if (scene_.model->view) {
        owner_ = owner_of(*scene_.model->view);
        visit(*scene_.model->view, [&](const Site& site) { use_parameters(site.expression); });
    }
    for (const Run& run : scene_.model->runs) {
        if (!run.scene.empty() && run.scene != scene_.base) continue;
        owner_ = owner_of(run);
        for (const ExpressionPtr& e : {run.until, run.period, run.step}) use_parameters(e.get());
        for (const Plot& plot : run.plots)
            for (const std::string& name : plot.y) fields_.tap_plotted(name);
        for (const RunEntry& entry : run.inputs)
            if (used_.contains(entry.variable->name)) use_parameters(entry.value.get());
        for (const RunEntry& entry : run.exact) use_parameters(entry.value.get());
    }
}

void UsedNames::use(const Site& site) {
    const auto holds = [&](const Expression& name) {
        const Named* named = names_.find(name.name);
        return named == nullptr || scene_.holds(named->item->when);
    };
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

void UsedNames::use_solid(const std::string& name) {
    if (!solids_.insert(name).second) return;
    const Solid& solid = *names_.find_element<Solid>(name);
    visit(solid, [&](const Site& site) { use(site); });
    visit_references(solid, [&](const Referred& part) { use_solid(part.to.name); });
}

void UsedNames::use_name(const std::string& name, const Span& span) {
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

}  // namespace dalembert
