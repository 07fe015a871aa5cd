// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/read_switching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "text/nearest.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

void needs_one(const Entry& e, const char* what, const char* a, const char* b) {
    if (e.has(a) == e.has(b)) e.error(Id::missing_key, e.span(), fmt::format("{} '{}' needs either a {} or a {}, and not both", what, e.name(), a, b));
}

/// Makes the parts of one element, at the place of that element.
class Element {
public:
    Element(Model& model, const Item& item) : model_(model), item_(item) {}

    std::string part(const std::string& name) const { return item_.name + "_" + name; }

    /// "brake_sticks and thermal": in a mode of the element, where the element is there.
    Condition in(const std::string& mode) const {
        Condition here{Condition::Kind::effect, item_.span, part(mode), {}};
        return item_.when ? Condition{Condition::Kind::conjunction, item_.span, {}, {*item_.when, here}} : here;
    }
    Condition in_either(const std::string& one, const std::string& other) const { return {Condition::Kind::disjunction, item_.span, {}, {in(one), in(other)}}; }
    Condition to(const std::string& mode) const { return {Condition::Kind::effect, item_.span, part(mode), {}}; }

    void modes(const std::vector<std::string>& names) {
        ModeGroup group;
        fill(group, item_.name);
        for (const std::string& name : names) {
            Mode mode;
            fill(mode, part(name));
            group.modes.push_back(std::move(mode));
        }
        model_.modes.push_back(std::move(group));
    }

    template <class T>
    T make(const std::string& name, const std::optional<Condition>& when) const {
        T result;
        fill(result, name);
        result.when = when;
        return result;
    }

    Event& event(const std::string& name, const std::string& mode, ExpressionPtr guard, const std::vector<std::string>& next) {
        Event event = make<Event>(part(name), in(mode));
        event.guard = std::move(guard);
        for (const std::string& to_mode : next) event.next.push_back(to(to_mode));
        model_.events.push_back(std::move(event));
        return model_.events.back();
    }

    ExpressionPtr name(const std::string& text) const { return make_name(text, item_.span); }
    /// constraint_force[NAME]
    ExpressionPtr force() const { return std::make_shared<Expression>(Expression{Kind::name, item_.span, 0, "constraint_force", {name(item_.name)}}); }
    Reference itself() const { return {item_.name, nullptr, item_.span}; }

private:
    void fill(Item& made, const std::string& name) const {
        made.name = name;
        made.span = item_.span;
        made.doc = item_.doc;
        made.when = item_.when;
    }

    Model& model_;
    const Item& item_;
};

ExpressionPtr times(ExpressionPtr a, ExpressionPtr b) { return make_binary(Kind::multiply, std::move(a), std::move(b)); }
ExpressionPtr plus(ExpressionPtr a, ExpressionPtr b) { return make_binary(Kind::add, std::move(a), std::move(b)); }
ExpressionPtr minus(ExpressionPtr a, ExpressionPtr b) { return make_binary(Kind::subtract, std::move(a), std::move(b)); }
ExpressionPtr negative(const ExpressionPtr& a) { return std::make_shared<Expression>(Expression{Kind::negate, a->span, 0, {}, {a}}); }
ExpressionPtr rate_of(const ExpressionPtr& a) { return std::make_shared<Expression>(Expression{Kind::call, a->span, 0, "dot", {a}}); }

/// A volume or reservoir as an expression names it.
ExpressionPtr end_name(const Reference& end) {
    Expression name{Kind::name, end.span, 0, end.name};
    if (end.index) name.children.push_back(end.index);
    return std::make_shared<Expression>(std::move(name));
}

/// Whether an expression, or a definition that it mentions, names anything but parameters. Nothing is checked yet, not even that
/// definitions do not need themselves.
bool mentions_what_moves(const Expression& e, const Model& model, std::set<std::string>& followed) {
    bool moves = false;
    for_each(e, [&](const Expression& part) {
        if (part.kind != Kind::name || part.name == "pi" || !followed.insert(part.name).second) return;
        const auto is_it = [&](const auto& item) { return item.name == part.name; };
        const auto definition = std::find_if(model.definitions.begin(), model.definitions.end(), is_it);
        if (definition != model.definitions.end()) moves = moves || (definition->value && mentions_what_moves(*definition->value, model, followed));
        else moves = moves || (std::none_of(model.parameters.begin(), model.parameters.end(), is_it) && std::none_of(model.sizes.begin(), model.sizes.end(), is_it));
    });
    return moves;
}

/// Sticks while |force| <= static_coefficient*normal_force; slides either way against coefficient*normal_force.
void expand(Model& model, const Friction& friction, bool may_part) {
    if (!friction.rate || !friction.normal_force || !friction.coefficient) return;  // reported where it was read
    Element made(model, friction);
    made.modes({"sticks", "slides_forwards", "slides_backwards"});
    const ExpressionPtr sliding = times(friction.coefficient, friction.normal_force);
    const ExpressionPtr holding = times(friction.static_coefficient ? friction.static_coefficient : friction.coefficient, friction.normal_force);

    Constraint sticks = made.make<Constraint>(friction.name, made.in("sticks"));
    sticks.rate = friction.rate;
    sticks.elsewhere = minus(times(made.name(made.part("slides_backwards")), sliding), times(made.name(made.part("slides_forwards")), sliding));
    model.constraints.push_back(std::move(sticks));
    const auto slides = [&](const char* mode, const ExpressionPtr& force) {
        Damper damper = made.make<Damper>(made.part(mode), made.in(mode));
        damper.rate = friction.rate;
        damper.force = Law{"rate", force, friction.span};
        model.dampers.push_back(std::move(damper));
    };
    slides("slides_forwards", sliding);
    slides("slides_backwards", negative(sliding));

    // Where it begins to slide forwards, friction acts backwards with all it has.
    made.event("breaks_forwards", "sticks", plus(holding, made.force()), {"slides_forwards"});
    made.event("breaks_backwards", "sticks", minus(holding, made.force()), {"slides_backwards"});
    made.event("stops_forwards", "slides_forwards", friction.rate, {"sticks", "slides_backwards", "slides_forwards"}).meets = made.itself();
    made.event("stops_backwards", "slides_backwards", negative(friction.rate), {"sticks", "slides_forwards", "slides_backwards"}).meets = made.itself();
    if (!may_part) return;
    Event parts = made.make<Event>(made.part("parts"), friction.when);
    parts.doc = "the surfaces of friction '" + friction.name + "' are pulled apart: its normal force becomes negative";
    parts.guard = friction.normal_force;
    parts.ends = parts.is_limit = true;
    model.events.push_back(std::move(parts));
}

void expand(Model& model, const Stop& stop) {
    if (!stop.gap) return;
    Element made(model, stop);
    made.modes({"open", "closed"});
    Constraint closed = made.make<Constraint>(stop.name, made.in("closed"));
    closed.position = stop.gap;
    model.constraints.push_back(std::move(closed));
    Event& hits = made.event("hits", "open", stop.gap, {"closed", "open"});
    hits.meets = made.itself();
    hits.restitution = stop.restitution;
    hits.rest = {made.to("closed")};
    made.event("opens", "closed", made.force(), {"open"});
}

/// One side of a contact: the spring, the damper and the events between its modes and "slack". The other side has names with an ending.
void expand_side(Model& model, const Contact& contact, Element& made, const ExpressionPtr& elongation, const std::string& ending) {
    const std::string taut = "taut" + ending, released = "released" + ending;
    Spring spring = made.make<Spring>(contact.name + ending, contact.damping ? made.in_either(taut, released) : made.in(taut));
    spring.elongation = elongation;
    spring.stiffness = contact.stiffness;
    model.springs.push_back(std::move(spring));
    if (!contact.damping) {
        made.event("tightens" + ending, "slack", elongation, {taut}).rises = true;
        made.event("slackens" + ending, taut, elongation, {"slack"});
        return;
    }
    Damper damper = made.make<Damper>(contact.name + ending, made.in(taut));
    damper.rate = rate_of(elongation);
    damper.coefficient = contact.damping;
    model.dampers.push_back(std::move(damper));
    // What is let go faster than its damper follows is stretched still, but pulls no more: the damper takes what the spring gives.
    Damper swallows = made.make<Damper>(made.part("takes_up" + ending), made.in(released));
    swallows.rate = rate_of(elongation);
    swallows.force = Law{"rate", negative(times(contact.stiffness, elongation)), contact.span};
    model.dampers.push_back(std::move(swallows));
    const ExpressionPtr pull = plus(times(contact.stiffness, elongation), times(contact.damping, rate_of(elongation)));
    made.event("tightens" + ending, "slack", elongation, {taut, released}).rises = true;
    made.event("slackens" + ending, taut, elongation, {"slack", released});
    made.event("releases" + ending, taut, pull, {released, "slack"});
    made.event("pulls_again" + ending, released, pull, {taut}).rises = true;
    made.event("relaxes" + ending, released, elongation, {"slack"});
}

void expand(Model& model, const Contact& contact) {
    if (!contact.elongation || !contact.stiffness) return;
    Element made(model, contact);
    std::vector<std::string> modes{"slack", "taut"};
    if (contact.damping) modes.emplace_back("released");
    if (contact.play) modes.emplace_back("taut_back");
    if (contact.play && contact.damping) modes.emplace_back("released_back");
    made.modes(modes);
    if (!contact.play) return expand_side(model, contact, made, contact.elongation, "");
    const ExpressionPtr half = make_binary(Kind::divide, contact.play, make_number(2, contact.span));
    expand_side(model, contact, made, minus(contact.elongation, half), "");
    expand_side(model, contact, made, minus(negative(contact.elongation), half), "_back");
}

void expand(Model& model, const Saturation& saturation) {
    if (!saturation.value || !saturation.low || !saturation.high) return;
    Element made(model, saturation);
    made.modes({"within", "below", "above"});
    Definition limited = made.make<Definition>(saturation.name, saturation.when);
    const auto part = [&](const char* mode, const ExpressionPtr& value) { return times(made.name(made.part(mode)), value); };
    limited.value = plus(plus(part("below", saturation.low), part("within", saturation.value)), part("above", saturation.high));
    model.definitions.push_back(std::move(limited));
    made.event("leaves_below", "within", minus(saturation.value, saturation.low), {"below"});
    made.event("leaves_above", "within", minus(saturation.high, saturation.value), {"above"});
    made.event("returns_from_below", "below", minus(saturation.low, saturation.value), {"within", "above"});
    made.event("returns_from_above", "above", minus(saturation.value, saturation.high), {"within", "below"});
}

/// A quantity of an end of a flow: "pressure[tank]".
ExpressionPtr of_end(const char* quantity, const Reference& end) { return std::make_shared<Expression>(Expression{Kind::name, end.span, 0, quantity, {end_name(end)}}); }

/// A check valve of which being open or shut is a mode.
void expand_check_valve(Model& model, const Flow& flow) {
    Element made(model, flow);
    made.modes({"shut", "open"});
    ExpressionPtr excess = minus(of_end("pressure", flow.from), of_end("pressure", flow.to));
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
            return std::make_shared<Expression>(Expression{Kind::name, up.span, 0, quantity, {make_name(medium->name, up.span), of_end("pressure", up), of_end("temperature", up)}});
        };
        const auto number = [&](int n) { return make_number(n, up.span); };
        const ExpressionPtr kappa = make_binary(Kind::divide, heat("isobaric_heat"), heat("isochoric_heat"));
        const ExpressionPtr ratio = make_binary(Kind::power, make_binary(Kind::divide, number(2), plus(kappa, number(1))), make_binary(Kind::divide, kappa, minus(kappa, number(1))));
        const ExpressionPtr critical = times(of_end("pressure", up), ratio);
        made.event("chokes" + ending, "subsonic" + ending, minus(of_end("pressure", down), critical), {"choked" + ending});
        made.event("unchokes" + ending, "choked" + ending, minus(critical, of_end("pressure", down)), {"subsonic" + ending});
        made.event("reverses" + ending, "subsonic" + ending, minus(of_end("pressure", up), of_end("pressure", down)), {"subsonic" + other});
    };
    one_way(flow.from, flow.to, "", "_back");
    one_way(flow.to, flow.from, "_back", "");
}

}  // namespace

void read(const Entry& e, ModeGroup& group) {
    const auto final = e.names("final");
    for (const auto& [name, span] : e.names("modes")) {
        Mode mode;
        mode.name = name;
        mode.span = span;
        mode.when = group.when;
        mode.is_final = std::any_of(final.begin(), final.end(), [&, wanted = name](const auto& f) { return f.first == wanted; });
        group.modes.push_back(std::move(mode));
    }
    if (group.modes.size() < 2) e.error(Id::wrong_modes, e.span(), fmt::format("'{}' has {}; modes are at least two, of which one holds", e.name(), group.modes.empty() ? "no mode" : "one mode"));
    std::vector<std::string> known;
    for (const Mode& mode : group.modes) known.push_back(mode.name);
    for (const auto& [name, span] : final)
        if (std::find(known.begin(), known.end(), name) == known.end()) e.error(Id::unknown_name, span, fmt::format("'{}' is no mode of '{}'; its modes are {}", name, e.name(), quoted_list(known)));
}

void read(const Entry& e, Constraint& constraint) {
    constraint.rate = e.expression("rate");
    constraint.position = e.expression("position");
    needs_one(e, "constraint", "rate", "position");
}

void read(const Entry& e, Event& event) {
    event.guard = e.expression("guard");
    const std::string direction = e.text("direction");
    event.rises = direction == "rising";
    if (!direction.empty() && direction != "rising" && direction != "falling")
        e.error(Id::wrong_type, e.span_of("direction"), fmt::format("the direction is 'falling' or 'rising', not '{}'", direction));
    event.ends = e.boolean("ends");
    event.reset = e.by_name("reset");
    event.meets = e.constraint("meets");
    event.restitution = e.expression("restitution");
    event.next = e.conditions("next");
    event.rest = e.conditions("rest");
    event.rest_reset = e.by_name("rest_reset");
    if (event.ends && (e.has("next") || e.has("reset") || e.has("rest") || e.has("meets")))
        e.error(Id::wrong_modes, e.span_of("ends"), fmt::format("event '{}' ends the run, so that nothing follows it", e.name()));
    if (e.has("restitution") && !e.has("meets")) e.error(Id::missing_key, e.span_of("restitution"), fmt::format("event '{}' has a restitution, but meets no constraint", e.name()));
    if (e.has("rest_reset") && !e.has("rest")) e.error(Id::missing_key, e.span_of("rest_reset"), fmt::format("event '{}' says what is reset at rest, but not to which mode that leads: it needs 'rest'", e.name()));
}

void read(const Entry& e, Friction& friction) {
    friction.rate = e.expression("rate");
    friction.normal_force = e.expression("normal_force");
    friction.coefficient = e.expression("coefficient");
    friction.static_coefficient = e.expression("static_coefficient");
}

void read(const Entry& e, Stop& stop) {
    stop.gap = e.expression("gap");
    stop.restitution = e.expression("restitution");
}

void read(const Entry& e, Contact& contact) {
    contact.elongation = e.expression("elongation");
    contact.stiffness = e.expression("stiffness");
    contact.damping = e.expression("damping");
    contact.play = e.expression("play");
}

void read(const Entry& e, Saturation& saturation) {
    saturation.value = e.expression("value");
    saturation.low = e.expression("low");
    saturation.high = e.expression("high");
}

void expand_switching(Model& model) {
    for (const Friction& friction : model.frictions) {
        std::set<std::string> followed;
        expand(model, friction, friction.normal_force && mentions_what_moves(*friction.normal_force, model, followed));
    }
    for (const Stop& stop : model.stops) expand(model, stop);
    for (const Contact& contact : model.contacts) expand(model, contact);
    for (const Saturation& saturation : model.saturations) expand(model, saturation);
    for (const Flow& flow : model.flows)
        if (flow.switches) (flow.law == Flow::Law::check_valve ? expand_check_valve : expand_orifice)(model, flow);
}

}  // namespace dalembert
