// SPDX-License-Identifier: GPL-3.0-or-later
// Rodas5P: orders and stability that prove its coefficients, stiff problems, events, and what it must refuse.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <complex>
#include <limits>
#include <memory>
#include <vector>

#include "dalembert/simulate.hpp"
#include "mechanics/cart_pendulum_lab.hpp"

using namespace dalembert;

namespace {

template <class Scalar>
using One = std::array<Scalar, 1>;
template <class Scalar>
using Two = std::array<Scalar, 2>;
using Three = std::array<double, 3>;
using Long = long double;
const auto nobody = [](const auto&, const auto&) {};
const auto autonomous = [](const auto&, const auto&, auto& dfdt) { dfdt.fill(0); };

/// Not linear, depends on time, coupled: x = 1/(1 + t^2), y = exp(-atan(t)).
template <class Scalar>
struct Smooth {
    using State = Two<Scalar>;
    static void rhs(const State& x, Scalar t, State& dxdt) { dxdt = {-2 * t * x[0] * x[0], -x[0] * x[1]}; }
    static void jacobian(const State& x, Scalar t, std::array<Scalar, 4>& J) { J = {-4 * t * x[0], -x[1], 0, -x[0]}; }
    static void time_derivative(const State& x, Scalar, State& dfdt) { dfdt = {-2 * x[0] * x[0], 0}; }
    static State exact(Scalar t) { return {1 / (1 + t * t), std::exp(-std::atan(t))}; }
    static auto derivatives() { return dalembert::derivatives<State>(jacobian, time_derivative); }
};

template <class State>
typename State::value_type distance(const State& a, const State& b) {
    typename State::value_type largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

/// One step of length h by the stepper itself.
template <class State, class Rhs, class Derivatives>
struct SingleStep {
    using Scalar = typename State::value_type;
    struct Evaluate {
        Rhs rhs;
        void operator()(const State& x, State& dxdt, Scalar t) const { rhs(x, t, dxdt); }
    };
    State x, dxdt;
    detail::Rodas5p<State, Evaluate, Derivatives> stepper;
    detail::Point<State> from;
    detail::Candidate<State> c;

    SingleStep(Rhs rhs, Derivatives& derivatives, const State& start, Scalar t, Scalar h) : x(start), stepper(Evaluate{rhs}, derivatives), from{x, dxdt, t, 0} {
        rhs(x, t, dxdt);
        c.length = h;
        c.end = t + h;
        stepper.take(from, c);
    }
    State at(Scalar s) {
        State between = x;
        stepper.between(from, c, from.t + s * c.length, between);
        return between;
    }
};

template <class State>
IntegrationOptions<State> stiff(typename State::value_type tolerance) {
    IntegrationOptions<State> options;
    options.method = Method::rodas5p;
    options.tolerance = tolerance;
    return options;
}

/// Steps of one length, whatever their errors.
template <class State>
IntegrationOptions<State> fixed(typename State::value_type step) {
    auto options = stiff<State>(typename State::value_type(1e30L));
    options.step = options.max_step = step;
    return options;
}

}  // namespace

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

namespace {

/// A rod that is cold at both ends, in N pieces, as a generated header would have it.
template <std::size_t N>
struct Rod {
    using scalar_type = double;
    static constexpr int api = supported_api;
    using State = std::array<double, N>;
    using Input = std::array<double, 1>;  // temperature of the left end
    using Output = std::array<double, 0>;
    using Guards = std::array<double, 0>;
    struct PatternX {
        static constexpr bool is_sparse = true;
        static constexpr auto column_starts = [] {
            std::array<std::size_t, N + 1> starts{};
            for (std::size_t c = 1; c <= N; ++c) starts[c] = starts[c - 1] + (c == 1 || c == N ? 2 : 3);
            return starts;
        }();
        static constexpr auto row_indices = [] {
            std::array<std::size_t, 3 * N - 2> rows{};
            for (std::size_t c = 0, k = 0; c < N; ++c)
                for (std::size_t r = c == 0 ? 0 : c - 1; r < N && r <= c + 1; ++r) rows[k++] = r;
            return rows;
        }();
    };
    struct PatternU {
        static constexpr bool is_sparse = true;
        static constexpr std::array<std::size_t, 2> column_starts{0, 1};
        static constexpr std::array<std::size_t, 1> row_indices{0};
    };
    using JacobianX = std::array<double, 3 * N - 2>;
    using JacobianU = std::array<double, 1>;
    struct Guard {
        bool ends;
    };
    static constexpr std::array<Guard, 0> guard_table() { return {}; }
    static constexpr double k = static_cast<double>((N + 1) * (N + 1));
    void guards(const State&, const Input&, double, Guards&) const {}
    void rhs(const State& x, const Input& u, double, State& dxdt) const {
        for (std::size_t i = 0; i < N; ++i) dxdt[i] = k * ((i == 0 ? u[0] : x[i - 1]) - 2 * x[i] + (i + 1 == N ? 0 : x[i + 1]));
    }
    void jacobian_x(const State&, const Input&, double, JacobianX& J) const {
        for (std::size_t c = 0; c < N; ++c)
            for (std::size_t place = PatternX::column_starts[c]; place < PatternX::column_starts[c + 1]; ++place) J[place] = PatternX::row_indices[place] == c ? -2 * k : k;
    }
    void jacobian_u(const State&, const Input&, double, JacobianU& J) const { J[0] = k; }
    void jacobian_t(const State&, const Input&, double, State& J) const { J.fill(0); }
    void output(const State&, const Input&, double, Output&) const {}
    double kinetic_energy(const State&, double) const { return 0; }
    double potential_energy(const State&, double) const { return 0; }
    double internal_energy(const State& x, double) const {
        double sum = 0;
        for (const double temperature : x) sum += temperature;
        return sum / (N + 1);
    }
    double supplied_power(const State&, const Input&, double) const { return 0; }
    double dissipated_power(const State&, const Input&, double) const { return 0; }
    double prescribed_power(const State&, const Input&, double) const { return 0; }
    double exchanged_power(const State& x, const Input& u, double) const { return static_cast<double>(N + 1) * (u[0] - x.front() - x.back()); }
    /// The slowest mode, which keeps its form.
    static State start() {
        State x;
        for (std::size_t i = 0; i < N; ++i) x[i] = std::sin(std::acos(-1) * static_cast<double>(i + 1) / static_cast<double>(N + 1));
        return x;
    }
    static double decay(double t) {
        const double s = std::sin(std::acos(-1) / static_cast<double>(2 * (N + 1)));
        return std::exp(-4 * k * s * s * t);
    }
};

}  // namespace

TEST_CASE("the heat equation: a band, its energy, and as many steps as a smooth problem needs") {
    using System = Rod<200>;
    static_assert(detail::SquareMatrix<double, System::PatternX, 200>::is_band);
    const System rod;
    for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
        System::State x = System::start();
        SimulationOptions<System> options;
        options.method = Method::rodas5p;
        options.tolerance = tolerance;
        options.intervals = 25;
        double error = 0;
        const auto result = simulate(rod, ZeroInputs<System>(), x, 0.0, 0.2, options, [&](const auto& sample) {
            const double decay = System::decay(sample.t);
            for (std::size_t i = 0; i < 200; ++i) error = std::max(error, std::abs(sample.x[i] - decay * System::start()[i]));
        });
        CHECK(result.outcome.status == Status::success);
        MESSAGE("tolerance ", tolerance, ": error ", error, ", energy ", result.energy.relative_error(), ", steps ", result.outcome.steps, ", calls ", result.outcome.rhs_calls);
        CHECK(error < 10 * tolerance);
        CHECK(result.energy.relative_error() < 10 * tolerance);
        CHECK(result.outcome.steps < 100);
    }
}

TEST_CASE("a band takes the same steps as all entries") {
    constexpr std::size_t n = 40;
    using System = Rod<n>;
    using State = System::State;
    const System rod;
    const auto rhs = [&](const State& x, double t, State& dxdt) { rod.rhs(x, {std::sin(10 * t)}, t, dxdt); };
    const auto rate = [](const State&, double t, State& dfdt) { dfdt.fill(0), dfdt[0] = System::k * 10 * std::cos(10 * t); };
    auto band = derivatives<State, System::PatternX>([&](const State& x, double t, System::JacobianX& J) { rod.jacobian_x(x, {}, t, J); }, rate);
    auto dense = derivatives<State>([](const State&, double, std::array<double, n * n>& J) {
        J.fill(0);
        for (std::size_t i = 0; i < n; ++i) {
            J[i * n + i] = -2 * System::k;
            if (i > 0) J[i * n + i - 1] = J[(i - 1) * n + i] = System::k;
        }
    }, rate);
    State a{}, b{};
    const Outcome of_band = integrate(rhs, band, a, 0.0, 1.0, stiff<State>(1e-7), nobody);
    const Outcome of_dense = integrate(rhs, dense, b, 0.0, 1.0, stiff<State>(1e-7), nobody);
    CHECK(of_band.status == Status::success);
    CHECK(of_band.steps == of_dense.steps);
    CHECK(distance(a, b) < 1e-11);
}

TEST_CASE("ten thousand states take linear time and little room") {
    using System = Rod<10000>;
    using Run = std::array<double, 10001>;
    struct Evaluate {
        void operator()(const Run&, Run&, double) const {}
    };
    using Derivatives = detail::SystemDerivatives<System, ZeroInputs<System>>;
    constexpr std::size_t workspace = sizeof(detail::Rodas5p<Run, Evaluate, Derivatives>) + sizeof(Derivatives) + 4 * sizeof(detail::Candidate<Run>);
    MESSAGE("bytes of the method, its derivatives and four candidates: ", workspace);
    static_assert(workspace < std::size_t(4) << 20);
    const auto x = std::make_unique<System::State>(System::start());
    const auto options = std::make_unique<SimulationOptions<System>>();
    options->method = Method::rodas5p;
    options->tolerance = 1e-6;
    const auto result = simulate(System(), ZeroInputs<System>(), *x, 0.0, 0.1, *options, [](const auto&) {});
    CHECK(result.outcome.status == Status::success);
    CHECK(result.outcome.steps < 60);
    CHECK((*x)[5000] == doctest::Approx(System::decay(0.1) * System::start()[5000]).epsilon(1e-5));
}

TEST_CASE("inputs of time and of the state keep the order, and the work keeps that of the states") {
    // A cart that is pushed by a sine and held by a controller, against shorter steps.
    using System = cart_pendulum::lab::System<Long>;
    const System system;
    const auto inputs = [](const System::State& x, Long t) {
        System::Input u{};
        u[0] = 3 * std::sin(5 * t) - 8 * x[0] - 4 * x[2] + x[1] * x[3];
        return u;
    };
    struct End {
        System::State x;
        Long work;
        double energy_error;
    };
    const auto run = [&](Long step) {
        SimulationOptions<System> options;
        options.method = Method::rodas5p;
        options.tolerance = 1e30L;
        options.step = options.max_step = step;
        End end{system.start_state(), 0, 0};
        const auto result = simulate(system, inputs, end.x, 0.0L, 2.0L, options, [&](const auto& sample) { end.work = sample.work; });
        REQUIRE(result.outcome.status == Status::success);
        end.energy_error = result.energy.largest_error;
        return end;
    };
    const End exact = run(1.0L / 1280), coarse = run(1.0L / 80), fine = run(1.0L / 320);
    const double order = static_cast<double>(std::log2(distance(coarse.x, exact.x) / distance(fine.x, exact.x))) / 2;
    const double order_of_work = static_cast<double>(std::log2(std::abs(coarse.work - exact.work) / std::abs(fine.work - exact.work))) / 2;
    MESSAGE("orders: ", order, ", of the work ", order_of_work, "; error ", static_cast<double>(distance(fine.x, exact.x)), ", of the energy ", fine.energy_error);
    CHECK(order > 4.6);
    CHECK(order_of_work > 4.6);
    CHECK(fine.energy_error < 1e-12);
}

TEST_CASE("feedback that leaves the band costs steps, not accuracy") {
    using System = Rod<40>;
    const System rod;
    // The right end, measured, heats the left one.
    const auto inputs = [](const System::State& x, double t) { return System::Input{std::sin(3 * t) - 0.5 * x[39] - 0.5 * x[1]}; };
    const auto run = [&](Method method, double tolerance) {
        SimulationOptions<System> options;
        options.method = method;
        options.tolerance = tolerance;
        System::State x = System::start();
        const auto result = simulate(rod, inputs, x, 0.0, 0.5, options, [](const auto&) {});
        CHECK(result.outcome.status == Status::success);
        return x;
    };
    CHECK(distance(run(Method::rodas5p, 1e-7), run(Method::dopri5, 1e-10)) < 1e-5);
}

TEST_CASE("an event ends the run at its time, on one side of it") {
    const std::array<bool, 1> ends{true};
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
        // Stiff: x stays within 1e-6 of cos(t).
        const auto rhs = [](const Two<double>& x, double t, Two<double>& dxdt) { dxdt = {-1e6 * (x[0] - std::cos(t)) - std::sin(t), -x[1]}; };
        auto derivatives = dalembert::derivatives<Two<double>>([](const Two<double>&, double, std::array<double, 4>& J) { J = {-1e6, 0, 0, -1}; },
                                                               [](const Two<double>&, double t, Two<double>& dfdt) { dfdt = {-1e6 * std::sin(t) - std::cos(t), 0}; });
        double last = -1;
        auto options = stiff<Two<double>>(tolerance);
        options.intervals = 7;
        const auto check = [&](auto guards, double exact) {
            last = -1;
            Two<double> x{1, 1};
            const Outcome outcome = integrate(rhs, derivatives, x, 0.0, 10.0, options, [&](double t, const Two<double>&) {
                CHECK(t > last);
                last = t;
            }, guards, ends);
            CHECK(outcome.status == Status::event);
            CHECK(outcome.guard == 0);
            MESSAGE("tolerance ", tolerance, ": error ", outcome.t - exact, ", steps ", outcome.steps);
            CHECK(std::abs(outcome.t - exact) < 10 * tolerance);
            CHECK(last == outcome.t);
            One<double> g;
            guards(x, outcome.t, g);
            CHECK(g[0] >= 0);
            CHECK(g[0] < 1e-12);
        };
        check([](const Two<double>& x, double, One<double>& g) { g[0] = x[0] - 0.5; }, std::acos(0.5));
        check([](const Two<double>& x, double, One<double>& g) { g[0] = x[1] - 0.3; }, -std::log(0.3));
        check([](const Two<double>&, double t, One<double>& g) { g[0] = 2 - t; }, 2);
    }
}

TEST_CASE("behind an edge a run starts anew, and keeps its order") {
    // x'' = -x - sign(x)/2: from (1, 0) the first zero is where cos(t) = 1/3, the period four times that.
    using State = Two<Long>;
    const auto rhs = [](const State& x, Long, State& dxdt) { dxdt = {x[1], -x[0] - (x[0] < 0 ? -0.5L : 0.5L)}; };
    auto derivatives = dalembert::derivatives<State>([](const State&, Long, std::array<Long, 4>& J) { J = {0, -1, 1, 0}; }, autonomous);
    const Long period = 4 * std::acos(1.0L / 3);
    const auto guard = [](const State& x, Long, One<Long>& g) { g[0] = x[0]; };
    const auto error = [&](int steps) {
        Long sum = 0;
        for (int k = 0; k < 6; ++k) {
            State x{1, 0};
            const auto options = fixed<State>(period / (static_cast<Long>(steps) * (1 + 0.03L * static_cast<Long>(k))));
            const Outcome outcome = integrate(rhs, derivatives, x, 0.0L, period, options, nobody, guard, std::array<bool, 1>{false});
            REQUIRE(outcome.status == Status::success);
            CHECK(outcome.events == 2);
            sum += std::abs(x[0] - 1) + std::abs(x[1]);
        }
        return sum;
    };
    const double order = static_cast<double>(std::log2(error(40) / error(160))) / 2;
    MESSAGE("order ", order);
    CHECK(order > 4.7);
    for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
        auto options = stiff<State>(static_cast<Long>(tolerance));
        State x{1, 0};
        const Outcome outcome = integrate(rhs, derivatives, x, 0.0L, 3 * period, options, nobody, guard, std::array<bool, 1>{false});
        CHECK(outcome.status == Status::success);
        CHECK(outcome.events == 6);
        CHECK(static_cast<double>(std::abs(x[0] - 1) + std::abs(x[1])) < 100 * tolerance);
    }
}

TEST_CASE("what is not finite is rejected, and the run stops before it") {
    using State = Two<double>;
    struct Name {
        const char* name;
    };
    const std::array<Name, 2> names{{{"position"}, {"charge"}}};
    // Beyond t = 1 the right-hand side has no value.
    auto edge_derivatives = derivatives<State>([](const State&, double t, std::array<double, 4>& J) { J = {0, std::sqrt(1 - t), 0, 0}; }, autonomous);
    State x{0, 0};
    const auto edge = [](const State& at, double t, State& dxdt) { dxdt = {1, std::sqrt(1 - t) * at[0]}; };
    const Outcome outcome = integrate(edge, edge_derivatives, x, 0.0, 2.0, stiff<State>(1e-9), nobody);
    CHECK(outcome.status == Status::not_finite);
    CHECK(outcome.rejected > 0);
    CHECK(outcome.t <= 1);
    CHECK(outcome.t > 0.99);
    CHECK(std::isfinite(x[1]));
    CHECK(message(outcome, names).find("state 'charge' or its derivative is not finite") != std::string::npos);
    // A pole at t = 1.
    auto pole_derivatives = derivatives<State>([](const State& at, double, std::array<double, 4>& J) { J = {0, 0, 0, 2 * at[1]}; }, autonomous);
    x = {0, 1};
    const Outcome pole = integrate([](const State& at, double, State& dxdt) { dxdt = {0, at[1] * at[1]}; }, pole_derivatives, x, 0.0, 2.0, stiff<State>(1e-9), nobody);
    CHECK(pole.status != Status::success);
    CHECK(pole.t == doctest::Approx(1).epsilon(1e-6));
    CHECK(std::isfinite(x[1]));
    // A Jacobian, or a time derivative, that is no number makes no step.
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto oscillator = [](const State& at, double, State& dxdt) { dxdt = {at[1], -at[0]}; };
    auto bad_jacobian = derivatives<State>([nan](const State&, double, std::array<double, 4>& J) { J = {0, -1, nan, 0}; }, autonomous);
    auto bad_rate = derivatives<State>([](const State&, double, std::array<double, 4>& J) { J = {0, -1, 1, 0}; }, [nan](const State&, double, State& dfdt) { dfdt = {0, nan}; });
    const auto check = [&](auto& bad) {
        State at{1, 0};
        const Outcome none = integrate(oscillator, bad, at, 0.0, 1.0, stiff<State>(1e-6), nobody);
        CHECK(none.status == Status::not_finite);
        CHECK(none.steps == 0);
        CHECK(at == State{1, 0});
        // Nor does it make an event.
        const auto guard = [](const State& near, double, One<double>& g) { g[0] = near[0] - 0.5; };
        const Outcome watched = integrate(oscillator, bad, at, 0.0, 1.0, stiff<State>(1e-6), nobody, guard, std::array<bool, 1>{true});
        CHECK(watched.status == Status::not_finite);
        CHECK(watched.t == 0);
    };
    check(bad_jacobian);
    check(bad_rate);
}

TEST_CASE("a step whose matrix is singular is made shorter") {
    // With J = 1/(h gamma) the first step has nothing to solve with.
    const double lambda = 1 / (0.5 * detail::Rodas5pCoefficients::gamma);
    auto derivatives = dalembert::derivatives<One<double>>([lambda](const One<double>&, double, One<double>& J) { J[0] = lambda; }, autonomous);
    const auto rhs = [lambda](const One<double>& x, double, One<double>& dxdt) { dxdt[0] = lambda * x[0]; };
    auto options = stiff<One<double>>(1e-9);
    options.step = 0.5;
    options.max_steps = 1;
    One<double> x{1};
    CHECK(integrate(rhs, derivatives, x, 0.0, 1.0, options, nobody).rejected == 1);
    options.max_steps = 100000;
    CHECK(integrate(rhs, derivatives, x, 0.0, 1.0, options, nobody).status == Status::success);
    CHECK(x[0] == doctest::Approx(std::exp(lambda)).epsilon(1e-6));
}

TEST_CASE("without derivatives, or with a matrix that has no room, the method is refused") {
    const auto oscillator = [](const Two<double>& at, double, Two<double>& dxdt) { dxdt = {at[1], -at[0]}; };
    Two<double> x{1, 0};
    CHECK(integrate(oscillator, x, 0.0, 1.0, stiff<Two<double>>(1e-6), nobody).status == Status::bad_options);
    CHECK(x == Two<double>{1, 0});
    using Large = std::array<double, 600>;
    const auto rest = [](const Large&, double, Large& dxdt) { dxdt.fill(0); };
    const auto dense = std::make_unique<Derivatives<Large, DensePattern, void (*)(const Large&, double, std::array<double, 360000>&), decltype(autonomous)>>(
        [](const Large&, double, std::array<double, 360000>& J) { J.fill(0); }, autonomous);
    Large y{};
    CHECK(integrate(rest, *dense, y, 0.0, 1.0, stiff<Large>(1e-6), nobody).status == Status::bad_options);
    // The other methods are there beside it.
    auto options = stiff<Two<double>>(1e-9);
    options.method = Method::dopri5;
    auto derivatives = dalembert::derivatives<Two<double>>([](const Two<double>&, double, std::array<double, 4>& J) { J = {0, -1, 1, 0}; }, autonomous);
    CHECK(integrate(oscillator, derivatives, x, 0.0, 1.0, options, nobody).status == Status::success);
    CHECK(x[0] == doctest::Approx(std::cos(1.0)).epsilon(1e-8));
}
