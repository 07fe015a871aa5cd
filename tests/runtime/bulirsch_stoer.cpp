// SPDX-License-Identifier: BSL-1.0
// Extrapolation of the midpoint rule: its order, errors that follow the tolerance, what it refuses and finds.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <type_traits>

#include "dalembert/integrate.hpp"

using namespace dalembert;

namespace {

using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

template <class Scalar>
using Two = std::array<Scalar, 2>;
const auto nobody = [](const auto&, const auto&) {};

/// x = 1/(1 + t^2), y = exp(-atan(t)).
const auto smooth = [](const auto& x, const auto& t, auto& dxdt) {
    dxdt[0] = -2 * t * x[0] * x[0];
    dxdt[1] = -x[0] * x[1];
};

template <class Scalar>
Scalar error(double tolerance, double step, Outcome* outcome = nullptr) {
    using std::abs;
    using std::atan;
    using std::exp;
    IntegrationOptions<Two<Scalar>> options;
    options.method = Method::bulirsch_stoer;
    options.tolerance = Scalar(tolerance);
    options.step = Scalar(step);
    options.is_fixed = step > 0;
    Two<Scalar> x{Scalar(1), Scalar(1)};
    const Outcome result = integrate(smooth, x, Scalar(0), Scalar(2), options, nobody);
    CHECK(result.status == Status::success);
    if (outcome != nullptr) *outcome = result;
    return abs(x[1] - exp(-atan(Scalar(2))));
}

}  // namespace

TEST_CASE("with k columns the order is 2k, and k follows from the tolerance") {
    for (const auto& [tolerance, order] : {std::pair(1e-3, 6), std::pair(1e-6, 8), std::pair(1e-9, 10), std::pair(1e-15, 14)}) {
        const double ratio = static_cast<double>(error<Digits50>(tolerance, 1.0 / 64) / error<Digits50>(tolerance, 1.0 / 128));
        CHECK(std::log2(ratio) == doctest::Approx(order).epsilon(0.05));
    }
}

TEST_CASE("errors follow the tolerance, in double and with fifty digits") {
    for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) CHECK(error<double>(tolerance, 0) < 10 * tolerance);
    for (const double tolerance : {1e-15, 1e-25, 1e-35}) {
        Outcome outcome;
        CHECK(error<Digits50>(tolerance, 0, &outcome) < Digits50(100 * tolerance));
        MESSAGE("tolerance ", tolerance, ": ", outcome.steps, " steps, ", outcome.rhs_calls, " right-hand sides");
    }
}

TEST_CASE("a step into what is not finite is no step, and an event is found") {
    // x' = x^2 from 1: infinite at t = 1.
    IntegrationOptions<std::array<double, 1>> options;
    options.method = Method::bulirsch_stoer;
    options.tolerance = 1e-9;
    std::array<double, 1> x{1};
    const auto square = [](const std::array<double, 1>& at, double, std::array<double, 1>& rate) { rate[0] = at[0] * at[0]; };
    const Outcome outcome = integrate(square, x, 0.0, 2.0, options, nobody);
    CHECK(outcome.status != Status::success);
    CHECK(std::isfinite(x[0]));
    CHECK(outcome.t < 1 + 1e-9);
    x = {1};
    const Outcome event = integrate(square, x, 0.0, 2.0, options, nobody, [](const std::array<double, 1>& at, double, std::array<double, 1>& g) { g[0] = 5 - at[0]; }, std::array<bool, 1>{true});
    CHECK(event.status == Status::event);
    CHECK(event.t == doctest::Approx(0.8).epsilon(1e-9));
}
