// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "elements/element.hpp"
#include "elements/expand_switching.hpp"
#include "elements/forces.hpp"
#include "elements/mentioned.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// Whether an expression, or a definition that it mentions, names anything but parameters.
bool mentions_what_moves(const Expression& e, const Model& model) {
    return mentions(e, model, [&](const Expression& part) {
        const auto is_it = [&](const auto& item) { return item.name == part.name; };
        return part.kind == Kind::name && part.name != "pi" && find_definition(model, part.name) == nullptr &&
               std::none_of(model.parameters.begin(), model.parameters.end(), is_it) &&
               std::none_of(model.sizes.begin(), model.sizes.end(), is_it);
    });
}

/// The surfaces of a friction may be pulled apart.
void expand_parting(Model& model, const Friction& friction, const Element& made) {
    Event parts = made.make<Event>(made.part("parts"), friction.when);
    parts.doc = "the surfaces of friction '" + friction.name + "' are pulled apart: its normal force becomes negative";
    parts.guard = friction.normal_force;
    parts.ends = parts.is_limit = true;
    model.events.push_back(std::move(parts));
}

/// The same as with modes, with a state d in their place: 0 where it sticks, 1 and -1 where it slides forwards and backwards. What is
/// watched in one mode alone is multiplied by a factor that is 1 there and 0 elsewhere, and 1 less that factor is added.
void expand_by_state(Model& model, const Friction& friction) {
    const Element made(model, friction);
    const ExpressionPtr one = make_number(1, friction.span), d = made.name(made.part("direction")), square = times(d, d);
    const ExpressionPtr sticks = minus(one, square);
    State direction = made.make<State>(made.part("direction"), friction.when);
    direction.unit.written = "1";
    direction.start = direction.derivative = make_number(0, friction.span);
    direction.doc = "of friction '" + friction.name + "': 0 where it sticks, 1 and -1 where it slides forwards and backwards";
    model.states.push_back(std::move(direction));

    const ExpressionPtr sliding = times(friction.coefficient, friction.normal_force);
    const ExpressionPtr holding =
        times(friction.static_coefficient ? friction.static_coefficient : friction.coefficient, friction.normal_force);
    Constraint constraint = made.make<Constraint>(friction.name, friction.when);
    constraint.rate = friction.rate;
    constraint.share = sticks;
    constraint.multiplier = true;
    constraint.elsewhere = negative(times(d, sliding));
    model.constraints.push_back(std::move(constraint));
    Damper damper = made.make<Damper>(made.part("slides"), friction.when);
    damper.rate = friction.rate;
    damper.force = Law{"rate", times(d, sliding), friction.span};
    model.dampers.push_back(std::move(damper));

    const auto event = [&](const char* name, const ExpressionPtr& guard, const ExpressionPtr& to) -> Event& {
        Event made_event = made.make<Event>(made.part(name), friction.when);
        made_event.guard = guard;
        made_event.reset = {{d, to, friction.span}};
        made_event.meets = made.itself();
        made_event.at_once = true;
        model.events.push_back(std::move(made_event));
        return model.events.back();
    };
    const auto watched = [&](const ExpressionPtr& where, const ExpressionPtr& guard) {
        return plus(times(where, guard), minus(one, where));
    };
    const auto half = [&](const ExpressionPtr& a) { return over(a, make_number(2, friction.span)); };
    const ExpressionPtr force = made.own("constraint_force"), zero = make_number(0, friction.span);
    event("breaks_forwards", watched(sticks, plus(holding, force)), one);
    event("breaks_backwards", watched(sticks, minus(holding, force)), negative(one));
    event("stops_forwards", watched(half(plus(square, d)), friction.rate), zero);
    event("stops_backwards", watched(half(minus(square, d)), negative(friction.rate)), zero);
    Event& start = event("starts", plus(one, square), call_of("sign", friction.rate));
    start.meets.reset();
    start.at_once = false;
    start.at_start = true;
}

/// Sticks while |force| <= static_coefficient*normal_force; slides either way against coefficient*normal_force.
void expand_by_modes(Model& model, const Friction& friction) {
    Element made(model, friction);
    made.modes({"sticks", "slides_forwards", "slides_backwards"});
    const ExpressionPtr sliding = times(friction.coefficient, friction.normal_force);
    const ExpressionPtr holding =
        times(friction.static_coefficient ? friction.static_coefficient : friction.coefficient, friction.normal_force);

    Constraint sticks = made.make<Constraint>(friction.name, made.in("sticks"));
    sticks.rate = friction.rate;
    sticks.elsewhere =
        minus(times(made.name(made.part("slides_backwards")), sliding), times(made.name(made.part("slides_forwards")), sliding));
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
    made.event("breaks_forwards", "sticks", plus(holding, made.own("constraint_force")), {"slides_forwards"});
    made.event("breaks_backwards", "sticks", minus(holding, made.own("constraint_force")), {"slides_backwards"});
    made.event("stops_forwards", "slides_forwards", friction.rate, {"sticks", "slides_backwards", "slides_forwards"}).meets = made.itself();
    made.event("stops_backwards", "slides_backwards", negative(friction.rate), {"sticks", "slides_forwards", "slides_backwards"}).meets =
        made.itself();
}

void expand(Model& model, const Friction& friction, bool may_part) {
    if (!friction.rate || !friction.normal_force || !friction.coefficient) return;  // reported where it was read
    friction.by_state ? expand_by_state(model, friction) : expand_by_modes(model, friction);
    if (may_part) expand_parting(model, friction, Element(model, friction));
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
    made.event("opens", "closed", made.own("constraint_force"), {"open"});
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
    const ExpressionPtr half = over(contact.play, make_number(2, contact.span));
    expand_side(model, contact, made, minus(contact.elongation, half), "");
    expand_side(model, contact, made, minus(negative(contact.elongation), half), "_back");
}

}  // namespace

void expand_contacts(Model& model) {
    for (const Friction& friction : model.frictions)
        expand(model, friction, friction.normal_force && mentions_what_moves(*friction.normal_force, model));
    for (const Stop& stop : model.stops) expand(model, stop);
    for (const Contact& contact : model.contacts) expand(model, contact);
}

}  // namespace dalembert
