// SPDX-License-Identifier: BSL-1.0
// How a computation ended. The runtime throws nothing; what can go wrong is said here.
#pragma once

#include <cstddef>
#include <string>

namespace dalembert {
inline namespace v1 {

enum class Status {
    success,
    not_finite,      ///< a state or its derivative became infinite or NaN however small the step was
    step_too_small,  ///< the tolerance cannot be met with steps that still change the time
    too_many_steps,
    not_converged,   ///< an iteration found no solution
    bad_options,
};

inline const char* to_string(Status status) noexcept {
    switch (status) {
        case Status::success: return "success";
        case Status::not_finite: return "not finite";
        case Status::step_too_small: return "step too small";
        case Status::too_many_steps: return "too many steps";
        case Status::not_converged: return "not converged";
        case Status::bad_options: return "bad options";
    }
    return "unknown";
}

/// How an integration went.
struct Outcome {
    Status status = Status::success;
    double t = 0;                 ///< s, where it ended
    std::size_t state = 0;        ///< with not_finite: the state that is to blame
    std::size_t steps = 0;        ///< accepted
    std::size_t rejected = 0;
    std::size_t rhs_calls = 0;
};

/// A sentence for people. `names` has a member .name for each state, as the tables of generated headers do.
template <class Table>
std::string message(const Outcome& outcome, const Table& names) {
    std::string text = to_string(outcome.status);
    text += " at t = " + std::to_string(outcome.t) + " s";
    if (outcome.status == Status::not_finite && outcome.state < names.size())
        text += ": state '" + std::string(names[outcome.state].name) + "' or its derivative is not finite";
    if (outcome.status == Status::step_too_small) text += ": the tolerance cannot be met";
    return text;
}

}  // namespace v1
}  // namespace dalembert
