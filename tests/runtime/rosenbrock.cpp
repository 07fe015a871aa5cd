// SPDX-License-Identifier: GPL-3.0-or-later
// Rodas5P: orders and stability that prove its coefficients, and stiff problems.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "runtime/rosenbrock.hpp"

using namespace rosenbrock_tests;

TEST_CASE("one step: order 5, the method within it 4, dense output 4") {
    struct Errors {
        Long step, embedded, dense;
    };
    const auto errors = [](Long h) {
        Errors sum{};  // over several places: at one of them a coefficient of the error may be small
        for (const Long t : {-1.0L, -0.4L, 0.1L, 0.5L, 1.0L}) {
            auto derivatives = Smooth<Long>::derivatives();
            SingleStep step(Smooth<Long>::rhs, derivatives, Smooth<Long>::exact(t), t, h);
            REQUIRE(step.c.finite);
            CHECK(distance(step.at(0), step.x) == 0);
            CHECK(distance(step.at(1), step.c.y) < 1e-18L);
            Two<Long> embedded;
            for (std::size_t i = 0; i < 2; ++i) embedded[i] = step.c.y[i] - step.c.error[i];
            sum.step += distance(step.c.y, Smooth<Long>::exact(t + h));
            sum.embedded += distance(embedded, Smooth<Long>::exact(t + h));
            for (int k = 1; k < 20; ++k) sum.dense += distance(step.at(k / 20.0L), Smooth<Long>::exact(t + h * k / 20));
        }
        return sum;
    };
    const Errors coarse = errors(0.04L), fine = errors(0.01L);
    const auto order = [](Long a, Long b) { return static_cast<double>(std::log2(a / b)) / 2 - 1; };  // of a step it is one more
    MESSAGE("orders: ", order(coarse.step, fine.step), ", ", order(coarse.embedded, fine.embedded), ", ", order(coarse.dense, fine.dense));
    CHECK(order(coarse.step, fine.step) == doctest::Approx(5).epsilon(0.04));
    CHECK(order(coarse.embedded, fine.embedded) == doctest::Approx(4).epsilon(0.04));
    CHECK(order(coarse.dense, fine.dense) > 3.9);
    CHECK(fine.step < fine.embedded / 5);
}

TEST_CASE("measured order of runs, at their ends and between") {
    const auto error = [](int steps) {
        Long between = 0;
        auto options = fixed<Two<Long>>(2.0L / steps);
        options.intervals = 997;  // whose points lie within steps
        auto derivatives = Smooth<Long>::derivatives();
        Two<Long> x = Smooth<Long>::exact(0);
        const auto watch = [&](Long t, const Two<Long>& at) { between = std::max(between, distance(at, Smooth<Long>::exact(t))); };
        const Outcome outcome = integrate(Smooth<Long>::rhs, derivatives, x, 0.0L, 2.0L, options, watch);
        REQUIRE(outcome.status == Status::success);
        REQUIRE(outcome.steps <= static_cast<std::size_t>(steps) + 1);
        return std::pair(distance(x, Smooth<Long>::exact(2)), between);
    };
    const auto coarse = error(40), fine = error(160);
    const double at_end = static_cast<double>(std::log2(coarse.first / fine.first)) / 2;
    const double between = static_cast<double>(std::log2(coarse.second / fine.second)) / 2;
    MESSAGE("orders: ", at_end, " at the end, ", between, " between; errors with 160 steps ", static_cast<double>(fine.first), ", ", static_cast<double>(fine.second));
    CHECK(at_end == doctest::Approx(5).epsilon(0.03));
    CHECK(between > 4);
}

TEST_CASE("A-stable, and nothing is left of what is very stiff") {
    // x' = z x as a rotation with damping, in one step of length 1: |x| afterwards is |R(z)|.
    const auto growth = [](std::complex<double> z) {
        const auto rhs = [z](const Two<double>& x, double, Two<double>& dxdt) { dxdt = {z.real() * x[0] - z.imag() * x[1], z.imag() * x[0] + z.real() * x[1]}; };
        auto derivatives = dalembert::derivatives<Two<double>>(
            [z](const Two<double>&, double, std::array<double, 4>& J) { J = {z.real(), z.imag(), -z.imag(), z.real()}; }, autonomous);
        SingleStep step(rhs, derivatives, Two<double>{1, 0}, 0.0, 1.0);
        return std::hypot(step.c.y[0], step.c.y[1]);
    };
    double largest = 0;
    for (double exponent = -3; exponent < 6; exponent += 0.02) {
        const double size = std::pow(10, exponent);
        for (const double angle : {0.5, 0.6, 0.75, 1.0}) largest = std::max(largest, growth(std::polar(size, angle * std::acos(-1))));
        CHECK(growth(-size) < 1);
    }
    MESSAGE("largest |R| - 1 in the left half-plane: ", largest - 1);
    CHECK(largest < 1 + 1e-12);
    for (const double z : {1e3, 1e6, 1e9, 1e12, 1e15}) {
        MESSAGE("|R(-", z, ")| = ", growth(-z));
        CHECK(growth(-z) < 20 / z + 1e-12);
        CHECK(growth({0, z}) < 20 / z + 1e-12);
    }
}

TEST_CASE("Prothero-Robinson: the order stays where stiffness takes it from other methods") {
    // x' = lambda (x - sin t) + cos t, x = sin t: Prothero, Robinson: Math. Comp. 28 (1974) 145. For large z = lambda h errors are like h^4/|z|.
    const auto error = [](Long z, int steps) {
        const Long lambda = z * static_cast<Long>(steps) / 3;
        const auto rhs = [lambda](const One<Long>& x, Long t, One<Long>& dxdt) { dxdt[0] = lambda * (x[0] - std::sin(t)) + std::cos(t); };
        auto derivatives = dalembert::derivatives<One<Long>>([lambda](const One<Long>&, Long, One<Long>& J) { J[0] = lambda; },
                                                             [lambda](const One<Long>&, Long t, One<Long>& dfdt) { dfdt[0] = -lambda * std::cos(t) - std::sin(t); });
        One<Long> x{0};
        Long largest = 0;
        auto options = fixed<One<Long>>(3.0L / steps);
        options.intervals = static_cast<std::size_t>(steps);
        const auto watch = [&](Long t, const One<Long>& at) { largest = std::max(largest, std::abs(at[0] - std::sin(t))); };
        REQUIRE(integrate(rhs, derivatives, x, 0.0L, 3.0L, options, watch).status == Status::success);
        return largest;
    };
    for (const Long z : {-0.1L, -1.0L, -10.0L, -100.0L, -1e3L, -1e5L, -1e7L}) {
        const double order = static_cast<double>(std::log2(error(z, 20) / error(z, 80))) / 2;
        MESSAGE("z = ", static_cast<double>(z), ": order ", order, ", error with 80 steps ", static_cast<double>(error(z, 80)));
        CHECK(order > 3.9);
        CHECK(error(z, 80) * std::max(1.0L, -z) < 1e-7L);
    }
}

TEST_CASE("the error follows the tolerance") {
    double last = 1;
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
        auto options = stiff<Two<double>>(tolerance);
        options.intervals = 300;
        auto derivatives = Smooth<double>::derivatives();
        Two<double> x = Smooth<double>::exact(0);
        double error = 0;
        const auto watch = [&](double t, const Two<double>& at) { error = std::max(error, distance(at, Smooth<double>::exact(t))); };
        const Outcome outcome = integrate(Smooth<double>::rhs, derivatives, x, 0.0, 3.0, options, watch);
        CHECK(outcome.status == Status::success);
        MESSAGE("tolerance ", tolerance, ": error ", error, ", steps ", outcome.steps);
        CHECK(error < 20 * tolerance);
        CHECK(error < last / 5);
        last = error;
    }
}

TEST_CASE("float, long double and fifty digits") {
    const auto decay = [](auto scalar, auto tolerance) {
        using Scalar = decltype(scalar);
        using State = One<Scalar>;
        auto derivatives = dalembert::derivatives<State>([](const State&, const Scalar&, State& J) { J[0] = Scalar(-1); },
                                                         [](const State&, const Scalar&, State& dfdt) { dfdt[0] = Scalar(0); });
        auto options = stiff<State>(Scalar(tolerance));
        options.max_step = Scalar(1) / Scalar(4);
        State x{Scalar(1)};
        CHECK(integrate([](const State& at, const Scalar&, State& dxdt) { dxdt[0] = -at[0]; }, derivatives, x, Scalar(0), Scalar(1), options, nobody).status == Status::success);
        using std::abs;
        using std::exp;
        return static_cast<double>(abs(x[0] - exp(Scalar(-1))));
    };
    CHECK(decay(0.0f, 1e-5f) < 1e-5);
    CHECK(decay(0.0L, 1e-12L) < 1e-12);
    CHECK(decay(boost::multiprecision::cpp_bin_float_50(), 1e-9) < 1e-9);
}

TEST_CASE("van der Pol with epsilon = 1e-6") {
    // Hairer, Wanner II, section IV.10, with their reference at t = 1 and 2.
    const auto rhs = [](const Two<double>& x, double, Two<double>& dxdt) { dxdt = {x[1], ((1 - x[0] * x[0]) * x[1] - x[0]) * 1e6}; };
    auto derivatives = dalembert::derivatives<Two<double>>(
        [](const Two<double>& x, double, std::array<double, 4>& J) { J = {0, (-2 * x[0] * x[1] - 1) * 1e6, 1, (1 - x[0] * x[0]) * 1e6}; }, autonomous);
    const std::array<Two<double>, 3> reference{{{2, 0}, {-1.863646254808130, 0.7535430865435460}, {1.706167732170456, -0.8928097010248257}}};
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
        auto options = stiff<Two<double>>(tolerance);
        options.intervals = 2;
        Two<double> x{2, 0};
        double error = 0;
        std::size_t next = 0;
        const Outcome outcome = integrate(rhs, derivatives, x, 0.0, 2.0, options, [&](double, const Two<double>& at) { error = std::max(error, distance(at, reference[next++])); });
        CHECK(outcome.status == Status::success);
        MESSAGE("tolerance ", tolerance, ": error ", error, ", steps ", outcome.steps, " and ", outcome.rejected, " rejected");
        CHECK(error < 100 * tolerance);
        CHECK(outcome.steps < 20000);
    }
}

TEST_CASE("Robertson's reaction over eleven decades") {
    const auto rhs = [](const Three& x, double, Three& dxdt) {
        dxdt[0] = -0.04 * x[0] + 1e4 * x[1] * x[2];
        dxdt[2] = 3e7 * x[1] * x[1];
        dxdt[1] = -dxdt[0] - dxdt[2];
    };
    auto derivatives = dalembert::derivatives<Three>([](const Three& x, double, std::array<double, 9>& J) {
        J = {-0.04, 0.04, 0, 1e4 * x[2], -1e4 * x[2] - 6e7 * x[1], 6e7 * x[1], 1e4 * x[1], -1e4 * x[1], 0};
    }, autonomous);
    // Hairer, Wanner II, section IV.10, at t = 40 and 1e11.
    struct Row {
        double t;
        Three x;
    };
    for (const Row& row : {Row{40, {0.7158270687193941, 0.9185534764557338e-5, 0.2841637457458413}}, Row{1e11, {0.2083340149701255e-7, 0.8333360770334713e-13, 0.9999999791665050}}}) {
        auto options = stiff<Three>(1e-8);
        options.scale = {1e-8, 1e-13, 1e-3};
        Three x{1, 0, 0};
        const Outcome outcome = integrate(rhs, derivatives, x, 0.0, row.t, options, nobody);
        CHECK(outcome.status == Status::success);
        MESSAGE("t = ", row.t, ": relative errors ", x[0] / row.x[0] - 1, ", ", x[1] / row.x[1] - 1, ", ", x[2] / row.x[2] - 1, ", steps ", outcome.steps);
        for (std::size_t i = 0; i < 3; ++i) CHECK(x[i] == doctest::Approx(row.x[i]).epsilon(1e-6));
        CHECK(x[0] + x[1] + x[2] == doctest::Approx(1).epsilon(1e-12));
    }
}
