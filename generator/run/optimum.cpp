// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/optimum.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dalembert {

namespace {

constexpr int search_bits = std::numeric_limits<double>::digits / 2;  // finer, and rounding decides
constexpr std::uintmax_t most_search_steps = 200;

using RealFunction = std::function<double(double)>;

/// The largest value between two places. Brent's method never looks at the ends themselves.
Optimum largest_between(const RealFunction& f, double low, double high) {
    // In a variable from 0 to 1: the tolerance of the method is partly an absolute one.
    std::uintmax_t steps = most_search_steps;
    const auto found =
        boost::math::tools::brent_find_minima([&](double s) { return -f(low + s * (high - low)); }, 0.0, 1.0, search_bits, steps);
    return {low + found.first * (high - low), -found.second, Optimum::Place::inside};
}

/// Newton's method on differences of fourth order. Values are flat at an optimum, and tell its place to half of their digits only; their
/// slopes tell it to nearly all. Where the function has a kink there the place by values stays.
void refine(const RealFunction& f, double low, double high, OptimumSearch& search) {
    constexpr int rounds = 3;
    Optimum& best = search.best;
    for (int round = 0; round < rounds; ++round) {
        const double x = best.at;
        const double h = std::min({(high - low) / 1000, (x - low) / 2, (high - x) / 2});
        if (!(h > search.resolution)) return;
        const double left = f(x - h), right = f(x + h), far_left = f(x - 2 * h), far_right = f(x + 2 * h);
        const double slope = (8 * (right - left) - (far_right - far_left)) / (12 * h);
        const double curvature = (16 * (right + left) - (far_right + far_left) - 30 * best.value) / (12 * h * h);
        const double shift = -slope / curvature;
        if (!(curvature < 0) || !(std::fabs(shift) < h)) return;
        const double value = f(x + shift);
        if (best.value - value > 1e-3 * -curvature * h * h) return;
        best.at = x + shift;
        best.value = value;
        search.curvature = curvature;
        search.step = h;
        search.last_shift = std::fabs(shift);
    }
}

}  // namespace

OptimumSearch find_maximum(const RealFunction& original, double low, double high, std::size_t points) {
    OptimumSearch result{};
    const RealFunction f = [&](double x) {
        ++result.evaluations;
        return original(x);
    };
    const auto place = [&](std::size_t i) {
        return i + 1 == points ? high : low + (high - low) * static_cast<double>(i) / static_cast<double>(points - 1);
    };
    std::vector<double> values;
    for (std::size_t i = 0; i < points; ++i) values.push_back(f(place(i)));
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    result.is_constant = !(*most - *least > 1e-13 * std::max(std::fabs(*most), std::fabs(*least)));

    std::vector<Optimum> found;
    for (std::size_t i = 0; i < points; ++i) {
        const bool rises = i == 0 || values[i] > values[i - 1], falls = i + 1 == points || values[i] >= values[i + 1];
        if (!rises || !falls) continue;
        Optimum one = largest_between(f, place(i == 0 ? 0 : i - 1), place(std::min(i + 1, points - 1)));
        const bool is_end = i == 0 || i + 1 == points;
        if (is_end && values[i] >= one.value) one = {place(i), values[i], i == 0 ? Optimum::Place::at_low : Optimum::Place::at_high};
        else if (values[i] > one.value) one = {place(i), values[i], Optimum::Place::inside};
        found.push_back(one);
    }
    const auto best = std::max_element(found.begin(), found.end(), [](const Optimum& a, const Optimum& b) { return a.value < b.value; });
    result.best = *best;
    found.erase(best);
    result.others = std::move(found);
    result.resolution = std::ldexp(1.0, 2 - search_bits) * (high - low) / static_cast<double>(points - 1);

    const double x = result.best.at;
    const double h = std::min({(high - low) / 100, x - low, high - x});
    if (result.best.place != Optimum::Place::inside || !(h > 0)) return result;
    result.curvature = (f(x - h) - 2 * result.best.value + f(x + h)) / (h * h);
    refine(f, low, high, result);
    return result;
}

}  // namespace dalembert
