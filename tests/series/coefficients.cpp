// SPDX-License-Identifier: GPL-3.0-or-later
// Coefficients of generated Taylor series, in 50 digits: the derivative of the polynomial that they make must be the right-hand side along it, but
// for an error that shrinks like the power of the distance that the order says. One coefficient that is wrong takes that away.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "arm_6r_series.hpp"
#include "cylinder_stops_series.hpp"
#include "dalembert/series.hpp"
#include "four_bar_series.hpp"
#include "heavy_top_series.hpp"
#include "kepler_series.hpp"
#include "n_pendulum_series.hpp"
#include "reservoir_discharge_series.hpp"
#include "series_functions.hpp"
#include "valve_cylinder_series.hpp"

namespace {

using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// u_i = a_i + t/3 - t^2/5 + x_0*t/7, whose series follow by hand.
template <class System>
struct Inputs {
    static constexpr std::size_t series_rows = 0;
    using Input = typename System::Input;
    static Number constant(std::size_t i) { return Number(3 * static_cast<int>(i) + 1) / 7; }
    template <class State>
    Input operator()(const State& x, const Number& t) const {
        Input u{};
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = constant(i) + t / 3 - t * t / 5 + x[0] * t / 7;
        return u;
    }
    template <class State>
    auto series(const State* x, Number t, Input& u, Number*) const {
        u = (*this)(x[0], t);
        return [x, t](std::size_t k) {
            Input now{};
            for (Number& value : now) value = (k == 1 ? Number(Number(1) / 3 - 2 * t / 5) : k == 2 ? Number(Number(-1) / 5) : Number(0)) + (x[k][0] * t + x[k - 1][0]) / 7;
            return now;
        };
    }
};

/// The largest difference of the slope of the polynomial and the right-hand side at t + s, relative to the slope at t; the work is one more state.
template <class System, class Series, class... Mode>
double residual(const System& system, const Series& c, const Number& t, const Number& s, Mode... mode) {
    constexpr std::size_t n = std::tuple_size<typename System::State>::value;
    typename System::State x{}, dxdt{};
    std::array<Number, n + 1> slope{};
    for (std::size_t i = 0; i <= n; ++i)
        for (std::size_t k = c.size(); k-- > 0;) {
            if (i < n) x[i] = x[i] * s + c[k][i];
            if (k > 0) slope[i] = slope[i] * s + Number(k) * c[k][i];
        }
    const Number later = t + s;
    const auto u = Inputs<System>()(x, later);
    system.rhs(mode..., x, u, later, dxdt);
    const Number power = system.supplied_power(mode..., x, u, later) - system.dissipated_power(mode..., x, u, later) + system.prescribed_power(mode..., x, u, later) + system.exchanged_power(mode..., x, u, later);
    Number worst = 0;
    for (std::size_t i = 0; i <= n; ++i) {
        const Number value = i < n ? dxdt[i] : power;
        const Number error = abs(value - slope[i]) / (abs(c[1][i]) + Number(1e-30));
        if (!(error <= worst)) worst = error;
    }
    return static_cast<double>(worst);
}

/// At random points near the start; `step` in s is well within the radius of convergence.
template <class System, class... Mode>
void check_order(const std::string& what, double step, const typename System::State* from, Mode... mode) {
    CAPTURE(what);
    constexpr std::size_t order = 8, n = std::tuple_size<typename System::State>::value;
    const System system;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> in(-1, 1);
    for (int trial = 0; trial < 3; ++trial) {
        std::vector<std::array<Number, n + 1>> c(order + 1);
        const typename System::State start = from != nullptr ? *from : system.start_state();
        for (std::size_t i = 0; i < n; ++i) c[0][i] = start[i] * (1 + Number(in(random)) / 50) + (start[i] == 0 ? Number(in(random)) / 10 : Number(0));
        std::vector<Number> rows(2 * System::series_rows * order);
        const Number t = Number(1) / 10;
        system.series(mode..., Inputs<System>(), t, order, c.data(), rows.data());
        const double coarse = residual(system, c, t, Number(step), mode...), fine = residual(system, c, t, Number(step) / 2, mode...);
        CAPTURE(trial);
        CAPTURE(coarse);
        CAPTURE(fine);
        CHECK(coarse < 1e-3);
        // 2^8 = 256; the next term makes it a little more or less.
        CHECK(coarse / fine > 230);
        CHECK(coarse / fine < 290);
    }
}

}  // namespace

TEST_CASE("series of every function") { check_order<series_functions::full::System<Number>>("functions", 1e-3, nullptr); }

TEST_CASE("series of machines whose accelerations are solved for") {
    check_order<n_pendulum_N3::full::System<Number>>("three links, M moves", 1e-4, nullptr);
    check_order<four_bar::full::System<Number>>("four bars, with multipliers", 1e-5, nullptr);
    check_order<heavy_top::attitude::System<Number>>("a quaternion", 1e-5, nullptr);
    check_order<arm_6r::plain::System<Number>>("M by loops", 1e-5, nullptr);
}

TEST_CASE("series of fluids, gases and of what switches") {
    check_order<valve_cylinder::exact::System<Number>>("orifices", 1e-7, nullptr);
    using Reservoir = reservoir_discharge::full::System<Number>;
    check_order<Reservoir>("a gas that flows out", 1e-3, nullptr, Reservoir::Mode{});
    using Cylinder = cylinder_stops::full::System<Number>;
    check_order<Cylinder>("between stops", 1e-7, nullptr, Cylinder::Mode::inner_open_and_outer_open);
}

TEST_CASE("the first coefficients of a Kepler orbit by hand") {
    using System = kepler::full::System<Number>;
    const System system;
    std::vector<System::State> c(4);
    c[0] = system.start_state();
    std::vector<Number> rows(2 * System::series_rows * 3);
    system.series(Inputs<System>(), Number(0), 3, c.data(), rows.data());
    System::State dxdt{};
    system.rhs(c[0], {}, Number(0), dxdt);
    System::JacobianX J{};
    system.jacobian_x(c[0], {}, Number(0), J);
    for (std::size_t i = 0; i < 4; ++i) {
        Number second = 0;
        for (std::size_t j = 0; j < 4; ++j) second += J[j * 4 + i] * dxdt[j] / 2;
        CHECK(c[1][i] == dxdt[i]);
        CHECK(abs(c[2][i] - second) <= abs(second) * Number(1e-45));
    }
}
