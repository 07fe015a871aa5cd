// SPDX-License-Identifier: BSL-1.0
// A state feedback and its observer around a generated model: what runs on the controller. To be copied.
#pragma once

#include <algorithm>
#include <cstddef>

/// One step of the classical Runge-Kutta method with the input held.
template <class System>
typename System::State runge_kutta_step(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type h) {
    using Scalar = typename System::scalar_type;
    constexpr Scalar half = Scalar(1) / Scalar(2);
    typename System::State k1, k2, k3, k4, at, result;
    const auto shifted = [&](const typename System::State& k, Scalar step) {
        for (std::size_t i = 0; i < x.size(); ++i) at[i] = x[i] + step * k[i];
    };
    system.rhs(x, u, Scalar(0), k1);
    shifted(k1, half * h);
    system.rhs(at, u, Scalar(0), k2);
    shifted(k2, half * h);
    system.rhs(at, u, Scalar(0), k3);
    shifted(k3, h);
    system.rhs(at, u, Scalar(0), k4);
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = x[i] + h / Scalar(6) * (k1[i] + Scalar(2) * (k2[i] + k3[i]) + k4[i]);
    return result;
}

/// The observer corrects what it expected by what is measured, the feedback acts on that, and the generated equations tell what to expect
/// at the next sample. `Gains` brings sample_time, upright, feedback, observer and largest_force; `measure(system, x)` what is measured.
template <class System, class Gains>
class Controller {
public:
    using State = typename System::State;
    using Input = typename System::Input;

    /// One sample: measurements in, input out.
    template <class Measurements>
    Input step(const Measurements& measured) noexcept {
        const Measurements expected = measure(model_, estimate_);
        for (std::size_t j = 0; j < measured.size(); ++j)
            for (std::size_t i = 0; i < estimate_.size(); ++i) estimate_[i] += Gains::observer[4 * j + i] * (measured[j] - expected[j]);
        float force = 0.0F;
        for (std::size_t i = 0; i < estimate_.size(); ++i) force -= Gains::feedback[i] * (estimate_[i] - Gains::upright[i]);
        const Input u{std::clamp(force, -Gains::largest_force, Gains::largest_force)};
        corrected_ = estimate_;
        estimate_ = runge_kutta_step(model_, estimate_, u, Gains::sample_time);
        return u;
    }

    /// The state as it was known at the last sample.
    const State& estimate() const noexcept { return corrected_; }

private:
    System model_;
    State estimate_ = Gains::upright;
    State corrected_ = Gains::upright;
};
