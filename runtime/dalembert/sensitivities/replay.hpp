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
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "dalembert/integrate.hpp"
#include "dalembert/sensitivities/differences.hpp"
#include "dalembert/sensitivities/known_kinks.hpp"
#include "dalembert/sensitivities/moded.hpp"
#include "dalembert/sensitivities/options.hpp"
#include "dalembert/sensitivities/projected_columns.hpp"
#include "dalembert/singular_positions.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Integrates the state and S from one point of the run to the next, in the mode of the run; the state is then that of the run.
template <class System, class Inputs, class List>
class Replay {
    using Scalar = typename System::scalar_type;
    using Plain = typename System::State;
    using Asked = Moded<System>;
    /// See Variational.
    struct Sides {
        const Replay* replay;
        int operator()(std::size_t c, const Scalar& t) const { return replay->side(c, t); }
    };
    using Motion = Variational<System, Inputs, List, typename Asked::View, Sides>;
    using All = typename Motion::State;
    using Kinks = typename Asked::Kinks;
    template <class T>
    using ColumnsOf = typename Columns<List>::template Of<T>;

public:
    using Mode = typename Asked::Mode;
    using Sensitivities = ColumnsOf<Plain>;

    using KinksOfInputs = KnownKinks<Scalar, ColumnsOf<Scalar>>;

    /// Refers to all of them but S. `options` are those of the run; with controls = false the steps follow the error of the state alone.
    Replay(const System& system, const Inputs& inputs, const List& varied, const Plain& x, const Sensitivities& S, Scalar from, Scalar to,
           const IntegrationOptions<Plain>& options, bool controls = true)
        : own_{system},
          system_(own_.system),
          inputs_(inputs),
          varied_(varied),
          moved_(own_.system, varied),
          scale_(options.scale),
          known_kinks_(options.kinks, to - from),
          x_(x),
          S_(S),
          t_(from),
          from_(from),
          span_(to - from),
          time_of_last_(from),
          shift_(Columns<List>::filled(varied, Scalar(0))) {
        copy_options(options_, options);
        options_.kinks.clear();
        options_.intervals = 1;
        set_scales_of_columns(
            options_.scale, scale_, varied.size(), [&](std::size_t c) { return size_of_varied(system, varied[c], scale_); }, controls);
    }

    /// Those of the options that move: see KnownKinks.
    template <class Kinks>
    void take_moving_kinks(const Kinks& kinks) {
        known_kinks_.take_moving(kinks);
    }

    const Sensitivities& S() const { return S_; }
    /// The state that comes with it.
    const Plain& x() const { return x_; }
    /// How the integration went; with Status::not_finite and a guard, that event or kink only touches zero, and S has no value behind it.
    const Outcome& outcome() const { return outcome_; }

    /// How inputs follow one that is varied, along the motion.
    typename System::Input slopes_of_inputs(std::size_t c) const {
        const int side = this->side(c, t_);
        return here().along(c, S_[c], Scalar(0),
                            [&](const System& a, const Plain& ahead, const Scalar& t, const System& b, const Plain& behind, const Scalar&,
                                const Scalar& step) {
                                auto slopes = side < 0 ? inputs_(x_, t) : inputs_with(inputs_, a)(ahead, t);
                                const auto other = side > 0 ? inputs_(x_, t) : inputs_with(inputs_, b)(behind, t);
                                for (std::size_t j = 0; j < slopes.size(); ++j)
                                    slopes[j] = (slopes[j] - other[j]) / (Scalar(side == 0 ? 2 : 1) * step);
                                return slopes;
                            });
    }

    /// A point of the run.
    struct Point {
        Scalar t;
        Plain x;
    };

    /// To the point (t, x) of the run.
    void advance(Scalar t, const Plain& x, Mode mode = {}) {
        const Point point{t, x};
        advance_along(&point, &point + 1, mode, [](const Point&) {});
    }

    /// To the last of some points of the run, between which nothing happens. Calls seen(point) at each of them, when S is that there: in
    /// one integration, whose steps do not end on the points. The state that comes with S is that of the run at the last point; at the
    /// others it is as near to it as the error of the steps.
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
                x_ = next_->x;
                seen(*next_);
            }
            if (next_ == end_) return;
            // No step sees the instant around a kink at a known time.
            const Scalar* kink = known_kinks_.next(t_);
            if (kink == nullptr || last <= *kink - instant(*kink)) {
                go_on(last, seen);
            } else if (t_ < *kink - instant(*kink)) {
                go_on(*kink - instant(*kink), seen);
            } else {
                const Scalar t = next_->t;
                if (t_ < *kink && t >= *kink) pass_known_kink(*kink);
                t_ = std::min(t, Scalar(*kink + instant(*kink)));
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
    Scalar instant(const Scalar& t) const { return known_kinks_.instant(t); }
    Plain rate(Mode mode, const Plain& x, const Scalar& t) const {
        Plain dxdt;
        Asked::view(mode)(system_).rhs(x, inputs_(x, t), t, dxdt);
        return dxdt;
    }
    void fail(Status status, std::size_t guard = Outcome::none) {
        outcome_.status = status;
        outcome_.t = static_cast<double>(t_);
        outcome_.guard = guard;
    }

    // From point to point.

    Kinks kinks_at(Mode mode, const Plain& x, const Scalar& t) const {
        Kinks k;
        Asked::kinks(system_, mode, x, inputs_(x, t), t, k);
        return k;
    }
    /// The signs that kinks have in a mode that begins here; of one at zero that to which it goes.
    void find_sides(Mode mode) {
        mode_ = mode;
        knows_sides_ = true;
        if constexpr (may_have_entries<Kinks>) {
            const Kinks here = kinks_at(mode, x_, t_);
            for (std::size_t i = 0; i < sides_.size(); ++i)
                sides_[i] = here[i] != Scalar(0) ? (here[i] < Scalar(0) ? -1 : 1) : side_ahead(mode, i);
            sides_since_ = t_;
        }
    }
    /// The sign of a kink a little later, by trial steps of second order: from rest it does not go along the rates. 1 where it stays.
    int side_ahead(Mode mode, std::size_t kink) const {
        const Plain here = rate(mode, x_, t_);
        for (Scalar h = instant(t_); h <= span_ / Scalar(1000); h *= Scalar(16)) {
            const Plain there = rate(mode, moved(x_, here, h), t_ + h);
            const Scalar value = kinks_at(mode, moved(moved(x_, here, h / Scalar(2)), there, h / Scalar(2)), t_ + h)[kink];
            if (value != Scalar(0)) return value < Scalar(0) ? -1 : 1;
        }
        return 1;
    }

    /// To the time `to`, past points on the way, or over the next kink before.
    template <class Seen>
    void go_on(Scalar to, const Seen& seen) {
        All all;
        Motion::put(all, 0, x_);
        for (std::size_t c = 0; c < varied_.size(); ++c) Motion::put(all, c + 1, S_[c]);
        Motion motion(system_, inputs_, varied_, moved_, scale_, Asked::view(mode_), Sides{this});
        const auto plain_rates = [&](const All& at, Scalar t, All& derivative) { motion.rates(at, t, derivative); };
        const auto rates = held(plain_rates);
        if (to - t_ <= instant(to)) {  // as between the last of many impacts: no method has a step so short
            All slope;
            rates(all, t_, slope);
            for (std::size_t i = 0; i < all.size(); ++i) all[i] += (to - t_) * slope[i];
            take(all, to);
            return;
        }
        options_.output_times.clear();
        for (const Point* p = next_; p != end_ && p->t < to; ++p) options_.output_times.push_back(p->t);
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
                for (std::size_t i = 0; i < g.size(); ++i) g[i] = Asked::is_kink(i) ? g[i] * Scalar(sides_[i]) : Scalar(1);
            };
            Like<Kinks, bool> ends;
            ends.fill(true);
            part = integrate(rates, motion, all, t_, to, options_, watch, guards, ends);
        } else {
            part = integrate(rates, motion, all, t_, to, options_, watch);
        }
        outcome_.steps += part.steps;
        outcome_.rejected += part.rejected;
        outcome_.rhs_calls += part.rhs_calls;
        for (std::size_t k = 0; k < part.steps_by.size(); ++k) outcome_.steps_by[k] += part.steps_by[k];
        take(all, part.status == Status::success ? to : reached);
        if constexpr (may_have_entries<Kinks>)
            if (part.status == Status::event) return pass_kink(part.guard);
        if (part.status != Status::success) fail(part.status);
    }

    /// Rates of what constraints hold: see ProjectedRhs.
    template <class Rates>
    auto held(const Rates& rates) {
        if constexpr (needs_projection<System>) {
            const auto back = [this](All& all, Scalar t) {
                Plain x = Motion::part(all, 0);
                const std::size_t broken = in_mode([&](auto... mode) { return project(system_, x, t, mode...).broken; });
                Motion::put(all, 0, x);
                const DifferencesAt<System, List> at{system_, varied_, moved_, scale_, x, t, span_, known_kinks_.free_time(t)};
                for (std::size_t c = 0; c < varied_.size(); ++c) {
                    Plain s = Motion::part(all, c + 1);
                    in_mode([&](auto... mode) { bring_back(system_, at, c, x, t, s, mode...); });
                    Motion::put(all, c + 1, s);
                }
                return broken;
            };
            if constexpr (can_be_singular<System>) {
                const auto measure = [this](const All& all, Scalar t, bool learns) {
                    const auto independence =
                        in_mode([&](auto... mode) { return independence_(system_, Motion::part(all, 0), t, learns, mode...); });
                    if constexpr (chooses_constraints<System>)
                        if (independence.is_chosen_anew) solve_for(independence_.chosen());
                    return independence;
                };
                return ProjectedRhs{rates, back, measure, size_of<Plain>()};
            } else {
                return ProjectedRhs{rates, back};
            }
        } else {
            return rates;
        }
    }
    /// On the constraints S is the same with each choice of those that are solved for, as the motion is.
    template <class Flags>
    void solve_for(const Flags& chosen) {
        own_.system.solve_for(chosen);
        for (std::size_t c = 0; c < varied_.size(); ++c) {
            moved_.ahead[c].solve_for(chosen);
            moved_.behind[c].solve_for(chosen);
        }
    }
    template <class Call>
    auto in_mode(const Call& call) const {
        if constexpr (is_switching<System>)
            return call(mode_);
        else
            return call();
    }

    void take(const All& all, const Scalar& t) {
        x_ = Motion::part(all, 0);
        for (std::size_t c = 0; c < varied_.size(); ++c) S_[c] = Motion::part(all, c + 1);
        t_ = t;
    }

    /// Over a kink of the rates, where they may jump.
    void pass_kink(std::size_t kink) {
        if (++outcome_.events > options_.max_events) return fail(Status::event_storm, kink);
        const Scalar d = instant(t_);
        Plain before;
        if (!rate_before(kink, Scalar(0), before)) {  // it is one of time
            if (known_kinks_.is_at_one(t_)) {         // where all is done already
                sides_[kink] = -sides_[kink];
                return;
            }
            if (!rate_before(kink, Scalar(1), before)) {
                // From rest, next to it but for roundings, nothing has come through it.
                const bool is_left = t_ - sides_since_ <= Scalar(1e-6) * span_ && side_ahead(mode_, kink) != sides_[kink];
                if (!is_left) return fail(Status::event_storm, kink);
                sides_[kink] = -sides_[kink];
                return;
            }
        }
        const auto value_of = [&](std::size_t i) {
            return [this, i](const System& system, const Plain& x, const Scalar& t) {
                Kinks k;
                Asked::kinks(system, mode_, x, inputs_with(inputs_, system)(x, t), t, k);
                return k[i];
            };
        };
        // Past it by the state alone, if that does: a kink at a known time next to it is passed on its own.
        const auto is_past = [&](std::size_t i, const Scalar& t) {
            return value_of(i)(system_, moved(x_, before, d), t) * Scalar(sides_[i]) < Scalar(0);
        };
        const bool waits = is_past(kink, t_);
        const auto behind = [&](const Scalar& distance) { return rate(mode_, moved(x_, before, distance), waits ? t_ : t_ + distance); };
        const Plain near = behind(d), far = behind(Scalar(16) * d);
        const auto times_of = [&](std::size_t i) {
            const auto value = value_of(i);
            return times_of_zero(value, here().by_time(before, [&](const Plain& x, const Scalar& t) { return value(system_, x, t); }), i);
        };
        const bool jumps = is_jump(before, near, far);
        ColumnsOf<Scalar> shift = Columns<List>::filled(varied_, Scalar(0));
        if (jumps) shift = times_of(kink);
        // Others that fall together with it are passed at once. What is varied must not move them apart.
        for (std::size_t i = 0; i < sides_.size(); ++i) {
            if (i != kink && !(Asked::is_kink(i) && is_past(i, waits ? t_ : t_ + d))) continue;
            if (i != kink && jumps && !are_equal(shift, times_of(i))) fail(Status::not_finite, i);
            sides_[i] = -sides_[i];
        }
        if (outcome_.status != Status::success) return;
        if (jumps) jump(before, near, shift);
        x_ = moved(x_, before, d);
        if (!waits) t_ += d;
    }
    static bool are_equal(const ColumnsOf<Scalar>& a, const ColumnsOf<Scalar>& b) {
        using std::abs;
        for (std::size_t c = 0; c < a.size(); ++c)
            if (abs(a[c] - b[c]) > Scalar(1e-6) * (abs(a[c]) + abs(b[c]))) return false;
        return true;
    }
    void jump(const Plain& before, const Plain& behind, const ColumnsOf<Scalar>& shift) {
        for (std::size_t c = 0; c < varied_.size(); ++c)
            for (std::size_t i = 0; i < before.size(); ++i) S_[c][i] += (before[i] - behind[i]) * shift[c];
    }
    /// The rate on the side where a kink comes from, which may lie behind: where it was passed in the instant of another, or of an output.
    bool rate_before(std::size_t kink, const Scalar& of_time, Plain& before) const {
        const Plain here = rate(mode_, x_, t_);
        const Scalar step = instant(t_);
        for (Scalar distance = step; distance <= Scalar(64) * step; distance += step) {
            const Plain x = moved(x_, here, -distance);
            const Scalar t = t_ - of_time * distance;
            if (!(kinks_at(mode_, x, t)[kink] * Scalar(sides_[kink]) > Scalar(0))) continue;
            before = rate(mode_, x, t);
            return true;
        }
        return false;
    }
    /// Behind an infinite slope rates go on growing; behind a jump they do not.
    static bool is_jump(const Plain& before, const Plain& near, const Plain& far) {
        using std::abs;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const Scalar there = near[i] - before[i];
            const bool is_seen = abs(there) > Scalar(1e-9) * (abs(before[i]) + abs(near[i]));
            if (is_seen && abs(far[i] - near[i]) <= abs(there) / Scalar(2)) return true;
        }
        return false;
    }
    void pass_known_kink(const Scalar& t) {
        if (const auto* kink = known_kinks_.moving(t)) jump(rate(mode_, x_, t - instant(t)), rate(mode_, x_, t + instant(t)), kink->slope);
    }
    int side(std::size_t c, const Scalar& t) const { return known_kinks_.side(c, t, moved_.distance[c]); }

    // Over an event.

    DifferencesAt<System, List> here() const { return {system_, varied_, moved_, scale_, x_, t_, span_, known_kinks_.free_time(t_)}; }

    /// How the time follows what is varied at which a function that is zero here, and whose rate is given, is zero.
    template <class Value>
    ColumnsOf<Scalar> times_of_zero(const Value& value, const Scalar& slope, std::size_t number) {
        ColumnsOf<Scalar> shift = Columns<List>::filled(varied_, Scalar(0));
        for (std::size_t c = 0; c < varied_.size(); ++c) {
            const auto central = [&](const System& a, const Plain& ahead, const Scalar& later, const System& b, const Plain& behind,
                                     const Scalar& earlier, const Scalar& step) {
                return Scalar((value(a, ahead, later) - value(b, behind, earlier)) / (Scalar(2) * step));
            };
            const Scalar by = of_order_four<Scalar>([&](const Scalar& times) { return here().along(c, S_[c], Scalar(0), central, times); });
            if (by == Scalar(0)) continue;
            shift[c] = -by / slope;
            if (!(shift[c] - shift[c] == Scalar(0))) fail(Status::not_finite, number);
        }
        return shift;
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
        const Scalar here = value(system_, x_, t_);
        const bool is_caused = has_last_ && t_ - time_of_last_ <= instant(t_) && here < -abs(slope) * instant(t_);
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

    SystemOfRun<System> own_;
    const System& system_;
    const Inputs& inputs_;
    const List& varied_;
    MeasureOf<System> independence_;
    MovedSystems<System, List> moved_;
    Plain scale_;
    KinksOfInputs known_kinks_;
    IntegrationOptions<All> options_;
    Plain x_;
    Sensitivities S_;
    Scalar t_, from_, span_;
    Mode mode_{};
    Like<Kinks, int> sides_{};
    bool knows_sides_ = false;
    Scalar sides_since_{};
    Scalar time_of_last_;  ///< event
    bool has_last_ = false;
    ColumnsOf<Scalar> shift_;      ///< how its time follows what is varied
    const Point* next_ = nullptr;  ///< of the points that are passed
    const Point* end_ = nullptr;
    Outcome outcome_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
