// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of C headers give the same numbers as those of C++ headers, to the last bit, in float and double.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "dalembert/angle_functions.hpp"
#include "dalembert/fluid_functions.hpp"
#include "dalembert/heat_functions.hpp"
#include "dalembert/heat_networks.hpp"
#include "dalembert/junctions.hpp"
#include "dalembert/ldlt.hpp"
#include "dalembert/scalar_functions.hpp"
#include "dalembert/series_functions.hpp"
#include "functions_double.h"
#include "functions_float.h"

namespace {

namespace cpp = dalembert::detail;

/// The C function of the type Real.
#define C(name)                                                                                \
    [](auto... arguments) {                                                                    \
        if constexpr (std::is_same_v<Real, float>) return c_float_##name(arguments...);        \
        else return c_double_##name(arguments...);                                             \
    }

template <class Real>
bool is_same(Real a, Real b) {
    return std::memcmp(&a, &b, sizeof(Real)) == 0 || (std::isnan(a) && std::isnan(b));
}

/// Zero, kinks and limits of all functions with their neighbours, what is no number, and numbers of every size.
template <class Real>
std::vector<Real> points(std::size_t random_count) {
    using Limits = std::numeric_limits<Real>;
    std::vector<Real> values{Real(0), Limits::min(), Limits::denorm_min(), Limits::max(), Limits::infinity(),
                             Limits::quiet_NaN(), Limits::epsilon()};
    for (const double kink : {0.25, 0.5, 0.75, 1.0, 1.4, 2.0, 3.0, 4.0, 5.0, 8.0, 511.5, 512.0, 1000.0, 65536.0, 1e10,
                               0.785398163397, 1.570796326795, 3.141592653590})
        for (const Real to : {Real(-1e9), Real(kink), Real(1e30)}) values.push_back(std::nextafter(Real(kink), to));
    std::mt19937_64 random(20);
    std::uniform_real_distribution<double> near(-6, 6);
    std::uniform_real_distribution<double> exponent(-30, 30);
    for (std::size_t i = 0; i < random_count; ++i) {
        values.push_back(Real(near(random)));
        values.push_back(Real(std::pow(10.0, exponent(random))));
    }
    const std::size_t count = values.size();
    for (std::size_t i = 0; i < count; ++i) values.push_back(-values[i]);
    return values;
}

template <class Real, class InC, class InCpp>
void one(const char* name, const InC& in_c, const InCpp& in_cpp) {
    for (const Real x : points<Real>(20000)) {
        if (is_same<Real>(in_c(x), in_cpp(x))) continue;
        FAIL_CHECK(std::string(name) << "(" << x << ") is " << in_c(x) << " in C and " << in_cpp(x) << " in C++");
        return;
    }
}

template <class Real, class InC, class InCpp>
void two(const char* name, const InC& in_c, const InCpp& in_cpp) {
    const std::vector<Real> values = points<Real>(60);
    for (const Real x : values)
        for (const Real y : values) {
            if (is_same<Real>(in_c(x, y), in_cpp(x, y))) continue;
            FAIL_CHECK(std::string(name) << "(" << x << ", " << y << ") is " << in_c(x, y) << " in C and " << in_cpp(x, y) << " in C++");
            return;
        }
}

template <class Real, class InC, class InCpp>
void three(const char* name, const InC& in_c, const InCpp& in_cpp) {
    std::mt19937 random(3);
    const std::vector<Real> values = points<Real>(10);
    const auto any = [&] { return values[random() % values.size()]; };
    for (int i = 0; i < 50000; ++i) {
        const Real x = any(), y = any(), z = any();
        if (is_same<Real>(Real(in_c(x, y, z)), Real(in_cpp(x, y, z)))) continue;
        FAIL_CHECK(std::string(name) << "(" << x << ", " << y << ", " << z << ") differs");
        return;
    }
}

#define ONE(name) one<Real>(#name, C(name), [](Real x) { return cpp::name<Real>(x); })
#define TWO(name) two<Real>(#name, C(name), [](Real x, Real y) { return cpp::name<Real>(x, y); })
#define THREE(name) three<Real>(#name, C(name), [](Real x, Real y, Real z) { return cpp::name<Real>(x, y, z); })
#define LIBRARY(name) one<Real>(#name, C(name), [](Real x) { return std::name(x); })

template <class Real>
void compare_scalars() {
    LIBRARY(fabs), LIBRARY(floor), LIBRARY(sqrt), LIBRARY(sin), LIBRARY(cos), LIBRARY(tan), LIBRARY(asin), LIBRARY(acos), LIBRARY(atan);
    LIBRARY(sinh), LIBRARY(cosh), LIBRARY(tanh), LIBRARY(exp), LIBRARY(expm1), LIBRARY(log), LIBRARY(log1p);
    two<Real>("pow", C(pow), [](Real x, Real y) { return std::pow(x, y); });
    two<Real>("atan2", C(atan2), [](Real x, Real y) { return std::atan2(x, y); });
    ONE(sign), ONE(step), ONE(inverse_norm), ONE(one_minus_cos), ONE(sinc), ONE(sinc_slope), ONE(cosc), ONE(cosc_slope);
    ONE(growth_mean), ONE(logc), ONE(combined_sin), ONE(combined_cos);
    TWO(min), TWO(max), TWO(independent_inverse);
    THREE(if_else), THREE(is_near), THREE(sum_of_three);
    one<Real>("select", [](Real x) { return C(select)(x < Real(1), x, Real(7)); },
              [](Real x) { return cpp::select<Real>(x < Real(1), x, Real(7)); });
    CHECK(is_same<Real>(C(pi)(), cpp::pi<Real>()));
    const auto pair = [](Real x, const auto& in_c, const auto& in_cpp) {
        Real s, c, sine, cosine;
        in_c(x, &s, &c);
        in_cpp(x, sine, cosine);
        return is_same(s, sine) && is_same(c, cosine);
    };
    bool all_same = true;
    for (const Real x : points<Real>(20000))
        all_same = all_same && pair(x, C(sin_and_cos), [](Real a, Real& s, Real& c) { cpp::sin_and_cos<Real>(a, s, c); }) &&
                   pair(x, C(combined_sin_and_cos), [](Real a, Real& s, Real& c) { cpp::combined_sin_and_cos<Real>(a, s, c); });
    CHECK(all_same);
    std::mt19937 random(4);
    std::uniform_real_distribution<Real> number(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        Real e[4] = {number(random), number(random), number(random), number(random)}, f[4];
        std::memcpy(f, e, sizeof e);
        const Real x = number(random), y = number(random), z = number(random);
        C(turn_back)(e, x, y, z);
        cpp::turn_back<Real>(f, x, y, z);
        REQUIRE(std::memcmp(e, f, sizeof e) == 0);
    }
}

template <class Real>
void compare_fluids_and_heat() {
    ONE(exponential_remainder), ONE(compression), ONE(signed_root), ONE(inverse_root), ONE(forward_root), ONE(outflow_logarithm);
    ONE(critical_logarithm), ONE(decay_mean), ONE(decay_mean_slope), ONE(logc_slope);
    TWO(outflow_factor), TWO(outflow_factor_slope), TWO(outflow_factor_by_exponent), TWO(log_ratio), TWO(log_mean), TWO(log_mean_slope);
    TWO(root_excess), TWO(radiant_temperature);
    two<Real>("compression", C(compression_by_decay), [](Real x, Real decay) { return cpp::compression<Real>(x, decay); });
    THREE(temperature_giving_off);
}

/// Numbers above zero of different sizes, some of them zero, as coefficients of networks are.
template <class Real>
struct Coefficients {
    std::mt19937 random{5};
    Real operator()() { return random() % 5 == 0 ? Real(0) : Real(std::pow(10.0, std::uniform_real_distribution<double>(-4, 4)(random))); }
};

template <class Real, std::size_t size>
bool same(const std::array<Real, size>& a, const std::array<Real, size>& b) {
    for (std::size_t i = 0; i < size; ++i)
        if (!is_same(a[i], b[i])) return false;
    return true;
}

#define NETWORKS(n)                                                                       \
    for (int k = 0; k < 300; ++k) {                                                       \
        std::array<Real, 2 * n * n + n> data;                                             \
        for (Real& each : data) each = next();                                            \
        for (std::size_t i = 0; i < 2 * n; ++i)                                           \
            for (std::size_t j = 0; j < i % n; ++j) data[i * n + j] = data[(i / n * n + j) * n + i % n]; \
        std::array<Real, n> T;                                                            \
        C(balanced_temperature_##n)(data.data(), T.data());                               \
        REQUIRE(same(T, cpp::balanced_temperature<Real, n>(data)));                       \
        std::array<Real, n * n> flow, inverse;                                            \
        for (Real& each : flow) each = next();                                            \
        const auto expected = cpp::network_inverse<Real, n>(flow);                        \
        C(network_inverse_##n)(flow.data(), inverse.data());                              \
        REQUIRE(same(inverse, expected));                                                 \
        std::array<Real, 2 * n + 2> junction;                                             \
        for (Real& each : junction) each = next();                                        \
        if (k % 3 == 0) junction[2] = junction[2 * n];                                    \
        std::array<Real, n> roots;                                                        \
        C(junction_root_##n)(junction.data(), roots.data());                              \
        REQUIRE(same(roots, cpp::junction_root<Real, n>(junction)));                      \
    }

#define MATRICES(n)                                                                       \
    for (int k = 0; k < 100; ++k) {                                                       \
        constexpr std::size_t columns = 19;                                               \
        std::array<Real, n*(n + 1) / 2> m, in_c;                                          \
        for (Real& each : m) each = number(random);                                       \
        for (std::size_t i = 0; i < n; ++i) m[i * (i + 1) / 2 + i] += Real(2 * n);        \
        in_c = m;                                                                         \
        cpp::ldlt_factor<Real, n>(m);                                                     \
        C(ldlt_factor_##n)(in_c.data());                                                  \
        REQUIRE(same(m, in_c));                                                           \
        std::array<Real, columns * n> values, other;                                      \
        for (Real& each : values) each = number(random);                                  \
        std::array<std::size_t, columns> starts;                                          \
        for (std::size_t i = 0; i < columns; ++i) starts[i] = (columns - 1 - i) * n;      \
        other = values;                                                                   \
        cpp::ldlt_solve_columns<Real, n>(m, values.data(), starts);                       \
        C(ldlt_solve_columns_##n)(m.data(), other.data(), starts.data(), columns);        \
        REQUIRE(same(values, other));                                                     \
        cpp::ldlt_solve<Real, n>(m, values.data());                                       \
        C(ldlt_solve_##n)(m.data(), other.data());                                        \
        REQUIRE(same(values, other));                                                     \
        std::array<Real, 2 * n * 12> rows;                                                \
        for (Real& each : rows) each = number(random);                                    \
        std::array<Real, n> sums, expected;                                               \
        cpp::series_sums<Real, n>(rows.data(), std::size_t(k % 12), expected.data());     \
        C(series_sums_##n)(rows.data(), std::size_t(k % 12), sums.data());                \
        REQUIRE(same(sums, expected));                                                    \
    }

template <class Real>
void compare_sized() {
    Coefficients<Real> next;
    NETWORKS(1) NETWORKS(2) NETWORKS(3) NETWORKS(5) NETWORKS(13)
    std::mt19937 random(6);
    std::uniform_real_distribution<Real> number(-1, 1);
    MATRICES(1) MATRICES(2) MATRICES(3) MATRICES(5) MATRICES(13)
}

}  // namespace

TEST_CASE_TEMPLATE("scalar functions and angles: C as C++", Real, float, double) { compare_scalars<Real>(); }
TEST_CASE_TEMPLATE("fluids and heat: C as C++", Real, float, double) { compare_fluids_and_heat<Real>(); }
TEST_CASE_TEMPLATE("networks, junctions, matrices and series: C as C++", Real, float, double) { compare_sized<Real>(); }
