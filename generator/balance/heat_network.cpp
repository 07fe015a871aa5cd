// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/heat_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "balance/block.hpp"
#include "balance/enclosure.hpp"
#include "balance/field.hpp"
#include "balance/rod.hpp"
#include "balance/sought_temperatures.hpp"
#include "elements/conduction.hpp"
#include "elements/heat.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/heat_formulas.hpp"
#include "symbolic/integrate.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::pow;

namespace {

/// The law in a letter for the temperature.
ex law_of(const Property& property, const ex& temperature, const Translator& translate, const Indices& indices) {
    if (property.variables.empty()) return translate(property.body, indices);
    return translate(*property.body, indices, {{property.variables[0], temperature}});
}

/// The integral of a law over the temperature, from anywhere.
ex primitive(const Property& property, const ex& letter, const Translator& translate, const Indices& indices) {
    const ex law = law_of(property, letter, translate, indices);
    for (const ex& form : {law, law.expand()})
        if (const auto found = integrate(form, GiNaC::ex_to<GiNaC::symbol>(letter))) return *found;
    throw Failure(Diagnostic{
        Id::cannot_integrate, property.span,
        fmt::format("'{}' has an integral over '{}' that the program cannot find", property.body->written(), property.variables[0])});
}

ex at(const ex& law, const ex& letter, const ex& temperature) { return law.subs(letter == temperature, GiNaC::subs_options::no_pattern); }

/// Differences of two temperatures are kept whole, because the two are often close; where one is sought they must come apart.
ex difference(const Warmth& a, const Warmth& b) {
    const ex d = (a.temperature - b.temperature).expand();
    return a.is_sought || b.is_sought ? d : whole(d);
}

class Linking {
public:
    Linking(HeatNetwork& network, const Scene& scene, const Translator& translate, Symbols& symbols, const Containers& containers)
        : network_(network), scene_(scene), translate_(translate), symbols_(symbols), containers_(containers) {}

    void add(const Member<Link>& member) {
        const Link& item = *member.item;
        indices_ = Translator::indices_of(member);
        LinkState link{member.name(), item.span, {}, {}, 0};
        const Warmth a = end(item.from, link.from);
        const Warmth b = end(item.to, link.to);
        if (link.from.node == link.to.node && link.from.volume == link.to.volume && link.from.reservoir == link.to.reservoir)
            throw Failure(Diagnostic{Id::not_allowed_here, item.to.span,
                                     fmt::format("link '{}' goes from '{}' to itself", link.name, std::string(item.to.span.text()))});
        link.heat = heat(item, a, b);
        link.radiates = item.law == Link::Law::radiation;
        network_.links.push_back(std::move(link));
    }

private:
    ex value(const ExpressionPtr& e) const { return translate_(e, indices_); }

    ex resistance(const Link& item) const {
        const ex found = value(item.resistance);
        if (!found.is_zero()) return found;
        throw Failure(Diagnostic{
            Id::value_out_of_range, item.span,
            fmt::format("the resistance of link '{}' is zero; join the two places in one node, or give a small resistance", item.name)});
    }

    ex heat(const Link& item, const Warmth& a, const Warmth& b) const {
        switch (item.law) {
            case Link::Law::given: return value(item.heat);
            case Link::Law::linear:
                return exchange(item.conductance ? value(item.conductance) : 1 / resistance(item), a, b);
            case Link::Law::conduction:
                return conduct(*item.conductivity, value(item.area) / value(item.length), a, b, translate_, symbols_, indices_);
            case Link::Law::convection: return exchange(value(item.coefficient) * value(item.area), a, b);
            case Link::Law::radiation: break;
        }
        return radiate(value(item.emissivity) * value(item.area), a, b);
    }

    Warmth end(const Reference& reference, LinkEnd& link_end) const {
        const int index = reference.index ? index_value(*reference.index, scene_, indices_) : 0;
        const std::string name = reference.index ? fmt::format("{}[{}]", reference.name, index) : reference.name;
        if (const NodeState* node = network_.find_node(name)) {
            link_end.node = node;
            return node->warmth;
        }
        link_end.volume = containers_.find_volume(reference.name, index);
        link_end.reservoir = containers_.find_reservoir(reference.name, index);
        if (link_end.volume == nullptr && link_end.reservoir == nullptr)
            throw Failure(Diagnostic{Id::index_out_of_range, reference.span, fmt::format("the scene has no '{}'", name)});
        const FluidState& fluid = link_end.volume != nullptr ? link_end.volume->fluid : link_end.reservoir->fluid;
        if (!fluid.temperature)
            throw Failure(
                Diagnostic{Id::needs_absent, reference.span, fmt::format("scene '{}' gives '{}' no temperature", scene_.name, name)});
        return warmth_of(*fluid.temperature);
    }

    HeatNetwork& network_;
    const Scene& scene_;
    const Translator& translate_;
    Symbols& symbols_;
    const Containers& containers_;
    Indices indices_;
};

BoilingState boiling_of(const HeatNode& item, const NodeState& node, const Scene& scene, const Translator& translate,
                        const Symbols& symbols) {
    const Expression& named = *item.boiling->mass;
    const Variable* mass = symbols.find(SymbolKind::state, named.name, 0);
    if (mass == nullptr)
        throw Failure(Diagnostic{Id::needs_absent, named.span, fmt::format("scene '{}' has no state '{}'", scene.name, named.written())});
    for (const Variable& state : symbols.all(SymbolKind::state)) {
        const bool may_depend = state.position == mass->position || (state.position == *node.state && !item.capacity->variables.empty());
        if (!may_depend && node.capacity.has(state.symbol))
            throw Failure(Diagnostic{
                Id::not_allowed_here, item.capacity->span,
                fmt::format("the capacity of node '{}' may depend on its mass '{}' and on no other state, but it depends on '{}'{}",
                            item.name, mass->name, state.name,
                            state.position == *node.state ? "; write a function of the temperature as a law, \"T -> ...\"" : "")});
    }
    return {mass->position, translate(item.boiling->enthalpy, {}), scene.modes[*scene.mode].is_in(item.name + "_boiling")};
}

NodeState node_of(const Member<HeatNode>& member, const Scene& scene, const Translator& translate, Symbols& symbols) {
    const HeatNode& item = *member.item;
    const Indices indices = Translator::indices_of(member);
    NodeState node{NodeState::Kind::held, member.name(), &item, item.temperature ? item.temperature->span : item.span, {}, {}};
    node.warmth = warmth_of(translate(item.temperature, indices));
    if (item.is_held()) return node;
    node.kind = NodeState::Kind::storing;
    const Expression& named = *item.temperature;
    const int index = named.children.empty() ? 0 : index_value(*named.children[0], scene, indices);
    const Variable* state = symbols.find(SymbolKind::state, named.name, index);
    if (state == nullptr)
        throw Failure(Diagnostic{Id::index_out_of_range, named.span, fmt::format("the scene has no state '{}'", named.written())});
    node.state = state->position;
    store(node, *item.capacity, 1, translate, symbols, indices);
    if (item.boiling) node.boiling = boiling_of(item, node, scene, translate, symbols);
    return node;
}

}  // namespace

Warmth warmth_of(const ex& temperature) { return {temperature, pow(temperature, 4), false}; }

ex exchange(const ex& factor, const Warmth& a, const Warmth& b) { return factor * difference(a, b); }

ex radiate(const ex& area, const Warmth& a, const Warmth& b) {
    const ex factor = area * GiNaC::numeric(stefan_boltzmann());
    if (a.is_sought || b.is_sought) return factor * (a.fourth - b.fourth);
    return factor * fourth_power_difference(a.temperature, b.temperature);
}

ex taken_up(const Warmth& surface, const ex& size, const ExpressionPtr& coefficient, const ExpressionPtr& emissivity,
            const ExpressionPtr& ambient, const Translator& translate) {
    const Warmth around = warmth_of(translate(ambient, {}));
    ex heat = 0;
    if (coefficient) heat += exchange(translate(coefficient, {}) * size, around, surface);
    if (emissivity) heat += radiate(translate(emissivity, {}) * size, around, surface);
    return heat;
}

ex conduct(const Property& conductivity, const ex& shape, const Warmth& a, const Warmth& b, const Translator& translate, Symbols& symbols,
           const Indices& indices) {
    if (conductivity.variables.empty()) return exchange(translate(conductivity.body, indices) * shape, a, b);
    const ex letter = symbols.letter(conductivity.variables[0]);
    const ex integral = primitive(conductivity, letter, translate, indices);
    return shape * (at(integral, letter, a.temperature) - at(integral, letter, b.temperature));
}

void store(NodeState& node, const Property& capacity, const ex& amount, const Translator& translate, Symbols& symbols,
           const Indices& indices) {
    node.capacity = amount * law_of(capacity, node.warmth.temperature, translate, indices);
    if (capacity.variables.empty()) {
        node.stored_energy = node.capacity * node.warmth.temperature;
        return;
    }
    const ex letter = symbols.letter(capacity.variables[0]);
    node.stored_energy = amount * at(primitive(capacity, letter, translate, indices), letter, node.warmth.temperature);
}

NodeState& add_sought(HeatNetwork& network, std::string name, const Item& item, const Span& place, Symbols& symbols) {
    const Warmth warmth{symbols.letter("temperature[" + name + "]"), symbols.letter("temperature[" + name + "]^4"), true};
    NodeState& node = network.nodes.emplace_back(NodeState{NodeState::Kind::sought, std::move(name), &item, place, warmth, {}});
    node.letter = warmth.temperature;
    node.fourth_letter = warmth.fourth;
    return node;
}

void add_link(HeatNetwork& network, const Item& item, const NodeState& a, const NodeState& b, const ex& heat) {
    LinkState link{fmt::format("between {} and {}", a.name, b.name), item.span, {}, {}, heat};
    link.from.node = &a;
    link.to.node = &b;
    network.links.push_back(std::move(link));
}

const NodeState* HeatNetwork::find_node(const std::string& name) const {
    const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const NodeState& n) { return n.name == name; });
    return found == nodes.end() ? nullptr : &*found;
}

const LinkState* HeatNetwork::find_link(const std::string& name) const {
    const auto found = std::find_if(links.begin(), links.end(), [&](const LinkState& l) { return l.name == name; });
    return found == links.end() ? nullptr : &*found;
}

const BorderState* HeatNetwork::find_border(const std::string& name) const {
    const auto found = std::find_if(borders.begin(), borders.end(), [&](const BorderState& b) { return b.name == name; });
    return found == borders.end() ? nullptr : &*found;
}

ex HeatNetwork::heat_into(const NodeState& node) const {
    GiNaC::exvector terms{node.source};
    for (const LinkState& link : links) {
        if (link.from.node == &node) terms.push_back(-link.heat);
        if (link.to.node == &node) terms.push_back(link.heat);
    }
    return GiNaC::add(terms);
}

ex HeatNetwork::heat_into(const ControlVolume& volume) const {
    GiNaC::exvector terms;
    for (const LinkState& link : links) {
        if (link.from.volume == &volume) terms.push_back(-link.heat);
        if (link.to.volume == &volume) terms.push_back(link.heat);
    }
    return GiNaC::add(terms);
}

ex HeatNetwork::steam_power(const NodeState& node, const Symbols& symbols) const {
    if (!node.boiling) return 0;
    return steam(node) * (node.boiling->enthalpy + partial(node.stored_energy, symbols.get(SymbolKind::state, node.boiling->mass)));
}

/// What is held takes and gives as it must. Volumes are outside of the network: the heat into them counts with theirs.
ex HeatNetwork::power_over_border(const Symbols& symbols) const {
    GiNaC::exvector terms;
    for (const NodeState& node : nodes) {
        if (node.kind != NodeState::Kind::held) terms.push_back(node.source);
        terms.push_back(-steam_power(node, symbols));
    }
    const auto is_outside = [](const LinkEnd& end) { return end.node != nullptr ? end.node->kind == NodeState::Kind::held : true; };
    for (const LinkState& link : links) {
        if (is_outside(link.from)) terms.push_back(link.heat);
        if (is_outside(link.to)) terms.push_back(-link.heat);
    }
    return GiNaC::add(terms);
}

std::vector<std::vector<std::size_t>> HeatNetwork::floating_parts() const {
    // Parts by the first node in them; a part that touches the outside is none.
    std::map<const NodeState*, const NodeState*> part;
    std::set<const NodeState*> anchored;
    for (const NodeState& node : nodes) {
        part[&node] = &node;
        if (node.kind == NodeState::Kind::held || node.is_surface ||
            (node.state && !partial(node.source, node.warmth.temperature).is_zero()))
            anchored.insert(&node);
    }
    const auto root = [&](const NodeState* node) {
        while (part[node] != node) node = part[node];
        return node;
    };
    for (const LinkState& link : links) {
        const NodeState *a = link.from.node, *b = link.to.node;
        if (a != nullptr && b != nullptr) part[root(b)] = root(a);
        else if (a != nullptr) anchored.insert(a);
        else if (b != nullptr) anchored.insert(b);
    }
    std::set<const NodeState*> fixed;
    for (const NodeState* node : anchored) fixed.insert(root(node));
    std::map<const NodeState*, std::vector<std::size_t>> found;
    for (const NodeState& node : nodes)
        if (node.state && !fixed.contains(root(&node))) found[root(&node)].push_back(*node.state);
    std::vector<std::vector<std::size_t>> result;
    for (const NodeState& node : nodes)
        if (const auto one = found.find(&node); one != found.end()) result.push_back(one->second);
    return result;
}

HeatNetwork make_nodes(const Scene& scene, const Translator& translate, Symbols& symbols) {
    HeatNetwork network;
    for (const auto& member : scene.nodes) {
        const bool is_sought = !member.item->is_held() && !scene.has_capacity(*member.item, translate.names());
        if (is_sought && member.item->boiling)
            throw Failure(Diagnostic{
                Id::needs_absent, member.item->span,
                fmt::format("node '{}' boils, but scene '{}' leaves out the state of its temperature", member.item->name, scene.name)});
        if (is_sought) add_sought(network, member.name(), *member.item, member.item->span, symbols);
        else network.nodes.push_back(node_of(member, scene, translate, symbols));
    }
    for (const auto& member : scene.rods) add_rod(network, *member.item, scene, translate, symbols);
    for (const auto& member : scene.blocks) add_block(network, *member.item, scene, translate, symbols);
    return network;
}

void complete_heat(HeatNetwork& network, const Scene& scene, const Translator& translate, Symbols& symbols, const Containers& containers) {
    for (const auto& member : scene.nodes)
        if (member.item->heat)
            for (NodeState& node : network.nodes)
                if (node.name == member.name()) node.source += translate(member.item->heat, Translator::indices_of(member));
    Linking linking(network, scene, translate, symbols, containers);
    for (const auto& member : scene.links) linking.add(member);
    for (const auto& member : scene.enclosures) add_enclosure(network, *member.item, scene, translate, symbols);
    find_sought_temperatures(network);
    for (BorderState& border : network.borders) border.heat = border.heat.subs(network.solved, GiNaC::subs_options::no_pattern);
    for (const NodeState& node : network.nodes)
        if (!node.is_tapped) network.stored_energy += node.stored_energy;
    network.exchanged_power = network.power_over_border(symbols);
}

}  // namespace dalembert
