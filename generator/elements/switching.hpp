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
    "Dry friction with stiction (2.95)-(2.99). NAME brings the modes NAME_sticks, NAME_slides_forwards, NAME_slides_backwards; "
    "constraint_force[NAME] is its force along the rate. With more than 128 combinations of modes in the file, and none of these named, a "
    "state instead, NAME_direction: 0 where it sticks, 1 and -1 where it slides.",
    "[frictions.floor]\nrate               = \"dot(x)\"\nnormal_force       = \"m*g\"\ncoefficient        = \"mu\"\n"
    "static_coefficient = \"mu_0\"", "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Friction> E>
void describe(Visitor& v, E& friction) {
    v("rate", friction.rate, {.required = true, .depends = on_motion | on_places,
        .doc = "the velocity that slides, linear in the velocities"});
    v("normal_force", friction.normal_force, {.required = true, .depends = on_state_and_inputs | on_places,
        .doc = "what presses the surfaces together; may depend on states and inputs"});
    v("coefficient", friction.coefficient, {.required = true, .depends = on_state_and_inputs | on_places,
        .doc = "of sliding friction: the force is coefficient*normal_force"});
    v("static_coefficient", friction.static_coefficient, {.dimension = v.dimension_of(friction.coefficient),
        .depends = on_state_and_inputs | on_places, .doc = "of what holds at rest, not below the other; the same, if left out"});
    v.item({});
}

/// A gap that cannot become negative. It is struck with a restitution, and closed where the machine leans on it.
struct Stop : Item {
    ExpressionPtr gap;
    ExpressionPtr restitution;  ///< null: 0
};

template <>
inline constexpr KindSpec kind_of<Stop>{"stop",
    "End stops that are struck, and hold where the machine leans on them. NAME brings the modes NAME_open and NAME_closed; "
    "constraint_force[NAME] is the force that opens the gap.",
    "[stops.floor]\ngap         = \"h\"\nrestitution = \"e\"", "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Stop> E>
void describe(Visitor& v, E& stop) {
    v("gap", stop.gap, {.required = true, .depends = on_configuration | on_places,
        .doc = "the distance, positive where the stop is not touched"});
    v("restitution", stop.restitution, {.dimension = Dimension::none(), .depends = constant_only,
        .doc = "the part of its speed with which the gap opens again after an impact; 0, if left out"});
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
    "Springs that act on one side only: ropes, contacts, the flanks of a backlash. NAME brings the modes NAME_slack and NAME_taut, with "
    "damping also NAME_released: stretched, but without force.",
    "[contacts.rope]\nelongation = \"x - l\"\nstiffness  = \"c\"", "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Contact> E>
void describe(Visitor& v, E& contact) {
    v("elongation", contact.elongation, {.required = true, .depends = on_configuration | on_places,
        .doc = "how far it is stretched or pressed; negative where it is slack"});
    const Dimension elongation = v.dimension_of(contact.elongation).value_or(Dimension::none());
    const Dimension rate = elongation / Dimension::time();
    v("stiffness", contact.stiffness, {.required = true, .dimension = Dimension::energy() / elongation / elongation,
        .depends = constant_only, .doc = "force = stiffness*elongation where that is positive"});
    v("damping", contact.damping, {.dimension = Dimension::power() / rate / rate, .depends = on_state_and_inputs | on_places,
        .doc = "of a damper beside the spring; the two together never pull back"});
    v("play", contact.play, {.dimension = elongation, .depends = constant_only,
        .doc = "it acts on both sides, beyond play/2 and below -play/2: a backlash. Brings also NAME_taut_back, with damping "
               "NAME_released_back"});
    v.item({});
}

/// A definition that follows a value within limits.
struct Saturation : Item {
    ExpressionPtr value, low, high;
};

template <>
inline constexpr KindSpec kind_of<Saturation>{"saturation",
    "Values within limits. NAME is what is left of the value, and brings the modes NAME_within, NAME_below, NAME_above; with more than 64 "
    "combinations of modes in the file, and none of these named, edges instead.",
    "[saturations.drive]\nvalue = \"k*(x_d - x)\"\nlow   = \"-f_max\"\nhigh  = \"f_max\"", "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Saturation> E>
void describe(Visitor& v, E& saturation) {
    constexpr unsigned moving = on_state_and_inputs | on_places;
    v("value", saturation.value, {.required = true, .depends = moving, .doc = "what is limited"});
    const std::optional<Dimension> value = v.dimension_of(saturation.value);
    v("low", saturation.low, {.required = true, .dimension = value, .depends = moving, .words = "lower limit", .doc = "the lower limit"});
    v("high", saturation.high, {.required = true, .dimension = value, .depends = moving, .words = "upper limit", .doc = "the upper limit"});
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
    v("name", phase.name, {.required = true, .doc = "of the phase; the mode is NAME_PHASE"});
    v("value", phase.value, {.required = true, .depends = on_state_and_inputs | on_places, .doc = "of the profile in this phase"});
    v("until", phase.until, {.dimension = Dimension::time(), .depends = on_state_and_inputs, .words = "end",
        .doc = "the time at which it ends; the last one has none"});
    describe_resets(v, "reset", phase.reset, {}, "new values of states, coordinates and velocities at its end");
}

/// A definition that goes through phases, one after the other.
struct Profile : Item {
    std::vector<Phase> phases;
};

template <>
inline constexpr KindSpec kind_of<Profile>{"profile",
    "Values that go through phases of time. NAME is the value, and each phase is a mode NAME_PHASE.",
    "[profiles.drive]\nphases = [{ name = \"runs\", value = \"a\", until = \"t_1\" }, { name = \"stands\", value = 0 }]",
    "", {.naming = Naming::bringing}};

template <class Visitor, ElementOf<Profile> E>
void describe(Visitor& v, E& profile) {
    v.list("phases", profile.phases, {.required = true, .noun = "phase",
        .doc = "one after the other: { name, value, until }; until is the time at which the next one begins, which the last one has not. "
               "With reset = { \"dot(x)\" = 0 }: new values at its end"});
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
    "Ways in which a part of the machine can be, one at any time. The first that fits the start values is the start.",
    "[modes]\npump = [\"pump_on\", \"pump_off\"]", "modes", {.naming = Naming::brought_section}};

template <class Visitor, ElementOf<ModeGroup> E>
void describe(Visitor& v, E&) {
    v.by_hand("modes", {.required = true, .type = ValueType::effects,
        .doc = "their names; conditions may name them, and in expressions each is 1 where it holds, else 0"});
    v.by_hand("final", {.type = ValueType::effects, .doc = "those of them that nothing has to leave"});
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
    "Rates or positions that are held at zero, in some mode. constraint_force[NAME] is what holds them: the force along the rate, on the "
    "machine.",
    "[constraints.clutch]\nrate = \"dot(phi_1) - dot(phi_2)\"\nwhen = \"engaged\"", "", {.naming = Naming::brought_section}};

template <class Visitor, ElementOf<Constraint> E>
void describe(Visitor& v, E& constraint) {
    v("rate", constraint.rate, {.depends = on_motion | on_places, .doc = "the rate that is held at zero, linear in the velocities"});
    v("position", constraint.position, {.depends = on_configuration | on_places,
        .doc = "instead: the position that is held at zero, and its rate with it"});
    v("eliminates", constraint.eliminates, {.type = ValueType::coordinate, .refers = {"coordinate"},
        .doc = "the coordinate whose velocity follows from the rate; its factor there must not move. If left out: the last one that can, "
               "else the force is an unknown of its own"});
    v("multiplier", constraint.multiplier, {
        .excludes = {{"eliminates", "either eliminates a coordinate or has a multiplier, and not both"}},
        .doc = "true: no velocity is eliminated; the force is an unknown of its own also where one could be"});
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
inline constexpr KindSpec kind_of<Event>{"event", "What happens where a guard goes through zero, in the modes that `when` names.",
    "[events.full]\nguard = \"h_max - h\"\nwhen  = \"pump_on\"\nnext  = \"pump_off\"", "", {.naming = Naming::brought_section}};

inline const KeyChoices<bool>& directions() {
    static const KeyChoices<bool> choices{{.word = "falling", .value = false, .doc = " (default)"}, {.word = "rising", .value = true}};
    return choices;
}

template <class Visitor, ElementOf<Event> E>
void describe(Visitor& v, E& event) {
    v("guard", event.guard, {.required = true, .depends = on_anything & ~on_outputs,
        .doc = "happens where this goes through zero; may use ddot(q) and constraint_force[NAME]"});
    v.choice("direction", event.rises, {}, directions());
    v("next", event.next, {.doc = "the mode afterwards: the first in the list that can go on from there; as before, if left out, where it "
                                  "resets something"});
    describe_resets(v, "reset", event.reset, {},
        "new values of states, coordinates and velocities, made of those before: { \"dot(h)\" = \"-e*dot(h)\" }");
    v("meets", event.meets, {.refers = {"constraint"},
        .doc = "a constraint whose rate is struck: velocities change by the smallest impulse that reverses it"});
    v("restitution", event.restitution, {.dimension = Dimension::none(), .depends = constant_only,
        .needs = {{"meets", "has a restitution, but meets no constraint"}},
        .doc = "with meets: the part of the rate that is left, reversed; 0, if left out: then the constraint holds exactly"});
    v("rest", event.rest, {.doc = "the mode after it has happened infinitely often at shrinking intervals; else a run stops there"});
    describe_resets(v, "rest_reset", event.rest_reset,
        {{"rest", "says what is reset at rest, but not to which mode that leads: it needs 'rest'"}}, "with rest: new values there");
    v("ends", event.ends, {.doc = "true: the run ends there"});
    v.item({});
}

}  // namespace dalembert
