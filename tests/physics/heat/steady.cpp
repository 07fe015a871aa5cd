// SPDX-License-Identifier: BSL-1.0
// Rods of every shape, scheme, grid and kind of end come to their known temperatures with the second power of the cell size.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "at_rest.hpp"
#include "steady_N16.hpp"
#include "steady_N32.hpp"
#include "steady_N8.hpp"

namespace {

struct Rod {
    const char* name;
    std::size_t extra;                           ///< states beyond N: -1 as a wrapped number
    std::function<double(double, double)> place; ///< of cell k of n intervals, 0 to 1
    bool is_radial;
};

double middle(double (*grid)(double), double k, double n) { return (grid(k / n) + grid((k + 1) / n)) / 2; }
double uniform(double s) { return s; }
double finer(double s) { return (s + s * s) / 2; }

const std::vector<Rod> rods{
    // in the order of the states
    {"held", std::size_t(-1), [](double k, double n) { return (k + 1) / n; }, false},
    {"points", 1, [](double k, double n) { return k / n; }, false},
    {"graded", 1, [](double k, double n) { return finer(k / n); }, false},
    {"cells", 0, [](double k, double n) { return middle(uniform, k, n); }, false},
    {"refined", 0, [](double k, double n) { return middle(finer, k, n); }, false},
    {"radiating", 0, [](double k, double n) { return middle(uniform, k, n); }, false},
    {"pipe", 0, [](double k, double n) { return middle(uniform, k, n); }, true},
    {"shell", 1, [](double k, double n) { return k / n; }, true},
    {"varying", 0, [](double k, double n) { return middle(uniform, k, n); }, false},
};

/// The largest error of each rod.
template <class System>
std::vector<double> errors(std::size_t n) {
    const System system;
    const auto p = system.parameters();
    const auto x = at_rest(system);
    std::vector<double> result;
    std::size_t first = 0;
    for (const Rod& rod : rods) {
        double largest = 0;
        for (std::size_t k = 0; k < n + rod.extra; ++k) {
            const double at = (rod.is_radial ? p.r : 0.0) + p.L * rod.place(static_cast<double>(k), static_cast<double>(n));
            largest = std::max(largest, std::fabs(x[first + k] - p.T_0 - p.c * std::sin(p.w * at)));
        }
        first += n + rod.extra;
        result.push_back(largest);
    }
    CHECK(first == x.size());
    return result;
}

}  // namespace

TEST_CASE("the error of a rod falls with the square of its cells, for all shapes, schemes, grids and ends") {
    const auto coarse = errors<steady_N8::full::System<double>>(8);
    const auto middling = errors<steady_N16::full::System<double>>(16);
    const auto fine = errors<steady_N32::full::System<double>>(32);
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const std::string name = rods[i].name;
        CAPTURE(name);
        CAPTURE(fine[i]);
        CHECK(fine[i] < 0.2);  // of 30 K
        const double first = std::log2(coarse[i] / middling[i]);
        const double second = std::log2(middling[i] / fine[i]);
        CHECK(first > 1.8);
        CHECK(second > 1.9);
        CHECK(second < 2.6);
    }
}
