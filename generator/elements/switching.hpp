// SPDX-License-Identifier: GPL-3.0-or-later
// What a machine with modes has: the modes, the events between them, what is held in some of them, and elements that bring all of that.
#pragma once

#include "elements/item.hpp"

namespace dalembert {

/// One of the ways in which a part of a machine can be. In expressions its name is 1 where the machine is in it, else 0.
struct Mode : Item {
    bool is_final = false;  ///< nothing has to leave it
};

/// Modes of which always one holds. A machine with several such groups is in one mode of each.
struct ModeGroup : Item {
    std::vector<Mode> modes;
};

/// A rate that is held at zero, with the position whose rate it is. It acts on the machine with a force along the rate.
struct Constraint : Item {
    ExpressionPtr rate;      ///< linear in the velocities; null with a position
    ExpressionPtr position;
    std::optional<Reference> eliminates;  ///< the coordinate whose velocity is to follow from it
    bool multiplier = false;              ///< nothing is to be eliminated
    ExpressionPtr elsewhere; ///< the force along the rate where it does not hold, for people only; null: zero
    ExpressionPtr share;     ///< 1 where it holds and 0 where it does not, of states that events set; null: 1
};

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

/// Dry friction along a rate: it sticks up to static_coefficient*normal_force, and slides with coefficient*normal_force (2.95)-(2.99).
struct Friction : Item {
    ExpressionPtr rate;
    ExpressionPtr normal_force;
    ExpressionPtr coefficient;
    ExpressionPtr static_coefficient;  ///< null: the same
    bool by_state = false;             ///< it brings no modes, but a state that says whether it sticks and which way it slides
};

/// A gap that cannot become negative. It is struck with a restitution, and closed where the machine leans on it.
struct Stop : Item {
    ExpressionPtr gap;
    ExpressionPtr restitution;  ///< null: 0
};

/// A spring, and a damper beside it, that act on one side only and never pull back: a rope, a contact; with play on two, as a backlash.
struct Contact : Item {
    ExpressionPtr elongation;
    ExpressionPtr stiffness;
    ExpressionPtr damping;  ///< null: none
    ExpressionPtr play;     ///< null: one-sided
};

/// A definition that follows a value within limits.
struct Saturation : Item {
    ExpressionPtr value, low, high;
};

/// What a profile is until a time, and values that are reset then.
struct Phase {
    std::string name;
    Span span;
    ExpressionPtr value;
    ExpressionPtr until;  ///< null: for ever
    std::vector<RunEntry> reset;
};

/// A definition that goes through phases, one after the other.
struct Profile : Item {
    std::vector<Phase> phases;
};

}  // namespace dalembert
