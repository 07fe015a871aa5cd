// SPDX-License-Identifier: BSL-1.0
// Derivatives at one point of a run, where the header has none: of guards, resets and inputs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "dalembert/sensitivities/varied.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

template <class State, class Scalar>
State moved(const State& x, const State& direction, const Scalar& length) {
    State result = x;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += length * direction[i];
    return result;
}

/// Of order four, from central differences with a step and with twice that: central(times).
inline constexpr int longest_of_order_four = 8;
template <class Scalar, class Central>
auto of_order_four(const Central& central) {
    auto near = central(Scalar(longest_of_order_four / 2));
    const auto far = central(Scalar(longest_of_order_four));
    if constexpr (std::is_same_v<decltype(near), Scalar>) {
        return Scalar((Scalar(4) * near - far) / Scalar(3));
    } else {
        for (std::size_t i = 0; i < near.size(); ++i) near[i] = (Scalar(4) * near[i] - far[i]) / Scalar(3);
        return near;
    }
}

/// At the state x and the time t. Refers to what it is given, but for the times.
template <class System, class List>
class DifferencesAt {
    using Scalar = typename System::scalar_type;
    using State = typename System::State;

public:
    /// `free_time` before and behind t inputs have no kink, in s.
    DifferencesAt(const System& system, const List& varied, const MovedSystems<System, List>& moved, const State& scale, const State& x,
                  const Scalar& t, const Scalar& span, const Scalar& free_time)
        : system_(system), varied_(varied), moved_(moved), scale_(scale), x_(x), t_(t), span_(span), free_time_(free_time) {}

    /// What central(system, x, t, other system, x, t, step) makes of both sides, along the parameter c, the state and the time; in steps
    /// that are so many times longer than usual.
    template <class Central>
    auto along(std::size_t c, const State& s, const Scalar& shift, const Central& central, const Scalar& times = Scalar(1)) const {
        using std::abs;
        const Scalar longest = largest_change(s, shift);
        const bool is_parameter = varied_[c].of == Varied::Of::parameter;
        Scalar step = is_parameter ? moved_.distance[c] : Scalar(1);
        if (longest > Scalar(0)) step = std::min(step, step_of_differences<Scalar>() / longest);
        step *= times;
        if (abs(shift) * step > free_time_) step = free_time_ / abs(shift);
        System ahead = system_, behind = system_;
        if (is_parameter) {
            move_parameter(ahead, varied_[c].number, step);
            move_parameter(behind, varied_[c].number, -step);
            step = (parameter_of(ahead, varied_[c].number) - parameter_of(behind, varied_[c].number)) / Scalar(2);
        }
        return central(ahead, moved(x_, s, step), t_ + step * shift, behind, moved(x_, s, -step), t_ - step * shift, step);
    }

    /// d/dt of value(x, t), where the state moves with this rate.
    template <class Value>
    Scalar by_time(const State& rate, const Value& value) const {
        const Scalar usual = step_of_differences<Scalar>() / largest_change(rate, Scalar(1));
        return of_order_four<Scalar>([&](const Scalar& times) {
            const Scalar step = std::min(Scalar(times * usual), Scalar(times / Scalar(longest_of_order_four) * free_time_));
            return Scalar((value(moved(x_, rate, step), t_ + step) - value(moved(x_, rate, -step), t_ - step)) / (Scalar(2) * step));
        });
    }

private:
    /// Of states and the time, relative to their sizes.
    Scalar largest_change(const State& of_state, const Scalar& of_time) const {
        using std::abs;
        return std::max(Scalar(abs(of_time) / span_), largest_part<System>(of_state, x_, scale_));
    }

    const System& system_;
    const List& varied_;
    const MovedSystems<System, List>& moved_;
    const State& scale_;
    const State& x_;
    Scalar t_, span_, free_time_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
