// SPDX-License-Identifier: BSL-1.0
// The sizes that errors of states are measured against, found by a rough run of the system itself.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <type_traits>

#include "dalembert/simulate.hpp"
#include "dalembert/simulate_switching.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// What a run of a system with or without modes takes and calls. A rough run and the run that counts share their types, so that a method is
/// compiled once.
template <class System, bool = is_switching<System>>
struct Running {
    using Options = SimulationOptions<System>;
    using Sample = dalembert::Sample<System>;
    using Observe = std::function<void(const Sample&)>;
    template <class Inputs, class Time>
    static SimulationResult run(const System& system, const Inputs& inputs, typename System::State& x, Time until, const Options& options,
                                const Observe& observe) {
        return simulate(system, inputs, x, Time(0), until, options, observe);
    }
};
template <class System>
struct Running<System, true> {
    using Options = SwitchingSimulationOptions<System>;
    using Sample = SwitchingSample<System>;
    using Observe = std::function<void(const Sample&)>;
    using State = typename System::State;
    using Mode = typename System::Mode;
    using OnChange = std::function<void(typename System::scalar_type, std::size_t, Mode, Mode, const State&, const State&, bool)>;
    template <class Inputs, class Time>
    static SwitchingResult<System> run(
        const System& system, const Inputs& inputs, State& x, Time until, const Options& options, const Observe& observe,
        const OnChange& on_change = [](const auto&...) {}) {
        return simulate_switching(system, inputs, x, Time(0), until, options, observe, on_change);
    }
};

/// What rounding leaves of the derivative of each state: how much it changes with the last digits of the states.
template <class System, class Sample>
typename System::State rate_rounding(const System& system, const Sample& sample) {
    using Scalar = typename System::scalar_type;
    using State = typename System::State;
    using std::abs;
    using std::max;
    const auto rate = [&](const State& x) {
        State dxdt;
        if constexpr (is_switching<System>)
            system.rhs(sample.mode, x, sample.u, sample.t, dxdt);
        else
            system.rhs(x, sample.u, sample.t, dxdt);
        return dxdt;
    };
    State largest{};
    const State here = rate(sample.x);
    for (const std::size_t period : {1U, 2U}) {
        State x = sample.x;
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] += Scalar(i / period % 2 == 0 ? 2 : -2) * std::numeric_limits<Scalar>::epsilon() * x[i];
        const State there = rate(x);
        for (std::size_t i = 0; i < x.size(); ++i) largest[i] = max(largest[i], Scalar(abs(there[i] - here[i])));
    }
    return largest;
}

}  // namespace detail

/// The scale of each state, in SI, of a run from `start` at t = 0. It is the largest magnitude that the state reaches, where this is
/// less than one unit: integration measures errors against the larger one of this and of the present magnitude, so that a valve stroke of a
/// tenth of a millimetre has as many digits as a way of metres. A state that rests at zero but for roundings counts in whole units.
/// Where the rough run stops, the sizes are those up to there.
/// A size stops where the digits that `tolerance` asks for are no longer there: where what rounding leaves of a rate, over the longest
/// step, would be an error that counts. A pendulum that swings by 3e-5 m rises at 3e-9 m/s, known to 1e-17 m/s, and not to 1e-9 of that.
/// Steps of the rough run are as long as an interval at most, or as four times `seen_step`, in s, within which nothing comes and goes; with
/// this it looks at a hundred points at most.
template <class System, class Inputs>
typename System::State state_scales(const System& system, const Inputs& inputs, const typename System::State& start,
                                    typename System::scalar_type until, std::size_t intervals, typename System::scalar_type tolerance = 1,
                                    typename System::scalar_type seen_step = 0) {
    using Scalar = typename System::scalar_type;
    using State = typename System::State;
    using std::abs;
    using std::isfinite;
    using std::max;
    using std::min;
    const Scalar longest = until / Scalar(static_cast<double>(intervals));
    const Scalar rest = Scalar(10000) * std::numeric_limits<Scalar>::epsilon();
    const Scalar most = Scalar(1) / Scalar(1000);  // states that are this large are never measured against less
    State scale;
    for (std::size_t i = 0; i < start.size(); ++i) scale[i] = abs(start[i]) > rest ? min(Scalar(1), Scalar(abs(start[i]))) : Scalar(1);
    State rounding{};
    // Against sizes that are much too large a rough run says little about small states: it is repeated with what it found.
    for (int again = 0; again < 5; ++again) {
        typename detail::Running<System>::Options options;
        options.tolerance = Scalar(1) / Scalar(1000);
        options.intervals = seen_step > Scalar(0) ? std::min<std::size_t>(intervals, 100) : intervals;
        options.max_step = min(until, max(Scalar(4) * seen_step, longest));
        options.max_steps = 100000;
        std::copy(scale.begin(), scale.end(), options.scale.begin());
        options.scale.back() = std::numeric_limits<Scalar>::max() / Scalar(1e10);  // the work
        State reach{};
        for (std::size_t i = 0; i < reach.size(); ++i) reach[i] = abs(start[i]);
        State x = start;
        detail::Running<System>::run(system, inputs, x, until, options, [&](const auto& sample) {
            for (std::size_t i = 0; i < reach.size(); ++i)
                if (isfinite(sample.x[i])) reach[i] = max(reach[i], Scalar(abs(sample.x[i])));
            // Of states that are large enough roundings change nothing.
            if (std::all_of(reach.begin(), reach.end(), [&](Scalar size) { return size >= most; })) return;
            const State rate = detail::rate_rounding(system, sample);
            for (std::size_t i = 0; i < rate.size(); ++i)
                if (isfinite(rate[i])) rounding[i] = max(rounding[i], rate[i]);
        });
        bool is_good = true;
        for (std::size_t i = 0; i < reach.size(); ++i) {
            const Scalar found = reach[i] > rest ? min(Scalar(1), reach[i]) : Scalar(1);
            is_good = is_good && found > scale[i] / Scalar(10);
            scale[i] = found;
        }
        if (is_good) break;
    }
    for (std::size_t i = 0; i < scale.size(); ++i)
        scale[i] = max(scale[i], min(most, Scalar(Scalar(4) * rounding[i] * longest / tolerance)));
    return scale;
}

}  // namespace v1
}  // namespace dalembert
