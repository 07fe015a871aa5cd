// SPDX-License-Identifier: BSL-1.0
// Drives a stepper from the start of a run to its end: which steps are taken, and what is observed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "dalembert/events/watched_run.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Integrates; the observer is called at the output points in order.
template <class StateOfRun, class Rhs, class Observer, class Guards, class Values>
class Integration : WatchedRun<StateOfRun, Rhs, Observer, Guards, Values> {
    using Run = WatchedRun<StateOfRun, Rhs, Observer, Guards, Values>;
    using Run::evaluate, Run::end, Run::end_at, Run::end_not_finite, Run::stop, Run::observe, Run::here, Run::try_step, Run::accept,
        Run::is_cut, Run::keeps_rest, Run::pass_event, Run::pass_kink;
    using Run::x_, Run::dxdt_, Run::t_, Run::from_, Run::to_, Run::options_, Run::control_, Run::outcome_, Run::events_, Run::observe_,
        Run::stepper_, Run::is_anew_;
    using typename Run::Try;

public:
    using typename Run::Scalar;
    using typename Run::State;

    using Run::Run;

    using GivenRhs = Rhs;
    /// The right-hand side as steppers call it.
    struct RightHandSide {
        Integration* run;
        void operator()(const State& x, State& dxdt, Scalar t) const { run->evaluate(x, t, dxdt); }
    };
    RightHandSide right_hand_side() { return {this}; }

    /// The run is a part of a longer one, up to a guard behind which the right-hand side would go on smoothly. Of the output points of the
    /// whole those from number `next` on are observed, besides both ends of the part.
    void be_part(const OutputPoints<State>& outputs, std::size_t next) {
        control_.set_outputs(outputs);
        next_ = next;
        if constexpr (may_have_entries<Values>) events_.spare_stages();
    }

    /// Where the run is, in s; Outcome has no more digits than a double.
    Scalar time() const { return t_; }

    /// For a method that cannot be used.
    Outcome refuse(Status status = Status::bad_options) { return end(status); }

    const IntegrationOptions<State>& options() const { return options_; }

    Outcome go(Stepper<State>& stepper, Steps steps) {
        stepper_ = &stepper;
        if (!control_.are_options_good()) return refuse();
        // Before projection, which spreads what is no number over all states.
        if (!are_finite(x_, x_)) return end_not_finite(Scalar(0));
        this->project(x_, t_);
        if (this->is_broken()) return end(Status::constraint_broken);
        this->act();
        evaluate(x_, t_, dxdt_);
        if (!are_finite(x_, dxdt_)) return end_not_finite(Scalar(0));
        observe(t_);
        if constexpr (may_have_entries<Values>) {
            if (events_.not_a_number(x_, t_) != Run::guard_count()) return end_not_finite(Scalar(0));
            const std::size_t guard = events_.start(x_, t_);
            if (guard != Run::guard_count()) return end_at(Status::event, guard);
        }
        if (to_ == from_) return end(Status::success);
        if constexpr (may_have_entries<Values>) this->leave_zero();
        switch (options_.has_fixed_steps() ? Steps::fixed : steps) {
            case Steps::fixed:
                return fixed_steps();
            case Steps::to_outputs:
                return controlled_steps(false);
            case Steps::dense:
                return controlled_steps(true);
        }
        return refuse();
    }

private:
    Outcome fixed_steps() {
        using std::ceil;
        for (std::size_t i = next_; i <= options_.output_count();) {
            if (!(t_ < control_.output_time(i))) {
                observe(control_.output_time(i));
                ++i;
                continue;
            }
            // Kinks are stepped over, but not instants at which somebody acts.
            const auto instant = control_.next_kink(t_);
            const Scalar target = options_.clock != nullptr ? std::min(control_.output_time(i), instant.before) : control_.output_time(i);
            const Scalar begin = t_;
            const Scalar length = target - begin;
            const Scalar wanted = ceil(length / options_.step * (Scalar(1) - Scalar(1e-9)));
            if (!(wanted <= Scalar(static_cast<double>(options_.max_steps)))) return end(Status::too_many_steps);
            const auto count = static_cast<std::size_t>(std::max(1.0, static_cast<double>(wanted)));
            const Scalar h = length / Scalar(static_cast<double>(count));
            bool is_crossed = false;
            for (std::size_t k = 0; k < count; ++k) {
                if (outcome_.steps == options_.max_steps) return end(Status::too_many_steps);
                Scalar way = to_;
                const Ahead ahead = this->look_ahead(h, control_.next_kink(t_).before, way, outputs_inside(i));
                if (ahead == Ahead::stuck) return stop(Status::singular_position);
                is_crossed = ahead == Ahead::crossed;
                if (is_crossed) break;
                Try c;
                c.length = h;
                c.end = k + 1 == count ? target : begin + h * Scalar(static_cast<double>(k + 1));
                try_step(c);
                if (!c.finite) return this->named(end_not_finite(h));
                if (ahead == Ahead::nearer && this->ends_on(c)) return stop(Status::singular_position);
                accept(c);
                if (is_cut()) break;
            }
            if (is_crossed) continue;
            Status status = pass_event();
            if (status == Status::success && options_.clock != nullptr && t_ == instant.before && t_ < to_)
                status = pass_kink(instant.behind);
            if (status != Status::success) return stop(status);
        }
        return end(Status::success);
    }

    /// Observes output points within a step that at(t) knows the states of.
    auto outputs_inside(std::size_t& next) {
        return [this, &next](const Scalar& until, const auto& at) {
            for (; next <= options_.output_count() && control_.output_time(next) < until; ++next)
                observe_(control_.output_time(next), at(control_.output_time(next)));
        };
    }

    /// With dense output steps need not end on output points.
    Outcome controlled_steps(bool dense) {
        Scalar h = control_.first(x_, dxdt_, stepper_->order());
        std::size_t next = next_;
        while (next <= options_.output_count()) {
            Try c;
            const auto kink = control_.next_kink(t_);
            Scalar target = std::min(dense ? to_ : control_.output_time(next), kink.before);
            const Ahead ahead = this->look_ahead(h, kink.before, target, outputs_inside(next));
            if (ahead == Ahead::stuck) return stop(Status::singular_position);
            Status status = Status::success;
            if (ahead != Ahead::crossed) {
                status = acceptable_step(h, target, c);
                if (status != Status::success) return stop(status);
                outputs_inside(next)(c.end, [&](const Scalar& t) {
                    State x;
                    stepper_->between(here(), c, t, x);
                    if (!this->is_close(x, t)) this->project(x, t);
                    return x;
                });
                accept(c);
                observe_up_to_now(next);
                status = pass_event();
                if (status != Status::success) return stop(status);
            } else {
                is_anew_ = false;
                observe_up_to_now(next);
            }
            if (t_ == kink.before && t_ < to_) {
                status = pass_kink(kink.behind);
                observe_up_to_now(next);
                if (status != Status::success) return stop(status);
            }
            if (!are_finite(x_, dxdt_)) return end_not_finite(Scalar(0));
            if (!is_anew_) continue;
            h = control_.first(x_, dxdt_, stepper_->order());
            observe_up_to_now(next);
        }
        return end(Status::success);
    }

    /// One step that can be accepted, of at most h and not beyond `target`; leaves the size of the next one in h.
    Status acceptable_step(Scalar& h, Scalar target, Try& c) {
        const Scalar limit = target - t_;
        bool not_finite = false;
        h = stepper_->suggested(here(), h);
        while (true) {
            if (outcome_.steps + outcome_.rejected >= options_.max_steps || is_hopeless()) {
                outcome_.guard = this->resting_guard();
                return Status::too_many_steps;
            }
            if (options_.max_step > Scalar(0) && h > options_.max_step) h = options_.max_step;
            bool clipped = h >= limit;
            c.length = clipped ? limit : h;
            c.end = clipped ? target : t_ + c.length;
            if (!(c.length > control_.smallest(t_)) && !clipped) return not_finite ? Status::not_finite : Status::step_too_small;
            try_step(c);
            clipped = clipped || is_cut();
            if (c.finite && is_cut()) stepper_->check_cut(here(), c);
            else if (c.finite) stepper_->check(here(), c);
            const Scalar e = c.finite ? control_.error_norm(x_, c.y, c.error) : Scalar(0);
            if (!c.finite || !(e <= Scalar(1)) || !keeps_rest(c) || (!is_cut() && (this->ends_close(c) || this->is_moved_far(c)))) {
                not_finite = not_finite || !c.finite;
                if (c.finite) outcome_.state = control_.worst(x_, c.y, c.error);
                ++outcome_.rejected;
                h = c.length * (e <= Scalar(1) ? Scalar(1) / Scalar(4) : control_.factor_of_failure(e, stepper_->order()));
                continue;
            }
            // After a step that was cut to end on an output point, the size from before is as good a guess as ever.
            const Scalar factor = control_.factor(e, stepper_->order());
            h = clipped ? std::max(h, c.length * factor) : c.length * factor;
            return Status::success;
        }
    }

    /// Whether the rest of the run takes more than max_steps at the pace of the last 2 million, so that it ends in seconds and not in
    /// minutes.
    bool is_hopeless() {
        const std::size_t looked_at = this->resting_guard() == Outcome::none ? 2000000 : 500000;
        const std::size_t tries = outcome_.steps + outcome_.rejected;
        if (tries - tries_at_mark_ < looked_at) return false;
        const Scalar pace = (t_ - mark_) / Scalar(static_cast<double>(tries - tries_at_mark_));
        mark_ = t_;
        tries_at_mark_ = tries;
        return pace * Scalar(static_cast<double>(options_.max_steps)) < to_ - t_;
    }

    void observe_up_to_now(std::size_t& next) {
        for (; next <= options_.output_count() && control_.output_time(next) <= t_; ++next) observe(control_.output_time(next));
    }

    std::size_t next_ = 1;  ///< the first output point behind the start
    Scalar mark_ = t_;      ///< time of the last look at the pace
    std::size_t tries_at_mark_ = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
