// SPDX-License-Identifier: BSL-1.0
// A run of a system with modes within one of them: which one, the integration up to an event, and what is observed.
#pragma once

#include <array>
#include <cstddef>

#include "dalembert/constraints.hpp"
#include "dalembert/events/modes.hpp"
#include "dalembert/integrate.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

template <class System, class Inputs, class Observer, class Result>
class ModeRun {
public:
    using Scalar = typename System::scalar_type;
    using State = typename System::State;
    using Input = typename System::Input;
    using Mode = typename System::Mode;
    static constexpr std::size_t event_count() noexcept { return size_of<typename System::Events>(); }
    static constexpr std::size_t none = Outcome::none;

    ModeRun(const System& system, const Inputs& inputs, State& x, Scalar from, Scalar to, const IntegrationOptions<State>& options,
            Observer& observer)
        : system_(system),
          inputs_(inputs),
          x_(x),
          t_(from),
          to_(to),
          options_(options),
          control_(options, from, to),
          outputs_(options_, from, to),
          observe_(observer),
          here_(system, Mode{}),
          derivatives_(here_, inputs, options_.scale) {}

protected:
    bool is_finite() {
        result_.state = first_not_finite(x_);
        return result_.state == x_.size();
    }

    /// Takes the first of the modes that accepts the state, or else the first one in which an event happens at once, or where `is_late` has
    /// happened an instant ago.
    template <class Modes>
    bool choose(const Modes& modes, std::size_t& event, bool is_late = false) {
        const Scalar instant = control_.tiny(t_);
        const InputsAhead<System> inputs{inputs_(x_, t_), inputs_(x_, t_ + instant / Scalar(2)), inputs_(x_, t_ + instant)};
        bool is_found = false;
        for (const Mode mode : modes) {
            const Acceptance answer = acceptance(system_, mode, x_, inputs, t_, instant, is_late);
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
        const auto plain_rhs = [this](const State& at, Scalar t, State& dxdt) { here_.rhs(at, inputs_(at, t), t, dxdt); };
        const auto rhs = [&] {
            using Bare = detail::Bare<System>;
            if constexpr (needs_projection<typename Bare::type>) {
                const auto back = [this](State& at, Scalar t) {
                    return Bare::change(at, [&](auto& part) { return project(Bare::of(system_), part, t, here_.mode).broken; });
                };
                return ProjectedRhs{plain_rhs, back};
            } else {
                return plain_rhs;
            }
        }();
        const auto guards = [this](const State& at, Scalar t, typename Here::Guards& g) { here_.guards(at, inputs_(at, t), t, g); };
        const auto observe = [this](Scalar t, const State& at) { observe_output(t, at); };
        Like<typename Here::Guards, bool> ends{};
        for (std::size_t e = 0; e < event_count(); ++e) ends[e] = true;
        // The limits are those of the whole.
        IntegrationOptions<State> options = options_;
        options.max_steps -= result_.steps + result_.rejected;
        options.max_events -= result_.events;
        options.intervals = options.output_count();
        options.output_times.clear();
        ClockInMode clock(options_.clock, here_.mode);
        if (options_.clock != nullptr) options.clock = &clock;
        if (to < to_)
            for (options.intervals = next_; outputs_.time(options.intervals) < to;) ++options.intervals;
        Integration<State, decltype(rhs), decltype(observe), decltype(guards), typename Here::Guards> run(rhs, x, t_, to, options, observe,
                                                                                                          guards, ends);
        run.be_part(outputs_, next_);
        const auto steps_before = choice_.steps;
        const Outcome part = integrate_by_method(run);
        if (is_trial_) {
            choice_.steps = steps_before;
            return part.status;
        }
        t_ = run.time();
        result_.steps += part.steps;
        result_.rejected += part.rejected;
        result_.rhs_calls += part.rhs_calls;
        result_.steps_by = choice_.steps;
        result_.events += part.events;
        result_.state = part.state;
        result_.guard = event = part.guard;
        result_.constraint = part.constraint;
        return part.status;
    }

    template <class Run>
    Outcome integrate_by_method(Run& run) {
        if constexpr (can_make_series<Here, Inputs>())
            if (options_.method == Method::taylor && has_series_in_run<Here>())
                return run_taylor(run, SystemSeries<Here, Inputs>(here_, inputs_));
        return run_by_method(run, derivatives_, options_, choice_);
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

    /// That of the whole run, which is told the mode.
    struct ClockInMode final : Clock<State> {
        ClockInMode(Clock<State>* of_run, Mode mode) : clock(of_run), number(static_cast<std::size_t>(mode)) {}
        Scalar next() const override { return clock->next(); }
        void act(const State& x, Scalar t, Scalar until, std::size_t) override { clock->act(x, t, until, number); }
        Clock<State>* clock;
        std::size_t number;
    };

    using Here = InMode<System>;
    struct WithoutDerivatives : NoDerivatives {
        WithoutDerivatives(const Here&, const Inputs&, const State&) {}
    };
    template <class S, bool>
    struct DerivativesOf {
        using type = WithoutDerivatives;
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
    OutputPoints<State> outputs_;
    std::size_t next_ = 0;  ///< output point
    Observer& observe_;
    Here here_;
    using OwnDerivatives = typename DerivativesOf<Here, has_derivatives<System>>::type;
    OwnDerivatives derivatives_;
    ChoiceOf<Scalar, OwnDerivatives> choice_;
    Result result_;
    Scalar observed_ = Scalar(0);  ///< s, when it was last
    bool is_trial_ = false;        ///< nobody looks, and nothing counts
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
