// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/names.hpp"

#include <algorithm>
#include <functional>

#include "elements/every_kind.hpp"


namespace dalembert {

const char* describe(Named::Kind kind) {
    switch (kind) {
        case Named::Kind::size: return "a size";
        case Named::Kind::parameter: return "a parameter";
        case Named::Kind::definition: return "a definition";
        case Named::Kind::coordinate: return "a coordinate";
        case Named::Kind::input: return "an input";
        case Named::Kind::state: return "a state";
        case Named::Kind::output: return "an output";
        case Named::Kind::mode: break;
    }
    return "a mode";
}

const char* describe(Part::Kind kind) {
    switch (kind) {
        case Part::Kind::medium: return "a medium";
        case Part::Kind::volume: return "a volume";
        case Part::Kind::reservoir: return "a reservoir";
        case Part::Kind::junction: return "a junction";
        case Part::Kind::flow: return "a flow";
        case Part::Kind::node: return "a node";
        case Part::Kind::link: return "a link";
        case Part::Kind::rod: return "a cell of a rod";
        case Part::Kind::block: return "a cell of a block";
        case Part::Kind::border: return "an end of a rod or side of a block";
        case Part::Kind::enclosure: break;
    }
    return "an enclosure";
}

std::vector<Part::Kind> parts_in(Subscript subscript) {
    using K = Part::Kind;
    switch (subscript) {
        case Subscript::fluid:
        case Subscript::fluid_or_medium: return {K::volume, K::reservoir, K::junction};
        case Subscript::warm: return {K::volume, K::reservoir, K::node, K::rod, K::block};
        case Subscript::medium: return {K::medium};
        case Subscript::volume: return {K::volume};
        case Subscript::optional_store: return {K::volume, K::node};
        case Subscript::heated: return {K::volume, K::node, K::link, K::border};
        case Subscript::flow: return {K::flow};
        case Subscript::surface:
        case Subscript::two_surfaces: return {K::enclosure};
        default: return {};
    }
}

namespace {

bool is_among(const KindSpec& kind, const std::vector<const char*>& kinds) {
    return std::any_of(kinds.begin(), kinds.end(), [&](std::string_view word) { return word == kind.word; });
}

template <class Element>
const Element* find_of(const Names& names, std::string_view name) {
    for (const OfKind& element : names.elements(name))
        if (element.kind == &kind_of<Element>) return static_cast<const Element*>(element.item);
    return nullptr;
}

}  // namespace

const Definition& Named::definition() const { return static_cast<const Definition&>(*item); }

Names::Names(const Model& model) {
    const auto add = [&](const auto& items, Named::Kind kind) {
        for (const auto& item : items) table_.emplace(item.name, Named{kind, &item});
    };
    add(model.sizes, Named::Kind::size);
    add(model.parameters, Named::Kind::parameter);
    add(model.definitions, Named::Kind::definition);
    add(model.coordinates, Named::Kind::coordinate);
    add(model.inputs, Named::Kind::input);
    add(model.states, Named::Kind::state);
    add(model.outputs, Named::Kind::output);
    for (const ModeGroup& group : model.modes) add(group.modes, Named::Kind::mode);
    const auto add_parts = [&](const auto& items, Part::Kind kind) {
        for (const auto& item : items) parts_.emplace(item.name, Part{kind, &item});
    };
    add_parts(model.media, Part::Kind::medium);
    add_parts(model.volumes, Part::Kind::volume);
    add_parts(model.reservoirs, Part::Kind::reservoir);
    add_parts(model.junctions, Part::Kind::junction);
    add_parts(model.flows, Part::Kind::flow);
    add_parts(model.nodes, Part::Kind::node);
    add_parts(model.links, Part::Kind::link);
    add_parts(model.rods, Part::Kind::rod);
    add_parts(model.blocks, Part::Kind::block);
    const auto add_borders = [&](const auto& items, std::initializer_list<const char*> borders) {
        for (const auto& item : items)
            for (const char* border : borders) parts_.emplace(item.name + "." + border, Part{Part::Kind::border, &item});
    };
    add_borders(model.rods, {"first", "last"});
    add_borders(model.blocks, {"left", "right", "bottom", "top"});
    add_parts(model.enclosures, Part::Kind::enclosure);
    for_each_kind(model, [&]<class Items>(const char*, const Items& items) {
        using Element = typename Items::value_type;
        if constexpr (std::derived_from<Element, Item>)
            for (const Element& item : items) elements_[item.name].push_back({&kind_of<Element>, &item});
    });
}

const Named* Names::find(std::string_view name) const {
    const auto found = table_.find(name);
    return found == table_.end() ? nullptr : &found->second;
}

const std::vector<OfKind>& Names::elements(std::string_view name) const {
    static const std::vector<OfKind> none;
    const auto found = elements_.find(name);
    return found == elements_.end() ? none : found->second;
}

OfKind Names::find_element(std::string_view name, const std::vector<const char*>& kinds) const {
    for (const OfKind& element : elements(name))
        if (is_among(*element.kind, kinds)) return element;
    return {nullptr, nullptr};
}

std::vector<std::string> Names::names_of(const std::vector<const char*>& kinds) const {
    std::vector<std::string> names;
    for (const auto& [name, elements] : elements_)
        for (const OfKind& element : elements)
            if (is_among(*element.kind, kinds)) names.push_back(name);
    return names;
}

const Body* Names::find_body(std::string_view name) const { return find_of<Body>(*this, name); }
const Damper* Names::find_damper(std::string_view name) const { return find_of<Damper>(*this, name); }
const Cut* Names::find_cut(std::string_view name) const { return find_of<Cut>(*this, name); }
const Constraint* Names::find_constraint(std::string_view name) const { return find_of<Constraint>(*this, name); }
const Solid* Names::find_solid(std::string_view name) const { return find_of<Solid>(*this, name); }
const Load* Names::find_load(std::string_view name) const { return find_of<Load>(*this, name); }
const Sticking* Names::find_sticking(std::string_view name) const { return find_of<Sticking>(*this, name); }
const Friction* Names::find_friction(std::string_view name) const { return find_of<Friction>(*this, name); }

const Part* Names::find_part(std::string_view name) const {
    const auto found = parts_.find(name);
    return found == parts_.end() ? nullptr : &found->second;
}

std::vector<std::string> Names::parts(const std::vector<Part::Kind>& kinds) const {
    std::vector<std::string> names;
    for (const auto& [name, part] : parts_)
        if (std::find(kinds.begin(), kinds.end(), part.kind) != kinds.end()) names.push_back(name);
    return names;
}

std::vector<std::string> Names::all() const {
    std::vector<std::string> names;
    for (const auto& [name, entry] : table_) names.push_back(name);
    return names;
}

unsigned dependence(const QuantitySpec& quantity) {
    if (quantity.is_property) return on_properties;
    if (quantity.is_place) return on_places;
    if (quantity.is_velocity) return on_places | on_velocities;
    if (quantity.subscript == Subscript::solid || quantity.subscript == Subscript::solid_and_axis ||
        quantity.subscript == Subscript::solid_and_axes)
        return on_parameters;
    return quantity.subscript == Subscript::optional_damper ? on_losses : on_quantities;
}

unsigned derivative_dependence(unsigned depends) {
    unsigned result = depends;
    if ((depends & (on_coordinates | on_places)) != 0) result |= on_velocities;
    if ((depends & (on_velocities | on_states | on_properties | on_losses | on_quantities | on_outputs)) != 0) result |= on_accelerations;
    return result;
}

namespace {

unsigned dependence(const Load& load, const Names& names, std::map<const Definition*, unsigned>& known);

/// Definitions are followed once each: a chain of definitions may mention the same one exponentially often.
unsigned dependence(const Expression& e, const Names& names, std::map<const Definition*, unsigned>& known) {
    using Kind = Expression::Kind;
    if (e.kind == Kind::name) {
        if (e.name == "t") return on_time;
        if (const QuantitySpec* quantity = find_quantity(e.name)) {
            const bool is_of_load = quantity->subscript == Subscript::load_and_axis || quantity->subscript == Subscript::load_and_unknown;
            if (is_of_load) {
                const Load* load = e.children.empty() ? nullptr : names.find_load(e.children[0]->name);
                return load == nullptr ? 0 : dependence(*load, names, known);
            }
            unsigned result = dependence(*quantity);
            for (const ExpressionPtr& child : e.children) result |= dependence(*child, names, known);
            return result;
        }
        const Named* named = names.find(e.name);
        if (named == nullptr) return 0;  // an index, the variable of a law or a letter
        switch (named->kind) {
            case Named::Kind::size: return 0;
            case Named::Kind::parameter: return on_parameters;
            case Named::Kind::coordinate: return on_coordinates;
            case Named::Kind::input: return on_inputs;
            case Named::Kind::state: return on_states;
            case Named::Kind::mode: return on_modes;
            case Named::Kind::output: return on_outputs;
            case Named::Kind::definition: break;
        }
        const Definition& definition = named->definition();
        if (const auto found = known.find(&definition); found != known.end()) return found->second;
        return known[&definition] = dependence(*definition.value, names, known);
    }
    unsigned result = 0;
    for (const ExpressionPtr& child : e.children) result |= dependence(*child, names, known);
    const int order = e.kind != Kind::call ? 0 : e.name == "dot" ? 1 : e.name == "ddot" ? 2 : 0;
    for (int i = 0; i < order; ++i) result = derivative_dependence(result);
    return result;
}

unsigned dependence(const Load& load, const Names& names, std::map<const Definition*, unsigned>& known) {
    // Its own unknowns are letters in it.
    for (const Unknown& unknown : load.unknowns)
        if (const Named* named = names.find(unknown.name); named != nullptr && named->kind == Named::Kind::definition)
            known[&named->definition()] = 0;
    unsigned result = 0;
    visit(load, [&](const Site& site) { result |= dependence(*site.expression, names, known); });
    for (const Unknown& unknown : load.unknowns)
        if (const Named* named = names.find(unknown.name); named != nullptr && named->kind == Named::Kind::definition)
            known[&named->definition()] = result;
    return result;
}

}  // namespace

std::set<std::string> loads_needed(const Load& load, const Names& names) {
    std::set<std::string> loads;
    std::set<const Definition*> seen;
    for (const Unknown& unknown : load.unknowns)
        if (const Named* named = names.find(unknown.name); named != nullptr && named->kind == Named::Kind::definition)
            seen.insert(&named->definition());
    const std::function<void(const Expression&)> collect = [&](const Expression& expression) {
        for_each(expression, [&](const Expression& e) {
            if (e.kind != Expression::Kind::name) return;
            const QuantitySpec* quantity = e.children.empty() ? nullptr : find_quantity(e.name);
            if (quantity != nullptr &&
                (quantity->subscript == Subscript::load_and_axis || quantity->subscript == Subscript::load_and_unknown))
                loads.insert(e.children[0]->name);
            const Named* named = names.find(e.name);
            if (named != nullptr && named->kind == Named::Kind::definition && seen.insert(&named->definition()).second)
                collect(*named->definition().value);
        });
    };
    visit(load, [&](const Site& site) { collect(*site.expression); });
    return loads;
}

unsigned dependence(const Load& load, const Names& names) {
    std::map<const Definition*, unsigned> known;
    return dependence(load, names, known);
}

unsigned dependence(const Expression& e, const Names& names) {
    std::map<const Definition*, unsigned> known;
    return dependence(e, names, known);
}

}  // namespace dalembert
