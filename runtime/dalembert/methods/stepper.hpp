// SPDX-License-Identifier: BSL-1.0
// The interface between the driver of an integration and a method. One interface with virtual functions: a step costs more than a call, and
// the control of steps and events is compiled once, not once for each method.
#pragma once

#include <cmath>
#include <cstddef>

#include "dalembert/status.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// A step that may or may not be taken: from where the run is to `end`.
template <class State>
struct Candidate {
    using Scalar = typename State::value_type;
    Scalar length = Scalar(0), end = Scalar(0);  ///< s
    State y{}, error{}, dydt{};
    bool has_derivative = false;  ///< dydt is that at the end
    bool finite = true;
};

/// Where the run is.
template <class State>
struct Point {
    const State& x;
    const State& dxdt;
    typename State::value_type t;
    std::size_t number;  ///< another one for another point
    bool is_behind_event;  ///< next to the zero of a guard, which the right-hand side may round otherwise
};

/// How the steps of a run lie to its output points.
enum class Steps {
    fixed,       ///< of one length between two output points
    to_outputs,  ///< controlled; they end on output points
    dense,       ///< controlled; output points lie within them
};

template <class State>
class Stepper {
public:
    using Scalar = typename State::value_type;
    virtual int order() const = 0;  ///< the error of a step shrinks like its length to this power
    /// Makes the step; c.finite tells whether all of its numbers are finite.
    virtual void take(const Point<State>& from, Candidate<State>& c) = 0;
    /// The length of the next step from here, which the control of errors would make h.
    virtual Scalar suggested(const Point<State>&, Scalar h) { return h; }
    /// A second look at a step that is about to be accepted; may find larger errors.
    virtual void check(const Point<State>&, Candidate<State>&) {}
    /// The same of a step that is cut at an event, where the right-hand side need not have a value.
    virtual void check_cut(const Point<State>&, Candidate<State>&) {}
    /// The state at t within the step that was made last.
    virtual void between(const Point<State>& from, Candidate<State>& c, Scalar t, State& x) = 0;

protected:
    ~Stepper() = default;
};

/// The first entry that is not finite, or N.
template <class State>
std::size_t first_not_finite(const State& x) noexcept {
    using std::isfinite;
    std::size_t i = 0;
    while (i < x.size() && isfinite(x[i])) ++i;
    return i;
}

/// By a sum of zeros, which costs less than a test of each.
template <class State>
bool are_finite(const State& a, const State& b) noexcept {
    using Scalar = typename State::value_type;
    Scalar sum = Scalar(0);
    for (std::size_t i = 0; i < a.size(); ++i) sum += Scalar(0) * a[i] + Scalar(0) * b[i];
    return sum == Scalar(0);
}

/// On a frame of its own: of long states those of all methods together would not fit the stack.
template <class Stepper, class Run, class... Arguments>
[[gnu::noinline]] Outcome run_with(Run& run, Steps steps, Arguments&&... arguments) {
    Stepper stepper(run.right_hand_side(), arguments...);
    return run.go(stepper, steps);
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
