// SPDX-License-Identifier: BSL-1.0
// Where a run is, and what moves it: a step that is taken, an event that is passed, an end that is named.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dalembert/constraints.hpp"
#include "dalembert/events/events.hpp"
#include "dalembert/integration_options.hpp"
#include "dalembert/status.hpp"
#include "dalembert/methods/step_control.hpp"
#include "dalembert/methods/stepper.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// The observer is called as observe(t, x). `Values` is an array for those of the guards.
template <class StateOfRun, class Rhs, class Observer, class Guards, class Values>
class RunState {
public:
    using State = StateOfRun;
    using Scalar = typename State::value_type;

    RunState(Rhs& rhs, State& x, Scalar from, Scalar to, const IntegrationOptions<State>& options, Observer& observe, Guards& guards,
             const Like<Values, bool>& ends)
        : rhs_(rhs),
          x_(x),
          from_(from),
          to_(to),
          t_(from),
          options_(options),
          control_(options, from, to),
          observe_(observe),
          events_(guards, ends, options.tolerance, (to - from) / Scalar(1000000)) {}

protected:
    using Try = Candidate<State>;

    static constexpr std::size_t guard_count() noexcept { return size_of<Values>(); }

    void evaluate(const State& x, Scalar t, State& dxdt) {
        if constexpr (may_have_entries<Values>) events_.see(x, t);
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

    /// Names the state to blame: infinite itself, or else the one whose derivative is at x or a little further on. Within a step
    /// what is not finite spreads from one state to the others, so the whole step would not tell.
    Outcome end_not_finite(Scalar further) {
        State ahead = x_;
        State dxdt;
        evaluate(x_, t_, dxdt);
        const auto to_blame = [](const State& x, const State& rate) {
            const std::size_t itself = first_not_finite(x);
            return itself < x.size() ? itself : first_not_finite(rate);
        };
        std::size_t i = to_blame(x_, dxdt);
        if (i == x_.size()) {
            for (std::size_t k = 0; k < x_.size(); ++k) ahead[k] += further * dxdt[k];
            evaluate(ahead, t_ + further, dxdt);
            i = to_blame(ahead, dxdt);
        }
        if constexpr (may_have_entries<Values>) {
            const std::size_t here = events_.not_a_number(x_, t_);
            const std::size_t guard = here != guard_count() ? here : events_.not_a_number(ahead, t_ + further);
            if (i == x_.size() && guard != guard_count()) outcome_.guard = guard;
        }
        outcome_.state = i;
        return end(Status::not_finite);
    }

    /// A step that cannot be made next to the zero of a guard that ends the run ends there.
    Outcome stop(Status status) {
        if constexpr (may_have_entries<Values>) {
            const bool is_stuck = status == Status::not_finite || status == Status::step_too_small;
            const std::size_t guard = is_stuck ? events_.vanishing_guard(x_, t_) : guard_count();
            if (guard != guard_count()) {
                if (observed_ != t_) observe(t_);
                return end_at(Status::event, guard);
            }
        }
        return stop_there(status);
    }
    Outcome stop_there(Status status) {
        return status == Status::not_finite ? end_not_finite(Scalar(64) * control_.smallest(t_)) : end(status);
    }

    Point<State> here() const { return {x_, dxdt_, t_, moves_, is_anew_}; }

    void move(Scalar t, const State& x) {
        t_ = t;
        x_ = x;
        ++moves_;
    }

    void accept(const Try& c) {
        if (c.length > Scalar(0)) ++outcome_.steps;
        move(c.end, c.y);
        if constexpr (may_have_entries<Values>) events_.accept();
        if (is_at_end()) {
            dxdt_ = c.dydt;
            return;
        }
        const bool is_moved = is_cut() ? false : project(x_, t_);
        if (c.has_derivative && !is_moved) dxdt_ = c.dydt;
        else evaluate(x_, t_, dxdt_);
    }

    /// Back to what constraints hold; false where there are none.
    bool project(State& x, Scalar t) {
        if constexpr (is_projected<Rhs, State>) {
            outcome_.constraint = rhs_.project(x, t);
            return true;
        } else {
            (void)x, (void)t;
            return false;
        }
    }

    bool is_broken() const { return outcome_.constraint != Outcome::none; }

    bool is_cut() const {
        if constexpr (may_have_entries<Values>) return events_.is_cut();
        else return false;
    }
    /// A guard that ends the run is behind the step that was cut. On the zero itself the right-hand side may have no value.
    bool is_at_end() const {
        if constexpr (may_have_entries<Values>) return events_.is_cut() && is_sure_of_end();
        else return false;
    }

    /// Where the right-hand side is smooth across guards, it is not they that cut a step short that runs into an input that jumps.
    bool is_sure_of_end() const { return events_.ending_guard() != guard_count() && !events_.spares_stages(); }

    /// The kink that the run keeps to, or none.
    std::size_t resting_guard() const {
        if constexpr (may_have_entries<Values>) {
            if (const std::size_t guard = events_.resting_guard(); guard < guard_count()) return guard;
        }
        return Outcome::none;
    }

    bool keeps_rest(const Try& c) const {
        if constexpr (may_have_entries<Values>) return events_.keeps_rest(c.y, c.end);
        else return true;
    }

    /// Makes the step; with guards, only up to its first event.
    void try_step(Try& c) {
        const auto take = [this](Try& step) { stepper_->take(here(), step); };
        if constexpr (!may_have_entries<Values>) {
            take(c);
        } else {
            const auto between = [this](Try& step, Scalar t, State& x) { stepper_->between(here(), step, t, x); };
            const auto accurate = [this](const Try& step) { return control_.error_norm(x_, step.y, step.error) <= Scalar(1); };
            if (guard_count() == 0) return take(c);
            events_.search(c, x_, t_, control_.tiny(t_), control_.resolution(c.end), take, between, accurate);
        }
    }

    /// On its zero a jump may have a value that holds on neither side: a run that starts there starts just behind it.
    void leave_zero() {
        using std::abs;
        using std::max;
        const Scalar ahead = Scalar(16) * std::numeric_limits<Scalar>::epsilon() * max(Scalar(abs(t_)), Scalar(to_ - from_));
        if (!events_.is_on_zero() || !(t_ + ahead < to_)) return;
        State x;
        State dxdt;
        for (std::size_t i = 0; i < x_.size(); ++i) x[i] = x_[i] + ahead * dxdt_[i];
        evaluate(x, t_ + ahead, dxdt);
        if (!are_finite(x, dxdt) || !events_.leave_zero(x, t_ + ahead)) return;
        move(t_ + ahead, x);
        dxdt_ = dxdt;
    }

    /// What is due now: a sample of a controller, say.
    void act() {
        if (options_.clock != nullptr) options_.clock->act(x_, t_, t_ + room(), 0);
    }
    /// Instants within it are not told apart.
    Scalar room() const { return Scalar(4) * control_.smallest(t_); }
    /// What is due between here and `behind`, at its own instant.
    void act_before(Scalar behind) {
        const Scalar instant = std::min(std::max(options_.clock->next(), t_), behind);
        State x;
        for (std::size_t i = 0; i < x_.size(); ++i) x[i] = x_[i] + (instant - t_) * dxdt_[i];
        options_.clock->act(x, instant, behind + room(), 0);
    }

    Status end_on(std::size_t guard) {
        outcome_.guard = guard;
        if (observed_ != t_) observe(t_);
        return Status::event;
    }

    /// From just before a kink that is known to just behind it. An event that jumps with it happens there.
    Status pass_kink(Scalar behind) {
        const bool acts = options_.clock != nullptr && behind < to_;  // what is due at the end of a run is not done any more
        if (acts) act_before(behind);
        const Scalar half = (behind - t_) / Scalar(2);
        const State before = dxdt_;
        State x;
        for (std::size_t i = 0; i < x_.size(); ++i) x[i] = x_[i] + (behind - t_) * dxdt_[i];
        move(behind, x);
        if constexpr (may_have_entries<Values>) outcome_.events += events_.pass_known(x_, t_);
        control_.forget();
        evaluate(x_, t_, dxdt_);
        // What acts does so from halfway on.
        for (std::size_t i = 0; acts && i < x_.size(); ++i) x_[i] += half * (dxdt_[i] - before[i]);
        if constexpr (may_have_entries<Values>)
            if (events_.has_jumped(x_, t_)) return end_on(events_.ending_guard());
        return Status::success;
    }

    /// At the end of a step that was cut for an event: ends the run there, or starts anew behind it.
    Status pass_event() {
        if (is_broken()) return Status::constraint_broken;
        if constexpr (may_have_entries<Values>) {
            is_anew_ = false;
            if (!is_cut()) return Status::success;
            Scalar t = t_;
            State x = x_;
            if (!is_sure_of_end() && !find_other_side(t, x)) {
                events_.retract();
                return Status::success;
            }
            const std::size_t ending = events_.ending_guard();
            if (ending != guard_count()) return end_on(ending);
            is_anew_ = true;
            move(t, x);
            act();
            const std::size_t changed = events_.changed_guard();
            outcome_.events += events_.pass(t_);
            stalled_ = outcome_.events > 1 && !(t_ - last_event_ > control_.smallest(t_)) ? stalled_ + 1 : 0;
            last_event_ = t_;
            control_.forget();
            evaluate(x_, t_, dxdt_);
            if (!are_finite(x_, dxdt_)) return Status::not_finite;
            if (outcome_.events > options_.max_events || stalled_ > 100 + guard_count()) {
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
        for (Scalar ahead = behind.end - t_; are_finite(dxdt_, dxdt_) && ahead <= control_.tiny(t_) && t_ + ahead <= to_;
             ahead *= Scalar(2)) {
            t = t_ + ahead;
            for (std::size_t i = 0; i < x_.size(); ++i) x[i] = x_[i] + ahead * dxdt_[i];
            if (events_.has_changed_at(x, t)) return true;
        }
        bool is_near = behind.finite;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const Scalar size = max(options_.scale[i], Scalar(abs(x_[i])));
            is_near = is_near && abs(behind.y[i] - x_[i]) <= Scalar(64) * std::numeric_limits<Scalar>::epsilon() * size;
        }
        t = behind.end;
        x = behind.y;
        return behind.finite && events_.has_changed() && (is_near || behind.length <= control_.tiny(t_) || !events_.can_retract());
    }

    Rhs& rhs_;
    State& x_;
    Scalar from_, to_, t_;
    const IntegrationOptions<State>& options_;
    StepControl<State> control_;
    Observer& observe_;
    State dxdt_{};
    std::size_t moves_ = 0;
    Stepper<State>* stepper_ = nullptr;
    Outcome outcome_;
    Scalar observed_ = Scalar(0);  ///< s, of the last observation of the state where the run is
    EventSearch<State, Guards, Values> events_;
    Scalar last_event_ = Scalar(0);
    bool is_anew_ = false;     ///< integration has just started anew
    std::size_t stalled_ = 0;  ///< events in a row without progress in time
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
