// SPDX-License-Identifier: GPL-3.0-or-later
#include "dalembert/lane_run.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "dalembert/simulate.hpp"
#include "hydraulics/hydraulic_cylinder_real.hpp"
#include "mechanics/cart_pendulum_lab.hpp"

using namespace dalembert;

namespace {

struct Guard {
    const char* name;
    const char* doc;
    bool ends;
};

/// A stone that falls from x[0] with the acceleration of 1 m/s^2 until it meets the ground.
template <class Scalar>
struct Stone {
    using scalar_type = Scalar;
    using State = std::array<Scalar, 2>;
    using Input = std::array<Scalar, 0>;
    using Guards = std::array<Scalar, 2>;
    static constexpr const std::array<Guard, 2>& guard_table() noexcept { return table; }
    void rhs(const State& x, const Input&, const Scalar&, State& dxdt) const { dxdt = {x[1], Scalar(-1)}; }
    void guards(const State& x, const Input&, const Scalar&, Guards& g) const { g = {-x[0], x[0]}; }
    static constexpr std::array<Guard, 2> table{Guard{"sign", "a kink", false}, Guard{"ground", "the ground", true}};
};

/// x' = x^2, which is infinite at t = 1/x(0).
template <class Scalar>
struct Explosion {
    using scalar_type = Scalar;
    using State = std::array<Scalar, 1>;
    using Input = std::array<Scalar, 0>;
    using Guards = std::array<Scalar, 0>;
    void rhs(const State& x, const Input&, const Scalar&, State& dxdt) const { dxdt = {x[0] * x[0]}; }
};

template <class System>
struct NoInput {
    typename System::Input operator()(const typename System::State&, const typename System::scalar_type&) const { return {}; }
};

template <class P, std::size_t n>
using Lanes = std::array<std::array<typename P::value_type, n>, P::size>;

/// Each lane beside a run of its own.
template <template <class> class System>
void are_as_alone(double until, double spread) {
    using P = WidestPack<double>;
    const System<P> packs;
    const System<double> one;
    using State = typename System<double>::State;
    std::array<State, P::size> starts;
    IntegrationOptions<State> options;
    SimulationOptions<System<double>> alone;
    options.tolerance = alone.tolerance = 1e-8;
    alone.method = Method::dopri5;
    for (std::size_t lane = 0; lane < P::size; ++lane) {
        starts[lane] = one.start_state();
        for (double& v : starts[lane]) v *= 1 + spread * static_cast<double>(lane);
    }
    const auto scale = state_scales(one, ZeroInputs<System<double>>{}, starts[0], until, 10);
    std::copy(scale.begin(), scale.end(), options.scale.begin());
    std::copy(scale.begin(), scale.end(), alone.scale.begin());
    auto x = packed<P>(starts);
    const auto outcomes = integrate_lanes(packs, NoInput<System<P>>{}, x, 0.0, until, options);
    for (std::size_t lane = 0; lane < P::size; ++lane) {
        CAPTURE(lane);
        State y = starts[lane];
        const auto result = simulate(one, ZeroInputs<System<double>>{}, y, 0.0, until, alone, [](const auto&) {});
        CHECK(outcomes[lane].status == Status::success);
        CHECK(outcomes[lane].t == until);
        CHECK(static_cast<double>(outcomes[lane].steps) < 1.5 * static_cast<double>(result.outcome.steps) + 5);
        for (std::size_t i = 0; i < y.size(); ++i) CHECK(std::abs(x[i].get(lane) - y[i]) < 3e-6 * std::max(std::abs(y[i]), options.scale[i]));
    }
}

}  // namespace

TEST_CASE("every lane goes its own way") {
    are_as_alone<cart_pendulum::lab::System>(10, 0.1);
    are_as_alone<hydraulic_cylinder::real::System>(0.02, 0.01);
}

TEST_CASE("lanes end at guards of their own, where those become negative") {
    using P = WidestPack<double>;
    Lanes<P, 2> starts;
    for (std::size_t lane = 0; lane < P::size; ++lane) starts[lane] = {0.5 * static_cast<double>((lane + 1) * (lane + 1)), 0.0};
    auto x = packed<P>(starts);
    const double until = 1.5;
    const auto outcomes = integrate_lanes(Stone<P>{}, NoInput<Stone<P>>{}, x, 0.0, until, {});
    for (std::size_t lane = 0; lane < P::size; ++lane) {
        CAPTURE(lane);
        const double hits = static_cast<double>(lane + 1);  // sqrt(2 h)
        CHECK(outcomes[lane].status == (hits < until ? Status::event : Status::success));
        CHECK(outcomes[lane].t == doctest::Approx(std::min(hits, until)).epsilon(1e-12));
        CHECK(x[1].get(lane) == doctest::Approx(-std::min(hits, until)).epsilon(1e-12));
        CHECK(x[0].get(lane) >= 0);
        if (hits < until) CHECK(outcomes[lane].guard == 1);
    }
}

TEST_CASE("a lane that begins beyond a guard ends at once") {
    using P = WidestPack<double>;
    Lanes<P, 2> starts;
    starts.fill({100.0, 0.0});
    starts[0] = {-1.0, 0.0};
    auto x = packed<P>(starts);
    const auto outcomes = integrate_lanes(Stone<P>{}, NoInput<Stone<P>>{}, x, 0.0, 2.0, {});
    CHECK(outcomes[0].status == Status::event);
    CHECK(outcomes[0].t == 0);
    CHECK(x[0].get(0) == -1);
    for (std::size_t lane = 1; lane < P::size; ++lane) CHECK(x[0].get(lane) == doctest::Approx(98).epsilon(1e-12));
}

TEST_CASE("a lane that cannot go on does not hold the others") {
    using P = WidestPack<double>;
    Lanes<P, 1> starts;
    for (std::size_t lane = 0; lane < P::size; ++lane) starts[lane] = {lane == 1 ? 1.0 : 0.25};
    auto x = packed<P>(starts);
    const auto outcomes = integrate_lanes(Explosion<P>{}, NoInput<Explosion<P>>{}, x, 0.0, 2.0, {});
    for (std::size_t lane = 0; lane < P::size; ++lane) {
        CAPTURE(lane);
        if (lane == 1) {
            CHECK(outcomes[lane].status != Status::success);
            CHECK(outcomes[lane].t == doctest::Approx(1).epsilon(1e-3));
        } else {
            CHECK(outcomes[lane].status == Status::success);
            CHECK(x[0].get(lane) == doctest::Approx(0.5).epsilon(1e-7));
        }
    }
}

TEST_CASE("a lane whose start is no number ends at once, and does not hold the others") {
    using P = WidestPack<double>;
    for (const double strange : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        CAPTURE(strange);
        Lanes<P, 1> starts;
        starts.fill({0.25});
        starts[0] = {strange};
        auto x = packed<P>(starts);
        const auto outcomes = integrate_lanes(Explosion<P>{}, NoInput<Explosion<P>>{}, x, 0.0, 2.0, {.max_steps = 1000});
        CHECK(outcomes[0].status == Status::not_finite);
        for (std::size_t lane = 1; lane < P::size; ++lane) {
            CHECK(outcomes[lane].status == Status::success);
            CHECK(x[0].get(lane) == doctest::Approx(0.5).epsilon(1e-7));
        }
    }
}

TEST_CASE("options that lanes do not take are refused") {
    using P = WidestPack<double>;
    auto x = packed<P>(Lanes<P, 2>{});
    IntegrationOptions<std::array<double, 2>> options;
    options.method = Method::rk4;
    options.step = 0.1;
    for (const Outcome& outcome : integrate_lanes(Stone<P>{}, NoInput<Stone<P>>{}, x, 0.0, 1.0, options)) CHECK(outcome.status == Status::bad_options);
}
