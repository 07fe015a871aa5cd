// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivities of runs beside a closed form, and beside differences of runs in long double.
#include <doctest/doctest.h>

#include <dalembert/sensitivities.hpp>
#include <dalembert/simulate.hpp>

#include <cmath>
#include <string>

#include "heat/heat_exchanger_N12_counter.hpp"
#include "heat/immersion_heater_heating.hpp"
#include "heat/voltage_regulator_cooled.hpp"
#include "mechanics/cart_pendulum_lab.hpp"
#include "mechanics/stick_slip_smooth.hpp"

using namespace dalembert;

namespace {

/// A force that follows the state and the time.
template <class System>
struct Feedback {
    using Scalar = typename System::scalar_type;
    typename System::Input operator()(const typename System::State& x, Scalar t) const {
        using std::sin;
        return {Scalar(-20) * x[1] - Scalar(3) * x[2] + sin(Scalar(2) * t)};
    }
};

/// The end of a run in long double, far more accurate than those that are compared with it.
template <template <class> class System, template <class> class Inputs>
typename System<long double>::State exact_end(const System<long double>& system, typename System<long double>::State x, long double until,
                                              long double scale) {
    using State = typename System<long double>::State;
    const Inputs<System<long double>> inputs;
    IntegrationOptions<State> options;
    options.method = Method::dop853;
    options.tolerance = 1e-16L;
    options.scale.fill(scale);
    const auto rhs = [&](const State& at, long double t, State& rate) { system.rhs(at, inputs(at, t), t, rate); };
    CHECK(integrate(rhs, x, 0.0L, until, options, [](long double, const State&) {}).status == Status::success);
    return x;
}

/// dx/d(varied) at the end, by differences of order six.
template <template <class> class System, template <class> class Inputs>
typename System<long double>::State by_differences(const Varied& varied, const typename System<double>::State& start, double until,
                                                   double scale) {
    using Wide = System<long double>;
    typename Wide::State x, sum{};
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = start[i];
    const bool is_start = varied.of == Varied::Of::start;
    const long double value = is_start ? x[varied.number] : reinterpret_cast<const long double*>(&Wide().parameters())[varied.number];
    const long double h = 1e-3L * (value == 0 ? scale : std::abs(value));
    for (const auto& [steps, weight] : {std::pair(1, 45), std::pair(2, -9), std::pair(3, 1)})
        for (const int sign : {1, -1}) {
            Wide system;
            typename Wide::State from = x;
            if (is_start)
                from[varied.number] += sign * steps * h;
            else
                detail::move_parameter(system, varied.number, sign * steps * h);
            const auto end = exact_end<System, Inputs>(system, from, until, scale);
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sign * weight * end[i] / (60 * h);
        }
    return sum;
}

template <template <class> class System, template <class> class Inputs, std::size_t count>
void compare(const std::array<Varied, count>& varied, const typename System<double>::State& start, double until, double scale,
             double tolerance, std::initializer_list<Method> methods, double allowed) {
    using Plain = System<double>;
    std::array<typename System<long double>::State, count> expected;
    for (std::size_t c = 0; c < count; ++c) expected[c] = by_differences<System, Inputs>(varied[c], start, until, scale);
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        typename Plain::State x = start;
        auto S = sensitivities_at_fixed_start<Plain>(varied);
        IntegrationOptions<typename Plain::State> options;
        options.method = method;
        options.tolerance = tolerance;
        options.scale.fill(scale);
        const Inputs<Plain> inputs;
        const Outcome outcome = simulate_sensitivities(Plain(), inputs, varied, x, S, 0.0, until, options, [](const auto&) {});
        CHECK(outcome.status == Status::success);
        for (std::size_t c = 0; c < count; ++c) {
            CAPTURE(c);
            double size = varied[c].of == Varied::Of::start ? 1 : 0, distance = 0;  // where it dies away beside that of the start
            for (std::size_t i = 0; i < x.size(); ++i) {
                size = std::max(size, static_cast<double>(std::abs(expected[c][i])));
                distance = std::max(distance, static_cast<double>(std::abs(expected[c][i] - S[c][i])));
            }
            CHECK(distance <= allowed * size);
        }
    }
}

constexpr std::initializer_list<Method> all_methods{Method::dopri5, Method::dop853, Method::rodas5p, Method::automatic};

}  // namespace

TEST_CASE("sensitivities of a heater are those of its closed form") {
    namespace model = immersion_heater::heating;
    using System = model::System<double>;
    const System system;
    const auto& p = system.parameters();
    const double start = 300, power = 500, conductance = p.A / (1 / p.alpha_i + p.L / p.lambda + 1 / p.alpha_a),
                 time = p.m_0 * p.c_p / conductance, warmer = start - p.T_inf - power / conductance;
    const auto heated = [&](const System::State&, double) { return System::Input{power}; };
    const std::array varied{Varied::parameter(model::parameter::m_0), Varied::parameter(model::parameter::c_p),
                            Varied::parameter(model::parameter::T_inf), Varied::parameter(model::parameter::t_s), Varied::start(0)};
    for (const Method method : all_methods) {
        System::State x{start};
        auto S = sensitivities_at_fixed_start<System>(varied);
        IntegrationOptions<System::State> options;
        options.method = method;
        options.tolerance = 1e-12;
        options.intervals = 10;
        std::size_t seen = 0;
        simulate_sensitivities(system, heated, varied, x, S, 0.0, 2000.0, options, [&](const SensitivitySample<System, 5>& sample) {
            ++seen;
            const double left = std::exp(-sample.t / time);  // T = T_inf + P/(k A) + warmer*left
            CHECK(sample.x[0] == doctest::Approx(p.T_inf + power / conductance + warmer * left).epsilon(1e-10));
            CHECK(sample.S[0][0] == doctest::Approx(warmer * left * sample.t / time / p.m_0).epsilon(1e-9));
            CHECK(sample.S[1][0] == doctest::Approx(warmer * left * sample.t / time / p.c_p).epsilon(1e-9));
            CHECK(sample.S[2][0] == doctest::Approx(1 - left).epsilon(1e-9));
            CHECK(sample.S[3][0] == 0);
            CHECK(sample.S[4][0] == doctest::Approx(left).epsilon(1e-9));
        });
        CHECK(seen == 11);
    }
}

TEST_CASE("sensitivities of the cart by all parameters and start values are differences of runs, with and without a controller") {
    namespace model = cart_pendulum::lab;
    std::array<Varied, model::parameter_count + model::state_count> varied;
    for (std::size_t i = 0; i < model::parameter_count; ++i) varied[i] = Varied::parameter(i);
    for (std::size_t i = 0; i < model::state_count; ++i) varied[model::parameter_count + i] = Varied::start(i);
    compare<model::System, ZeroInputs>(varied, {0.3, 0.2, 0, 0}, 1, 1e-2, 1e-11, all_methods, 1e-8);
    const std::array some{Varied::parameter(model::parameter::l_S), Varied::parameter(model::parameter::d_R), Varied::start(1)};
    compare<model::System, Feedback>(some, {0.3, 0.2, 0, 0}, 1, 1e-2, 1e-11, all_methods, 1e-8);
}

TEST_CASE("sensitivities of stiff machines") {
    namespace model = stick_slip::smooth;
    const std::array varied{Varied::parameter(0), Varied::parameter(1), Varied::parameter(2), Varied::start(0), Varied::start(1)};
    compare<model::System, ZeroInputs>(varied, model::System<double>().start_state(), 0.1, 1e-2, 1e-10,
                                       {Method::rodas5p, Method::automatic}, 1e-7);
    namespace exchanger = heat_exchanger_N12::counter;
    compare<exchanger::System, ZeroInputs>(varied, exchanger::System<double>().start_state(), 20, 1, 1e-10,
                                        {Method::rodas5p, Method::automatic}, 1e-8);
}

TEST_CASE("sensitivities that do not control the steps follow those of the state") {
    namespace model = cart_pendulum::lab;
    using System = model::System<double>;
    const System system;
    const ZeroInputs<System> inputs;
    const std::array varied{Varied::parameter(model::parameter::d_R)};
    IntegrationOptions<System::State> options;
    options.tolerance = 1e-8;
    options.scale.fill(1e-2);
    options.method = Method::dopri5;
    System::State x{0.3, 0.2, 0, 0}, plain = x;
    auto S = sensitivities_at_fixed_start<System>(varied);
    const Outcome with = simulate_sensitivities(
        system, inputs, varied, x, S, 0.0, 3.0, options, [](const auto&) {}, false);
    const auto rhs = [&](const System::State& at, double t, System::State& rate) { system.rhs(at, inputs(at, t), t, rate); };
    const Outcome without = integrate(rhs, plain, 0.0, 3.0, options, [](double, const System::State&) {});
    CHECK(with.steps == without.steps);
    for (std::size_t i = 0; i < 4; ++i) CHECK(x[i] == doctest::Approx(plain[i]).epsilon(1e-12));
    const auto expected = by_differences<model::System, ZeroInputs>(varied[0], {0.3, 0.2, 0, 0}, 3, 1e-2);
    for (std::size_t i = 0; i < 4; ++i) CHECK(S[0][i] == doctest::Approx(static_cast<double>(expected[i])).epsilon(1e-5));
}

TEST_CASE("sensitivities that do not control the steps stay right where the state rests") {
    namespace model = cart_pendulum::lab;
    using System = model::System<double>;
    const System system;
    const std::array varied{Varied::start(0), Varied::start(1)};
    IntegrationOptions<System::State> options;
    std::array<Sensitivities<System, 2>, 2> S;
    for (const bool controls : {false, true}) {
        System::State x{};
        S[controls] = sensitivities_at_fixed_start<System>(varied);
        const Outcome outcome = simulate_sensitivities(
            system, ZeroInputs<System>(), varied, x, S[controls], 0.0, 100.0, options, [](const auto&) {}, controls);
        CHECK(outcome.status == Status::success);
        CHECK(x == System::State{});
    }
    for (std::size_t c = 0; c < 2; ++c)
        for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(S[0][c][i] - S[1][c][i]) < 1e-3);
}

template <class Scalar>
void see_stiffness(double tolerance, double allowed) {
    using System = voltage_regulator::cooled::System<Scalar>;
    const System system;
    const auto held = [](const typename System::State&, Scalar) { return typename System::Input{Scalar(10)}; };
    const std::array varied{Varied::parameter(0), Varied::parameter(1)};
    IntegrationOptions<typename System::State> options;
    options.tolerance = static_cast<Scalar>(tolerance);
    options.scale.fill(Scalar(300));
    Outcome outcome[2];
    Sensitivities<System, 2> S[2];
    for (const bool controls : {false, true}) {
        auto x = system.start_state();
        S[controls] = sensitivities_at_fixed_start<System>(varied);
        const auto nobody = [](const auto&) {};
        outcome[controls] =
            simulate_sensitivities(system, held, varied, x, S[controls], Scalar(0), Scalar(3000), options, nobody, controls);
        CHECK(outcome[controls].status == Status::success);
        CHECK(outcome[controls].steps_by[2] > 10);
    }
    CHECK(outcome[false].steps <= outcome[true].steps);
    for (std::size_t c = 0; c < varied.size(); ++c)
        for (std::size_t i = 0; i < S[0][c].size(); ++i)
            CHECK(S[false][c][i] == doctest::Approx(S[true][c][i]).epsilon(allowed));
}

TEST_CASE("stiffness is seen where sensitivities do not control the steps") {
    see_stiffness<double>(1e-8, 1e-6);
    see_stiffness<float>(1e-4, 1e-3);
}

// This friction changes its sign within a speed that is far below those of the motion.
TEST_CASE("steep friction: implicit steps with sensitivities are about as long as without") {
    namespace model = stick_slip::smooth;
    using System = model::System<double>;
    const System system;
    const ZeroInputs<System> inputs;
    for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
        SimulationOptions<System> alone;
        alone.method = Method::rodas5p;
        alone.tolerance = tolerance;
        alone.scale = {0.1, 0.1, 1};
        System::State x = system.start_state();
        const auto run = simulate(system, inputs, x, 0.0, 4.0, alone, [](const auto&) {});
        IntegrationOptions<System::State> options;
        options.method = Method::rodas5p;
        options.tolerance = tolerance;
        options.scale.fill(0.1);
        const std::array varied{Varied::parameter(model::parameter::mu_C), Varied::parameter(model::parameter::w_s), Varied::start(0)};
        System::State along = system.start_state();
        auto S = sensitivities_at_start(system, varied);
        const Outcome outcome = simulate_sensitivities(system, inputs, varied, along, S, 0.0, 4.0, options, [](const auto&) {});
        CHECK(outcome.status == Status::success);
        CAPTURE(tolerance);
        CAPTURE(run.outcome.steps);
        CHECK(outcome.steps < 4 * run.outcome.steps);
        if (tolerance < 1e-11) CHECK(S[0][0] == doctest::Approx(-0.733037409405).epsilon(1e-10));  // differences in long double
    }
}

TEST_CASE("what is not in a table has no sensitivities") {
    using System = cart_pendulum::lab::System<double>;
    const System system;
    const ZeroInputs<System> inputs;
    for (const Varied wrong : {Varied::parameter(9), Varied::start(4)}) {
        const std::array varied{wrong};
        System::State x = system.start_state();
        const System::State start = x;
        Sensitivities<System, 1> S{};
        const Outcome outcome = simulate_sensitivities(system, inputs, varied, x, S, 0.0, 1.0, {}, [](const auto&) { FAIL("a run"); });
        CHECK(outcome.status == Status::bad_options);
        CHECK(x == start);
    }
}

TEST_CASE("sensitivities begin with those of a start that follows from parameters") {
    namespace model = immersion_heater::heating;
    using System = model::System<double>;
    const System system;
    const std::array varied{Varied::parameter(model::parameter::T_inf), Varied::parameter(model::parameter::c_p), Varied::start(0)};
    const auto S = sensitivities_at_start(system, varied);
    CHECK(S[0][0] == doctest::Approx(1).epsilon(1e-11));
    CHECK(S[1][0] == 0);
    CHECK(S[2][0] == 1);
    CHECK(sensitivities_at_fixed_start<System>(varied)[0][0] == 0);
}

TEST_CASE("methods that a run cannot take end it") {
    using System = cart_pendulum::lab::System<double>;
    const System system;
    const ZeroInputs<System> inputs;
    const std::array varied{Varied::parameter(0)};
    for (const Method method : {Method::taylor, Method::symplectic}) {
        System::State x = system.start_state();
        auto S = sensitivities_at_start(system, varied);
        IntegrationOptions<System::State> options;
        options.method = method;
        options.step = 0.01;
        CHECK(simulate_sensitivities(system, inputs, varied, x, S, 0.0, 1.0, options, [](const auto&) {}).status != Status::success);
    }
}
