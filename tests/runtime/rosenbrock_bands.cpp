// SPDX-License-Identifier: GPL-3.0-or-later
// Rodas5P with a band of derivatives: the heat equation from twenty to ten thousand states, and inputs beside the band.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "mechanics/cart_pendulum_lab.hpp"
#include "runtime/rosenbrock.hpp"

using namespace rosenbrock_tests;

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
