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

#include "dalembert/events.hpp"
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

/// Integrates; the observer is called as observe(t, x) at the output points in order. There are G guards.
template <class State, class Rhs, class Observer, class Guards, std::size_t G>
class Integration {
    using Scalar = typename State::value_type;
    static constexpr std::size_t N = std::tuple_size<State>::value;
    template <template <class, class, class, class, class, class, class> class Stepper>
    using On = Stepper<State, Scalar, State, Scalar, odeint::array_algebra, odeint::default_operations, odeint::initially_resizer>;

public:
    Integration(Rhs& rhs, State& x, Scalar from, Scalar to, const IntegrationOptions<State>& options, Observer& observe, Guards& guards, const std::array<bool, G>& ends)
        : rhs_(rhs), x_(x), from_(from), to_(to), t_(from), options_(options), observe_(observe), events_(guards, ends, options.tolerance, (to - from) / Scalar(1000000)) {}

    Outcome run() {
        using std::isfinite;
        const bool bad = !(to_ >= from_) || !isfinite(from_) || !isfinite(to_) || options_.intervals == 0 || !(options_.tolerance > Scalar(0)) ||
                         !(options_.step >= Scalar(0)) || !(options_.max_step >= Scalar(0)) ||
                         !std::all_of(options_.scale.begin(), options_.scale.end(), [](const Scalar& scale) { return scale > Scalar(0); }) || (options_.method == Method::rk4 && !(options_.step > Scalar(0)));
        if (bad) return end(Status::bad_options);
        evaluate(x_, t_, dxdt_);
        if (!good(x_, dxdt_)) return end_not_finite(Scalar(0));
        observe(t_);
        if constexpr (G > 0) {
            if (events_.not_a_number(x_, t_) != G) return end_not_finite(Scalar(0));
            const std::size_t guard = events_.start(x_, t_);
            if (guard != G) return end_at(Status::event, guard);
        }
        if (to_ == from_) return end(Status::success);
        if constexpr (G > 0) leave_zero();
        switch (options_.method) {
            case Method::rk4: return fixed_steps();
            case Method::dopri5: return dense_steps(true);
            case Method::dopri5_controlled: return dense_steps(false);
            case Method::fehlberg78: return controlled_steps();
        }
        return end(Status::bad_options);
    }

private:
    using Try = Candidate<State>;

    void evaluate(const State& x, Scalar t, State& dxdt) {
        if constexpr (G > 0) events_.see(x, t);
        ++outcome_.rhs_calls;
        rhs_(x, t, dxdt);
    }

    Outcome end(Status status) {
        outcome_.status = status;
        outcome_.t = static_cast<double>(t_);
        return outcome_;
    }

    Outcome end_at(Status status, std::size_t guard) {
        outcome_.guard = guard;
        return end(status);
    }

    /// The state where the run is, as that at the time t: the same but for a few last digits.
    void observe(Scalar t) {
        observe_(t, x_);
        observed_ = t_;
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
        if constexpr (G > 0) {
            const std::size_t here = events_.not_a_number(x_, t_);
            const std::size_t guard = here != G ? here : events_.not_a_number(ahead, t_ + further);
            if (i == N && guard != G) outcome_.guard = guard;
        }
        outcome_.state = i;
        return end(Status::not_finite);
    }

    /// A step that cannot be made next to the zero of a guard that ends the run ends there.
    Outcome stop(Status status) {
        if constexpr (G > 0) {
            const bool is_stuck = status == Status::not_finite || status == Status::step_too_small;
            const std::size_t guard = is_stuck ? events_.vanishing_guard(x_, t_) : G;
            if (guard != G) {
                if (observed_ != t_) observe(t_);
                return end_at(Status::event, guard);
            }
        }
        return stop_there(status);
    }
    Outcome stop_there(Status status) { return status == Status::not_finite ? end_not_finite(Scalar(64) * smallest_step()) : end(status); }

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
        const auto take = [&](Try& c) {
            c.error = State{};
            stepper.do_step(f, x_, dxdt_, t_, c.y, c.length);
            c.has_derivative = false;
            c.finite = good(c.y, c.y);
        };
        for (std::size_t i = 1; i <= options_.intervals; ++i) {
            while (t_ < output_time(i)) {
                const Scalar begin = t_;
                const Scalar length = output_time(i) - begin;
                using std::ceil;
                const auto count = static_cast<std::size_t>(std::max(1.0, static_cast<double>(ceil(length / options_.step * (Scalar(1) - Scalar(1e-9))))));
                const Scalar h = length / Scalar(static_cast<double>(count));
                for (std::size_t k = 0; k < count; ++k) {
                    if (outcome_.steps == options_.max_steps) return end(Status::too_many_steps);
                    Try c;
                    c.length = h;
                    c.end = k + 1 == count ? output_time(i) : begin + h * Scalar(static_cast<double>(k + 1));
                    try_step(c, take, [this](Try& step, Scalar t, State& x) { interpolate(step, t, x); });
                    if (!c.finite) return end_not_finite(h);
                    accept(c);
                    if (is_cut()) break;
                }
                const Status status = pass_event();
                if (status != Status::success) return stop(status);
            }
            observe(output_time(i));
        }
        return end(Status::success);
    }

    /// One step that can be accepted, of at most h and not beyond `target`; leaves the size of the next one in h.
    template <class Take, class Between>
    Status acceptable_step(Scalar& h, Scalar target, int order, Try& c, Take take, Between between) {
        const Scalar limit = target - t_;
        bool not_finite = false;
        while (true) {
            if (outcome_.steps + outcome_.rejected >= options_.max_steps) return Status::too_many_steps;
            if (options_.max_step > Scalar(0) && h > options_.max_step) h = options_.max_step;
            bool clipped = h >= limit;
            c.length = clipped ? limit : h;
            c.end = clipped ? target : t_ + c.length;
            if (!(c.length > smallest_step()) && !clipped) return not_finite ? Status::not_finite : Status::step_too_small;
            try_step(c, take, between);
            clipped = clipped || is_cut();
            if (!c.finite) {
                not_finite = true;
                ++outcome_.rejected;
                h = c.length / Scalar(4);
                continue;
            }
            const Scalar e = error_norm(c.error, c.y);
            if (!(e <= Scalar(1))) {
                using std::max;
                using std::pow;
                ++outcome_.rejected;
                h = c.length * max(Scalar(1) / Scalar(10), Scalar(9) / Scalar(10) * pow(e, -Scalar(1) / Scalar(order)));
                continue;
            }
            if constexpr (G > 0) {
                if (!events_.keeps_rest(c.y, c.end)) {
                    ++outcome_.rejected;
                    h = c.length / Scalar(4);
                    continue;
                }
            }
            // After a step that was cut to end on an output point, the size from before is as good a guess as ever.
            const Scalar factor = step_factor(e, order);
            h = clipped ? std::max(h, c.length * factor) : c.length * factor;
            last_error_ = std::max(e, Scalar(1) / Scalar(10000));
            return Status::success;
        }
    }

    Outcome controlled_steps() {
        constexpr int order = 8;
        On<odeint::runge_kutta_fehlberg78> stepper;
        auto f = [this](const State& x, State& dxdt, Scalar t) { evaluate(x, t, dxdt); };
        const auto take = [&](Try& c) {
            stepper.do_step(f, x_, dxdt_, t_, c.y, c.length, c.error);
            c.has_derivative = false;
            c.finite = good(c.y, c.error);
        };
        Scalar h = first_step(order);
        for (std::size_t i = 1; i <= options_.intervals; ++i) {
            const Scalar target = output_time(i);
            while (t_ < target) {
                Try c;
                Status status = acceptable_step(h, target, order, c, take, [this](Try& step, Scalar t, State& x) { interpolate(step, t, x); });
                if (status != Status::success) return stop(status);
                accept(c);
                status = pass_event();
                if (status != Status::success) return stop(status);
                if (!good(x_, dxdt_)) return end_not_finite(Scalar(0));
                if (is_anew_) h = first_step(order);
            }
            observe(output_time(i));
        }
        return end(Status::success);
    }

    /// The last stage of a Dormand-Prince step is the first of the next; with dense output steps need not end on output points.
    Outcome dense_steps(bool dense) {
        constexpr int order = 5;
        On<odeint::runge_kutta_dopri5> stepper;
        auto f = [this](const State& x, State& dxdt, Scalar t) { evaluate(x, t, dxdt); };
        const auto take = [&](Try& c) {
            stepper.do_step(f, x_, dxdt_, t_, c.y, c.dydt, c.length, c.error);
            c.has_derivative = true;
            c.finite = good(c.y, c.error) && good(c.dydt, c.dydt);
        };
        const auto between = [&](const Try& c, Scalar t, State& x) { stepper.calc_state(t, x, x_, dxdt_, t_, c.y, c.dydt, c.end); };
        Scalar h = first_step(order);
        std::size_t next = 1;
        while (next <= options_.intervals) {
            Try c;
            Status status = acceptable_step(h, dense ? to_ : output_time(next), order, c, take, between);
            if (status != Status::success) return stop(status);
            for (; next <= options_.intervals && output_time(next) < c.end; ++next) {
                State x;
                between(c, output_time(next), x);
                observe_(output_time(next), x);
            }
            accept(c);
            observe_up_to_now(next);
            status = pass_event();
            if (status != Status::success) return stop(status);
            if (!is_anew_) continue;
            h = first_step(order);
            observe_up_to_now(next);
        }
        return end(Status::success);
    }

    void observe_up_to_now(std::size_t& next) {
        for (; next <= options_.intervals && output_time(next) <= t_; ++next) observe(output_time(next));
    }

    void accept(const Try& c) {
        if (c.length > Scalar(0)) ++outcome_.steps;
        t_ = c.end;
        x_ = c.y;
        if constexpr (G > 0) events_.accept();
        if (c.has_derivative || is_at_end()) dxdt_ = c.dydt;
        else evaluate(x_, t_, dxdt_);
    }

    bool is_cut() const {
        if constexpr (G > 0) return events_.is_cut();
        else return false;
    }
    /// A guard that ends the run is behind the step that was cut. On the zero itself the right-hand side may have no value.
    bool is_at_end() const {
        if constexpr (G > 0) return events_.is_cut() && events_.ending_guard() != G;
        else return false;
    }

    /// Makes the step; with guards, only up to its first event.
    template <class Take, class Between>
    void try_step(Try& c, Take& take, Between between) {
        if constexpr (G == 0) {
            take(c);
        } else {
            using std::abs;
            using std::max;
            const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
            const Scalar resolution = epsilon * max(Scalar(abs(c.end)), Scalar(epsilon * (to_ - from_)));
            const auto accurate = [this](const Try& step) { return error_norm(step.error, step.y) <= Scalar(1); };
            events_.search(c, x_, t_, tiny_step(), resolution, take, between, accurate);
        }
    }

    /// A step so short that it does no harm when its stages lie on both sides of a jump.
    Scalar tiny_step() const { return Scalar(64) * smallest_step(); }

    /// The cubic polynomial through both ends of a step with their derivatives.
    void interpolate(Try& c, Scalar t, State& x) {
        if (!c.has_derivative) evaluate(c.y, c.end, c.dydt);
        c.has_derivative = true;
        const Scalar s = (t - t_) / c.length;
        const Scalar r = Scalar(1) - s;
        for (std::size_t i = 0; i < N; ++i)
            x[i] = r * r * (Scalar(1) + Scalar(2) * s) * x_[i] + s * s * (Scalar(1) + Scalar(2) * r) * c.y[i] + r * s * c.length * (r * dxdt_[i] - s * c.dydt[i]);
    }

    /// On its zero a jump may have a value that holds on neither side: a run that starts there starts just behind it.
    void leave_zero() {
        using std::abs;
        using std::max;
        const Scalar ahead = Scalar(16) * std::numeric_limits<Scalar>::epsilon() * max(Scalar(abs(t_)), Scalar(to_ - from_));
        if (!events_.is_on_zero() || !(t_ + ahead < to_)) return;
        State x;
        State dxdt;
        for (std::size_t i = 0; i < N; ++i) x[i] = x_[i] + ahead * dxdt_[i];
        evaluate(x, t_ + ahead, dxdt);
        if (!good(x, dxdt) || !events_.leave_zero(x, t_ + ahead)) return;
        t_ += ahead;
        x_ = x;
        dxdt_ = dxdt;
    }

    /// At the end of a step that was cut for an event: ends the run there, or starts anew behind it.
    Status pass_event() {
        if constexpr (G > 0) {
            is_anew_ = false;
            if (!is_cut()) return Status::success;
            Scalar t = t_;
            State x = x_;
            if (events_.ending_guard() == G && !find_other_side(t, x)) {
                events_.retract();
                return Status::success;
            }
            const std::size_t ending = events_.ending_guard();
            if (ending != G) {
                outcome_.guard = ending;
                if (observed_ != t_) observe(t_);
                return Status::event;
            }
            is_anew_ = true;
            t_ = t;
            x_ = x;
            const std::size_t changed = events_.changed_guard();
            outcome_.events += events_.pass(t_);
            stalled_ = outcome_.events > 1 && !(t_ - last_event_ > smallest_step()) ? stalled_ + 1 : 0;
            last_event_ = t_;
            last_error_ = Scalar(1);
            evaluate(x_, t_, dxdt_);
            if (!good(x_, dxdt_)) return Status::not_finite;
            if (outcome_.events > options_.max_events || stalled_ > 100 + G) {
                outcome_.guard = changed;
                return Status::event_storm;
            }
        }
        return Status::success;
    }

    /// The first point behind the event along dx/dt. What the longer step reached there may have used the right-hand side of the other
    /// side; it is taken only where that makes no difference. If neither is there, the event is yet to come.
    bool find_other_side(Scalar& t, State& x) {
        using std::abs;
        using std::max;
        const Try& behind = events_.behind();
        for (Scalar ahead = behind.end - t_; good(dxdt_, dxdt_) && ahead <= tiny_step() && t_ + ahead <= to_; ahead *= Scalar(2)) {
            t = t_ + ahead;
            for (std::size_t i = 0; i < N; ++i) x[i] = x_[i] + ahead * dxdt_[i];
            if (events_.has_changed_at(x, t)) return true;
        }
        bool is_near = behind.finite;
        for (std::size_t i = 0; i < N; ++i) {
            const Scalar size = max(options_.scale[i], Scalar(abs(x_[i])));
            is_near = is_near && abs(behind.y[i] - x_[i]) <= Scalar(64) * std::numeric_limits<Scalar>::epsilon() * size;
        }
        t = behind.end;
        x = behind.y;
        return behind.finite && events_.has_changed() && (is_near || behind.length <= tiny_step() || !events_.can_retract());
    }

    Rhs& rhs_;
    State& x_;
    Scalar from_, to_, t_;
    const IntegrationOptions<State>& options_;
    Observer& observe_;
    State dxdt_{};
    Outcome outcome_;
    Scalar last_error_ = Scalar(1);
    Scalar observed_ = Scalar(0);  ///< s, of the last observation of the state where the run is
    EventSearch<State, Guards, G> events_;
    Scalar last_event_ = Scalar(0);
    bool is_anew_ = false;     ///< integration has just started anew
    std::size_t stalled_ = 0;  ///< events in a row without progress in time
};

}  // namespace detail

/// Integrates dx/dt = rhs(x, t, dxdt) from `from` to `to`. `x` holds the start and afterwards the last good state.
/// Calls observe(t, x) at the output points.
///
/// guards(x, t, g) writes functions whose sign matters into an array. Where one changes its sign, the step is cut:
/// ends[i] = true: the model holds only where g[i] >= 0. The run ends there with Status::event; x is the last state with g[i] >= 0, and
/// is observed. A start with g[i] < 0 is such an end.
/// ends[i] = false: the right-hand side has a kink, a jump or an infinite slope there. Integration starts anew just behind it.
/// Times are found down to neighbouring numbers, in steps repeated with other lengths: the work of ten to twenty steps for an event, up
/// to sixty at a jump. Guards that change together are passed together; one that ends the run comes first. Output points are observed
/// once each, whatever lies on them. A guard that begins at zero, or touches zero, has not changed. A guard that is not a number makes
/// a step as bad as a state that is not; infinite ones are allowed.
/// Guards are looked at in the stages of a step, at its end, and at three points between, in its interpolation. What changes and changes
/// back between two of these is missed; options.max_step puts them closer together. Sliding along a zero, as a relay does whose two
/// sides both lead back to it, is an event storm.
template <class State, class Rhs, class Observer, class Guards, std::size_t G>
Outcome integrate(Rhs&& rhs, State& x, typename State::value_type from, typename State::value_type to, const IntegrationOptions<State>& options, Observer&& observe,
                  Guards&& guards, const std::array<bool, G>& ends) {
    using Run = detail::Integration<State, std::remove_reference_t<Rhs>, std::remove_reference_t<Observer>, std::remove_reference_t<Guards>, G>;
    return Run(rhs, x, from, to, options, observe, guards, ends).run();
}

/// The same without guards.
template <class State, class Rhs, class Observer>
Outcome integrate(Rhs&& rhs, State& x, typename State::value_type from, typename State::value_type to, const IntegrationOptions<State>& options, Observer&& observe) {
    return integrate(rhs, x, from, to, options, observe, detail::NoGuards{}, std::array<bool, 0>{});
}

}  // namespace v1
}  // namespace dalembert
