// SPDX-License-Identifier: BSL-1.0
// Status of a computation. The runtime throws no exceptions; a status names each failure.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace dalembert {
inline namespace v1 {

enum class Status {
    success,
    not_finite,      ///< a state or its derivative became infinite or NaN, even in the smallest step
    step_too_small,  ///< the tolerance cannot be met with steps that still change the time
    too_many_steps,
    not_converged,  ///< an iteration found no solution
    bad_options,
    event,              ///< a guard that ends the run is about to become negative
    event_storm,        ///< too many events, or one after the other without any progress in time
    no_start_mode,      ///< no mode accepts the start values, or the chosen one does not
    no_mode,            ///< no mode accepts the state after an event
    accumulation,       ///< an event happens at ever shorter intervals, and the system has no mode for the time after
    no_series,          ///< the header of the system or its inputs have no Taylor series
    constraint_broken,  ///< the start violates a constraint, or the run cannot hold it any more
    singular_position,  ///< constraints depend on each other, and the motion cannot go on
};

inline const char* to_string(Status status) noexcept {
    switch (status) {
        case Status::success:
            return "success";
        case Status::not_finite:
            return "not finite";
        case Status::step_too_small:
            return "step too small";
        case Status::too_many_steps:
            return "too many steps";
        case Status::not_converged:
            return "not converged";
        case Status::bad_options:
            return "bad options";
        case Status::event:
            return "event";
        case Status::event_storm:
            return "event storm";
        case Status::no_start_mode:
            return "no start mode";
        case Status::no_mode:
            return "no mode";
        case Status::accumulation:
            return "accumulation";
        case Status::no_series:
            return "no series";
        case Status::constraint_broken:
            return "constraint broken";
        case Status::singular_position:
            return "singular position";
    }
    return "unknown";
}

/// Result of an integration.
struct Outcome {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    Status status = Status::success;
    double t = 0;           ///< s, time of the end
    std::size_t state = 0;  ///< with not_finite and step_too_small: the state that caused it
    /// With event and event_storm: the guard; with too_many_steps: the kink that the run stays at, if there is one; with not_finite: a
    /// guard that is not a number, if no state caused it.
    std::size_t guard = none;
    std::size_t constraint = none;  ///< with constraint_broken and singular_position: its number in constraint_table()
    std::size_t events = 0;         ///< number of sign changes of guards that the run passed
    std::size_t steps = 0;          ///< number of accepted steps
    std::size_t rejected = 0;
    std::size_t rhs_calls = 0;
    std::array<std::size_t, 3> steps_by{};  ///< of Method::automatic: steps of dopri5, dop853 and rodas5p
};

/// The result as a sentence. `names` has a member .name for each state, `guards` have .name and .doc for each guard, like the tables
/// of generated headers.
template <class Table, class Guards>
std::string message(const Outcome& outcome, const Table& names, const Guards& guards) {
    std::string text = outcome.status == Status::event ? "stopped" : to_string(outcome.status);
    text += " at t = " + std::to_string(outcome.t) + " s";
    if (outcome.status == Status::not_finite && outcome.state < names.size())
        text += ": state '" + std::string(names[outcome.state].name) + "' or its derivative is not finite";
    if (outcome.status == Status::step_too_small)
        text += ": the tolerance cannot be met" +
                (outcome.state < names.size() ? ", least by state '" + std::string(names[outcome.state].name) + "'" : std::string()) +
                "; try a larger one, and look there for a jump or a growth without bound";
    if (outcome.status == Status::constraint_broken)
        text += ": constraint number " + std::to_string(outcome.constraint) + " is violated, and a small step cannot restore it";
    if (outcome.status == Status::singular_position)
        text += ": constraint number " + std::to_string(outcome.constraint) + " depends on the others there";
    if (outcome.guard >= guards.size()) return text;
    const auto& guard = guards[outcome.guard];
    if (outcome.status == Status::event) text += ": " + std::string(guard.doc);
    if (outcome.status == Status::too_many_steps)
        text += ": guard '" + std::string(guard.name) + "' stays next to zero, because both sides lead back to it (" + guard.doc + ")";
    if (outcome.status == Status::event_storm)
        text += ": guard '" + std::string(guard.name) + "' keeps changing its sign (" + guard.doc + ")";
    if (outcome.status == Status::not_finite) text += ": guard '" + std::string(guard.name) + "' is not a number";
    return text;
}

/// The same for a system without guards.
template <class Table>
std::string message(const Outcome& outcome, const Table& names) {
    struct Guard {
        const char* name;
        const char* doc;
    };
    return message(outcome, names, std::array<Guard, 0>{});
}

}  // namespace v1
}  // namespace dalembert
