// SPDX-License-Identifier: BSL-1.0
// A run whose constraints may come to singular positions: sees them come, and passes over them. See note [singular positions].
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "dalembert/events/run_state.hpp"
#include "dalembert/singular_positions.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// What comes of a look for a singular position ahead.
enum class Ahead {
    clear,    ///< nothing near
    nearer,   ///< one too far away for one step over it: a usual step up to half the way comes first
    crossed,  ///< the run is behind it
    stuck,    ///< one that no step leads over, and next to it
};

template <class StateOfRun, class Rhs, class Observer, class Guards, class Values>
class WatchedRun : public RunState<StateOfRun, Rhs, Observer, Guards, Values> {
    using Run = RunState<StateOfRun, Rhs, Observer, Guards, Values>;

public:
    using typename Run::State;
    using typename Run::Scalar;
    using Run::Run;

protected:
    using typename Run::Try;
    using Run::x_, Run::dxdt_, Run::t_, Run::rhs_, Run::options_, Run::control_, Run::outcome_, Run::events_;

    static constexpr bool is_watched = has_measure<Rhs, State>;

    /// Looks ahead of a usual step of h, not beyond `limit`. If a singular position is so near, it makes the step over it; at(t) is then
    /// the state at a time on the way, for inside(end, at). Else it shortens the way to `target`, if need be.
    template <class Inside>
    Ahead look_ahead(const Scalar& h, const Scalar& limit, Scalar& target, const Inside& inside) {
        if constexpr (!is_watched) {
            (void)h, (void)limit, (void)target, (void)inside;
            return Ahead::clear;
        } else {
            using std::min;
            const Scalar reach = distance(h);
            if (!(reach > Scalar(0))) return Ahead::clear;
            const SlopePolynomial<State> guess = extrapolation(min(reach, h));
            const auto independence_after = [&](const Scalar& s) { return independence(guess.at(s), t_ + s, false).value; };
            const Scalar middle = place_of_least<Scalar>(independence_after, Scalar(5) / Scalar(2) * reach);
            if (!(independence_after(middle) <= now_.value / Scalar(10))) return Ahead::clear;
            const Scalar end = min(Scalar(t_ + Scalar(2) * middle), limit);
            if (!(end - t_ > middle / Scalar(2))) return Ahead::clear;
            if (cross(guess, middle, end, inside)) return Ahead::crossed;
            if (now_.value <= least()) return Ahead::stuck;
            target = min(target, Scalar(t_ + middle / Scalar(2)));
            return Ahead::nearer;
        }
    }

    /// Whether a state is too near to a singular position to be brought back to the constraints, or for a step to end there that comes from
    /// further away.
    bool is_close(const State& x, const Scalar& t) {
        if constexpr (is_watched) return independence(x, t, false).value <= close();
        else return (void)x, (void)t, false;
    }
    bool ends_close(const Try& c) {
        if constexpr (is_watched) {
            const Scalar there = independence(c.y, c.end, false).value;
            return there <= close() && there <= Scalar(3) / Scalar(10) * now_.value;
        } else {
            return (void)c, false;
        }
    }

    /// Constraints may move a state by about the error of the step, not by more: else they are not solved well there.
    bool is_moved_far(const Try& c) {
        if constexpr (is_watched) {
            State y = c.y;
            return rhs_.project(y, c.end) == Outcome::none && !(distance(c.y, y) <= Scalar(1000) * allowance());
        } else {
            return (void)c, false;
        }
    }

    /// Whether a fixed step ends so near to one that velocities would lose half of their digits.
    bool ends_on(const Try& c) const {
        using std::sqrt;
        if constexpr (is_watched) return independence(c.y, c.end, false).value <= sqrt(noise() / Scalar(1e-6));
        else return (void)c, false;
    }

    /// A step that cannot be made next to a singular position ends the run because of that.
    Outcome stop(Status status) { return named(Run::stop(status)); }
    Outcome named(const Outcome& usual) {
        if constexpr (is_watched) {
            const bool is_singular = usual.status == Status::singular_position;
            if (!is_singular && usual.status != Status::step_too_small && usual.status != Status::not_finite) return usual;
            const Independence<Scalar> here = independence(x_, t_, false);
            if (!is_singular && !(here.value <= Scalar(1) / Scalar(20))) return usual;
            outcome_.constraint = here.constraint;
            return this->end(Status::singular_position);
        }
        return usual;
    }

private:
    static Scalar close() { return Scalar(1) / Scalar(50); }
    /// Where rounding in velocities is as large as the tolerance.
    Scalar noisy() const {
        using std::sqrt;
        return sqrt(std::numeric_limits<Scalar>::epsilon() / options_.tolerance);
    }
    /// Where it is as large as 1e-9, or as a larger tolerance.
    Scalar least() const {
        using std::max;
        using std::min;
        using std::sqrt;
        return min(Scalar(close() / Scalar(2)), Scalar(sqrt(noise() / max(options_.tolerance, Scalar(1e-9)))));
    }
    static Scalar noise() { return Scalar(20) * std::numeric_limits<Scalar>::epsilon(); }
    /// How many times the tolerance the last digits of a state may differ that was brought back to the constraints here.
    Scalar allowance() const {
        using std::max;
        return max(Scalar(1), Scalar(noise() / (now_.value * now_.value * options_.tolerance)));
    }
    Independence<Scalar> independence(const State& x, const Scalar& t, bool learns) const { return rhs_.independence(x, t, learns); }
    Scalar distance(const State& x, const State& y) const {
        State difference;
        for (std::size_t i = 0; i < x.size(); ++i) difference[i] = i < rhs_.judged ? y[i] - x[i] : Scalar(0);
        return control_.error_norm(x, y, difference);
    }

    /// The time to a singular position that the last two points promise, if it is within reach of the next step or close; else zero.
    Scalar distance(const Scalar& h) {
        const Independence<Scalar> before = std::exchange(now_, independence(x_, t_, true));
        if (now_.is_chosen_anew) {
            this->move(t_, State(x_));  // steppers keep nothing that they know of here
            this->evaluate(x_, t_, dxdt_);
        }
        const Scalar since = t_ - std::exchange(measured_, t_);
        if (now_.rank != before.rank || !(since > Scalar(0)) || !(now_.value < before.value)) return Scalar(0);
        const Scalar reach = now_.value / (before.value - now_.value) * since;
        const bool is_close_by = now_.value <= std::max(Scalar(Scalar(3) * close()), Scalar(Scalar(8) * noisy()));
        return reach <= Scalar(is_close_by ? 50.0 : 1.5) * h ? reach : Scalar(0);
    }

    /// The motion for a while, from slopes here and before; its argument is the time from here.
    SlopePolynomial<State> extrapolation(const Scalar& back) {
        SlopePolynomial<State> result(x_, Scalar(1), {Scalar(0), -back, -Scalar(2) * back});
        result.slopes[0] = dxdt_;
        State x = x_, slope = dxdt_;
        for (std::size_t k = 1; k < 3; ++k) {
            const Scalar t = t_ + result.point(k);
            x = backwards(x, slope, t, back);
            rhs_.project(x, t);
            rhs_(x, t, slope);
            result.slopes[k] = slope;
        }
        outcome_.rhs_calls += 8;
        return result;
    }

    /// A step of the classical Runge-Kutta method to the earlier time t.
    State backwards(const State& x, const State& slope, const Scalar& t, const Scalar& back) const {
        const auto away = [&](const State& k, const Scalar& h) {
            State y = x;
            for (std::size_t i = 0; i < y.size(); ++i) y[i] -= h * k[i];
            return y;
        };
        State b, c, d, mean;
        rhs_(away(slope, back / Scalar(2)), t + back / Scalar(2), b);
        rhs_(away(b, back / Scalar(2)), t + back / Scalar(2), c);
        rhs_(away(c, back), t, d);
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (slope[i] + Scalar(2) * (b[i] + c[i]) + d[i]) / Scalar(6);
        return away(mean, back);
    }

    /// One long step to `end`, taken if two orders agree.
    template <class Inside>
    bool cross(const SlopePolynomial<State>& guess, const Scalar& middle, const Scalar& end, const Inside& inside) {
        const Scalar h = end - t_;
        const std::size_t stages = best_stages(middle / h);
        SlopePolynomial<State> step = collocation(stages, h), other = collocation(stages - 2, h);
        const bool ends_beyond = h >= Scalar(3) / Scalar(2) * middle;
        const auto bring_back = [&](State& x) { return !ends_beyond || rhs_.project(x, end) == Outcome::none; };
        if (!solve(step, guess, h, bring_back) || !solve(other, guess, h, bring_back)) return false;
        State x = step.at(Scalar(1)), y = other.at(Scalar(1));
        if (!bring_back(x) || !bring_back(y) || !(distance(step.at(Scalar(1)), x) <= Scalar(1000) * allowance())) return false;
        if (!(distance(x, y) <= Scalar(10) * allowance()) || changes_guard(x, end)) return false;
        for (int quarter = 1; quarter < 4; ++quarter) {  // where output points may lie
            const Scalar s = Scalar(quarter) / Scalar(4);
            if (!(distance(step.at(s), other.at(s)) <= Scalar(100) * allowance())) return false;
        }
        inside(end, [&](const Scalar& t) { return step.at((t - t_) / h); });
        ++outcome_.steps;
        this->move(end, x);
        control_.forget();
        this->evaluate(x_, t_, dxdt_);
        return true;
    }

    SlopePolynomial<State> collocation(std::size_t stages, const Scalar& h) const { return {x_, h, GaussPoints<Scalar>(stages).points}; }

    template <class BringBack>
    bool solve(SlopePolynomial<State>& step, const SlopePolynomial<State>& guess, const Scalar& h, const BringBack& bring_back) {
        for (std::size_t i = 0; i < step.size(); ++i) step.slopes[i] = guess.slope(step.point(i) * h);
        const auto slope = [&](const Scalar& s, State x, State& dxdt) {
            const Scalar t = t_ + s * h;
            if (rhs_.project(x, t) != Outcome::none) return false;
            ++outcome_.rhs_calls;
            rhs_(x, t, dxdt);
            return are_finite(x, dxdt) && !changes_guard(x, t);
        };
        return collocate(step, slope, [&](const State& a, const State& b) { return distance(a, b) / allowance(); }, bring_back);
    }

    /// Of eight and nine stages those that keep further away from the middle, as those of two fewer do.
    static std::size_t best_stages(const Scalar& middle) {
        const auto room = [&](std::size_t stages) {
            using std::abs;
            using std::min;
            Scalar least(1);
            for (const std::size_t count : {stages, stages - 2})
                for (const Scalar& point : GaussPoints<Scalar>(count).points) least = min(least, Scalar(abs(point - middle)));
            return least;
        };
        return room(8) >= room(9) ? 8 : 9;
    }

    bool changes_guard(const State& x, const Scalar& t) const {
        if constexpr (may_have_entries<Values>) return events_.changes_at(x, t);
        else return (void)x, (void)t, false;
    }

    Independence<Scalar> now_;  ///< where the last usual step began
    Scalar measured_ = Scalar(0);  ///< s, when
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
