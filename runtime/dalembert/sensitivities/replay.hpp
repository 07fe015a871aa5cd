// SPDX-License-Identifier: BSL-1.0
// Sensitivities of a run that is made beside: with modes, events, constraints, kinks.
//
// note [jumps]: Where the motion changes at a time t* that depends on what is varied, S jumps. With the rates f- before and f+ behind, and
// the change of the state x+ = R(x-, t*, p): S+ = R_x (S- + f- t') + R_p + R_t t' - f+ t', where t' = dt*/d(varied). Where a guard g falls
// through zero, t' = -(g_x S- + g_p)/(dg/dt along the motion). An event that another one causes happens when that one does; the last of
// infinitely many when the one before; an event at the start, or when inputs jump, at a fixed time. R and g are differentiated by
// differences of order four along (S, t', p): they cost nothing beside the run, and keep about eleven digits.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "dalembert/sensitivities/replay_kinks.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Integrates the state and S from one point of the run to the next, in the mode of the run; the state is then that of the run.
template <class System, class Inputs, class List>
class Replay : public ReplayKinks<System, Inputs, List> {
    using Base = ReplayKinks<System, Inputs, List>;

public:
    using Base::Base;
    using typename Base::Mode, typename Base::Plain, typename Base::Scalar;

    /// A point of the run. Where its state is not known, that which comes with S stays as it is.
    struct Point {
        Scalar t;
        Plain x;
        bool is_known = true;
    };

    /// There is no run that ended in time where the model does: Status::event.
    void watch_ends() { watches_ends_ = true; }

    /// To the point (t, x) of the run.
    void advance(Scalar t, const Plain& x, Mode mode = {}) {
        const Point point{t, x, true};
        advance_along(&point, &point + 1, mode, [](const Point&) {});
    }

    /// To the last of some points of the run, between which nothing happens. Calls seen(point) at each of them, when S is that there: in
    /// one integration, whose steps do not end on the points. The state that comes with S is that of the run at the last point, if it is
    /// known; at the others it is as near to it as the error of the steps.
    template <class Seen>
    void advance_along(const Point* points, const Point* end, Mode mode, const Seen& seen) {
        if (outcome_.status != Status::success || points == end) return;
        if (!knows_sides_ || mode != mode_) find_sides(mode);
        next_ = points;
        end_ = end;
        const Scalar last = end[-1].t;
        while (outcome_.status == Status::success) {
            for (; next_ != end_ && next_->t <= t_; ++next_) {
                t_ = next_->t;
                if (next_->is_known) x_ = next_->x;
                seen(*next_);
            }
            if (next_ == end_) return;
            // No step sees the instant around a kink at a known time: rates are those where it begins and ends.
            const Scalar* kink = known_kinks_.next(t_);
            if (kink == nullptr || last <= *kink - instant(*kink)) {
                go_on(last, seen);
            } else if (t_ < *kink - instant(*kink)) {
                go_on(*kink - instant(*kink), seen);
            } else if (t_ < *kink) {
                creep(std::min(next_->t, *kink), t_);
                if (t_ == *kink) pass_known_kink(*kink);
            } else {
                const Scalar behind = std::min(next_->t, Scalar(*kink + instant(*kink)));
                creep(behind, behind);
            }
        }
    }

    /// Over an event of the run, with the states before and behind it.
    void change(Scalar t, std::size_t event, Mode from, Mode to, const Plain& before, const Plain& after, bool is_accumulation) {
        advance(t, before, from);
        if (outcome_.status != Status::success) return;
        shift_ = times_of_event(event, from, is_accumulation);
        if (outcome_.status != Status::success) return;
        const Plain rate_before = rate(from, before, t), rate_after = rate(to, after, t);
        for (std::size_t c = 0; c < varied_.size(); ++c) {
            const Scalar shift = shift_[c];
            Plain s = S_[c];
            for (std::size_t i = 0; i < s.size(); ++i) s[i] += rate_before[i] * shift;
            s = through_reset(c, s, shift, event, from, is_accumulation);
            for (std::size_t i = 0; i < s.size(); ++i) s[i] -= rate_after[i] * shift;
            S_[c] = s;
        }
        x_ = after;
        time_of_last_ = t;
        has_last_ = true;
        knows_sides_ = false;
    }

private:
    using typename Base::All, typename Base::Asked, typename Base::Kinks, typename Base::Motion, typename Base::Sides;
    template <class T>
    using ColumnsOf = typename Base::template ColumnsOf<T>;
    using Base::fail, Base::find_sides, Base::held, Base::here, Base::instant, Base::kinks_at, Base::motion_here, Base::pass_kink,
        Base::pass_known_kink, Base::rate, Base::set_scales, Base::take, Base::times_of_zero, Base::together;
    using Base::controls_, Base::from_, Base::inputs_, Base::known_kinks_, Base::knows_sides_, Base::mode_, Base::moved_,
        Base::options_, Base::outcome_, Base::S_, Base::scale_, Base::span_, Base::system_, Base::t_, Base::varied_, Base::x_;

    /// Next to no time, with the rates at the time `at`. Where constraints may depend on each other, these have no digits, and S rests.
    void creep(const Scalar& to, const Scalar& at) {
        if constexpr (can_be_singular<System>) {
            if (!next_->is_known) x_ = moved(x_, rate(mode_, x_, at), to - t_);
            t_ = to;
        } else {
            All all = together(), slope;
            motion_here().rates(all, at, slope);
            for (std::size_t i = 0; i < all.size(); ++i) all[i] += (to - t_) * slope[i];
            take(all, to);
        }
    }

    /// To the time `to`, past points on the way, or over the next kink before.
    template <class Seen>
    void go_on(Scalar to, const Seen& seen) {
        if (to - t_ <= instant(to)) return creep(to, t_);  // as between the last of many impacts: no method has a step so short
        All all = together();
        Motion motion = motion_here();
        const auto plain_rates = [&](const All& at, Scalar t, All& derivative) { motion.rates(at, t, derivative); };
        const auto rates = held(plain_rates);
        options_.output_times.clear();
        for (const Point* p = next_; p != end_ && p->t < to; ++p) options_.output_times.push_back(p->t);
        set_scales();
        begin_part(all, motion, to);
        Scalar reached = t_;
        const auto watch = [&](Scalar t, const All& at) {
            reached = t;
            if (next_ == end_ || next_->t != t || !(t < to)) return;
            take(at, t);
            seen(*next_++);
        };
        Outcome part;
        if constexpr (may_have_entries<Kinks>) {
            const auto guards = [&](const All& at, Scalar t, Kinks& g) {
                g = kinks_at(mode_, Motion::part(at, 0), t);
                for (std::size_t i = 0; i < g.size(); ++i)
                    if (Asked::is_kink(i)) g[i] = this->until_kink(i, g[i]);
                    else if (!watches_ends_) g[i] = Scalar(1);
            };
            Like<Kinks, bool> ends;
            ends.fill(true);
            part = integrate_part(rates, motion, all, t_, to, options_, watch, guards, ends, choice_);
        } else {
            part = integrate_part(rates, motion, all, t_, to, options_, watch, NoGuards{}, std::array<bool, 0>{}, choice_);
        }
        outcome_.steps += part.steps;
        outcome_.rejected += part.rejected;
        outcome_.rhs_calls += part.rhs_calls;
        outcome_.steps_by = choice_.steps;
        take(all, part.status == Status::success ? to : reached);
        if constexpr (may_have_entries<Kinks>)
            if (part.status == Status::event && Asked::is_kink(part.guard)) return pass_kink(part.guard, std::min(to, next_->t) - t_);
        if (part.status == Status::event) return fail(part.status, part.guard);
        if (part.status != Status::success) fail(part.status);
    }

    /// The run is known: explicit methods that would need many steps from one of its points to the next are left early. By itself
    /// Method::automatic waits until stability limits their steps, and rates of few digits may do so before.
    void begin_part(const All& all, Motion& motion, const Scalar& to) {
        if (is_begun_ || !controls_ || options_.method != Method::automatic || !may_become_implicit<Motion>()) return;
        is_begun_ = true;
        const Scalar spacing = (to - t_) / Scalar(static_cast<double>(options_.output_times.size() + 1));
        motion.prepare(all, t_);
        if (choice_.radius(motion, options_.scale) * spacing > Scalar(1000)) choice_.is_eager = true;
    }

    ColumnsOf<Scalar> times_of_event(std::size_t event, Mode mode, bool is_accumulation) {
        using std::abs;
        const ColumnsOf<Scalar> fixed = Columns<List>::filled(varied_, Scalar(0));
        if (t_ - from_ <= instant(from_)) return fixed;
        if (is_accumulation) return shift_;
        using Events = typename System::Events;
        const auto value = [&](const System& system, const Plain& x, const Scalar& t) {
            Events g;
            system.guards(mode, x, inputs_with(inputs_, system)(x, t), t, g);
            return g[event];
        };
        const Scalar d = Scalar(2) * instant(t_);
        const bool is_at_kink = known_kinks_.is_at_one(t_);
        // Where inputs have a kink, what counts is how they come.
        const Scalar at = is_at_kink ? t_ - d : t_;
        Events slopes;
        system_.guard_rates(mode, x_, inputs_(x_, at), at, slopes);
        Scalar slope = slopes[event];
        if constexpr (may_have_entries<typename System::Input>) {  // the rates hold inputs
            const Plain dxdt = rate(mode, x_, at);
            const auto by_inputs = [&](const Plain& there, const Scalar& time) {
                Events g;
                system_.guards(mode, x_, inputs_(there, time), at, g);
                return g[event];
            };
            if (is_at_kink) {
                const Scalar step = step_of_differences<Scalar>() * span_ / Scalar(1000);
                slope += (by_inputs(x_, at) - by_inputs(moved(x_, dxdt, -step), at - step)) / step;
            } else {
                slope += here().by_time(dxdt, by_inputs);
            }
        }
        // A guard that jumps there makes the event happen when the kink does; one that comes to its zero by itself does not.
        if (is_at_kink && abs(value(system_, x_, t_ + d) - value(system_, x_, t_ - d)) > Scalar(1e-6) * abs(slope) * span_) {
            const auto* kink = known_kinks_.moving(t_);
            return kink != nullptr ? kink->slope : fixed;
        }
        const Scalar now = value(system_, x_, t_);
        const bool is_caused = has_last_ && t_ - time_of_last_ <= instant(t_) && now < -abs(slope) * instant(t_);
        return is_caused ? shift_ : times_of_zero(value, slope, event);
    }

    Plain through_reset(std::size_t c, const Plain& s, const Scalar& shift, std::size_t event, Mode mode, bool is_accumulation) const {
        const auto central = [&](const System& a, const Plain& ahead, const Scalar& later, const System& b, const Plain& behind,
                                 const Scalar& earlier, const Scalar& step) {
            const auto reset = [&](const System& system, Plain x, const Scalar& t) {
                const auto u = inputs_with(inputs_, system)(x, t);
                if (is_accumulation)
                    system.settle(event, mode, x, u, t);
                else
                    system.reset(event, mode, x, u, t);
                return x;
            };
            Plain result = s;
            const Plain at_a = reset(a, ahead, later), at_b = reset(b, behind, earlier);
            for (std::size_t i = 0; i < result.size(); ++i)
                if (at_a[i] != ahead[i] || at_b[i] != behind[i]) result[i] = (at_a[i] - at_b[i]) / (Scalar(2) * step);
            return result;
        };
        return of_order_four<Scalar>([&](const Scalar& times) { return here().along(c, s, shift, central, times); });
    }

    using Choice = ChoiceOf<Scalar, Motion>;
    Choice choice_;  ///< from part to part
    bool is_begun_ = false, watches_ends_ = false;
    Scalar time_of_last_ = from_;  ///< event
    bool has_last_ = false;
    ColumnsOf<Scalar> shift_ = Columns<List>::filled(varied_, Scalar(0));  ///< how its time follows what is varied
    const Point* next_ = nullptr;                                          ///< of the points that are passed
    const Point* end_ = nullptr;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
