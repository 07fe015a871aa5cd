// SPDX-License-Identifier: GPL-3.0-or-later
// Each function of heat transfer in float, double, long double and 50 digits against its printed definition in 120 digits, where what
// the definition loses by cancellation does not matter. Errors are in units of the last place, beyond what half such a unit in each
// argument would change.
#include "dalembert/heat_functions.hpp"

#include <doctest/doctest.h>

#include "runtime/exact_heat.hpp"

using namespace dalembert;
using namespace exact_heat;

namespace {

using Decimal50 = boost::multiprecision::cpp_dec_float_50;
using Binary50 = boost::multiprecision::cpp_bin_float_50;

template <class Scalar, class Function, std::size_t N>
void check_within(double allowed, const std::string& name, const Function& function, const Formula<N>& exact, const Points<Scalar, N>& points) {
    const Worst worst = worst_error<Scalar>([&](const auto& point) { return std::apply(function, point); }, exact, points);
    INFO(name, ", ", std::numeric_limits<Scalar>::digits, " bits, at", worst.place);
    CHECK_FALSE(worst.place.empty());
    CHECK(worst.error <= allowed);
}

#define CALL(f) [](const auto&... x) { return f(x...); }

}  // namespace

TEST_CASE_TEMPLATE("functions of heat transfer: the kernels within 4 units of the last place", Scalar, float, double, long double) {
    check_within<Scalar>(4, "decay_mean", CALL(decay_mean), exact_decay_mean, each(signed_numbers<Scalar>()));
    check_within<Scalar>(4, "decay_mean_slope", CALL(detail::decay_mean_slope), exact_decay_mean_slope, each(signed_numbers<Scalar>()));
    check_within<Scalar>(4, "log_ratio", CALL(log_ratio), exact_log_ratio, neighbours<Scalar>());
    check_within<Scalar>(4, "log_mean", CALL(log_mean), exact_log_mean, neighbours<Scalar>());
    check_within<Scalar>(4, "log_mean_slope", CALL(detail::log_mean_slope), exact_log_mean_slope, neighbours<Scalar>());
    check_within<Scalar>(4, "root_excess", CALL(root_excess), exact_root_excess, roots<Scalar>());
    check_within<Scalar>(4, "radiant_temperature", CALL(radiant_temperature), exact_radiant_temperature, radiations<Scalar>());
}

TEST_CASE_TEMPLATE("functions of heat transfer: the others within 8 units of the last place", Scalar, float, double, long double) {
    check_within<Scalar>(8, "fourth_power_difference", CALL(fourth_power_difference), exact_fourth_power_difference, temperatures<Scalar>());
    check_within<Scalar>(8, "plate_resistance", CALL(plate_resistance), exact_plate_resistance, layers<Scalar>());
    check_within<Scalar>(8, "pipe_resistance", CALL(pipe_resistance), exact_pipe_resistance, pipes<Scalar>());
    check_within<Scalar>(8, "in_series", CALL(in_series), exact_in_series, neighbours<Scalar>());
    check_within<Scalar>(8, "in_parallel", CALL(in_parallel), exact_in_parallel, neighbours<Scalar>());
    check_within<Scalar>(8, "sinh_ratio", CALL(sinh_ratio), exact_sinh_ratio, lengths<Scalar>());
    check_within<Scalar>(8, "cosh_ratio", CALL(cosh_ratio), exact_cosh_ratio, lengths<Scalar>());
    check_within<Scalar>(8, "fin_temperature", CALL(fin_temperature), exact_fin_temperature, fins<Scalar>());
    check_within<Scalar>(8, "fin_heat", CALL(fin_heat), exact_fin_heat, fin_bases<Scalar>());
    check_within<Scalar>(8, "rod_heat", CALL(rod_heat), exact_rod_heat, rods<Scalar>());
    check_within<Scalar>(8, "effectiveness_parallel_flow", CALL(effectiveness_parallel_flow), exact_parallel_flow, exchangers<Scalar>());
    check_within<Scalar>(8, "effectiveness_counter_flow", CALL(effectiveness_counter_flow), exact_counter_flow, exchangers<Scalar>());
    check_within<Scalar>(8, "plate_nusselt", CALL(plate_nusselt), exact_plate_nusselt, plates<Scalar>());
    check_within<Scalar>(8, "view_parallel_strips", CALL(view_parallel_strips), exact_parallel_strips, strips<Scalar>());
    check_within<Scalar>(8, "view_half_plane", CALL(view_half_plane), exact_half_plane, half_planes<Scalar>());
    check_within<Scalar>(8, "view_perpendicular_strips", CALL(view_perpendicular_strips), exact_perpendicular_strips, perpendicular_strips<Scalar>());
    check_within<Scalar>(8, "view_wedge", CALL(view_wedge), exact_wedge, wedges<Scalar>());
    check_within<Scalar>(8, "view_groove", CALL(view_groove), exact_groove, grooves<Scalar>());
}

namespace {

/// At every seventh point.
template <class Scalar, class Function, std::size_t N>
void check_digits(const std::string& name, const Function& function, const Formula<N>& exact, const Points<double, N>& points) {
    for (std::size_t n = 0; n < points.size(); n += 7) {
        std::array<Scalar, N> arguments;
        std::array<Exact, N> x;
        INFO(name);
        for (std::size_t i = 0; i < N; ++i) arguments[i] = Scalar(points[n][i]);
        for (std::size_t i = 0; i < N; ++i) x[i] = Exact(points[n][i]);
        const Exact value = exact(x);
        Exact sum = 10 * abs(value);
        for (std::size_t i = 0; i < N; ++i) sum += abs(share(exact, x, i));
        CHECK(abs(Exact(std::apply(function, arguments)) - value) <= Exact("1e-47") * sum);
    }
}

/// What a function says of its derivative by argument i, against differences.
template <std::size_t N, class Slope>
void check_slope(const std::string& name, const Formula<N>& exact, std::size_t i, const Slope& slope, const Points<double, N>& points) {
    for (std::size_t n = 0; n < points.size(); n += 7) {
        std::array<Binary50, N> arguments;
        std::array<Exact, N> x;
        for (std::size_t k = 0; k < N; ++k) arguments[k] = points[n][k];
        for (std::size_t k = 0; k < N; ++k) x[k] = points[n][k];
        if (x[i] == 0) continue;
        INFO(name, " by argument ", i, " at ", points[n][0]);
        const Exact expected = share(exact, x, i);
        CHECK(abs(Exact(std::apply(slope, arguments)) * x[i] - expected) <= Exact("1e-20") * abs(expected));
    }
}

}  // namespace

TEST_CASE_TEMPLATE("functions of heat transfer: 46 of 50 digits", Scalar, Decimal50, Binary50) {
    check_digits<Scalar>("decay_mean", CALL(decay_mean), exact_decay_mean, each(signed_numbers<double>()));
    check_digits<Scalar>("decay_mean_slope", CALL(detail::decay_mean_slope), exact_decay_mean_slope, each(signed_numbers<double>()));
    check_digits<Scalar>("log_ratio", CALL(log_ratio), exact_log_ratio, neighbours<double>());
    check_digits<Scalar>("log_mean", CALL(log_mean), exact_log_mean, neighbours<double>());
    check_digits<Scalar>("log_mean_slope", CALL(detail::log_mean_slope), exact_log_mean_slope, neighbours<double>());
    check_digits<Scalar>("root_excess", CALL(root_excess), exact_root_excess, roots<double>());
    check_digits<Scalar>("radiant_temperature", CALL(radiant_temperature), exact_radiant_temperature, radiations<double>());
    if constexpr (std::numeric_limits<Scalar>::radix == 2)  // detail::pi has the digits of a long double in decimal types
        check_digits<Scalar>("plate_nusselt", CALL(plate_nusselt), exact_plate_nusselt, plates<double>());
    check_digits<Scalar>("view_parallel_strips", CALL(view_parallel_strips), exact_parallel_strips, strips<double>());
    check_digits<Scalar>("view_wedge", CALL(view_wedge), exact_wedge, wedges<double>());
}

TEST_CASE("functions of heat transfer: derivatives are limits of differences") {
    check_slope("decay_mean", exact_decay_mean, 0, CALL(detail::decay_mean_slope), each(signed_numbers<double>()));
    check_slope("log_mean", exact_log_mean, 0, CALL(detail::log_mean_slope), neighbours<double>());
    check_slope("log_mean", exact_log_mean, 1, [](const auto& a, const auto& b) { return detail::log_mean_slope(b, a); }, neighbours<double>());
    const auto by_c = [](const Binary50& c, const Binary50& s) { return Binary50(-root_excess(c, s) / (root_excess(c, s) + c)); };
    const auto by_s = [](const Binary50& c, const Binary50& s) { return Binary50(1 / (2 * (root_excess(c, s) + c))); };
    const Points<double, 2> ordinary = pairs(numbers<double>({-1e6, -3, -0.01, 1e-9, 0.2, 7, 1e6}), powers<double>(1e-6, 3.7, 25));
    check_slope("root_excess", exact_root_excess, 0, by_c, ordinary);
    check_slope("root_excess", exact_root_excess, 1, by_s, ordinary);
    const auto by_b = [](const Binary50& a, const Binary50& b) { return Binary50(1 / (4 * a * pow(radiant_temperature(a, b), 3) + 1)); };
    const auto by_a = [&](const Binary50& a, const Binary50& b) { return Binary50(-pow(radiant_temperature(a, b), 4) * by_b(a, b)); };
    Points<double, 2> radiating;
    for (const auto& [a, b] : radiations<double>())
        if (a > 1e-12 && a < 1e12 && b > 1e-5 && b < 1e12) radiating.push_back({a, b});
    check_slope("radiant_temperature", exact_radiant_temperature, 0, by_a, radiating);
    check_slope("radiant_temperature", exact_radiant_temperature, 1, by_b, radiating);
}

TEST_CASE_TEMPLATE("functions of heat transfer: limits, and nothing that is not a number gets lost", Scalar, float, double, long double, Decimal50, Binary50) {
    const Scalar nan = std::numeric_limits<Scalar>::quiet_NaN();
    const Scalar a = Scalar(7) / Scalar(5);
    const Scalar b = Scalar(1) / Scalar(3);
    CHECK(decay_mean(Scalar(0)) == 1);
    CHECK(decay_mean(Scalar(std::numeric_limits<Scalar>::infinity())) == 0);
    CHECK(detail::decay_mean_slope(Scalar(0)) * 2 == -1);
    CHECK(log_ratio(a, a) == 0);
    CHECK(log_ratio(a, b) == -log_ratio(b, a));
    CHECK(log_mean(a, a) == a);
    CHECK(log_mean(Scalar(0), a) == 0);
    CHECK(log_mean(a, b) == log_mean(b, a));
    CHECK(detail::log_mean_slope(a, a) * 2 == 1);
    CHECK(root_excess(Scalar(0), Scalar(0)) == 0);
    CHECK(root_excess(Scalar(-a), Scalar(0)) == 2 * a);
    CHECK(radiant_temperature(Scalar(0), a) == a);
    CHECK(radiant_temperature(a, Scalar(0)) == 0);
    CHECK(radiant_temperature(Scalar(0), Scalar(0)) == 0);
    CHECK(detail::sum_of_three(Scalar(1), Scalar(std::numeric_limits<Scalar>::epsilon() / 4), Scalar(-1)) * 4 == std::numeric_limits<Scalar>::epsilon());
    CHECK(fin_temperature(a, Scalar(0), b) == 1);
    CHECK(effectiveness_counter_flow(Scalar(1), Scalar(1)) * 2 == 1);
    CHECK(view_wedge(a, a, Scalar(0)) == 1);
    const auto lost = [&](const auto& function, auto... arguments) {
        const std::array<Scalar, sizeof...(arguments)> all{arguments...};
        bool any = false;
        for (std::size_t i = 0; i < all.size(); ++i) {
            auto with_nan = all;
            with_nan[i] = nan;
            const Scalar value = std::apply(function, with_nan);
            any = any || value == value;
        }
        return any;
    };
    CHECK_FALSE(lost(CALL(decay_mean), a));
    CHECK_FALSE(lost(CALL(detail::decay_mean_slope), a));
    CHECK_FALSE(lost(CALL(log_ratio), a, b));
    CHECK_FALSE(lost(CALL(log_mean), a, b));
    CHECK_FALSE(lost(CALL(detail::log_mean_slope), a, b));
    CHECK_FALSE(lost(CALL(root_excess), a, b));
    CHECK_FALSE(lost(CALL(radiant_temperature), a, b));
    CHECK_FALSE(lost(CALL(fourth_power_difference), a, b));
    CHECK_FALSE(lost(CALL(sinh_ratio), a, b));
    CHECK_FALSE(lost(CALL(cosh_ratio), a, b));
    CHECK_FALSE(lost(CALL(fin_temperature), a, b, b));
    CHECK_FALSE(lost(CALL(fin_heat), a, b));
    CHECK_FALSE(lost(CALL(rod_heat), a, b));
    CHECK_FALSE(lost(CALL(effectiveness_parallel_flow), a, b));
    CHECK_FALSE(lost(CALL(effectiveness_counter_flow), a, b));
    CHECK_FALSE(lost(CALL(plate_nusselt), a, b));
    CHECK_FALSE(lost(CALL(view_parallel_strips), a, b, a, b));
    CHECK_FALSE(lost(CALL(view_half_plane), a, b, a));
    CHECK_FALSE(lost(CALL(view_perpendicular_strips), a, b, a, b));
    CHECK_FALSE(lost(CALL(view_wedge), a, b, a));
    CHECK_FALSE(lost(CALL(view_groove), a, b));
}
