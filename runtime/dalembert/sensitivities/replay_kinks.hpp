// SPDX-License-Identifier: BSL-1.0
// Sensitivities over kinks and jumps of the rates within a mode.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dalembert/sensitivities/replay_state.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Knows on which side of each kink the motion is. See note [jumps] in replay.hpp.
template <class System, class Inputs, class List>
class ReplayKinks : public ReplayState<System, Inputs, List> {
    using Base = ReplayState<System, Inputs, List>;

public:
    using Base::Base;
    using typename Base::Mode;

protected:
    using typename Base::All, typename Base::Asked, typename Base::Kinks, typename Base::Motion;
    using typename Base::Plain, typename Base::Scalar;
    template <class T>
    using ColumnsOf = typename Base::template ColumnsOf<T>;
    using Base::fail, Base::here, Base::instant, Base::jump, Base::kinks_at, Base::motion_here, Base::rate, Base::take,
        Base::times_of_zero, Base::together;
    using Base::inputs_, Base::known_kinks_, Base::mode_, Base::options_, Base::outcome_, Base::S_, Base::scale_, Base::sides_, Base::span_,
        Base::system_, Base::t_, Base::varied_, Base::x_;

    /// The signs that kinks have in a mode that begins here; of one at zero that to which it goes.
    void find_sides(Mode mode) {
        mode_ = mode;
        knows_sides_ = true;
        if constexpr (may_have_entries<Kinks>) {
            const Kinks values = kinks_at(mode, x_, t_);
            for (std::size_t i = 0; i < sides_.size(); ++i)
                sides_[i] = values[i] != Scalar(0) ? (values[i] < Scalar(0) ? -1 : 1) : side_ahead(mode, i);
            sides_since_ = t_;
            std::fill(rests_.begin(), rests_.end(), Scalar(0));
        }
    }
    /// The sign of a kink a little later, by trial steps of second order: from rest it does not go along the rates. 1 where it stays.
    int side_ahead(Mode mode, std::size_t kink) const {
        const Plain now = rate(mode, x_, t_);
        for (Scalar h = instant(t_); h <= span_ / Scalar(1000); h *= Scalar(16)) {
            const Plain ahead = rate(mode, moved(x_, now, h), t_ + h);
            const Scalar value = kinks_at(mode, moved(moved(x_, now, h / Scalar(2)), ahead, h / Scalar(2)), t_ + h)[kink];
            if (value != Scalar(0)) return value < Scalar(0) ? -1 : 1;
        }
        return 1;
    }

    /// What is above zero up to where a kink is passed, or ends to rest.
    Scalar until_kink(std::size_t kink, const Scalar& value) const {
        using std::abs;
        return rests_[kink] == Scalar(0) ? value * Scalar(sides_[kink]) : rests_[kink] - abs(value);
    }

    /// Over a kink whose value does not leave its roundings within many instants, as that of a check valve beside which pressures become
    /// equal. S goes on as it is: rates must not jump there. A kink that stays within its roundings rests: it is not looked for as long as
    /// it stays near. No step is longer than `room`.
    void pass_slowly(std::size_t kink, const Scalar& room) {
        const Scalar near = size_next_to(kink);
        if (near == Scalar(0)) return fail(Status::event_storm, kink);
        const Plain now = rate(mode_, x_, t_);
        const auto value = [&](const Scalar& way) {
            const Scalar half = way / Scalar(2);
            const Plain there = moved(x_, rate(mode_, moved(x_, now, half), t_ + half), way);
            return kinks_at(mode_, there, t_ + way)[kink] * Scalar(sides_[kink]);
        };
        for (Scalar d = Scalar(64) * instant(t_); d <= std::min(room, Scalar(Scalar(1e-5) * span_)); d *= Scalar(2)) {
            const Scalar behind = value(d);
            if (!(value(-d) > Scalar(0)) || behind == Scalar(0)) continue;
            if (behind < Scalar(0)) sides_[kink] = -sides_[kink];
            return step_over(d);
        }
        rests_[kink] = near;
    }
    /// Of a kink, in states on both sides of it, as near as they can be told apart; 0 where there are none or rates jump between them.
    Scalar size_next_to(std::size_t kink) const {
        using std::abs;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const Scalar h = Scalar(1e-9) * std::max(Scalar(abs(x_[i])), scale_[i]);
            const auto at = [&](int steps) {
                Plain x = x_;
                x[i] += Scalar(steps) * h;
                return x;
            };
            const Scalar before = kinks_at(mode_, at(-1), t_)[kink], behind = kinks_at(mode_, at(1), t_)[kink];
            if (!(before * behind < Scalar(0))) continue;
            if (is_jump(rate(mode_, at(-1), t_), rate(mode_, at(1), t_), rate(mode_, at(16), t_))) break;
            return std::min(abs(before), abs(behind));
        }
        return Scalar(0);
    }
    /// One step of order four, which does not look for kinks.
    void step_over(const Scalar& h) {
        Motion motion = motion_here();
        const All start = together();
        All k, sum = start, at = start;
        const Scalar nodes[] = {Scalar(0), h / Scalar(2), h / Scalar(2), h};
        const Scalar weights[] = {h / Scalar(6), h / Scalar(3), h / Scalar(3), h / Scalar(6)};
        for (int stage = 0; stage < 4; ++stage) {
            if (stage > 0)
                for (std::size_t i = 0; i < at.size(); ++i) at[i] = start[i] + nodes[stage] * k[i];
            motion.rates(at, t_ + nodes[stage], k);
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weights[stage] * k[i];
        }
        take(sum, t_ + h);
    }

    /// Over a kink of the rates, where they may jump.
    void pass_kink(std::size_t kink, const Scalar& room) {
        using std::abs;
        if (++outcome_.events > options_.max_events) return fail(Status::event_storm, kink);
        if (rests_[kink] != Scalar(0)) {
            rests_[kink] = Scalar(0);
            sides_[kink] = kinks_at(mode_, x_, t_)[kink] < Scalar(0) ? -1 : 1;
            return;
        }
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
                if (is_left) {
                    sides_[kink] = -sides_[kink];
                    return;
                }
                return pass_slowly(kink, room);
            }
        }
        const auto value_of = [&](std::size_t i) {
            return [this, i](const System& system, const Plain& x, const Scalar& t) {
                Kinks k;
                Asked::kinks(system, mode_, x, inputs_with(inputs_, system)(x, t), t, k);
                return k[i];
            };
        };
        // Past it by the state alone, if that does, next to a kink at a known time, which is passed on its own, or where S rests.
        const auto is_past = [&](std::size_t i, const Scalar& t) {
            return value_of(i)(system_, moved(x_, before, d), t) * Scalar(sides_[i]) < Scalar(0);
        };
        const Scalar* const known = known_kinks_.next(t_);
        const bool is_at_next = known != nullptr && t_ < *known && *known <= t_ + d;
        const bool waits = (can_be_singular<System> || is_at_next) && is_past(kink, t_);
        const auto behind = [&](const Scalar& distance) { return rate(mode_, moved(x_, before, distance), waits ? t_ : t_ + distance); };
        const Plain near = behind(d), far = behind(Scalar(16) * d);
        const auto times_of = [&](std::size_t i) {
            const auto value = value_of(i);
            return times_of_zero(value, here().by_time(before, [&](const Plain& x, const Scalar& t) { return value(system_, x, t); }), i);
        };
        const bool jumps = is_jump(before, near, far);
        // Others that fall together with it are passed at once. What is varied must not move them apart; one that jumps itself, as where
        // a period begins, follows the rest.
        const auto is_passed = [&](std::size_t i) {
            return i == kink || (Asked::is_kink(i) && is_past(i, waits ? t_ : t_ + d));
        };
        const auto jumps_itself = [&](std::size_t i) {
            constexpr double far_behind = 1e6;  // where a slow guard has moved by more than its roundings
            const auto at = [&](double times) {
                const Scalar way = Scalar(times) * d;
                return value_of(i)(system_, moved(x_, before, way), waits ? t_ : t_ + way);
            };
            const Scalar slope = (at(-1) - at(-far_behind)) / (Scalar(far_behind - 1) * d);
            return abs(at(1) - at(-1)) > Scalar(1e-6) * abs(slope) * span_;
        };
        std::size_t leader = kink;
        for (std::size_t i = 0; jumps && i < sides_.size() && jumps_itself(leader); ++i)
            if (is_passed(i) && !jumps_itself(i)) leader = i;
        ColumnsOf<Scalar> shift = Columns<List>::filled(varied_, Scalar(0));
        if (jumps && !jumps_itself(leader)) shift = times_of(leader);
        else if (jumps && !known_kinks_.is_at_one(t_)) return fail(Status::not_finite, kink);
        for (std::size_t i = 0; i < sides_.size(); ++i) {
            if (!is_passed(i)) continue;
            if (i != leader && jumps && !jumps_itself(i) && !are_equal(shift, times_of(i))) fail(Status::not_finite, i);
            sides_[i] = -sides_[i];
        }
        if (outcome_.status != Status::success) return;
        if (jumps) jump(before, near, shift);
        x_ = moved(x_, before, d);
        if (!waits) t_ += d;
        if constexpr (!can_be_singular<System>) {  // see Replay::creep
            All slope;
            motion_here().rates(together(), t_, slope);
            for (std::size_t c = 0; c < varied_.size(); ++c) S_[c] = moved(S_[c], Motion::part(slope, c + 1), d);
        }
    }
    static bool are_equal(const ColumnsOf<Scalar>& a, const ColumnsOf<Scalar>& b) {
        using std::abs;
        for (std::size_t c = 0; c < a.size(); ++c)
            if (abs(a[c] - b[c]) > Scalar(1e-6) * (abs(a[c]) + abs(b[c]))) return false;
        return true;
    }
    /// The rate on the side where a kink comes from, which may lie behind: where it was passed in the instant of another, or of an output.
    bool rate_before(std::size_t kink, const Scalar& of_time, Plain& before) const {
        const Plain now = rate(mode_, x_, t_);
        const Scalar step = instant(t_);
        for (Scalar distance = step; distance <= Scalar(64) * step; distance += step) {
            const Plain x = moved(x_, now, -distance);
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

    Kinks rests_{};  ///< up to these values; 0 of one that does not
    bool knows_sides_ = false;
    Scalar sides_since_{};
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
