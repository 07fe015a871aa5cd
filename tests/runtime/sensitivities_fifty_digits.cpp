// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivities in double over events, kinks and modes, beside central differences of runs in 50 digits.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <dalembert/sensitivities.hpp>

#include <algorithm>
#include <cmath>

#include "hydraulics/switched_tank_switched.hpp"
#include "hydraulics/torricelli_moving_surface.hpp"
#include "mechanics/bouncing_ball_full.hpp"
#include "mechanics/stick_slip_exact.hpp"
#include "pneumatics/reservoir_discharge_full.hpp"

using namespace dalembert;

namespace {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// The end of a run in 50 digits. `scale` holds the sizes of the states.
template <class System, class Scale>
typename System::State end_of(const System& system, const Digits& until, const Scale& scale) {
    typename System::State x = system.start_state();
    const ZeroInputs<System> inputs;
    const auto set = [&](auto& options) {
        options.method = Method::dop853;
        options.tolerance = Digits(1e-24);
        options.scale.fill(1);
        std::copy(scale.begin(), scale.end(), options.scale.begin());
    };
    if constexpr (detail::is_switching<System>) {
        SwitchingSimulationOptions<System> options;
        set(options);
        const auto nobody = [](const auto&...) {};
        CHECK(simulate_switching(system, inputs, x, Digits(0), until, options, nobody, nobody).outcome.status == Status::success);
    } else {
        SimulationOptions<System> options;
        set(options);
        CHECK(simulate(system, inputs, x, Digits(0), until, options, [](const auto&) {}).outcome.status == Status::success);
    }
    return x;
}

/// By all parameters; `events` is how many the run must have.
template <template <class> class SystemOf>
void compare(double until, const typename SystemOf<double>::State& scale, std::size_t events) {
    using System = SystemOf<double>;
    using Exact = SystemOf<Digits>;
    constexpr std::size_t count = System::parameter_table().size();
    std::array<Varied, count> varied{};
    for (std::size_t c = 0; c < count; ++c) varied[c] = Varied::parameter(c);
    const System system;
    typename System::State x = system.start_state();
    auto S = sensitivities_at_start(system, varied);
    IntegrationOptions<typename System::State> options;
    options.method = Method::dop853;
    options.tolerance = 1e-12;
    options.scale = scale;
    const ZeroInputs<System> inputs;
    const Outcome outcome = simulate_sensitivities(system, inputs, varied, x, S, 0.0, until, options, [](const auto&) {});
    CHECK(outcome.status == Status::success);
    CHECK(outcome.events == events);
    for (std::size_t c = 0; c < count; ++c) {
        const double size = detail::size_of_parameter(system, c);
        const Digits step = Digits(1e-10) * Digits(size);
        Exact ahead, behind;
        detail::move_parameter(ahead, c, step);
        detail::move_parameter(behind, c, -step);
        const auto at_ahead = end_of(ahead, until, scale), at_behind = end_of(behind, until, scale);
        for (std::size_t i = 0; i < x.size(); ++i) {
            CAPTURE(System::parameter_table()[c].name);
            CAPTURE(i);
            const double expected = static_cast<double>(Digits((at_ahead[i] - at_behind[i]) / (2 * step)));
            CAPTURE(expected);
            CAPTURE(S[c][i]);
            CHECK(std::fabs(S[c][i] - expected) <= 1e-8 * std::max(std::fabs(expected), 1e-3 * scale[i] / size));
        }
    }
}

}  // namespace

TEST_CASE("50 digits: a ball that bounces three times") { compare<bouncing_ball::full::System>(2.5, {1, 10}, 3); }
TEST_CASE("50 digits: a block that sticks and slips") { compare<stick_slip::exact::System>(6, {0.1, 0.1}, 4); }
TEST_CASE("50 digits: a tank with an outlet") { compare<torricelli::moving_surface::System>(900, {1}, 0); }
TEST_CASE("50 digits: a tank whose valve switches three times") { compare<switched_tank::switched::System>(300, {1}, 3); }
TEST_CASE("50 digits: a flow that is choked, then not") { compare<reservoir_discharge::full::System>(120, {800}, 1); }
