// SPDX-License-Identifier: GPL-3.0-or-later
// Machines with modes as they were written: the modes, the events between them, what is held in some of them, and elements that bring all
// of that.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

/// Dry friction along a rate: it sticks up to static_coefficient*normal_force, and slides with coefficient*normal_force (2.95)-(2.99).
struct Friction : Item {
    ExpressionPtr rate;
    ExpressionPtr normal_force;
    ExpressionPtr coefficient;
    ExpressionPtr static_coefficient;  ///< null: the same
    bool by_state = false;             ///< it brings no modes, but a state that says whether it sticks and which way it slides
};

template <>
inline constexpr KindSpec kind_of<Friction>{"friction",
    "Dry friction with stiction (2.95)-(2.99). NAME adds the modes NAME_sticks, NAME_slides_forwards and "
    "NAME_slides_backwards; constraint_force[NAME] is the friction force along the rate. In a file with more than "
    "128 combinations of modes, and if no expression names one of these modes, NAME adds the state NAME_direction "
    "instead: 0 if it sticks, 1 or -1 if it slides.",
    "[frictions.floor]\nrate               = \"dot(x)\"\nnormal_force       = \"m*g\"\ncoefficient        = \"mu\"\n"
    "static_coefficient = \"mu_0\"", "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Friction> E>
void describe(Visitor& v, E& friction) {
    v("rate", friction.rate, {.required = true, .depends = on_motion | on_places,
        .doc = "sliding velocity, linear in the velocities"});
    v("normal_force", friction.normal_force, {.required = true, .depends = on_state_and_inputs | on_places,
        .doc = "force that presses the surfaces together; may depend on states and inputs"});
    v("coefficient", friction.coefficient, {.required = true, .depends = on_state_and_inputs | on_places,
        .doc = "coefficient of sliding friction: the force is coefficient*normal_force"});
    v("static_coefficient", friction.static_coefficient, {.dimension = v.dimension_of(friction.coefficient),
        .depends = on_state_and_inputs | on_places, .doc = "coefficient of static friction, not below the other; the same if left out"});
    v.item({});
}

/// A gap that cannot become negative. It is struck with a restitution, and closed where the machine leans on it.
struct Stop : Item {
    ExpressionPtr gap;
    ExpressionPtr restitution;  ///< null: 0
};

template <>
inline constexpr KindSpec kind_of<Stop>{"stop",
    "End stops with impacts, which hold while the machine presses on them. NAME adds the modes NAME_open and "
    "NAME_closed; constraint_force[NAME] is the force that opens the gap.",
    "[stops.floor]\ngap         = \"h\"\nrestitution = \"e\"", "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Stop> E>
void describe(Visitor& v, E& stop) {
    v("gap", stop.gap, {.required = true, .depends = on_configuration | on_places,
        .doc = "distance to the stop, positive while it is open"});
    v("restitution", stop.restitution, {.dimension = Dimension::none(), .depends = constant_only,
        .doc = "coefficient of restitution: speed after an impact divided by speed before it; 0 if left out"});
    v.item({});
}

/// A spring, and a damper beside it, that act on one side only and never pull back: a rope, a contact; with play on two, as a backlash.
struct Contact : Item {
    ExpressionPtr elongation;
    ExpressionPtr stiffness;
    ExpressionPtr damping;  ///< null: none
    ExpressionPtr play;     ///< null: one-sided
};

template <>
inline constexpr KindSpec kind_of<Contact>{"contact",
    "Springs that act on one side only: ropes, contacts, the flanks of a backlash. NAME adds the modes NAME_slack "
    "and NAME_taut; with damping also NAME_released: stretched, but without force.",
    "[contacts.rope]\nelongation = \"x - l\"\nstiffness  = \"c\"", "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Contact> E>
void describe(Visitor& v, E& contact) {
    v("elongation", contact.elongation, {.required = true, .depends = on_configuration | on_places,
        .doc = "elongation or compression; negative while the contact is slack"});
    const Dimension elongation = v.dimension_of(contact.elongation).value_or(Dimension::none());
    const Dimension rate = elongation / Dimension::time();
    v("stiffness", contact.stiffness, {.required = true, .dimension = Dimension::energy() / elongation / elongation,
        .depends = constant_only, .doc = "stiffness: force = stiffness*elongation if the elongation is positive"});
    v("damping", contact.damping, {.dimension = Dimension::power() / rate / rate, .depends = on_state_and_inputs | on_places,
        .doc = "coefficient of a damper parallel to the spring; the total force is never negative"});
    v("play", contact.play, {.dimension = elongation, .depends = constant_only,
        .doc = "backlash: the contact acts above play/2 and below -play/2. Adds the mode NAME_taut_back, with damping also "
               "NAME_released_back"});
    v.item({});
}

/// A definition that follows a value within limits.
struct Saturation : Item {
    ExpressionPtr value, low, high;
};

template <>
inline constexpr KindSpec kind_of<Saturation>{"saturation",
    "Values within limits. NAME is the limited value. NAME adds the modes NAME_within, NAME_below and NAME_above; in "
    "a file with more than 64 combinations of modes, and if no expression names one of these modes, NAME has located "
    "kinks instead.",
    "[saturations.drive]\nvalue = \"k*(x_d - x)\"\nlow   = \"-f_max\"\nhigh  = \"f_max\"", "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Saturation> E>
void describe(Visitor& v, E& saturation) {
    constexpr unsigned moving = on_state_and_inputs | on_places;
    v("value", saturation.value, {.required = true, .depends = moving, .doc = "value to be limited"});
    const std::optional<Dimension> value = v.dimension_of(saturation.value);
    v("low", saturation.low, {.required = true, .dimension = value, .depends = moving, .words = "lower limit", .doc = "lower limit"});
    v("high", saturation.high, {.required = true, .dimension = value, .depends = moving, .words = "upper limit", .doc = "upper limit"});
    v.item({});
}

template <class Visitor, class Resets>
void describe_resets(Visitor& v, const char* name, Resets& resets, std::vector<KeyRule> needs, const char* doc) {
    v(name, resets, {.depends = on_state_and_inputs, .names = on_coordinates | on_velocities | on_states, .words = "new value",
        .needs = std::move(needs), .doc = doc});
}

/// What a profile is until a time, and values that are reset then.
struct Phase {
    std::string name;
    Span span;
    ExpressionPtr value;
    ExpressionPtr until;  ///< null: for ever
    std::vector<RunEntry> reset;
};

template <>
inline constexpr KindSpec kind_of<Phase>{"phase", "", ""};

template <class Visitor, ElementOf<Phase> E>
void describe(Visitor& v, E& phase) {
    v("name", phase.name, {.required = true, .doc = "name of the phase; its mode is NAME_PHASE"});
    v("value", phase.value, {.required = true, .depends = on_state_and_inputs | on_places, .doc = "value of the profile in this phase"});
    v("until", phase.until, {.dimension = Dimension::time(), .depends = on_state_and_inputs, .words = "end",
        .doc = "time at which the phase ends; the last phase has none"});
    describe_resets(v, "reset", phase.reset, {}, "new values of states, coordinates and velocities at its end");
}

/// A definition that goes through phases, one after the other.
struct Profile : Item {
    std::vector<Phase> phases;
};

template <>
inline constexpr KindSpec kind_of<Profile>{"profile",
    "Values that follow a sequence of phases. NAME is the value, and each phase is a mode NAME_PHASE.",
    "[profiles.drive]\nphases = [{ name = \"runs\", value = \"a\", until = \"t_1\" }, { name = \"stands\", value = 0 }]",
    "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Profile> E>
void describe(Visitor& v, E& profile) {
    v.list("phases", profile.phases, {.required = true, .noun = "phase",
        .doc = "{ name, value, until } for each phase, in order; `until` is the time at which it ends. With reset = { "
               "\"dot(x)\" = 0 }: new values at its end"});
    v.item({});
}

/// One of the ways in which a part of a machine can be. In expressions its name is 1 where the machine is in it, else 0.
struct Mode : Item {
    bool is_final = false;  ///< nothing has to leave it
};

/// Modes of which always one holds. A machine with several such groups is in one mode of each.
struct ModeGroup : Item {
    std::vector<Mode> modes;
};

template <>
inline constexpr KindSpec kind_of<ModeGroup>{"mode group",
    "Groups of modes, of which always one is active. A run starts in the first mode that the start values allow.",
    "[modes]\npump = [\"pump_on\", \"pump_off\"]", "modes", {.naming = Naming::brought_section}};

template <class Visitor, ElementOf<ModeGroup> E>
void describe(Visitor& v, E&) {
    v.by_hand(
        "modes",
        {.required = true,
         .type = ValueType::effects,
         .doc = "names of the modes; conditions may contain them, and in an expression the name of a mode is 1 in this mode, else 0"});
    v.by_hand("final", {.type = ValueType::effects, .doc = "modes of the group that no event needs to leave"});
    v.item({});
}

/// A rate that is held at zero, with the position whose rate it is. It acts on the machine with a force along the rate.
struct Constraint : Item {
    ExpressionPtr rate;      ///< linear in the velocities; null with a position
    ExpressionPtr position;
    std::optional<Reference> eliminates;  ///< the coordinate whose velocity is to follow from it
    bool multiplier = false;              ///< nothing is to be eliminated
    ExpressionPtr elsewhere; ///< the force along the rate where it does not hold, for people only; null: zero
    ExpressionPtr share;     ///< 1 where it holds and 0 where it does not, of states that events set; null: 1
};

template <>
inline constexpr KindSpec kind_of<Constraint>{"constraint",
    "Rates or positions that are held at zero, always or in some modes. constraint_force[NAME] is the constraint "
    "force along the rate, on the machine.",
    "[constraints.clutch]\nrate = \"dot(phi_1) - dot(phi_2)\"\nwhen = \"engaged\"", "", {.naming = Naming::brought_section}};

template <class Visitor, ElementOf<Constraint> E>
void describe(Visitor& v, E& constraint) {
    v("rate", constraint.rate, {.depends = on_motion | on_places, .doc = "rate that is held at zero, linear in the velocities"});
    v("position", constraint.position, {.depends = on_configuration | on_places,
        .doc = "instead of a rate: position that is held at zero, together with its rate"});
    v("eliminates", constraint.eliminates, {.type = ValueType::coordinate, .refers = {"coordinate"},
        .doc = "coordinate whose velocity the constraint eliminates; its factor in the rate must be constant. If left out: the "
               "last possible one; if there is none, the force is an additional unknown"});
    v("multiplier", constraint.multiplier, {
        .excludes = {{"eliminates", "either eliminates a coordinate or has a multiplier, and not both"}},
        .doc = "true: the constraint eliminates no velocity, and its force is an additional unknown"});
    v.either("rate", "position", "a rate or a position");
    v.item({.has_family = true});
}

/// Happens where the guard falls through zero (or rises).
struct Event : Item {
    ExpressionPtr guard;
    bool rises = false;
    bool ends = false;                ///< the run
    bool is_limit = false;            ///< with ends: because the model holds no further
    std::vector<RunEntry> reset;      ///< values after it, of what was before it
    std::optional<Reference> meets;   ///< a constraint: the rate is struck there, and is -restitution times what it was
    ExpressionPtr restitution;        ///< null: 0
    std::vector<Condition> next;      ///< modes afterwards, in order of preference; none: as before
    std::vector<Condition> rest;      ///< modes after infinitely many of it
    std::vector<RunEntry> rest_reset;
    bool at_once = false;             ///< it happens at once where another event takes its guard below zero
    bool at_start = false;            ///< a run begins with what it resets, and it does not happen later
};

template <>
inline constexpr KindSpec kind_of<Event>{"event", "Events where a guard crosses zero, in the modes that `when` names.",
    "[events.full]\nguard = \"h_max - h\"\nwhen  = \"pump_on\"\nnext  = \"pump_off\"", "", {.naming = Naming::brought_section}};

inline const KeyChoices<bool>& directions() {
    static const KeyChoices<bool> choices{{.word = "falling", .value = false, .doc = " (default)"}, {.word = "rising", .value = true}};
    return choices;
}

template <class Visitor, ElementOf<Event> E>
void describe(Visitor& v, E& event) {
    v("guard", event.guard, {.required = true, .depends = on_anything & ~on_outputs,
        .doc = "the event happens where this crosses zero; may use `ddot(q)` and `constraint_force[NAME]`"});
    v.choice("direction", event.rises, {}, directions());
    v("next", event.next, {
        .doc = "mode after the event: the first of the list that the state allows. An event with a reset may leave it out: the "
               "mode then stays"});
    describe_resets(v, "reset", event.reset, {},
        "new values of states, coordinates and velocities, as expressions of those before: { \"dot(h)\" = \"-e*dot(h)\" }");
    v("meets", event.meets, {.refers = {"constraint"},
        .doc = "constraint that the machine hits: the smallest impulse that reverses its rate changes the velocities"});
    v("restitution", event.restitution, {.dimension = Dimension::none(), .depends = constant_only,
        .needs = {{"meets", "has a restitution, but meets no constraint"}},
        .doc = "with meets: rate after the impact divided by the rate before; 0 if left out, and the constraint then holds "
               "exactly"});
    v("rest", event.rest, {.doc = "mode after infinitely many events at shrinking intervals; if left out, a run stops there"});
    describe_resets(v, "rest_reset", event.rest_reset, {{"rest", "has new values at rest, but no mode at rest: it needs 'rest'"}},
                    "with rest: new values there");
    v("ends", event.ends, {.doc = "true: the run ends at the event"});
    v.item({});
}

}  // namespace dalembert
