// SPDX-License-Identifier: BSL-1.0
// Blocks come to their known temperatures with the second power of the cell size, steady heat across layers is exact, and what flows
// through sides and ends accounts for all that a source gives.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "at_rest.hpp"
#include "block_M2_N2.hpp"
#include "block_M4_N4.hpp"
#include "block_M6_N6.hpp"
#include "blocks_ends.hpp"
#include "blocks_mixed_N2.hpp"
#include "blocks_mixed_N4.hpp"
#include "blocks_mixed_N8.hpp"
#include "blocks_radiating_N2.hpp"
#include "blocks_radiating_N4.hpp"
#include "blocks_radiating_N8.hpp"

namespace {

/// Where cell k of n lies, 0 to 1. Columns of the radiating block: the first n/2 of 0.4, the others of 0.6.
double place(std::size_t k, std::size_t n) { return (static_cast<double>(k) + 0.5) / static_cast<double>(n); }
double stretched(double s) { return s < 0.5 ? 0.8 * s : 0.4 + 1.2 * (s - 0.5); }

/// The largest error of a block of n times n cells.
template <class System, class Exact>
double error(std::size_t n, const Exact& exact) {
    const System system;
    const auto p = system.parameters();
    const auto x = at_rest(system);
    REQUIRE(x.size() == n * n);
    double largest = 0;
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::fabs(x[i + n * j] - exact(p, place(i, n), place(j, n))));
    return largest;
}

void falls_with_the_square(double coarse, double middling, double fine) {
    CAPTURE(coarse);
    CAPTURE(middling);
    CAPTURE(fine);
    CHECK(fine < 0.4);  // K, of some 300
    CHECK(std::log2(coarse / middling) > 1.7);
    CHECK(std::log2(middling / fine) > 1.85);
    CHECK(std::log2(middling / fine) < 2.3);
}

template <class System>
typename System::Output outputs_at_rest(const System& system) {
    typename System::Output y;
    system.output(at_rest(system), {}, 0, y);
    return y;
}

/// Of the block of four materials between the plate and the right side, K/W.
template <class System>
double resistance() {
    const System system;
    typename System::Input u{};
    u[0] = 40;
    const auto x = at_rest(system, u);
    typename System::Output y;
    system.output(x, u, 0, y);
    CHECK(y[0] == doctest::Approx(40).epsilon(1e-9));
    CHECK(y[1] == doctest::Approx(40).epsilon(1e-9));
    return (x[0] - system.parameters().T_0) / y[0];
}

}  // namespace

TEST_CASE("the error of a block falls with the square of its cells, for all kinds of sides") {
    const auto mixed = [](const auto& p, double s, double t) { return p.T_0 + p.c * s * (5 - 2 * s * s * s) / 3 * (1 - t * t * t * t); };
    falls_with_the_square(error<blocks_N2::mixed::System<double>>(4, mixed), error<blocks_N4::mixed::System<double>>(8, mixed),
                          error<blocks_N8::mixed::System<double>>(16, mixed));
    const auto radiating = [](const auto& p, double s, double t) {
        const double r = stretched(s);
        return p.T_0 + p.c * r * r * (3 - 2 * r) * std::pow(1 - t * t, 2) + p.b * std::pow(p.H * t, 2);
    };
    falls_with_the_square(error<blocks_N2::radiating::System<double>>(4, radiating), error<blocks_N4::radiating::System<double>>(8, radiating),
                          error<blocks_N8::radiating::System<double>>(16, radiating));
}

TEST_CASE("steady heat across layers is exact") {
    const blocks_N2::ends::System<double> system;
    const auto p = system.parameters();
    const auto x = at_rest(system);
    const auto y = outputs_at_rest(system);
    // From T_0 through three layers to the surface, which takes up q and convects.
    const double R = p.L / p.lambda + p.L / 10 / p.mu + p.L / (2 * p.lambda);
    const double through = (p.alpha * (p.T_0 - p.T_inf) - p.q) / (1 + p.alpha * R);
    const double area = 1.25 * p.H * p.B;
    using output = blocks_N2::ends::output;
    CHECK(y[output::Q_left] == doctest::Approx(through * area).epsilon(1e-12));
    CHECK(y[output::Q_right] == doctest::Approx(-through * area).epsilon(1e-12));
    const double half = p.L / 6 / p.lambda;  // of a cell of the first layer
    const std::vector<double> resistances{half, 3 * half, 5 * half, 6 * half + p.L / 20 / p.mu, R - 3 * p.L / 8 / p.lambda, R - p.L / 8 / p.lambda};
    for (std::size_t k = 0; k < 12; ++k) CHECK(x[blocks_N2::ends::state::T_layers_0 + k] == doctest::Approx(p.T_0 - through * resistances[k % 6]).epsilon(1e-12));
}

TEST_CASE("what enters through sides and ends and what a source gives is nothing at rest") {
    const auto zero = [](double sum, double size) { CHECK(std::fabs(sum) < 1e-11 * std::fabs(size)); };
    {
        using output = blocks_N2::ends::output;
        const blocks_N2::ends::System<double> system;
        const auto p = system.parameters();
        const auto y = outputs_at_rest(system);
        zero(y[output::Q_cells_first] + y[output::Q_cells_last] + y[output::source], y[output::source]);
        zero(y[output::Q_points_first] + y[output::Q_points_last] + y[output::source], y[output::source]);
        zero(y[output::Q_many_last] + y[output::source], y[output::source]);
        CHECK(y[output::Q_many_first] == 0);
        CHECK(y[output::Q_points_first] == doctest::Approx(p.q * p.B * p.B).epsilon(1e-14));
        CHECK(y[output::Q_points_last] < 0);
    }
    // The source of a block as it is cut, by midpoints.
    constexpr std::size_t n = 8;
    const auto source = [](const auto& density) {
        double sum = 0;
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < n; ++i) sum += density(place(i, n), place(j, n)) / (n * n);
        return sum;
    };
    {
        using output = blocks_N4::mixed::output;
        const blocks_N4::mixed::System<double> system;
        const auto p = system.parameters();
        const auto y = outputs_at_rest(system);
        const double given = p.lambda * p.c * p.L * p.H * p.B * source([&](double s, double t) { return 8 * s * s * (1 - std::pow(t, 4)) / (p.L * p.L) + 4 * s * (5 - 2 * s * s * s) * t * t / (p.H * p.H); });
        zero(y[output::Q_mixed_left] + y[output::Q_mixed_right] + y[output::Q_mixed_top] + given, given);
        CHECK(y[output::Q_mixed_left] < 0);
        CHECK(y[output::Q_mixed_floor] == 0);
    }
    {
        const blocks_N4::radiating::System<double> system;
        const auto p = system.parameters();
        const double given = p.L * p.H * p.B * source([&](double s, double t) {
            const double r = stretched(s), width = s < 0.5 ? 0.8 : 1.2;
            return -width * (p.lambda * p.c * ((6 - 12 * r) / (p.L * p.L) * std::pow(1 - t * t, 2) + r * r * (3 - 2 * r) * (12 * t * t - 4) / (p.H * p.H)) + 2 * p.lambda * p.b);
        });
        zero(outputs_at_rest(system)[0] + given, given);
    }
}

TEST_CASE("the resistance of four materials lies between its bounds (4.108) and converges") {
    const block_M2_N2::block::Parameters<double> p;
    const double H = p.H_b + p.H_c;
    const double low = p.L_a / (p.lambda_a * H * p.B) + p.L_b / ((p.lambda_b * p.H_b + p.lambda_c * p.H_c) * p.B) + p.L_d / (p.lambda_d * H * p.B);
    const auto row = [&](double height, double lambda) { return (p.L_a / p.lambda_a + p.L_b / lambda + p.L_d / p.lambda_d) / (height * p.B); };
    const double up = 1 / (1 / row(p.H_b, p.lambda_b) + 1 / row(p.H_c, p.lambda_c));
    const double coarse = resistance<block_M2_N2::block::System<double>>();
    const double middling = resistance<block_M4_N4::block::System<double>>();
    const double fine = resistance<block_M6_N6::block::System<double>>();
    for (const double R : {coarse, middling, fine}) {
        CHECK(R > low);
        CHECK(R < up);
    }
    CAPTURE(coarse);
    CAPTURE(middling);
    CAPTURE(fine);
    // Where three materials meet the flux has no bound, so that the error falls slower than with the square.
    CHECK(std::fabs(fine - middling) < 0.4 * std::fabs(middling - coarse));
    CHECK(std::fabs(fine - middling) < 0.03 * (up - low));
}
