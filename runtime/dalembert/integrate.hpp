// SPDX-License-Identifier: BSL-1.0
// Integration of dx/dt = f(x, t) on fixed-size states with the explicit steppers of Boost.Odeint. Step control is our own, because
// odeint's controlled steppers take a step whose error is NaN for a success and go on.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dalembert/integration_options.hpp"
#include "dalembert/status.hpp"

namespace dalembert {
inline namespace v1 {

namespace detail {

namespace odeint = boost::numeric::odeint;

/// The first entry that is not finite, or N.
template <class Scalar, std::size_t N>
std::size_t first_not_finite(const std::array<Scalar, N>& x) noexcept {
    using std::isfinite;
    for (std::size_t i = 0; i < N; ++i)
        if (!isfinite(x[i])) return i;
    return N;
}

/// Integrates; the observer is called as observe(t, x) at the output points in order.
template <class State, class Rhs, class Observer>
class Integration {
    using Scalar = typename State::value_type;
    static constexpr std::size_t N = std::tuple_size<State>::value;
    template <template <class, class, class, class, class, class, class> class Stepper>
    using On = Stepper<State, Scalar, State, Scalar, odeint::array_algebra, odeint::default_operations, odeint::initially_resizer>;

public:
    Integration(Rhs& rhs, State& x, Scalar from, Scalar to, const IntegrationOptions<State>& options, Observer& observe)
        : rhs_(rhs), x_(x), from_(from), to_(to), t_(from), options_(options), observe_(observe) {}

    Outcome run() {
        using std::isfinite;
        const bool bad = !(to_ >= from_) || !isfinite(from_) || !isfinite(to_) || options_.intervals == 0 || !(options_.tolerance > Scalar(0)) ||
                         !(options_.step >= Scalar(0)) || !(options_.max_step >= Scalar(0)) ||
                         !std::all_of(options_.scale.begin(), options_.scale.end(), [](const Scalar& scale) { return scale > Scalar(0); }) || (options_.method == Method::rk4 && !(options_.step > Scalar(0)));
        if (bad) return end(Status::bad_options);
        evaluate(x_, t_, dxdt_);
        if (!good(x_, dxdt_)) return end_not_finite(Scalar(0));
        observe_(t_, x_);
        if (to_ == from_) return end(Status::success);
        switch (options_.method) {
            case Method::rk4: return fixed_steps();
            case Method::dopri5: return dense_steps(true);
            case Method::dopri5_controlled: return dense_steps(false);
            case Method::fehlberg78: return controlled_steps();
        }
        return end(Status::bad_options);
    }

private:
    void evaluate(const State& x, Scalar t, State& dxdt) {
        ++outcome_.rhs_calls;
        rhs_(x, t, dxdt);
    }

    Outcome end(Status status) {
        outcome_.status = status;
        outcome_.t = static_cast<double>(t_);
        return outcome_;
    }

    static bool good(const State& a, const State& b) { return first_not_finite(a) == N && first_not_finite(b) == N; }

    /// Names the state to blame: infinite itself, or else the one whose derivative is at x or a little further on. Within a step
    /// what is not finite spreads from one state to the others, so the whole step would not tell.
    Outcome end_not_finite(Scalar further) {
        State ahead = x_;
        State dxdt;
        evaluate(x_, t_, dxdt);
        std::size_t i = std::min(first_not_finite(x_), first_not_finite(dxdt));
        if (i == N) {
            for (std::size_t k = 0; k < N; ++k) ahead[k] += further * dxdt[k];
            evaluate(ahead, t_ + further, dxdt);
            i = std::min(first_not_finite(ahead), first_not_finite(dxdt));
        }
        outcome_.state = i;
        return end(Status::not_finite);
    }

    Outcome stop(Status status) { return status == Status::not_finite ? end_not_finite(Scalar(64) * smallest_step()) : end(status); }

    Scalar output_time(std::size_t i) const {
        return i == options_.intervals ? to_ : from_ + (to_ - from_) * (Scalar(static_cast<double>(i)) / Scalar(static_cast<double>(options_.intervals)));
    }

    /// A step that changes nothing any more.
    Scalar smallest_step() const {
        using std::abs;
        using std::max;
        return Scalar(16) * std::numeric_limits<Scalar>::epsilon() * max(abs(t_), abs(to_ - from_) * std::numeric_limits<Scalar>::epsilon());
    }

    /// Largest error relative to what is allowed; NaN counts as infinite.
    Scalar error_norm(const State& error, const State& y) const {
        using std::abs;
        using std::max;
        Scalar largest = Scalar(0);
        for (std::size_t i = 0; i < N; ++i) {
            const Scalar size = max(options_.scale[i], max(Scalar(abs(x_[i])), Scalar(abs(y[i]))));
            const Scalar ratio = abs(error[i]) / (options_.tolerance * size);
            if (!(ratio <= largest)) largest = ratio;
            if (!(largest == largest)) return std::numeric_limits<Scalar>::infinity();
        }
        return largest;
    }

    /// Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I, section II.4: a first step from the sizes of x and dx/dt.
    Scalar first_step(int order) const {
        using std::abs;
        using std::max;
        using std::min;
        using std::pow;
        if (options_.step > Scalar(0)) return min(options_.step, to_ - from_);
        Scalar d0 = Scalar(0);
        Scalar d1 = Scalar(0);
        for (std::size_t i = 0; i < N; ++i) {
            const Scalar size = max(options_.scale[i], Scalar(abs(x_[i])));
            d0 = max(d0, Scalar(abs(x_[i]) / size));
            d1 = max(d1, Scalar(abs(dxdt_[i]) / size));
        }
        const Scalar guess = d1 > Scalar(0) ? Scalar(max(d0, Scalar(1) / Scalar(100)) / d1) : to_ - from_;
        return min(Scalar(pow(options_.tolerance, Scalar(1) / Scalar(order + 1)) * guess), to_ - from_);
    }

    /// The factor for the next step (Gustafsson's PI controller).
    Scalar step_factor(Scalar error, int order) {
        using std::max;
        using std::min;
        using std::pow;
        const Scalar floor = Scalar(1) / Scalar(10000);
        const Scalar e = max(error, floor);
        const Scalar k = Scalar(order);
        const Scalar factor = Scalar(9) / Scalar(10) * pow(e, -Scalar(7) / (Scalar(10) * k)) * pow(last_error_, Scalar(4) / (Scalar(10) * k));
        return min(Scalar(5), max(Scalar(1) / Scalar(5), factor));
    }

    Outcome fixed_steps() {
        On<odeint::runge_kutta4> stepper;
        auto f = [this](const State& x, State& dxdt, Scalar t) { evaluate(x, t, dxdt); };
        for (std::size_t i = 1; i <= options_.intervals; ++i) {
            const Scalar begin = t_;
            const Scalar length = output_time(i) - begin;
            using std::ceil;
            const auto count = static_cast<std::size_t>(std::max(1.0, static_cast<double>(ceil(length / options_.step * (Scalar(1) - Scalar(1e-9))))));
            const Scalar h = length / Scalar(static_cast<double>(count));
            for (std::size_t k = 0; k < count; ++k) {
                if (outcome_.steps == options_.max_steps) return end(Status::too_many_steps);
                State y = x_;
                stepper.do_step(f, y, t_, h);
                if (!good(y, y)) return end_not_finite(h);
                x_ = y;
                ++outcome_.steps;
                t_ = k + 1 == count ? output_time(i) : begin + h * Scalar(static_cast<double>(k + 1));
            }
            observe_(t_, x_);
        }
        return end(Status::success);
    }

    /// One accepted step of at most h; leaves the size of the next one in h. `step` computes y and its error.
    template <class Step>
    Status accepted_step(Scalar& h, Scalar limit, int order, State& y, Step step) {
        bool not_finite = false;
        while (true) {
            if (outcome_.steps + outcome_.rejected >= options_.max_steps) return Status::too_many_steps;
            if (options_.max_step > Scalar(0) && h > options_.max_step) h = options_.max_step;
            const bool clipped = h >= limit;
            const Scalar now = clipped ? limit : h;
            if (!(now > smallest_step()) && !clipped) return not_finite ? Status::not_finite : Status::step_too_small;
            State error;
            step(now, y, error);
            if (!good(y, error)) {
                not_finite = true;
                ++outcome_.rejected;
                h = now / Scalar(4);
                continue;
            }
            const Scalar e = error_norm(error, y);
            if (!(e <= Scalar(1))) {
                using std::max;
                using std::pow;
                ++outcome_.rejected;
                h = now * max(Scalar(1) / Scalar(10), Scalar(9) / Scalar(10) * pow(e, -Scalar(1) / Scalar(order)));
                continue;
            }
            // After a step that was cut to end on an output point, the size from before is as good a guess as ever.
            const Scalar factor = step_factor(e, order);
            h = clipped ? std::max(h, now * factor) : now * factor;
            last_error_ = std::max(e, Scalar(1) / Scalar(10000));
            taken_ = now;
            ++outcome_.steps;
            return Status::success;
        }
    }

    Outcome controlled_steps() {
        constexpr int order = 8;
        On<odeint::runge_kutta_fehlberg78> stepper;
        auto f = [this](const State& x, State& dxdt, Scalar t) { evaluate(x, t, dxdt); };
        Scalar h = first_step(order);
        for (std::size_t i = 1; i <= options_.intervals; ++i) {
            const Scalar target = output_time(i);
            while (t_ < target) {
                State y;
                const Scalar limit = target - t_;
                const Status status = accepted_step(h, limit, order, y, [&](Scalar now, State& out, State& error) { stepper.do_step(f, x_, dxdt_, t_, out, now, error); });
                if (status != Status::success) return stop(status);
                t_ = taken_ == limit ? target : t_ + taken_;
                x_ = y;
                evaluate(x_, t_, dxdt_);
                if (!good(x_, dxdt_)) return end_not_finite(Scalar(0));
            }
            observe_(t_, x_);
        }
        return end(Status::success);
    }

    /// The last stage of a Dormand-Prince step is the first of the next; with dense output steps need not end on output points.
    Outcome dense_steps(bool dense) {
        constexpr int order = 5;
        On<odeint::runge_kutta_dopri5> stepper;
        auto f = [this](const State& x, State& dxdt, Scalar t) { evaluate(x, t, dxdt); };
        Scalar h = first_step(order);
        std::size_t next = 1;
        while (next <= options_.intervals) {
            State y;
            State dydt;
            const Scalar target = dense ? to_ : output_time(next);
            const Scalar limit = target - t_;
            const Status status = accepted_step(h, limit, order, y, [&](Scalar now, State& out, State& error) {
                stepper.do_step(f, x_, dxdt_, t_, out, dydt, now, error);
                const std::size_t culprit = first_not_finite(dydt);
                if (culprit != N) out[culprit] = std::numeric_limits<Scalar>::quiet_NaN();
            });
            if (status != Status::success) return stop(status);
            const Scalar reached = taken_ == limit ? target : t_ + taken_;
            for (; next <= options_.intervals && output_time(next) < reached; ++next) {
                State between;
                stepper.calc_state(output_time(next), between, x_, dxdt_, t_, y, dydt, reached);
                observe_(output_time(next), between);
            }
            t_ = reached;
            x_ = y;
            dxdt_ = dydt;
            if (next <= options_.intervals && output_time(next) == t_) {
                observe_(t_, x_);
                ++next;
            }
        }
        return end(Status::success);
    }

    Rhs& rhs_;
    State& x_;
    Scalar from_, to_, t_;
    const IntegrationOptions<State>& options_;
    Observer& observe_;
    State dxdt_{};
    Outcome outcome_;
    Scalar last_error_ = Scalar(1);
    Scalar taken_ = Scalar(0);
};

}  // namespace detail

/// Integrates dx/dt = rhs(x, t, dxdt) from `from` to `to`. `x` holds the start and afterwards the last good state.
/// Calls observe(t, x) at the output points.
template <class State, class Rhs, class Observer>
Outcome integrate(Rhs&& rhs, State& x, typename State::value_type from, typename State::value_type to, const IntegrationOptions<State>& options, Observer&& observe) {
    return detail::Integration<State, std::remove_reference_t<Rhs>, std::remove_reference_t<Observer>>(rhs, x, from, to, options, observe).run();
}

}  // namespace v1
}  // namespace dalembert
