// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "elements/element.hpp"
#include "elements/expand_switching.hpp"
#include "elements/fluids.hpp"
#include "elements/heat.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// A volume, reservoir or junction as an expression names it.
ExpressionPtr end_name(const Reference& end) {
    Expression name{Kind::name, end.span, 0, end.name};
    if (end.index) name.children.push_back(end.index);
    return std::make_shared<Expression>(std::move(name));
}

/// A quantity of an end of a flow: "pressure[tank]".
ExpressionPtr of_end(const char* quantity, const Reference& end) {
    return std::make_shared<Expression>(Expression{Kind::name, end.span, 0, quantity, {end_name(end)}});
}

/// The expression with a member of a family in place of its index.
ExpressionPtr with_index(const ExpressionPtr& e, const std::string& index, const ExpressionPtr& member) {
    if (e->kind == Kind::name && e->name == index && e->children.empty()) return member;
    Expression copy = *e;
    for (ExpressionPtr& child : copy.children) child = with_index(child, index, member);
    return std::make_shared<Expression>(std::move(copy));
}

/// The specific potential energy of an end of a flow; null where none is given.
ExpressionPtr potential_of(const Model& model, const Reference& end) {
    const auto in = [&](const auto& items) -> ExpressionPtr {
        for (const auto& item : items) {
            if (item.name != end.name || !item.potential) continue;
            return item.family && end.index ? with_index(item.potential, item.family->index, end.index) : item.potential;
        }
        return nullptr;
    };
    const ExpressionPtr of_volume = in(model.volumes);
    if (of_volume) return of_volume;
    const ExpressionPtr of_junction = in(model.junctions);
    return of_junction ? of_junction : in(model.reservoirs);
}

/// What drives a flow: the difference of the pressures, and of heights.
ExpressionPtr drive(const Model& model, const Flow& flow) {
    const ExpressionPtr pressures = minus(of_end("pressure", flow.from), of_end("pressure", flow.to));
    const ExpressionPtr high = potential_of(model, flow.from), low = potential_of(model, flow.to);
    if (!high && !low) return pressures;
    const ExpressionPtr density = over(plus(of_end("density", flow.from), of_end("density", flow.to)), make_number(2, flow.span));
    const auto weight = [&](const ExpressionPtr& potential) { return times(density, potential); };
    if (!low) return plus(pressures, weight(high));
    return minus(high ? plus(pressures, weight(high)) : pressures, weight(low));
}

/// A check valve of which being open or shut is a mode.
void expand_check_valve(Model& model, const Flow& flow) {
    Element made(model, flow);
    made.modes({"shut", "open"});
    ExpressionPtr excess = drive(model, flow);
    if (flow.cracking_pressure) excess = minus(excess, flow.cracking_pressure);
    made.event("opens", "shut", excess, {"open"}).rises = true;
    made.event("shuts", "open", excess, {"shut"});
}

/// An orifice chokes where the lower pressure is (2/(kappa + 1))^(kappa/(kappa - 1)) of the higher one (3.159).
void expand_orifice(Model& model, const Flow& flow) {
    Element made(model, flow);
    made.modes({"subsonic", "choked", "subsonic_back", "choked_back"});
    const Reference* medium = nullptr;
    const auto find = [&](const auto& items) {
        for (const auto& item : items)
            if (item.name == flow.from.name) medium = &item.medium;
    };
    find(model.volumes);
    find(model.reservoirs);
    if (medium == nullptr) return;  // reported where ends are looked up
    const auto one_way = [&](const Reference& up, const Reference& down, const std::string& ending, const std::string& other) {
        const auto heat = [&](const char* quantity) {
            return std::make_shared<Expression>(Expression{
                Kind::name, up.span, 0, quantity, {make_name(medium->name, up.span), of_end("pressure", up), of_end("temperature", up)}});
        };
        const auto number = [&](int n) { return make_number(n, up.span); };
        const ExpressionPtr kappa = over(heat("isobaric_heat"), heat("isochoric_heat"));
        const ExpressionPtr ratio = make_binary(Kind::power, over(number(2), plus(kappa, number(1))), over(kappa, minus(kappa, number(1))));
        const ExpressionPtr critical = times(of_end("pressure", up), ratio);
        made.event("chokes" + ending, "subsonic" + ending, minus(of_end("pressure", down), critical), {"choked" + ending});
        made.event("unchokes" + ending, "choked" + ending, minus(critical, of_end("pressure", down)), {"subsonic" + ending});
        made.event("reverses" + ending, "subsonic" + ending, minus(of_end("pressure", up), of_end("pressure", down)), {"subsonic" + other});
    };
    one_way(flow.from, flow.to, "", "_back");
    one_way(flow.to, flow.from, "_back", "");
}

/// A volume that runs empty stays so until more flows in than flows out. What is integrated as its root does not come back from zero.
void expand(Model& model, const Volume& volume) {
    if (!volume.filling) return;  // reported where it was read
    Element made(model, volume);
    made.modes({"filled", "empty"}, "empty");
    made.event("runs_empty", "filled", volume.filling, {"empty"}).reset = {{volume.filling, make_number(0, volume.span), volume.span}};
    Condition fed{Condition::Kind::disjunction, volume.span, {}, {}};
    for (const Flow& flow : model.flows)
        if (flow.to.name == volume.name) fed.parts.push_back(flow.when.value_or(made.in_either("filled", "empty")));
    if (fed.parts.empty()) return;
    Event& fills = made.event("fills", "empty", made.own("surplus"), {"filled"});
    fills.rises = true;
    fills.when = Condition{Condition::Kind::conjunction, volume.span, {}, {*fills.when, fed}};
    const auto state =
        std::find_if(model.states.begin(), model.states.end(), [&](const State& s) { return s.name == volume.filling->name; });
    if (state == model.states.end() || !state->root) return;
    fills.next.clear();
    fills.ends = fills.is_limit = true;
    fills.doc = "more flows into volume '" + volume.name +
                "' than out of it, which is empty: what is integrated as its root does not rise from zero";
}

/// Whether an expression is zero where a name is, told by zeros that are factors and sums of zeros.
bool vanishes_with(const Expression& e, const std::string& name, const Model& model, int depth = 0) {
    constexpr int deepest = 500;  // definitions may still need themselves
    if (depth > deepest) return false;
    const auto child = [&](std::size_t i) { return vanishes_with(*e.children[i], name, model, depth + 1); };
    switch (e.kind) {
        case Kind::number: return cln::zerop(e.value);
        case Kind::name: {
            if (e.name == name) return true;
            const auto found =
                std::find_if(model.definitions.begin(), model.definitions.end(), [&](const Definition& d) { return d.name == e.name; });
            return found != model.definitions.end() && found->value && vanishes_with(*found->value, name, model, depth + 1);
        }
        case Kind::add:
        case Kind::subtract: return child(0) && child(1);
        case Kind::multiply: return child(0) || child(1);
        case Kind::divide:
        case Kind::negate: return child(0);
        default: return false;
    }
}

/// At the boiling temperature heat makes steam instead of warmth, until nothing is left.
void expand(Model& model, const HeatNode& node) {
    if (!node.temperature || !node.capacity || !node.boiling->temperature || !node.boiling->mass) return;
    const Boiling& boiling = *node.boiling;
    Element made(model, node);
    const bool leaves_nothing = vanishes_with(*node.capacity->body, boiling.mass->name, model);
    made.modes(leaves_nothing ? std::vector<std::string>{"liquid", "boiling"} : std::vector<std::string>{"liquid", "boiling", "dry"},
               "dry");
    made.event("boils", "liquid", minus(boiling.temperature, node.temperature), {"boiling"}).reset = {
        {node.temperature, boiling.temperature, boiling.temperature->span}};
    made.event("cools", "boiling", made.own("heat"), {"liquid"});
    Event& runs_dry = made.event("runs_dry", "boiling", boiling.mass, {});
    runs_dry.ends = leaves_nothing;
    if (leaves_nothing) {
        runs_dry.doc = "nothing is left of node '" + node.name + "' that could store heat";
        return;
    }
    runs_dry.next = {made.to("dry")};
    runs_dry.reset = {{boiling.mass, make_number(0, node.span), node.span}};
}

}  // namespace

void expand_balances(Model& model) {
    for (const Flow& flow : model.flows)
        if (flow.switches) (flow.law == Flow::Law::check_valve ? expand_check_valve : expand_orifice)(model, flow);
    for (const Volume& volume : model.volumes)
        if (volume.empties) expand(model, volume);
    for (const HeatNode& node : model.nodes)
        if (node.boiling) expand(model, node);
}

}  // namespace dalembert
