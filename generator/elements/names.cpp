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

namespace {

bool is_among(const KindSpec& kind, const std::vector<const char*>& kinds) {
    return std::any_of(kinds.begin(), kinds.end(), [&](std::string_view word) { return word == kind.word; });
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
    for_each_kind(model, [&]<class Items>(const char*, const Items& items) {
        using Element = typename Items::value_type;
        if constexpr (std::derived_from<Element, Item>)
            for (const Element& item : items) {
                elements_[item.name].push_back({&kind_of<Element>, &item});
                for (const char* border : kind_of<Element>.facts.borders)
                    if (border != nullptr) elements_[item.name + "." + border].push_back({&border_kind, &item});
            }
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
                const Load* load = e.children.empty() ? nullptr : names.find_element<Load>(e.children[0]->name);
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
