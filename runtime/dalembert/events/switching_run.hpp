// SPDX-License-Identifier: BSL-1.0
// The way of a run through its modes: what happens at an event, and at the end of a sequence of them.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "dalembert/events/accumulation.hpp"
#include "dalembert/events/mode_run.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// All modes, in order of declaration.
template <class Mode>
struct EveryMode {
    struct Place {
        std::size_t i;
        Mode operator*() const noexcept { return static_cast<Mode>(i); }
        Place& operator++() noexcept { return ++i, *this; }
        bool operator!=(const Place& other) const noexcept { return i != other.i; }
    };
    std::size_t count;
    Place begin() const noexcept { return {0}; }
    Place end() const noexcept { return {count}; }
};

template <class System, class Inputs, class Observer, class OnChange, class Result, class Change>
class SwitchingRun : ModeRun<System, Inputs, Observer, Result> {
    using Run = ModeRun<System, Inputs, Observer, Result>;
    using typename Run::Scalar, typename Run::State, typename Run::Input, typename Run::Mode;
    using Run::event_count, Run::none, Run::system_, Run::inputs_, Run::x_, Run::t_, Run::to_, Run::options_, Run::control_;
    using Run::here_, Run::observed_, Run::is_trial_, Run::result_;
    using Run::is_finite, Run::choose, Run::integrate_to, Run::observe, Run::observe_output;
    using EachEvent = Like<typename System::Events, bool>;

public:
    SwitchingRun(const System& system, const Inputs& inputs, State& x, Scalar from, Scalar to, const IntegrationOptions<State>& options,
                 Observer& observer, OnChange& on_change)
        : Run(system, inputs, x, from, to, options, observer), on_change_(on_change) {}

    Result go(bool is_given, Mode given) {
        if (!control_.are_options_good()) return end(Status::bad_options);
        if (!is_finite()) return end(Status::not_finite);
        std::size_t event = none;
        if constexpr (has_events_at_once<System>)
            for (std::size_t e = 0; e < event_count(); ++e)
                if (System::happens_at_start(e)) system_.reset(e, Mode{}, x_, inputs_(x_, t_), t_);
        if (!start(is_given, given, event)) {
            result_.last.event = happened_before();
            return end(Status::no_start_mode);
        }
        if (options_.clock != nullptr)
            options_.clock->act(x_, t_, t_ + control_.smallest(t_), static_cast<std::size_t>(here_.mode));
        // Friction that cannot hold at the start slides there: what is observed first is what holds from then on.
        if constexpr (has_events_at_once<System>)
            while (event != none && System::happens_at_once(event))
                if (const Status status = pass(event); status != Status::success) {
                    observe_output(t_, x_);
                    return end(status);
                }
        observe_output(t_, x_);
        while (true) {
            if (event == none) {
                // An event next to the end leaves no time for a step.
                if (result_.events > 0 && to_ - t_ <= control_.tiny(t_)) {
                    t_ = to_;
                    observe_output(t_, x_);
                    return end(Status::success);
                }
                const Status status = integrate_to(x_, to_, event);
                if (status != Status::event) return end(status);
            }
            const Status status = pass(event);
            // A jump at the end: a mode accepts what is behind it only.
            if (status == Status::no_mode && to_ - t_ <= control_.tiny(t_)) {
                t_ = to_;
                observe_output(t_, x_);
                return end(Status::success);
            }
            if (status != Status::success) return end(status);
        }
    }

private:
    Result end(Status status) {
        result_.status = status;
        result_.t = static_cast<double>(t_);
        result_.mode = here_.mode;
        return result_;
    }

    /// The first mode that accepts the start, or else the first one in which an event happens there and then.
    bool start(bool is_given, Mode given, std::size_t& event) {
        if (is_given) return choose(std::array<Mode, 1>{given}, event);
        return choose(EveryMode<Mode>{System::mode_table().size()}, event);
    }

    /// An event that has happened before the start, whatever the mode, or none.
    std::size_t happened_before() const {
        EachEvent in_all{};
        in_all.fill(true);
        for (std::size_t i = 0; i < System::mode_table().size(); ++i) {
            const Mode mode = static_cast<Mode>(i);
            typename System::Events g{};
            system_.guards(mode, x_, inputs_(x_, t_), t_, g);
            for (std::size_t e = 0; e < event_count(); ++e) in_all[e] = in_all[e] && System::is_watched(mode, e) && g[e] < Scalar(0);
        }
        for (std::size_t e = 0; e < event_count(); ++e)
            if (in_all[e]) return e;
        return none;
    }

    /// The event happens now. Leaves the next one there, if that happens at once.
    Status pass(std::size_t& event) {
        if (std::size_t other = is_last(event) ? happens_too(event) : none; other != none)
            if (const Status status = pass(other); status != Status::no_mode) return event = other, status;
        if (!count(event)) return Status::event_storm;
        const auto candidates = System::next_modes(event, here_.mode);
        if (is_last(event)) {
            if (observed_ != t_) observe(t_, x_);
            return Status::event;
        }
        const std::size_t happened = event;
        if (is_too_soon(happened) || is_too_low(happened)) {
            // A friction in a loop turns round, and projection has left a rounding of its rate, on the wrong side.
            if (!goes_on_after(happened) && leader_of(happened) == none && change_ahead(std::array<Mode, 1>{here_.mode}, event))
                return Status::success;
            accumulations_[happened].stall();
            event = none;
            return pass_accumulation(happened, event);
        }
        const auto reset = [this, happened](State& x, const Input& u) { system_.reset(happened, here_.mode, x, u, t_); };
        const Status status = change(happened, candidates, reset, false, event);
        return status == Status::success && event == none ? pass_accumulation(happened, event) : status;
    }

    /// Whether the run ends with the event.
    bool is_last(std::size_t event) const {
        const auto candidates = System::next_modes(event, here_.mode);
        return candidates.begin() == candidates.end();
    }

    /// An event at the same time as one that ends the run, with which the run goes on. A force that falls to zero just when its phase ends
    /// is such a case: what counts is the phase that begins.
    std::size_t happens_too(std::size_t event) const {
        using std::abs;
        typename System::Events g{}, rates{};
        const Input u = inputs_(x_, t_);
        system_.guards(here_.mode, x_, u, t_, g);
        system_.guard_rates(here_.mode, x_, u, t_, rates);
        for (std::size_t e = 0; e < event_count(); ++e)
            if (e != event && System::is_watched(here_.mode, e) && !is_last(e) && rates[e] < Scalar(0) &&
                g[e] <= control_.tiny(t_) * abs(rates[e]))
                return e;
        return none;
    }

    /// Notes what happens. False if that is too much.
    bool count(std::size_t event) {
        stalled_ = result_.last.event != none && !(t_ - last_time_ > Scalar(2) * control_.tiny(t_)) ? stalled_ + 1 : 0;
        last_time_ = t_;
        is_circle_ = stalled_ > 1 && result_.before_last.event == event && result_.before_last.mode == here_.mode;
        result_.guard = event;
        result_.before_last = result_.last;
        result_.last = {event, here_.mode};
        accumulations_[event].add(t_, control_.tiny(t_), result_.before_last.event == event);
        return result_.events++ < options_.max_events && stalled_ <= 100 + event_count();
    }

    /// The guard rises from zero, but is back there before the time has changed. A reset would take it the wrong way.
    bool is_too_soon(std::size_t event) const {
        if (!accumulations_[event].is_repeated(control_.smallest(t_))) return false;
        typename System::Events rates{};
        system_.guard_rates(here_.mode, x_, inputs_(x_, t_), t_, rates);
        return rates[event] > Scalar(0);
    }

    /// The guard has risen no higher than its roundings: what the event is about was at rest all the time.
    bool is_too_low(std::size_t event) const {
        using std::abs;
        if (!goes_on_after(event) || !(departures_[event] > Scalar(0)) || !accumulations_[event].is_repeated(to_)) return false;
        const Input u = inputs_(x_, t_);
        const auto guard = [&](const State& x) {
            typename System::Events g{};
            system_.guards(here_.mode, x, u, t_, g);
            return g[event];
        };
        const Scalar here = guard(x_);
        Scalar roundings = Scalar(0);
        for (std::size_t i = 0; i < x_.size(); ++i) {
            State x = x_;
            x[i] += std::numeric_limits<Scalar>::epsilon() * x[i];
            roundings += abs(guard(x) - here);
        }
        return departures_[event] * accumulations_[event].interval() <= Scalar(4) * roundings;
    }

    /// Within a step constraints hold as well as the step is exact. No mode may take what is left of them where a loop comes to rest, or
    /// where the tolerance is large.
    template <class Modes, class Reset>
    Status change(std::size_t event, const Modes& candidates, const Reset& reset, bool is_accumulation, std::size_t& next) {
        const Status status = change_once(event, candidates, reset, is_accumulation, next);
        using Bare = detail::Bare<System>;
        if constexpr (needs_projection<typename Bare::type>)
            if (status == Status::no_mode) {
                Bare::change(x_, [&](auto& part) { return project(Bare::of(system_), part, t_, here_.mode).broken; });
                return change_once(event, candidates, reset, is_accumulation, next);
            }
        return status;
    }

    template <class Modes, class Reset>
    Status change_once(std::size_t event, const Modes& candidates, const Reset& reset, bool is_accumulation, std::size_t& next) {
        const State before = x_;
        const Mode from = here_.mode;
        const bool is_jump = jumps(event);
        State old = before, changed;  // on both sides of the reset, at one time
        Scalar t = t_;
        reset(x_, inputs_(x_, t_));
        const auto behind = [&](const auto& modes, bool is_late = false) {
            return (is_jump && change_behind(before, from, modes, reset, next, is_late, control_.smallest(t_) / Scalar(4), old)) ||
                   change_behind(before, from, modes, reset, next, is_late, control_.tiny(t_), old);
        };
        bool is_ahead = false;
        const auto ahead = [&](const auto& modes) {
            const State here = x_;
            const Scalar now = t_;
            if (!change_ahead(modes, next)) return false;
            changed = here;
            t = now;
            return is_ahead = true;
        };
        bool is_found = is_finite() && choose(candidates, next);
        if (result_.state == x_.size() && (!is_found || next != none)) is_found = behind(candidates) || is_found;
        if constexpr (has_modes_beside<System>) {
            // Two frictions on one rate: where one lets go, the other holds.
            if (is_found && next != none && is_circle_) ahead(System::modes_beside(event, from));
            if (!is_found && !is_accumulation && is_finite()) is_found = choose(System::modes_beside(event, from), next);
        }
        if (!is_found && is_finite()) is_found = ahead(candidates);
        // Two springs that meet a body at one position: between the two events stands a mode that only that position allows.
        if (!is_found && is_finite()) is_found = behind(candidates, true);
        // A switch opens, and the diode beside it takes its current over: it does so behind the zero.
        if constexpr (has_modes_beside<System>)
            if (!is_found && !is_accumulation && is_finite()) is_found = behind(System::modes_beside(event, from));
        if (!is_found) {
            x_ = before;
            return result_.state < x_.size() ? Status::not_finite : Status::no_mode;
        }
        if (is_ahead)
            on_change_(Change{t, event, from, here_.mode, is_accumulation, old, changed});
        else
            on_change_(Change{t_, event, from, here_.mode, is_accumulation, old, x_});
        typename System::Events rates{};
        system_.guard_rates(here_.mode, x_, inputs_(x_, t_), t_, rates);
        departures_[event] = System::is_watched(here_.mode, event) ? rates[event] : Scalar(0);
        return Status::success;
    }

    /// Whether the guard jumps over its zero. Then a few roundings of the time lie between both sides, and no more.
    bool jumps(std::size_t event) const {
        using std::abs;
        const Input u = inputs_(x_, t_);
        typename System::Events g{}, rates{};
        system_.guards(here_.mode, x_, u, t_, g);
        system_.guard_rates(here_.mode, x_, u, t_, rates);
        return g[event] > Scalar(2) * control_.tiny(t_) * abs(rates[event]);
    }

    /// The run is in front of the zero. Where an input jumps, or a guard leaves zero with a rate that is zero itself but grows, as with
    /// friction that is the same at rest, a mode only accepts what is behind: the motion goes on for an instant before the reset.
    /// Where `is_late`, another event may have happened in that instant: it is the next. Gives the state in front of the reset as `passed`.
    template <class Modes, class Reset>
    bool change_behind(const State& before, Mode from, const Modes& candidates, const Reset& reset, std::size_t& event, bool is_late,
                       const Scalar& instant, State& passed) {
        const Mode to = here_.mode;
        const State after = x_;
        const Scalar t = t_;
        std::size_t next = none;
        here_.mode = from;
        State dxdt;
        here_.rhs(before, inputs_(before, t), t, dxdt);
        t_ += instant;
        for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = before[i] + (t_ - t) * dxdt[i];
        const State in_front = x_;
        reset(x_, inputs_(x_, t_));
        if (t_ > t && t_ <= to_ && is_finite() && choose(candidates, next, is_late) && (next == none || is_late)) {
            event = next;
            passed = in_front;
            return true;
        }
        result_.state = x_.size();
        here_.mode = to;
        x_ = after;
        t_ = t;
        return false;
    }

    /// A guard that is zero but for a rounding, on the wrong side, and rises: a mode accepts it an instant later, or a few, where the guard
    /// rises from a rate that is zero itself. False, and nothing has changed, if none does without further events.
    template <class Modes>
    bool change_ahead(const Modes& modes, std::size_t& event) {
        constexpr int most_tries = 7;  // the last one is 2^18 instants
        const State here = x_;
        const Scalar t = t_;
        const Mode as_before = here_.mode;
        Scalar instant = control_.tiny(t);
        for (int tries = 0; tries < most_tries; ++tries, instant *= Scalar(8))
            for (const Mode mode : modes) {
                std::size_t next = none;
                here_.mode = mode;
                t_ = t + instant / Scalar(2);
                State dxdt;
                here_.rhs(here, inputs_(here, t_), t_, dxdt);
                t_ = t + instant;
                for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = here[i] + (t_ - t) * dxdt[i];
                if (t_ > t && t_ <= to_ && is_finite() && choose(std::array<Mode, 1>{mode}, next) && next == none) {
                    event = none;
                    return true;
                }
            }
        here_.mode = as_before;
        x_ = here;
        t_ = t;
        result_.state = x_.size();
        return false;
    }

    /// Where the event accumulates, the run goes on at the time at which its intervals vanish. What accumulates at the same time, as in
    /// parts of a machine that are alike, goes with it; so does what happens between, as friction that turns round at the top of each
    /// bounce.
    Status pass_accumulation(std::size_t happened, std::size_t& event) {
        using std::abs;
        const Accumulation<Scalar>& times = accumulations_[happened];
        if (!times.is_certain() || (times.end() > to_ && !times.is_stalled())) return Status::success;
        const Scalar end = times.end() < to_ ? times.end() : to_;
        const std::size_t leader = goes_on_after(happened) ? happened : leader_of(happened);
        if constexpr (says_what_follows_accumulation<System>) {
            if (leader != none && leader != happened && !accumulations_[leader].is_certain() && !times.is_stalled()) return Status::success;
            EachEvent is_over{}, is_ignored{};
            for (std::size_t e = 0; e < event_count(); ++e) {
                const bool is_certain = accumulations_[e].is_certain();
                const Scalar apart = abs(accumulations_[e].end() - end);
                is_over[e] = e == leader || (System::is_watched(here_.mode, e) && goes_on_after(e) && is_certain &&
                                             apart <= control_.tiny(t_));
                is_ignored[e] = is_over[e] || e == happened || (is_certain && apart <= (end - t_) / Scalar(8) + control_.tiny(t_));
            }
            if (leader != none) return end > t_ && !coast(is_ignored, end) ? Status::success : settle(is_over, event);
        }
        result_.accumulates_at = static_cast<double>(end);
        return Status::accumulation;
    }

    /// An event that says what follows, and happens between any two times of the one that does not.
    std::size_t leader_of(std::size_t event) const {
        for (std::size_t e = 0; e < event_count(); ++e)
            if (e != event && goes_on_after(e) && accumulations_[e].is_between(accumulations_[event])) return e;
        return none;
    }

    bool goes_on_after(std::size_t event) const {
        if constexpr (says_what_follows_accumulation<System>) {
            const auto candidates = System::after_accumulation(event, here_.mode);
            return candidates.begin() != candidates.end();
        } else {
            return false;
        }
    }

    /// To the end of accumulations, without a look at their events. False, and nothing has happened, if there is another one before.
    bool coast(const EachEvent& is_ignored, Scalar end) {
        if (options_.clock != nullptr && options_.clock->next() <= end) return false;  // nobody acts twice
        here_.is_ignored = is_ignored;
        State x = x_;
        std::size_t other = none;
        is_trial_ = true;
        bool is_alone = integrate_to(x, end, other) == Status::success;
        is_trial_ = false;
        if (is_alone) is_alone = integrate_to(x_, end, other) == Status::success;
        here_.is_ignored = {};
        return is_alone;
    }

    Status settle(const EachEvent& is_over, std::size_t& event) {
        bool is_first = true;
        const auto all = [&](State& x, const Input& u) {
            for (std::size_t e = 0; e < event_count() && is_first; ++e)
                if (is_over[e]) system_.settle(e, here_.mode, x, u, t_);
        };
        for (std::size_t e = 0; e < event_count(); ++e) {
            if (!is_over[e]) continue;
            accumulations_[e].forget();
            const Status status = change(e, System::after_accumulation(e, here_.mode), all, true, event);
            if (status != Status::success) return status;
            is_first = false;
        }
        return Status::success;
    }

    OnChange& on_change_;
    Like<typename System::Events, Accumulation<Scalar>> accumulations_{};
    typename System::Events departures_{};  ///< how fast the guards rose after their last events
    Scalar last_time_ = Scalar(0);
    std::size_t stalled_ = 0;  ///< events in a row without progress in time
    bool is_circle_ = false;   ///< the last of them are two that lead to each other
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
