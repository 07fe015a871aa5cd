// SPDX-License-Identifier: GPL-3.0-or-later
// What is emitted for functions of heat transfer keeps their digits: the outputs of a model that uses each of them against the printed
// formulas in 120 digits and against the runtime's templates, its Jacobian against differences.
#include "heat_functions.hpp"

#include <doctest/doctest.h>

#include "dalembert/heat_functions.hpp"
#include "runtime/exact_heat.hpp"

using namespace exact_heat;

namespace {

namespace model = heat_functions::full;
using output = model::output;
using input = model::input;
using Binary50 = boost::multiprecision::cpp_bin_float_50;

template <class Scalar>
typename model::System<Scalar>::Input typical() {
    typename model::System<Scalar>::Input u;
    u.fill(Scalar(1));
    u[input::mx] = Scalar(1) / 2;
    return u;
}

/// One output as a function of some inputs.
template <class Scalar, std::size_t N>
struct Emitted {
    std::size_t which;
    std::array<std::size_t, N> inputs;
    model::System<Scalar> system{};
    typename model::System<Scalar>::Input u = typical<Scalar>();

    void set(const std::array<Scalar, N>& x) {
        for (std::size_t i = 0; i < N; ++i) u[inputs[i]] = x[i];
    }
    Scalar operator()(const std::array<Scalar, N>& x) {
        set(x);
        typename model::System<Scalar>::Output y;
        system.output({}, u, Scalar(0), y);
        return y[which];
    }
    std::array<Scalar, N> slopes(const std::array<Scalar, N>& x) {
        set(x);
        typename model::System<Scalar>::OutputJacobianU D;
        system.output_jacobian_u({}, u, Scalar(0), D);
        std::array<Scalar, N> result;
        for (std::size_t i = 0; i < N; ++i) result[i] = D[inputs[i] * model::output_count + which];
        return result;
    }
};

template <class Scalar, std::size_t N>
void check_value(double allowed, std::size_t which, const std::array<std::size_t, N>& inputs, const Formula<N>& exact, const Points<Scalar, N>& points) {
    Emitted<Scalar, N> emitted{which, inputs};
    const Worst worst = worst_error<Scalar>([&](const auto& point) { return emitted(point); }, exact, points);
    INFO("output ", which, ", ", std::numeric_limits<Scalar>::digits, " bits, at", worst.place);
    CHECK_FALSE(worst.place.empty());
    CHECK(worst.error <= allowed);
}

/// The template with 50 digits, at every 29th point.
template <class Function, std::size_t N>
void check_template(std::size_t which, const std::array<std::size_t, N>& inputs, const Function& function, const Formula<N>& exact, const Points<double, N>& points) {
    Emitted<Binary50, N> emitted{which, inputs};
    for (std::size_t n = 0; n < points.size(); n += 29) {
        std::array<Binary50, N> arguments;
        std::array<Exact, N> x;
        for (std::size_t i = 0; i < N; ++i) arguments[i] = points[n][i];
        for (std::size_t i = 0; i < N; ++i) x[i] = points[n][i];
        const Exact value(std::apply(function, arguments));
        Exact sum = 10 * abs(value);
        for (std::size_t i = 0; i < N; ++i) sum += abs(share(exact, x, i));
        INFO("output ", which, ", point ", n);
        CHECK(abs(Exact(emitted(arguments)) - value) <= Exact("1e-47") * sum);
    }
}

/// Norm-wise, each column by the size of its argument. Nothing is asked where the type cannot hold the slopes.
template <std::size_t N>
void check_jacobian(std::size_t which, const std::array<std::size_t, N>& inputs, const Formula<N>& exact, const Points<double, N>& points) {
    Emitted<double, N> emitted{which, inputs};
    double worst = 0;
    std::string place;
    for (const auto& point : points) {
        std::array<Exact, N> x;
        for (std::size_t i = 0; i < N; ++i) x[i] = point[i];
        const Exact value = exact(x);
        const std::array<double, N> slopes = emitted.slopes(point);
        Exact size = abs(value);
        Exact error = 0;
        bool fits = abs(value) < 1e250;
        for (std::size_t i = 0; i < N; ++i) {
            if (x[i] == 0) continue;
            const Exact expected = share(exact, x, i);
            fits = fits && abs(expected / x[i]) < 1e250;
            size += abs(expected);
            error += std::isfinite(slopes[i]) ? Exact(abs(slopes[i] * x[i] - expected)) : Exact("1e300") * abs(size);
        }
        if (!fits || size < 1e-250) continue;
        for (const double slope : slopes) CHECK(std::isfinite(slope));
        const double relative = static_cast<double>(Exact(error / size));
        if (relative <= worst) continue;
        worst = relative;
        place.clear();
        for (const double number : point) place += " " + Exact(number).str(12);
    }
    INFO("output ", which, " at", place);
    CHECK(worst < 1e-12);
}

const Formula<2> exact_excess_of_root = [](const auto& x) { return Exact(root(x[0], x[1]) - x[0]); };

template <class Scalar>
Points<Scalar, 2> distances() {
    Points<Scalar, 2> points;
    for (const auto& [c, s] : roots<Scalar>())
        if (s > 0) points.push_back({c, std::sqrt(s)});
    return points;
}

/// Calls visit(which, inputs, exact, points, bound in units of the last place, template) for every function.
template <class Scalar, class Visit>
void for_each_function(const Visit& visit) {
    using namespace dalembert;
    using One = std::array<std::size_t, 1>;
    using Two = std::array<std::size_t, 2>;
    using Three = std::array<std::size_t, 3>;
    using Four = std::array<std::size_t, 4>;
#define CALL(f) [](const auto&... x) { return f(x...); }
    visit(output::decay, One{input::r}, exact_decay_mean, each(signed_numbers<Scalar>()), 4, CALL(decay_mean));
    visit(output::ratio_of_logarithms, Two{input::T_a, input::T_b}, exact_log_ratio, neighbours<Scalar>(), 4, CALL(log_ratio));
    visit(output::mean_difference, Two{input::T_a, input::T_b}, exact_log_mean, neighbours<Scalar>(), 4, CALL(log_mean));
    const auto excess = [](const auto& x, const auto& y) { return root_excess(x, std::decay_t<decltype(x)>(y * y)); };
    visit(output::excess, Two{input::x, input::y}, exact_excess_of_root, distances<Scalar>(), 4, excess);
    visit(output::radiant, Two{input::k, input::T_b}, exact_radiant_temperature, radiations<Scalar>(), 4, CALL(radiant_temperature));
    visit(output::fourth_powers, Two{input::T_a, input::T_b}, exact_fourth_power_difference, temperatures<Scalar>(), 8, CALL(fourth_power_difference));
    visit(output::plate, Three{input::x, input::lambda, input::A}, exact_plate_resistance, layers<Scalar>(), 4, CALL(plate_resistance));
    visit(output::pipe, Four{input::L_i, input::L_j, input::lambda, input::x}, exact_pipe_resistance, pipes<Scalar>(), 8, CALL(pipe_resistance));
    visit(output::series, Two{input::R_1, input::R_2}, exact_in_series, neighbours<Scalar>(), 4, CALL(in_series));
    visit(output::parallel, Two{input::R_1, input::R_2}, exact_in_parallel, neighbours<Scalar>(), 4, CALL(in_parallel));
    visit(output::sines, Two{input::mx, input::mL}, exact_sinh_ratio, lengths<Scalar>(), 8, CALL(sinh_ratio));
    visit(output::cosines, Two{input::mx, input::mL}, exact_cosh_ratio, lengths<Scalar>(), 8, CALL(cosh_ratio));
    visit(output::fin_excess, Three{input::mL, input::mx, input::h}, exact_fin_temperature, fins<Scalar>(), 8, CALL(fin_temperature));
    visit(output::fin_base, Two{input::mL, input::h}, exact_fin_heat, fin_bases<Scalar>(), 8, CALL(fin_heat));
    visit(output::rod_base, Two{input::mL, input::r}, exact_rod_heat, rods<Scalar>(), 8, CALL(rod_heat));
    visit(output::parallel_flow, Two{input::N, input::c}, exact_parallel_flow, exchangers<Scalar>(), 8, CALL(effectiveness_parallel_flow));
    visit(output::counter_flow, Two{input::N, input::c}, exact_counter_flow, exchangers<Scalar>(), 8, CALL(effectiveness_counter_flow));
    visit(output::nusselt, Two{input::Re, input::Pr}, exact_plate_nusselt, plates<Scalar>(), 8, CALL(plate_nusselt));
    visit(output::parallel_strips, Four{input::x, input::y, input::L_i, input::L_j}, exact_parallel_strips, strips<Scalar>(), 8, CALL(view_parallel_strips));
    visit(output::half_plane, Three{input::x, input::y, input::L_i}, exact_half_plane, half_planes<Scalar>(), 8, CALL(view_half_plane));
    visit(output::perpendicular_strips, Four{input::x, input::y, input::L_i, input::L_j}, exact_perpendicular_strips, perpendicular_strips<Scalar>(), 8,
          CALL(view_perpendicular_strips));
    visit(output::wedge, Three{input::L_i, input::L_j, input::theta}, exact_wedge, wedges<Scalar>(), 8, CALL(view_wedge));
    visit(output::groove, Two{input::x, input::y}, exact_groove, grooves<Scalar>(), 8, CALL(view_groove));
#undef CALL
}

}  // namespace

TEST_CASE_TEMPLATE("emitted functions of heat transfer: kernels within 4, formulas within 8 units of the last place", Scalar, float, double, long double) {
    for_each_function<Scalar>([](std::size_t which, const auto& inputs, const auto& exact, const auto& points, double allowed, const auto&) {
        check_value<Scalar>(allowed, which, inputs, exact, points);
    });
}

TEST_CASE("emitted functions of heat transfer are those of the runtime") {
    for_each_function<double>([](std::size_t which, const auto& inputs, const auto& exact, const auto& points, double, const auto& function) {
        check_template(which, inputs, function, exact, points);
    });
}

TEST_CASE("emitted Jacobians of functions of heat transfer are finite and right, also where the functions are hard") {
    for_each_function<double>([](std::size_t which, const auto& inputs, const auto& exact, const auto& points, double, const auto&) {
        check_jacobian(which, inputs, exact, points);
    });
}
