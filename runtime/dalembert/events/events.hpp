// SPDX-License-Identifier: BSL-1.0
// Where guards change their sign: what is remembered of them, and the search for the first change within a step.
//
// note [clean steps]: The right-hand side may jump or have a kink where a guard changes its sign, so a step is only worth its order
// when none of its stages lies on the other side, or on the zero itself. All stages are therefore watched. A step that is not clean is
// repeated from its beginning with other lengths (on its dense output the time would be as wrong as the step) until two neighbouring
// lengths are known, of which the shorter one is clean. That step is taken, and integration starts anew behind the zero. When only a
// stage of the longer step was on the other side, the zero is near, but not yet reached; what is missing shrinks like the error of a
// stage, and the next step finds it.
//
// note [rest]: Where the motion on both sides leads back to the zero, as with two pressures that have become equal, the sign changes
// again and again by rounding alone. A kink that has come back several times without going anywhere rests: it is not watched, and the
// control of errors alone keeps the motion near the zero, until the guard keeps its sign for a while.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dalembert/events/bracket.hpp"
#include "dalembert/methods/stepper.hpp"
#include "dalembert/sizes.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// No guards: nothing of what follows becomes code.
struct NoGuards {
    template <class State, class Scalar>
    void operator()(const State&, Scalar, std::array<Scalar, 0>&) const {}
};

/// Watches the guards of a run. A guard has a side, the sign that it had last; zero belongs to the side where the guard comes from,
/// and a guard that begins at zero takes the side to which it goes. A guard that ends the run is on the side >= 0 from the start.
/// Values here are those of the guards times their sides: negative means changed.
template <class State, class Guards, class ValuesOfGuards>
class EventSearch {
    using Scalar = typename State::value_type;
    using Try = Candidate<State>;

public:
    using Values = ValuesOfGuards;
    /// How many guards there are, which also says that none is meant.
    static constexpr std::size_t count() noexcept { return size_of<Values>(); }

    /// A kink may rest when it moves by less than `tolerance` of what it did before, or comes back within the time `soon`.
    EventSearch(Guards& guards, const Like<Values, bool>& ends, Scalar tolerance, Scalar soon)
        : guards_(guards), ends_(ends), tolerance_(tolerance), soon_(soon) {}

    /// The first guard that is not a number, or none.
    std::size_t not_a_number(const State& x, Scalar t) const {
        const Values g = raw(x, t);
        return first(g, [](const Scalar& value) { return !(value == value); });
    }

    /// The right-hand side goes on smoothly behind guards that end the run, or has no number there: of these guards only the ends of steps
    /// matter, not the stages, where rounding can take one that begins at zero to the other side.
    void spare_stages() {
        spares_stages_ = true;
        for (const bool is_end : ends_) has_kinks_ = has_kinks_ || !is_end;
    }

    bool spares_stages() const { return spares_stages_; }

    /// The sides at the start. The first guard that ends the run there and then, or none.
    std::size_t start(const State& x, Scalar t) {
        const Values g = raw(x, t);
        for (std::size_t i = 0; i < count(); ++i) side_[i] = ends_[i] ? 1 : sign(g[i]);
        settled_ = side_;
        found_ = values(x, t);
        return ending_guard();
    }

    /// A kink on whose zero the run starts.
    bool is_on_zero() const {
        for (const int side : settled_)
            if (side == 0) return true;
        return false;
    }

    /// The sides just behind the start. False, with nothing changed, if none becomes known or a guard would end the run.
    bool leave_zero(const State& x, Scalar t) {
        const Values g = raw(x, t);
        bool leaves = false;
        for (std::size_t i = 0; i < count(); ++i) {
            if (ends_[i] && g[i] < Scalar(0)) return false;
            if (settled_[i] == 0) side_[i] = sign(g[i]);
            leaves = leaves || side_[i] != settled_[i];
        }
        if (leaves) settled_ = side_;
        return leaves;
    }

    /// Makes the step c from (t, x), and cuts it at its first event. Looks at its stages, its end and, if it is accurate, three points
    /// between. What cannot be taken is left in the candidate: not finite, or not accurate enough.
    /// take(candidate) makes the step to candidate.end and calls `see` for each of its stages; between(candidate, t, x) interpolates
    /// in the step that was made last; accurate(candidate) judges its error.
    template <class Take, class Between, class Accurate>
    void search(Try& c, const State& x, Scalar t, Scalar tiny, Scalar resolution, Take take, Between between, Accurate accurate) {
        is_cut_ = false;
        notice(x, t);
        side_ = settled_;
        const Values at_start = values(x, t);
        for (std::size_t i = 0; i < count(); ++i) {
            is_strict_[i] = !may_touch_ && !ends_[i] && at_start[i] > Scalar(0);
            begins_at_zero_[i] = ends_[i] && at_start[i] == Scalar(0);
        }
        begin_ = t;
        Values lowest;
        bool is_step = is_clean(c, tiny, lowest, take);
        const bool inside = c.finite && accurate(c);
        Scalar before = t;
        Values at_before = at_start;
        for (int k = inside ? 1 : parts; k <= parts; ++k) {
            const bool is_end = k == parts;
            const Scalar at = is_end ? c.end : t + (c.end - t) * (Scalar(k) / Scalar(parts));
            State between_x = c.y;
            if (!is_end) between(c, at, between_x);
            const Values sample = values_and_sides(between_x, at);
            if (!is_behind(sample) && !(is_end && !is_step)) {
                before = at;
                at_before = sample;
                continue;
            }
            const Scalar guess =
                inside && is_behind(sample) ? interpolated(Bracket<Values>(before, at_before, at, sample), c, between) : at;
            Try part = c;
            if (!is_end) {
                part.end = at;
                part.length = at - t;
                is_step = is_clean(part, tiny, lowest, take);
            }
            if (!is_step) return close(t, at_start, at, lowest, guess, c, x, tiny, resolution, take, accurate);
            if (!part.finite) {
                c = part;
                return;
            }
            // A false alarm: the step itself does not do what its interpolation does. The next look needs the interpolation again.
            if (!is_end) is_step = is_clean(c, tiny, lowest, take);
        }
        cuts_ = 0;
        may_touch_ = false;
    }

    /// A stage of the step that is being made. A later stage at its beginning is the start but for an error, which tells nothing of a guard
    /// that is zero there.
    void see(const State& x, Scalar t) {
        if (!is_watching_) return;
        const Values seen = values(x, t);
        for (std::size_t i = 0; i < count(); ++i)
            if (seen[i] < lowest_[i] && (sees_ends_ || !ends_[i]) && !(begins_at_zero_[i] && t == begin_)) lowest_[i] = seen[i];
    }

    /// Whether the step that was made last ends before its time, and the shortest one that was tried behind its end.
    bool is_cut() const { return is_cut_; }
    const Try& behind() const { return behind_; }

    /// Of the guards that changed: the first one that ends the run, or none.
    std::size_t ending_guard() const {
        for (std::size_t i = 0; i < count(); ++i)
            if (ends_[i] && found_[i] < Scalar(0)) return i;
        return count();
    }
    std::size_t changed_guard() const { return first(found_, [](const Scalar& value) { return value < Scalar(0); }); }

    /// The step that was searched last is taken.
    void accept() { settled_ = side_; }

    /// Whether a guard has changed at (x, t). If so, that is what `pass` passes.
    bool has_changed_at(const State& x, Scalar t) {
        const Values seen = values(x, t);
        if (!has_changed(seen)) return false;
        found_ = seen;
        return true;
    }
    bool has_changed() const { return has_changed(found_); }
    bool changes_at(const State& x, Scalar t) const { return has_changed(values(x, t)); }

    /// The event was none yet: the step ran into it too early, or a guard is zero there without a change. It may be, in the next step.
    void retract() {
        may_touch_ = true;
        ++cuts_;
    }
    bool can_retract() const { return cuts_ < most_cuts; }

    /// Goes on behind the event at t: other sides. How many guards changed.
    std::size_t pass(Scalar t) {
        cuts_ = 0;
        may_touch_ = false;
        std::size_t changed = 0;
        for (std::size_t i = 0; i < count(); ++i) {
            if (!(found_[i] < Scalar(0))) continue;
            settled_[i] = -side_[i];
            ++changed;
            if (!ends_[i]) watches_[i].change(t, tolerance_, soon_);
        }
        return changed;
    }

    /// Behind a kink at a known time: kinks that changed with it need no search. How many.
    std::size_t pass_known(const State& x, Scalar t) {
        const Values g = raw(x, t);
        std::size_t changed = 0;
        for (std::size_t i = 0; i < count(); ++i) {
            const int now = sign(g[i]);
            if (ends_[i] || watches_[i].rests || now == 0 || now == settled_[i]) continue;
            if (settled_[i] != 0) ++changed;
            settled_[i] = now;
            watches_[i].excursion = Scalar(0);
        }
        return changed;
    }

    /// Behind a kink at a known time: whether a guard that ends the run, or an event, has jumped below zero with it. That one is
    /// ending_guard(): it needs no search either.
    bool has_jumped(const State& x, Scalar t) {
        found_ = raw(x, t);
        for (std::size_t i = 0; i < count(); ++i) {
            const Watch& watch = watches_[i];
            if (!(ends_[i] && watch.last > Scalar(0) && found_[i] < -watch.largest / Scalar(1000000))) found_[i] = Scalar(1);
        }
        return has_changed();
    }

    /// Whether a kink that rests is still near its zero at (x, t), or leaves it to one side, no faster than twice as far in a step.
    /// Estimates of errors do not see every jump.
    bool keeps_rest(const State& x, Scalar t) const {
        using std::abs;
        using std::max;
        const Values g = raw(x, t);
        for (std::size_t i = 0; i < count(); ++i) {
            const Watch& watch = watches_[i];
            const Scalar leaving = watch.kept >= 5 ? Scalar(2) * watch.last : Scalar(0);
            if (watch.rests && abs(g[i]) > max(Scalar(1000) * max(Scalar(tolerance_ * watch.largest), watch.rest), leaving)) return false;
        }
        return true;
    }

    /// A kink that rests, or none: there the motion on both sides leads back to the zero.
    std::size_t resting_guard() const {
        for (std::size_t i = 0; i < count(); ++i)
            if (watches_[i].rests) return i;
        return count();
    }

    /// The guard that ends the run and is next to nothing beside what it was, or none: where a step cannot be made, it is why.
    std::size_t vanishing_guard(const State& x, Scalar t) const {
        const Values g = raw(x, t);
        for (std::size_t i = 0; i < count(); ++i)
            if (ends_[i] && !(g[i] > watches_[i].largest / Scalar(1000000)) && !(spares_stages_ && watches_[i].largest == Scalar(0)))
                return i;
        return count();
    }

private:
    /// What is remembered of one guard; see note [rest].
    struct Watch {
        Scalar largest = Scalar(0);    ///< of all values
        Scalar excursion = Scalar(0);  ///< of the values since the last change
        Scalar last = Scalar(0);       ///< where the last step began
        Scalar rest = Scalar(0);       ///< of the values between the changes that made it rest
        Scalar last_change = -std::numeric_limits<Scalar>::infinity();
        int small_changes = 0, soon_changes = 0;  ///< in a row
        bool rests = false;
        int sign = 0, kept = 0;  ///< where it rests: the last sign, and for how many steps
        int patience = 15;       ///< steps with one sign after which it rests no more; twice as many each time

        void change(Scalar t, Scalar tolerance, Scalar soon) {
            small_changes = excursion <= tolerance * largest ? small_changes + 1 : 0;
            soon_changes = t - last_change <= soon ? soon_changes + 1 : 0;
            const bool is_first = small_changes <= 1 && soon_changes <= 1;  // the excursion before that led here
            rest = !is_first && rest > excursion ? rest : excursion;
            rests = small_changes >= 3 || soon_changes >= 20;
            if (rests && patience < 1000000) patience *= 2;
            last_change = t;
            excursion = Scalar(0);
            kept = 0;
        }
        /// Whether it rests no more.
        bool wakes(int seen) {
            kept = seen != 0 && seen == sign ? kept + 1 : 0;
            sign = seen;
            if (kept < patience) return false;
            rests = false;
            small_changes = soon_changes = 0;
            return true;
        }
    };

    void notice(const State& x, Scalar t) {
        using std::abs;
        if (t == noticed_) return;
        noticed_ = t;
        const Values g = raw(x, t);
        for (std::size_t i = 0; i < count(); ++i) {
            Watch& watch = watches_[i];
            const Scalar size = abs(g[i]);
            if (size > watch.largest) watch.largest = size;
            if (size > watch.excursion) watch.excursion = size;
            watch.last = size;
            if (watch.rests && watch.wakes(sign(g[i]))) settled_[i] = watch.sign;
        }
    }

    static constexpr int parts = 4;       // into which a step is divided to look between
    static constexpr int most_cuts = 30;  // in a row that bring no event

    Values raw(const State& x, Scalar t) const {
        Values g{};
        guards_(x, t, g);
        return g;
    }

    Values values(const State& x, Scalar t) const { return with_sides(raw(x, t)); }

    Values values_and_sides(const State& x, Scalar t) {
        const Values g = raw(x, t);
        for (std::size_t i = 0; i < count(); ++i)
            if (side_[i] == 0) side_[i] = sign(g[i]);
        return with_sides(g);
    }

    Values with_sides(Values g) const {
        for (std::size_t i = 0; i < count(); ++i)
            if (watches_[i].rests) g[i] = Scalar(1);
            else if (g[i] == g[i]) g[i] = side_[i] > 0 ? g[i] : side_[i] < 0 ? Scalar(-g[i]) : Scalar(0);
        return g;
    }

    static int sign(const Scalar& g) { return g > Scalar(0) ? 1 : g < Scalar(0) ? -1 : 0; }

    template <class Condition>
    static std::size_t first(const Values& values, Condition condition) {
        for (std::size_t i = 0; i < count(); ++i)
            if (condition(values[i])) return i;
        return count();
    }
    static bool has_changed(const Values& values) {
        return first(values, [](const Scalar& value) { return value < Scalar(0); }) != count();
    }
    bool is_behind(const Values& values) const {
        for (std::size_t i = 0; i < count(); ++i)
            if (values[i] < Scalar(0) || (is_strict_[i] && values[i] == Scalar(0))) return true;
        return false;
    }
    static bool has_nan(const Values& values) {
        return first(values, [](const Scalar& value) { return !(value == value); }) != count();
    }

    /// The time of the change in the interpolation of the step.
    template <class Between>
    Scalar interpolated(Bracket<Values> bracket, Try& c, Between& between) const {
        const Scalar rough = c.length / Scalar(1000000);
        while (!bracket.is_closed(rough)) {
            const Scalar at = bracket.next(rough);
            State x;
            between(c, at, x);
            const Values sample = values(x, at);
            is_behind(sample) ? bracket.put_far(at, sample) : bracket.put_near(at, sample);
        }
        return bracket.middle();
    }

    /// Makes the step c, and notes the least values of its stages.
    template <class Take>
    void watch(Try& c, bool with_ends, Take& take) {
        lowest_.fill(std::numeric_limits<Scalar>::infinity());
        sees_ends_ = with_ends;
        is_watching_ = with_ends || has_kinks_;
        take(c);
        is_watching_ = false;
    }

    /// Makes the step c; see note [clean steps]. `lowest` are the least values of its stages and its end; where clean steps
    /// do not lead on, those of its end alone, unless there are no numbers on the other side.
    template <class Take>
    bool is_clean(Try& c, Scalar tiny, Values& lowest, Take& take) {
        watch(c, !spares_stages_, take);
        if (spares_stages_ && !c.finite) watch(c, true, take);
        const Values at_end = values(c.y, c.end);
        for (std::size_t i = 0; i < count(); ++i)
            if (at_end[i] < lowest_[i]) lowest_[i] = at_end[i];
        if (has_nan(at_end)) c.finite = false;
        lowest = cuts_ < most_cuts || !c.finite ? lowest_ : at_end;
        if (!is_behind(lowest)) return true;
        behind_ = c;
        found_ = at_end;
        // What ends the run is found when it is near enough, whether or not there are numbers on the other side.
        for (std::size_t i = 0; i < count(); ++i)
            if (ends_[i] && !(c.length > tiny) && !(found_[i] < Scalar(0))) found_[i] = lowest_[i];
        return false;
    }

    /// Closes the bracket with repeated steps, the guess first, and leaves the longest clean step.
    template <class Take, class Accurate>
    void close(Scalar t, const Values& at_start, Scalar end, const Values& at_end, Scalar guess, Try& c, const State& x, Scalar tiny,
               Scalar resolution, Take& take, Accurate& accurate) {
        Bracket<Values> bracket(t, at_start, end, at_end);
        c = Try();
        bool is_first = guess > bracket.near() && guess < bracket.far();
        while (!bracket.is_closed(resolution)) {
            Try part;
            part.end = is_first ? guess : bracket.next(resolution);
            part.length = part.end - t;
            is_first = false;
            Values lowest;
            if (!is_clean(part, tiny, lowest, take)) {
                bracket.put_far(part.end, lowest);
                continue;
            }
            c = part;
            if (!c.finite || !accurate(c)) return;  // nor would a longer one be
            bracket.put_near(part.end, lowest);
        }
        is_cut_ = true;
        c.end = bracket.near();
        c.length = c.end - t;
        if (c.end > t) return take(c);  // the stepper knows the step again, for its dense output
        c.y = x;
        c.finite = cuts_ < most_cuts || has_changed(found_);
        if (!c.finite) c.length = behind_.length;
    }

    Guards& guards_;
    const Like<Values, bool>& ends_;
    Scalar tolerance_, soon_;
    Like<Values, Watch> watches_{};
    Scalar noticed_ = std::numeric_limits<Scalar>::quiet_NaN();
    Like<Values, int> settled_{};     ///< the sides where the run is: -1, 1, or 0 when not known yet
    Like<Values, int> side_{};        ///< and further on in the step that is tried
    Like<Values, bool> is_strict_{};  ///< kinks that the step does not start on, and must not end on
    bool may_touch_ = false;           ///< it may
    Like<Values, bool> begins_at_zero_{};  ///< guards that end the run
    Scalar begin_ = Scalar(0);         ///< of the step
    bool is_watching_ = false;
    bool spares_stages_ = false, has_kinks_ = false, sees_ends_ = true;
    Values lowest_{};
    Try behind_;
    Values found_{};
    bool is_cut_ = false;
    int cuts_ = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
