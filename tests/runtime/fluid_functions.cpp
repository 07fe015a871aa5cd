// SPDX-License-Identifier: GPL-3.0-or-later
// Each function in float, double, long double and 50 digits against its textbook definition in 250 digits, where what the
// definition loses by cancellation does not matter. Errors are in units of the last place, beyond what half such a unit in the
// arguments would change.
#include "dalembert/fluid_functions.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace dalembert::detail;

namespace {

namespace mp = boost::multiprecision;
using Exact = mp::number<mp::cpp_bin_float<250>, mp::et_off>;
using Decimal50 = mp::cpp_dec_float_50;
using Binary50 = mp::cpp_bin_float_50;

// ---- the definitions

Exact exact_compression(const Exact& x) {
    const Exact series = x * x / 2 * (1 - 2 * x / 3);
    return abs(x) < Exact("1e-40") ? series : Exact(1 - (1 + x) * exp(-x));
}

struct Outflow {
    Exact factor, slope, by_exponent;
};

/// phi and its derivatives by the rules of calculus; k = 1, where (3.157) is 0/0, by a k beside it, d = 0 by a d beside it.
Outflow exact_outflow(Exact d, Exact k) {
    if (k == 1) k += Exact("1e-60");
    if (d < Exact("1e-40")) {
        const Exact factor = 1 - 3 * d / (4 * k);
        return {factor, -3 / (4 * k), 3 * d / (4 * k * k)};
    }
    const Exact critical = pow(2 / (k + 1), k / (k - 1));
    if (1 - d <= critical) {
        const Exact factor = sqrt(k / (k + 1)) * pow(2 / (k + 1), 1 / (k - 1)) / sqrt(d);
        const Exact relative = 1 / (2 * k) - 1 / (2 * (k + 1)) - log(2 / (k + 1)) / ((k - 1) * (k - 1)) - 1 / ((k - 1) * (k + 1));
        return {factor, -factor / (2 * d), factor * relative};
    }
    const Exact Pi = 1 - d;
    const Exact root = pow(Pi, 1 / k);
    const Exact square = k / (k - 1) * (root * root - Pi * root);
    const Exact by_d = -k / (k - 1) * (2 / k * root * root / Pi - (k + 1) / k * root);
    const Exact by_k = -square / (k * (k - 1)) + k / (k - 1) * log(Pi) / (k * k) * (Pi * root - 2 * root * root);
    const Exact Psi = sqrt(square);
    return {Psi / sqrt(d), by_d / (2 * Psi * sqrt(d)) - Psi / (2 * d * sqrt(d)), by_k / (2 * Psi * sqrt(d))};
}

// ---- how far away from them

template <class Scalar>
double error_in_ulp(const Scalar& computed, const Exact& exact) {
    using limits = std::numeric_limits<Scalar>;
    if (!std::isfinite(computed)) return std::numeric_limits<double>::infinity();
    const int exponent = exact == 0 ? limits::min_exponent - 1 : std::max(static_cast<int>(ilogb(exact)), limits::min_exponent - 1);
    return static_cast<double>(Exact(abs(Exact(computed) - exact) / ldexp(Exact(1), exponent - limits::digits + 1)));
}

/// The largest error of a series of points, and where it is.
struct Worst {
    double excess = -1;
    double at_x = 0;
    double at_k = 0;
    void add(double error, const Exact& condition, const Exact& x, const Exact& k = 0) {
        const double found = error - static_cast<double>(condition) / 2;
        if (found <= excess) return;
        excess = found;
        at_x = static_cast<double>(x);
        at_k = static_cast<double>(k);
    }
};

void check_within(const std::string& name, const Worst& worst, double allowed) {
    CAPTURE(name);
    CAPTURE(worst.at_x);
    CAPTURE(worst.at_k);
    CHECK(worst.excess >= 0);
    CHECK(worst.excess <= allowed);
}

template <class Scalar>
Scalar neighbour(Scalar x, int steps) {
    for (; steps > 0; --steps) x = std::nextafter(x, std::numeric_limits<Scalar>::max());
    for (; steps < 0; ++steps) x = std::nextafter(x, std::numeric_limits<Scalar>::lowest());
    return x;
}

// ---- where they are compared

template <class Scalar>
std::vector<Scalar> points_of_compression() {
    std::vector<Scalar> points;
    for (int n = 1; n <= 800; ++n) points.push_back(static_cast<Scalar>(n) * Scalar(0.0051L));
    for (int n = 0; n < 120; ++n) points.push_back(Scalar(4) * std::pow(Scalar(175), static_cast<Scalar>(n) / Scalar(119)));
    for (int n = 0; n < 140; ++n) points.push_back(std::ldexp(Scalar(1.37L), -n));
    for (const int steps : {-3, -2, -1, 0, 1, 2, 3}) {
        points.push_back(neighbour(Scalar(2), steps));
        points.push_back(neighbour(Scalar(1), steps));
    }
    for (const Scalar x : {std::numeric_limits<Scalar>::min(), std::numeric_limits<Scalar>::denorm_min(), Scalar(0)}) points.push_back(x);
    const std::size_t positive = points.size();
    for (std::size_t i = 0; i < positive; ++i) points.push_back(-points[i]);
    return points;
}

template <class Scalar>
std::vector<Scalar> exponents() {
    return {Scalar(1),    neighbour(Scalar(1), 1), Scalar(1.0001L), Scalar(1.02L), Scalar(1.135L),
            Scalar(1.4L), Scalar(5) / Scalar(3),   Scalar(1.891L),  Scalar(2),     Scalar(4.9L)};
}

template <class Scalar>
std::vector<Scalar> points_of_outflow(const Scalar& k) {
    using limits = std::numeric_limits<Scalar>;
    std::vector<Scalar> points{Scalar(0), limits::denorm_min(), limits::min(), 3 * limits::min(), limits::epsilon()};
    for (int n = 0; n < 60; ++n) points.push_back((static_cast<Scalar>(n) + Scalar(0.37L)) / Scalar(60));
    for (int n = 2; n < 140; n += n < 20 ? 1 : 9) points.push_back(std::ldexp(Scalar(1.37L), -n));
    const Scalar critical = static_cast<Scalar>(Exact(1 - exp(Exact(critical_logarithm<Exact>(k)))));
    for (int n = -3; n <= 3; ++n) points.push_back(neighbour(critical, n));
    for (int n = 2; n < limits::digits; n += 5) {
        points.push_back(critical - std::ldexp(critical, -n));
        points.push_back(std::min(Scalar(1), critical + std::ldexp(critical, -n)));
        points.push_back(Scalar(1) - std::ldexp(Scalar(1), -n));
    }
    points.push_back(neighbour(Scalar(1), -1));
    points.push_back(Scalar(1));
    return points;
}

/// (f(x + h) - f(x - h))/(2h)
template <class Scalar, class Function>
Scalar difference(const Function& f, const Scalar& x, const Scalar& h) {
    const Scalar above = x + h;
    const Scalar below = x - h;
    return Scalar(f(above) - f(below)) / Scalar(2 * h);
}

template <class Scalar>
double relative(const Scalar& computed, const Exact& exact) {
    return static_cast<double>(Exact(abs(Exact(computed) - exact) / max(Exact(abs(exact)), Exact("1e-1000"))));
}

}  // namespace

TEST_CASE_TEMPLATE("functions of fluids: within 4 units of the last place", Scalar, float, double, long double) {
    CAPTURE(std::numeric_limits<Scalar>::digits);
    Worst compressions;
    Worst signed_roots;
    Worst inverse_roots;
    Worst forward_roots;
    for (const Scalar& x : points_of_compression<Scalar>()) {
        const Exact X(x);
        const Exact size = abs(X);
        const Exact exact = exact_compression(X);
        if (exact <= Exact(std::numeric_limits<Scalar>::max()))
            compressions.add(error_in_ulp(compression(x), exact), exact == 0 ? Exact(0) : Exact(X * X * exp(-X) / exact), X);
        const Exact root = sqrt(size);
        signed_roots.add(error_in_ulp(signed_root(x), x < 0 ? Exact(-root) : root), Exact(0.5), X);
        forward_roots.add(error_in_ulp(forward_root(x), x > 0 ? root : Exact(0)), Exact(0.5), X);
        if (x != 0) inverse_roots.add(error_in_ulp(inverse_root(x), 1 / root), Exact(0.5), X);
    }
    check_within("compression", compressions, 4);
    check_within("signed_root", signed_roots, 4);
    check_within("inverse_root", inverse_roots, 4);
    check_within("forward_root", forward_roots, 4);
}

TEST_CASE_TEMPLATE("outflow: the factor within 4 units of the last place, its derivatives within 8 of any arguments", Scalar, float, double, long double) {
    CAPTURE(std::numeric_limits<Scalar>::digits);
    Worst factors;
    Worst slopes;
    Worst slopes_above_2;
    Worst by_exponents;
    for (const Scalar& k : exponents<Scalar>()) {
        for (const Scalar& d : points_of_outflow(k)) {
            const Exact D(d);
            const Exact K(k);
            const Outflow exact = exact_outflow(D, K);
            factors.add(error_in_ulp(outflow_factor(d, k), exact.factor), Exact((abs(D * exact.slope) + abs(K * exact.by_exponent)) / exact.factor), D, K);
            (k <= 2 ? slopes : slopes_above_2).add(error_in_ulp(outflow_factor_slope(d, k), exact.slope), Exact(0), D, K);
            by_exponents.add(error_in_ulp(outflow_factor_by_exponent(d, k), exact.by_exponent), Exact(0), D, K);
        }
        CHECK(outflow_factor(Scalar(0), k) == 1);
        CHECK(outflow_factor_by_exponent(Scalar(0), k) == 0);
    }
    check_within("outflow_factor", factors, 4);
    check_within("outflow_factor_slope", slopes, 8);
    check_within("outflow_factor_slope for k above 2", slopes_above_2, 16);
    check_within("outflow_factor_by_exponent", by_exponents, 8);
}

TEST_CASE_TEMPLATE("functions of fluids: 45 of 50 digits", Scalar, Decimal50, Binary50) {
    for (const std::string digits : {"1e-30", "1e-12", "1e-6", "0.01", "0.3", "1", "1.7", "1.999999999", "2", "3", "20", "700"}) {
        CAPTURE(digits);
        for (const Scalar& x : {Scalar(digits), Scalar(-Scalar(digits))}) {
            CHECK(relative(compression(x), exact_compression(Exact(x))) < 1e-45);
            CHECK(relative(Scalar(signed_root(x) * abs(signed_root(x))), Exact(x)) < 1e-45);
            CHECK(relative(Scalar(inverse_root(x) * inverse_root(x)), Exact(abs(1 / Exact(x)))) < 1e-45);
        }
    }
    for (const std::string exponent : {"1", "1.00000000000001", "1.02", "1.4", "2", "5"}) {
        for (const std::string drop : {"1e-30", "1e-12", "1e-6", "0.01", "0.3", "0.39346", "0.4717", "0.55", "0.8", "1"}) {
            CAPTURE(exponent);
            CAPTURE(drop);
            const Scalar k(exponent);
            const Scalar d(drop);
            const Outflow exact = exact_outflow(Exact(d), Exact(k));
            CHECK(relative(outflow_factor(d, k), exact.factor) < 1e-45);
            CHECK(relative(outflow_factor_slope(d, k), exact.slope) < 1e-45);
            CHECK(relative(outflow_factor_by_exponent(d, k), exact.by_exponent) < 1e-45);
        }
        CHECK(outflow_factor(Scalar(0), Scalar(exponent)) == 1);
    }
}

TEST_CASE("functions of fluids: derivatives are limits of differences") {
    const Binary50 h("1e-16");
    for (const std::string digits : {"-30", "-2", "-1", "-0.001", "0.001", "0.5", "1.99", "2", "7", "40"}) {
        CAPTURE(digits);
        const Binary50 x(digits);
        const Binary50 step_size = h * abs(x);
        CHECK(relative(difference([](const Binary50& at) { return compression(at); }, x, step_size), Exact(Exact(x) * exp(-Exact(x)))) < 1e-12);  // beside 1 at 40
        CHECK(relative(difference(signed_root<Binary50>, x, step_size), Exact(inverse_root(x)) / 2) < 1e-28);
        CHECK(relative(difference(forward_root<Binary50>, x, step_size), Exact(step(x) * inverse_root(x)) / 2) < 1e-28);
    }
    const Exact tiny("1e-60");
    for (const std::string exponent : {"1.001", "1.4", "2"}) {
        for (const std::string drop : {"1e-6", "0.01", "0.3", "0.39", "0.47", "0.48", "0.56", "0.8", "1"}) {
            CAPTURE(exponent);
            CAPTURE(drop);
            const Binary50 k(exponent);
            const Binary50 d(drop);
            const auto along_d = [&](const Binary50& moved) { return outflow_factor(moved, k); };
            const auto along_k = [&](const Binary50& moved) { return outflow_factor(d, moved); };
            CHECK(relative(difference(along_d, d, Binary50(h * d)), Exact(outflow_factor_slope(d, k))) < 1e-24);
            CHECK(relative(difference(along_k, k, h), Exact(outflow_factor_by_exponent(d, k))) < 1e-24);
            const auto exact_along_d = [&](const Exact& moved) { return exact_outflow(moved, Exact(k)).factor; };
            const auto exact_along_k = [&](const Exact& moved) { return exact_outflow(Exact(d), moved).factor; };
            CHECK(relative(difference(exact_along_d, Exact(d), tiny), exact_outflow(Exact(d), Exact(k)).slope) < 1e-80);
            CHECK(relative(difference(exact_along_k, Exact(k), tiny), exact_outflow(Exact(d), Exact(k)).by_exponent) < 1e-80);
        }
    }
}

TEST_CASE_TEMPLATE("functions of fluids: they rise and fall as they should, over their seams too", Scalar, float, double, long double) {
    const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    Scalar below = 0;
    for (int n = 1; n <= 600; ++n) {  // up to 6, where 1 is still far away
        const Scalar x = static_cast<Scalar>(n) / Scalar(100);
        CHECK(compression(x) > below);
        CHECK(compression(-x) > compression(-x + Scalar(0.01L)));
        below = compression(x);
    }
    for (const Scalar seam : {Scalar(-2), Scalar(2)})
        for (const int steps : {-1, 1}) CHECK(std::abs(compression(neighbour(seam, steps)) - compression(seam)) <= 8 * epsilon * compression(seam));
    for (const Scalar& k : exponents<Scalar>()) {
        CAPTURE(k);
        Scalar factor = 1;
        for (int n = 1; n <= 500; ++n) {
            const Scalar d = static_cast<Scalar>(n) / Scalar(500);
            CHECK(outflow_factor(d, k) < factor);
            CHECK(outflow_factor_slope(d, k) < 0);
            CHECK(outflow_factor_by_exponent(d, k) > 0);
            factor = outflow_factor(d, k);
        }
        const Scalar critical = static_cast<Scalar>(Exact(1 - exp(critical_logarithm(Exact(k)))));
        for (int n = -8; n <= 8; ++n) {
            const Scalar d = neighbour(critical, n);
            CHECK(std::abs(outflow_factor(d, k) - outflow_factor(critical, k)) <= 8 * epsilon);
            CHECK(std::abs(outflow_factor_slope(d, k) - outflow_factor_slope(critical, k)) <= 40 * epsilon);
            CHECK(std::abs(outflow_factor_by_exponent(d, k) - outflow_factor_by_exponent(critical, k)) <= 8 * epsilon);
        }
    }
}

TEST_CASE_TEMPLATE("functions of fluids: nothing that is not a number comes up, and none gets lost", Scalar, float, double, long double, Decimal50, Binary50) {
    const Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
    const Scalar huge = (std::numeric_limits<Scalar>::max)();
    const Scalar smallest = (std::numeric_limits<Scalar>::min)();
    const auto is_nan = [](const Scalar& x) { return !(x == x); };
    CHECK(compression(infinity) == 1);
    CHECK(compression(huge) == 1);
    CHECK(compression(Scalar(700)) == 1);
    CHECK(compression(Scalar(-infinity)) == infinity);
    CHECK(compression(Scalar(-huge)) == infinity);
    CHECK(compression(Scalar(0)) == 0);
    CHECK(compression(smallest) >= 0);
    CHECK(signed_root(infinity) == infinity);
    CHECK(signed_root(Scalar(-infinity)) == -infinity);
    CHECK(signed_root(Scalar(-9)) == -3);
    CHECK(signed_root(Scalar(0)) == 0);
    CHECK(inverse_root(Scalar(0)) == infinity);
    CHECK(inverse_root(infinity) == 0);
    CHECK(inverse_root(Scalar(-4)) * 2 == 1);
    CHECK(forward_root(infinity) == infinity);
    CHECK(forward_root(Scalar(-infinity)) == 0);
    CHECK(forward_root(Scalar(-0.0F)) == 0);
    CHECK(forward_root(Scalar(9)) == 3);
    for (const Scalar& value : {compression(nan), signed_root(nan), inverse_root(nan), forward_root(nan)}) CHECK(is_nan(value));
    for (const Scalar& k : {Scalar(1), Scalar(1 + std::numeric_limits<Scalar>::epsilon()), Scalar(Scalar(7) / Scalar(5)), Scalar(2), Scalar(5)}) {
        for (const Scalar& d : {Scalar(0), smallest, Scalar(Scalar(1) / Scalar(2)), Scalar(Scalar(3) / Scalar(4)), Scalar(1)}) {
            CHECK(isfinite(outflow_factor(d, k)));
            CHECK(isfinite(outflow_factor_slope(d, k)));
            CHECK(isfinite(outflow_factor_by_exponent(d, k)));
        }
        for (const Scalar& value : {outflow_factor(nan, k), outflow_factor_slope(nan, k), outflow_factor_by_exponent(nan, k)}) CHECK(is_nan(value));
    }
    for (const Scalar& d : {Scalar(0), Scalar(Scalar(1) / Scalar(4)), Scalar(1)})
        for (const Scalar& value : {outflow_factor_slope(d, nan), outflow_factor_by_exponent(d, nan)}) CHECK(is_nan(value));
}
