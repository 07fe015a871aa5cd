// SPDX-License-Identifier: BSL-1.0
// How the sensitivities of a run depend on parameters and start values themselves: d2x/(dp dp), for small systems.
//
// The first derivatives are those of simulate_sensitivities(). The second ones are differences of them, extrapolated over steps that are
// halved: any machine that has first derivatives has these, with events, modes and constraints. Each number comes with its doubt.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "dalembert/sensitivities.hpp"
#include "dalembert/sensitivities/extrapolation.hpp"

namespace dalembert {
inline namespace v1 {

/// At the end of a run.
template <class System, std::size_t count>
struct SecondSensitivities {
    using State = typename System::State;
    State x{};
    Sensitivities<System, count> S{};                      ///< dx/d(varied c) at S[c]
    std::array<std::array<State, count>, count> second{};  ///< d2x/(d(varied c) d(varied d)) at second[c][d]; symmetric
    std::array<std::array<State, count>, count> doubt{};   ///< an estimate of the error; infinite where there is none
    Outcome outcome{};                                     ///< of the run itself
};

/// Makes 1 + 14 count runs from `from` to `to`, each with its first derivatives: options.tolerance should be tight, as 1e-12. start(system,
/// x, S) sets the start of a run and its derivatives for a system whose parameters are moved; a start that is varied is moved behind it.
/// `inputs` as in simulate_sensitivities(): where they follow parameters they have of(system).
template <std::size_t count, class System, class Inputs, class Start>
SecondSensitivities<System, count> simulate_second_sensitivities(const System& system, const Inputs& inputs,
                                                                 const std::array<Varied, count>& varied, const Start& start,
                                                                 typename System::scalar_type from, typename System::scalar_type to,
                                                                 const IntegrationOptions<typename System::State>& options) {
    using Scalar = typename System::scalar_type;
    using std::abs;
    constexpr std::size_t levels = detail::steps_of_extrapolation;
    SecondSensitivities<System, count> result;
    const auto nothing = [](const auto&) {};
    start(system, result.x, result.S);
    const typename System::State x0 = result.x;
    result.outcome = simulate_sensitivities(system, inputs, varied, result.x, result.S, from, to, options, nothing);
    for (auto& row : result.doubt)
        for (auto& of_pair : row) of_pair.fill(std::numeric_limits<Scalar>::infinity());
    if (result.outcome.status != Status::success) return result;
    const std::size_t n = result.x.size();
    // differences[level][c]: of S[c], by the one that is moved
    std::array<Sensitivities<System, count>, levels> differences{};
    for (std::size_t d = 0; d < count; ++d) {
        const bool is_start = varied[d].of == Varied::Of::start;
        const std::size_t number = varied[d].number;
        Scalar step = is_start ? std::max(Scalar(abs(x0[number])), options.scale[number]) : detail::size_of_parameter(system, number);
        step *= Scalar(detail::longest_step_of_extrapolation);
        for (auto& level : differences) {
            const auto moved = [&](const Scalar& by, Sensitivities<System, count>& S) {
                System other = system;
                typename System::State x{};
                if (!is_start) detail::move_parameter(other, number, by);
                start(other, x, S);
                if (is_start) x[number] += by;
                const Outcome outcome =
                    simulate_sensitivities(other, detail::inputs_with(inputs, other), varied, x, S, from, to, options, nothing);
                return outcome.status == Status::success;
            };
            Sensitivities<System, count> behind{};
            const bool is_good = moved(step, level) && moved(-step, behind);
            for (std::size_t c = 0; c < count; ++c)
                for (std::size_t i = 0; i < n; ++i)
                    level[c][i] = is_good ? (level[c][i] - behind[c][i]) / (Scalar(2) * step) : std::numeric_limits<Scalar>::quiet_NaN();
            step /= Scalar(2);
        }
        for (std::size_t c = 0; c < count; ++c)
            for (std::size_t i = 0; i < n; ++i) {
                std::array<Scalar, levels> one{};
                for (std::size_t k = 0; k < levels; ++k) one[k] = differences[k][c][i];
                const auto found = detail::extrapolated(one);
                if (!(found.doubt < result.doubt[c][d][i])) continue;
                for (auto [a, b] : {std::array{c, d}, std::array{d, c}}) {
                    result.second[a][b][i] = found.value;
                    result.doubt[a][b][i] = found.doubt;
                }
            }
    }
    return result;
}

/// With the start of the model, which parameters may move.
template <std::size_t count, class System, class Inputs>
SecondSensitivities<System, count> simulate_second_sensitivities(const System& system, const Inputs& inputs,
                                                                 const std::array<Varied, count>& varied, typename System::scalar_type from,
                                                                 typename System::scalar_type to,
                                                                 const IntegrationOptions<typename System::State>& options) {
    const auto start = [&](const System& of, typename System::State& x, Sensitivities<System, count>& S) {
        x = of.start_state();
        S = sensitivities_at_start(of, varied);
    };
    return simulate_second_sensitivities(system, inputs, varied, start, from, to, options);
}

}  // namespace v1
}  // namespace dalembert
