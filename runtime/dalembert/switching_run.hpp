// SPDX-License-Identifier: BSL-1.0
// The way of a run through its modes: integration up to an event, the reset, the choice of the next mode.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "dalembert/accumulation.hpp"
#include "dalembert/integrate.hpp"
#include "dalembert/modes.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

template <class System, class Inputs, class Observer, class OnChange, class Result, class Change>
class SwitchingRun {
    using Scalar = typename System::scalar_type;
    using State = typename System::State;
    using Input = typename System::Input;
    using Mode = typename System::Mode;
    static constexpr std::size_t events = std::tuple_size<typename System::Events>::value;
    static constexpr std::size_t mode_count = std::tuple_size<std::decay_t<decltype(System::mode_table())>>::value;
    static constexpr std::size_t none = Outcome::none;

public:
    SwitchingRun(const System& system, const Inputs& inputs, State& x, Scalar from, Scalar to, const IntegrationOptions<State>& options, Observer& observe, OnChange& on_change)
        : system_(system), inputs_(inputs), x_(x), t_(from), to_(to), options_(options), control_(options, from, to), outputs_{from, to, options.intervals}, observe_(observe),
          on_change_(on_change), here_(system, Mode{}), derivatives_(here_, inputs, options_.scale) {}

    Result go(bool is_given, Mode given) {
        if (!control_.are_options_good()) return end(Status::bad_options);
        if (!is_finite()) return end(Status::not_finite);
        std::size_t event = none;
        if (!start(is_given, given, event)) return end(Status::no_start_mode);
        observe_output(t_, x_);
        while (true) {
            if (event == none) {
                const Status status = integrate_to(x_, to_, event);
                if (status != Status::event) return end(status);
            }
            const Status status = pass(event);
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

    bool is_finite() {
        result_.state = first_not_finite(x_);
        return result_.state == x_.size();
    }

    /// The first mode that accepts the start, or else the first one in which an event happens there and then.
    bool start(bool is_given, Mode given, std::size_t& event) {
        if (is_given) return choose(std::array<Mode, 1>{given}, t_, event);
        std::array<Mode, mode_count> all{};
        for (std::size_t i = 0; i < mode_count; ++i) all[i] = static_cast<Mode>(i);
        return choose(all, t_, event);
    }

    /// Takes the first of the modes that accepts the state, or else the first one in which an event happens at once.
    template <class Modes>
    bool choose(const Modes& modes, Scalar t, std::size_t& event) {
        const Input u = inputs_(x_, t);
        bool is_found = false;
        for (const Mode mode : modes) {
            const Acceptance answer = acceptance(system_, mode, x_, u, t, control_.tiny(t));
            if (!answer.is_possible || (is_found && answer.event != none)) continue;
            here_.mode = mode;
            event = answer.event;
            is_found = true;
            if (event == none) break;
        }
        return is_found;
    }

    /// In the present mode up to `to`, or to an event.
    Status integrate_to(State& x, Scalar to, std::size_t& event) {
        const auto rhs = [this](const State& at, Scalar t, State& dxdt) { here_.rhs(at, inputs_(at, t), t, dxdt); };
        const auto guards = [this](const State& at, Scalar t, typename Here::Guards& g) { here_.guards(at, inputs_(at, t), t, g); };
        const auto observe = [this](Scalar t, const State& at) { observe_output(t, at); };
        std::array<bool, std::tuple_size<typename Here::Guards>::value> ends{};
        for (std::size_t e = 0; e < events; ++e) ends[e] = true;
        // The limits are those of the whole.
        IntegrationOptions<State> options = options_;
        options.max_steps -= result_.steps + result_.rejected;
        options.max_events -= result_.events;
        for (options.intervals = next_; outputs_.time(options.intervals) < to;) ++options.intervals;
        Integration<State, decltype(rhs), decltype(observe), decltype(guards), ends.size()> run(rhs, x, t_, to, options, observe, guards, ends);
        run.be_part(outputs_, next_);
        const Outcome part = integrate_by_method(run);
        if (is_trial_) return part.status;
        t_ = run.time();
        result_.steps += part.steps;
        result_.rejected += part.rejected;
        result_.rhs_calls += part.rhs_calls;
        result_.events += part.events;
        result_.state = part.state;
        result_.guard = event = part.guard;
        return part.status;
    }

    template <class Run>
    Outcome integrate_by_method(Run& run) {
        if constexpr (has_derivatives<System>)
            if (options_.method == Method::rodas5p) return run_rodas5p(run, derivatives_);
        return run_explicit(run, options_.method);
    }

    /// Integrations observe their ends too; of these only output points are passed on.
    void observe_output(Scalar t, const State& x) {
        if (is_trial_ || next_ > outputs_.intervals || t != outputs_.time(next_)) return;
        ++next_;
        observe(t, x);
    }
    void observe(Scalar t, const State& x) {
        observed_ = t;
        observe_(t, x, here_.mode);
    }

    /// The event happens now. Leaves the next one there, if that happens at once.
    Status pass(std::size_t& event) {
        if (!count(event)) return Status::event_storm;
        const auto candidates = System::next_modes(event, here_.mode);
        if (candidates.begin() == candidates.end()) {
            if (observed_ != t_) observe(t_, x_);
            return Status::event;
        }
        const std::size_t happened = event;
        if (is_too_soon(happened)) {
            accumulations_[happened].stall();
            event = none;
            return pass_accumulation(happened, event);
        }
        const auto reset = [this, happened](State& x, const Input& u) { system_.reset(happened, here_.mode, x, u, t_); };
        const Status status = change(happened, candidates, reset, false, event);
        return status == Status::success && event == none ? pass_accumulation(happened, event) : status;
    }

    /// Notes what happens. False if that is too much.
    bool count(std::size_t event) {
        stalled_ = result_.last.event != none && !(t_ - last_time_ > control_.smallest(t_)) ? stalled_ + 1 : 0;
        last_time_ = t_;
        result_.guard = event;
        result_.before_last = result_.last;
        result_.last = {event, here_.mode};
        accumulations_[event].add(t_, control_.tiny(t_), result_.before_last.event == event);
        return result_.events++ < options_.max_events && stalled_ <= 100 + events;
    }

    /// The guard rises from zero, but is back there before the time has changed. A reset would take it the wrong way.
    bool is_too_soon(std::size_t event) const {
        if (!accumulations_[event].is_repeated(control_.smallest(t_))) return false;
        typename System::Events rates{};
        system_.guard_rates(here_.mode, x_, inputs_(x_, t_), t_, rates);
        return rates[event] > Scalar(0);
    }

    template <class Modes, class Reset>
    Status change(std::size_t event, const Modes& candidates, const Reset& reset, bool is_accumulation, std::size_t& next) {
        const State before = x_;
        const Mode from = here_.mode;
        reset(x_, inputs_(x_, t_));
        bool is_found = is_finite() && choose(candidates, t_, next);
        if (result_.state == x_.size() && (!is_found || next != none)) is_found = change_behind(before, from, candidates, reset, next) || is_found;
        if (!is_found) {
            x_ = before;
            return result_.state < x_.size() ? Status::not_finite : Status::no_mode;
        }
        on_change_(Change{t_, event, from, here_.mode, is_accumulation, before, x_});
        return Status::success;
    }

    /// The run is in front of the zero. Where an input jumps, or a guard leaves zero with a rate that is zero itself but grows, as with
    /// friction that is the same at rest, a mode only accepts what is behind: the motion goes on for an instant before the reset.
    template <class Modes, class Reset>
    bool change_behind(const State& before, Mode from, const Modes& candidates, const Reset& reset, std::size_t& event) {
        const Mode to = here_.mode;
        const State after = x_;
        const Scalar t = t_;
        std::size_t next = none;
        here_.mode = from;
        State dxdt;
        here_.rhs(before, inputs_(before, t), t, dxdt);
        t_ += control_.tiny(t);
        for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = before[i] + (t_ - t) * dxdt[i];
        reset(x_, inputs_(x_, t_));
        if (t_ > t && t_ <= to_ && is_finite() && choose(candidates, t_, next) && next == none) {
            event = none;
            return true;
        }
        result_.state = x_.size();
        here_.mode = to;
        x_ = after;
        t_ = t;
        return false;
    }

    /// Where the event accumulates, the run goes on at the time at which its intervals vanish. What accumulates at the same time, as in
    /// parts of a machine that are alike, goes with it.
    Status pass_accumulation(std::size_t happened, std::size_t& event) {
        using std::abs;
        const Accumulation<Scalar>& times = accumulations_[happened];
        if (!times.is_certain() || (times.end() > to_ && !times.is_stalled())) return Status::success;
        const Scalar end = times.end() < to_ ? times.end() : to_;
        std::array<bool, events> is_over{};
        for (std::size_t e = 0; e < events; ++e)
            is_over[e] = e == happened || (System::is_watched(here_.mode, e) && accumulations_[e].is_certain() && abs(accumulations_[e].end() - end) <= control_.tiny(t_) && goes_on_after(e));
        if constexpr (says_what_follows_accumulation<System>) {
            if (goes_on_after(happened)) return end > t_ && !coast(is_over, end) ? Status::success : settle(is_over, event);
        }
        result_.accumulates_at = static_cast<double>(end);
        return Status::accumulation;
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
    bool coast(const std::array<bool, events>& is_over, Scalar end) {
        here_.is_ignored = is_over;
        State x = x_;
        std::size_t other = none;
        is_trial_ = true;
        bool is_alone = integrate_to(x, end, other) == Status::success;
        is_trial_ = false;
        if (is_alone) is_alone = integrate_to(x_, end, other) == Status::success;
        here_.is_ignored = {};
        return is_alone;
    }

    Status settle(const std::array<bool, events>& is_over, std::size_t& event) {
        bool is_settled = false;
        const auto all = [&](State& x, const Input& u) {
            for (std::size_t e = 0; e < events && !is_settled; ++e)
                if (is_over[e]) system_.settle(e, here_.mode, x, u, t_);
            is_settled = true;
        };
        for (std::size_t e = 0; e < events; ++e) {
            if (!is_over[e]) continue;
            accumulations_[e].forget();
            const Status status = change(e, System::after_accumulation(e, here_.mode), all, true, event);
            if (status != Status::success) return status;
        }
        return Status::success;
    }

    using Here = InMode<System>;
    struct NoDerivatives {
        NoDerivatives(const Here&, const Inputs&, const State&) {}
    };
    template <class S, bool>
    struct DerivativesOf {
        using type = NoDerivatives;
    };
    template <class S>
    struct DerivativesOf<S, true> {
        using type = SystemDerivatives<S, Inputs>;
    };

    const System& system_;
    const Inputs& inputs_;
    State& x_;
    Scalar t_, to_;
    const IntegrationOptions<State>& options_;
    StepControl<State> control_;
    OutputPoints<Scalar> outputs_;
    std::size_t next_ = 0;  ///< output point
    Observer& observe_;
    OnChange& on_change_;
    Here here_;
    typename DerivativesOf<Here, has_derivatives<System>>::type derivatives_;
    Result result_;
    std::array<Accumulation<Scalar>, events> accumulations_{};
    Scalar last_time_ = Scalar(0);
    Scalar observed_ = Scalar(0);
    std::size_t stalled_ = 0;  ///< events in a row without progress in time
    bool is_trial_ = false;    ///< nobody looks
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
