// SPDX-License-Identifier: BSL-1.0
// Several motions in time at once, one in each lane of a pack: every lane has a time, a step and an end of its own.
#pragma once

#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include "dalembert/constraints.hpp"
#include "dalembert/methods/step_control.hpp"
#include "dalembert/pack.hpp"
#include "dalembert/scales.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Dormand and Prince's method 5(4). A lane that has ended goes along with steps of no length.
template <class System, class Inputs>
class LaneRun {
    static_assert(!is_switching<System>, "lanes are in one mode: take OneMode, or run machines with modes one by one");
    static_assert(!needs_projection<System>, "constraints are not held in lanes; run such machines one by one");

public:
    using Number = typename System::scalar_type;
    using Lane = typename Number::value_type;
    using Mask = typename Number::batch_bool_type;
    using State = typename System::State;
    using Guards = typename System::Guards;
    static constexpr std::size_t lanes = Number::size, state_count = std::tuple_size<State>::value,
                                 guard_count = std::tuple_size<Guards>::value;
    using Options = IntegrationOptions<std::array<Lane, state_count>>;

    LaneRun(const System& system, const Inputs& inputs, State& x, Lane from, Lane to, const Options& options)
        : system_(system), inputs_(inputs), options_(options), from_(from), to_(to), x_(x), t_(from), active_(true) {}

    std::array<Outcome, lanes> run() {
        const StepControl<std::array<Lane, state_count>> control(options_, from_, to_);
        const bool is_known = options_.method == Method::automatic || options_.method == Method::dopri5;
        if (!is_known || options_.has_fixed_steps() || !control.are_options_good()) return retired(Status::bad_options);
        rate(x_, dxdt_, t_);
        std::array<std::array<Lane, 1>, lanes> first;
        for (std::size_t lane = 0; lane < lanes; ++lane) first[lane][0] = control.first(lane_of(x_, lane), lane_of(dxdt_, lane), 5);
        h_ = packed<Number>(first)[0];
        end_at_guards(t_, x_, Number(Lane(0)), active_);
        if (!(to_ > from_)) retire(active_, Status::success);
        for (std::size_t step = 0; any(active_) && step < options_.max_steps; ++step) advance();
        retire(active_, Status::too_many_steps);
        return outcomes_;
    }

private:
    void rate(const State& x, State& dxdt, const Number& t) const { system_.rhs(x, inputs_(x, t), t, dxdt); }

    void advance() {
        const Number longest(options_.max_step > Lane(0) ? options_.max_step : to_ - from_), left = Number(to_) - t_;
        const Mask is_last = left <= min(h_, longest) * Number(Lane(1) + Lane(1) / Lane(1000));
        const Number h = select(active_, select(is_last, left, min(h_, longest)), Number(Lane(0)));
        const auto rhs = [this](const State& x, State& dxdt, const Number& t) { rate(x, dxdt, t); };
        stepper_.do_step(rhs, x_, dxdt_, t_, y_, dydt_, h, error_);
        const Number norm = error_norm();
        const Mask accepted = active_ & (norm <= Number(Lane(1)));
        const Number after = select(is_last, Number(to_), t_ + h);
        end_at_guards(after, y_, h, accepted);
        const Mask goes_on = accepted & active_;
        for (std::size_t i = 0; i < state_count; ++i) {
            x_[i] = select(goes_on, y_[i], x_[i]);
            dxdt_[i] = select(goes_on, dydt_[i], dxdt_[i]);
        }
        t_ = select(goes_on, after, t_);
        next_step(h, norm, accepted);
        count(accepted, active_ & !accepted);
        retire(goes_on & is_last, Status::success);
        const Number smallest = Number(Lane(16) * std::numeric_limits<Lane>::epsilon()) *
                                max(abs(t_), Number((to_ - from_) * std::numeric_limits<Lane>::epsilon()));
        const Mask stuck = active_ & !accepted & !(h_ >= smallest);  // also where the step is no number
        const Mask has_value = norm < Number(std::numeric_limits<Lane>::infinity());
        retire(stuck & has_value, Status::step_too_small);
        retire(stuck & !has_value, Status::not_finite);
    }

    /// Infinite where anything is no number.
    Number error_norm() const {
        Number largest(Lane(0));
        Mask is_number(true);
        for (std::size_t i = 0; i < state_count; ++i) {
            const Number ratio =
                abs(error_[i]) / (Number(options_.tolerance) * max(Number(options_.scale[i]), max(abs(x_[i]), abs(y_[i]))));
            is_number = is_number & (ratio < Number(std::numeric_limits<Lane>::infinity()));
            largest = max(largest, ratio);
        }
        return select(is_number, largest, Number(std::numeric_limits<Lane>::infinity()));
    }

    /// As StepControl::factor and factor_of_failure have it.
    void next_step(const Number& h, const Number& norm, const Mask& accepted) {
        const Number e = log(max(min(norm, Number(Lane(1e30))), Number(Lane(1) / Lane(10000))));
        const Number better =
            min(Number(Lane(5)), max(Number(Lane(1) / Lane(5)),
                                     Number(Lane(0.9)) * exp((Number(Lane(4)) * last_error_ - Number(Lane(7)) * e) / Number(Lane(50)))));
        const Number worse = max(Number(Lane(0.1)), Number(Lane(0.9)) * exp(e / Number(Lane(-5))));
        h_ = h * select(accepted, better, worse);
        last_error_ = select(accepted, e, last_error_);
    }

    /// Lanes in which a guard that ends the run is negative end where it became so, within the step that was made.
    void end_at_guards(const Number& after, const State& y, const Number& h, const Mask& where) {
        if constexpr (guard_count > 0) {
            const Mask ended = where & is_beyond(y, after);
            if (!any(ended)) return;
            Number low = t_, high = after;
            const Mask within = ended & (h > Number(Lane(0)));
            for (int k = 0; k < std::numeric_limits<Lane>::digits && any(within); ++k) {
                const Number middle = (low + high) / Number(Lane(2));
                const Mask beyond = is_beyond(between(middle, after, h), middle);
                high = select(beyond, middle, high);
                low = select(beyond, low, middle);
            }
            const State at_end = any(within) ? between(low, after, h) : y;
            const State behind = any(within) ? between(high, after, h) : y;
            Guards g;
            system_.guards(behind, inputs_(behind, high), high, g);
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                if (!ended.get(lane)) continue;
                std::size_t guard = 0;
                while (guard < guard_count && !(System::guard_table()[guard].ends && g[guard].get(lane) < Lane(0))) ++guard;
                outcomes_[lane].guard = guard < guard_count ? guard : Outcome::none;
            }
            for (std::size_t i = 0; i < state_count; ++i) x_[i] = select(within, at_end[i], x_[i]);
            t_ = select(within, low, t_);
            retire(ended, Status::event);
        }
    }

    Mask is_beyond(const State& x, const Number& t) const {
        Guards g;
        system_.guards(x, inputs_(x, t), t, g);
        Mask result(false);
        for (std::size_t k = 0; k < guard_count; ++k)
            if (System::guard_table()[k].ends) result = result | (g[k] < Number(Lane(0)));
        return result;
    }

    /// The dense output of the step. Lanes without one keep what they have.
    State between(const Number& t, const Number& after, const Number& h) {
        State z;
        stepper_.calc_state(t, z, x_, dxdt_, t_, y_, dydt_, after);
        for (std::size_t i = 0; i < state_count; ++i) z[i] = select(h > Number(Lane(0)), z[i], x_[i]);
        return z;
    }

    void count(const Mask& accepted, const Mask& rejected) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            outcomes_[lane].steps += accepted.get(lane) ? 1 : 0;
            outcomes_[lane].rejected += rejected.get(lane) ? 1 : 0;
        }
    }

    void retire(const Mask& which, Status status) {
        if (!any(which)) return;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (!which.get(lane)) continue;
            Outcome& outcome = outcomes_[lane];
            outcome.status = status;
            outcome.t = static_cast<double>(t_.get(lane));
            outcome.rhs_calls = 1 + 6 * (outcome.steps + outcome.rejected);
            if (status == Status::not_finite)
                while (outcome.state + 1 < state_count && std::isfinite(error_[outcome.state].get(lane))) ++outcome.state;
        }
        active_ = active_ & !which;
    }

    std::array<Outcome, lanes> retired(Status status) {
        retire(active_, status);
        return outcomes_;
    }

    const System& system_;
    const Inputs& inputs_;
    const Options& options_;
    Lane from_, to_;
    State& x_;
    State dxdt_{}, y_{}, dydt_{}, error_{};
    Number t_, h_ = Number(Lane(0)), last_error_ = Number(Lane(0));
    Mask active_;
    std::array<Outcome, lanes> outcomes_{};
    boost::numeric::odeint::runge_kutta_dopri5<State, Number, State, Number, boost::numeric::odeint::array_algebra> stepper_;
};

}  // namespace detail

/// Integrates `system`, whose Scalar is a pack, from `from` to `to`: x holds the start of every lane, and afterwards its end. Each lane
/// ends independently: at `to`, at a guard that ends runs (Status::event, found within the step), or where it cannot go on. `inputs` is
/// called as inputs(x, t) with packs. The options tolerance, scale, step, max_step and max_steps count; kinks are not located, only the
/// error of the steps is controlled.
template <class System, class Inputs>
auto integrate_lanes(const System& system, const Inputs& inputs, typename System::State& x, typename System::scalar_type::value_type from,
                     typename System::scalar_type::value_type to, const typename detail::LaneRun<System, Inputs>::Options& options) {
    return detail::LaneRun<System, Inputs>(system, inputs, x, from, to, options).run();
}

}  // namespace v1
}  // namespace dalembert
