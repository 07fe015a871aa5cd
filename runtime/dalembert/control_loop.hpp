// SPDX-License-Identifier: BSL-1.0
// A generated controller that samples, in a run of a generated system.
#pragma once

#include <algorithm>
#include <utility>

#include "dalembert/clock.hpp"
#include "dalembert/simulate.hpp"

namespace dalembert {
inline namespace v1 {

/// Takes samples during simulate(): give it to the options as `clock`, and use output() in the inputs of the run. `measure` is called as
/// measure(x, t) with the state of the system, and returns what the controller measures. Numbers of the controller may be others than
/// those of the system, as float beside double.
template <class System, class Controller, class Measure>
class ControlLoop final : public Clock<typename SimulationOptions<System>::State> {
    using StateAndWork = typename SimulationOptions<System>::State;

public:
    /// Before the first sample takes effect, the output is what it would be if it was taken at the start, where the state is x.
    ControlLoop(const Controller& controller, const SampleClock& clock, const typename System::State& x, Measure measure)
        : controller_(controller), clock_(clock), measure_(std::move(measure)), z_(controller.start_state()) {
        typename Controller::State z = z_;
        controller_.sample(measure_(x, 0.0), z, computed_);
        output_ = computed_;
    }

    /// What acts on the system now.
    const typename Controller::Output& output() const { return output_; }
    /// The states of the controller for its next sample.
    const typename Controller::State& state() const { return z_; }

    double next() const override { return clock_.next(); }
    void act(const StateAndWork& x, double t, double until, std::size_t) override {
        while (true) {
            if (clock_.is_effect_due(until)) {
                output_ = computed_;
                clock_.take_effect();
            } else if (clock_.is_sample_due(until)) {
                typename System::State state;
                std::copy_n(x.begin(), state.size(), state.begin());
                controller_.sample(measure_(state, t), z_, computed_);
                clock_.take_sample();
            } else {
                return;
            }
        }
    }

private:
    Controller controller_;
    SampleClock clock_;
    Measure measure_;
    typename Controller::State z_;
    typename Controller::Output computed_{}, output_{};
};

template <class System, class Controller, class Measure>
ControlLoop<System, Controller, Measure> control_loop(const Controller& controller, const SampleClock& clock,
                                                      const typename System::State& x, Measure measure) {
    return {controller, clock, x, std::move(measure)};
}

}  // namespace v1
}  // namespace dalembert
