// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/names.hpp"

#include <algorithm>

#include "model/vocabulary.hpp"

namespace dalembert {

const char* describe(Named::Kind kind) {
    switch (kind) {
        case Named::Kind::size: return "a size";
        case Named::Kind::parameter: return "a parameter";
        case Named::Kind::definition: return "a definition";
        case Named::Kind::coordinate: return "a coordinate";
        case Named::Kind::input: return "an input";
        case Named::Kind::state: return "a state";
        case Named::Kind::output: break;
    }
    return "an output";
}

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
    for (const Body& body : model.bodies) bodies_.emplace(body.name, &body);
    const auto add_parts = [&](const auto& items, Part::Kind kind) {
        for (const auto& item : items) parts_.emplace(item.name, Part{kind, &item});
    };
    add_parts(model.media, Part::Kind::medium);
    add_parts(model.volumes, Part::Kind::volume);
    add_parts(model.reservoirs, Part::Kind::reservoir);
    add_parts(model.flows, Part::Kind::flow);
}

const Named* Names::find(std::string_view name) const {
    const auto found = table_.find(name);
    return found == table_.end() ? nullptr : &found->second;
}

const Body* Names::find_body(std::string_view name) const {
    const auto found = bodies_.find(name);
    return found == bodies_.end() ? nullptr : found->second;
}

const Part* Names::find_part(std::string_view name) const {
    const auto found = parts_.find(name);
    return found == parts_.end() ? nullptr : &found->second;
}

std::vector<std::string> Names::parts(std::initializer_list<Part::Kind> kinds) const {
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

unsigned derivative_dependence(unsigned depends) {
    unsigned result = depends;
    if ((depends & on_coordinates) != 0) result |= on_velocities;
    if ((depends & (on_velocities | on_states | on_properties | on_quantities | on_outputs)) != 0) result |= on_accelerations;
    return result;
}

namespace {

/// Definitions are followed once each: a chain of definitions may mention the same one exponentially often.
unsigned dependence(const Expression& e, const Names& names, std::map<const Definition*, unsigned>& known) {
    using Kind = Expression::Kind;
    if (e.kind == Kind::name) {
        if (e.name == "t") return on_time;
        if (const QuantitySpec* quantity = find_quantity(e.name)) {
            unsigned result = quantity->is_property ? on_properties : on_quantities;
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

}  // namespace

unsigned dependence(const Expression& e, const Names& names) {
    std::map<const Definition*, unsigned> known;
    return dependence(e, names, known);
}

}  // namespace dalembert
