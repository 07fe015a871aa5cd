// SPDX-License-Identifier: BSL-1.0
// Pressures of junctions, where flows meet and nothing is stored, of a fixed number of orifices, without heap. The generator copies what stands
// between the marks into headers that need it; "needs" names the sections that have to stand before.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dalembert/fluid_functions.hpp"
#include "dalembert/heat_networks.hpp"  // is_certain

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin junction_root: select, signed_root, is_certain
/// b - G*p + sum of r_k*signed_root(P_k - p), what flows into a junction whose pressure p is reference + difference.
template <class Scalar, std::size_t n>
Scalar junction_surplus(const std::array<Scalar, 2 * n + 2>& data, const Scalar& reference, const Scalar& difference) noexcept {
    Scalar sum = (data[1] - data[0] * reference) - data[0] * difference;
    for (std::size_t k = 0; k < n; ++k) sum += data[2 * k + 3] * signed_root<Scalar>(Scalar((data[2 * k + 2] - reference) - difference));
    return sum;
}

/// The roots s_k = signed_root(P_k - p) at the pressure p of a junction into which flow b - G*p and r_k*s_k, in sum nothing; `data` is G, b, P_1,
/// r_1, P_2, r_2 and so on, G and all r not negative. The sum falls with p, and bends like a root at each P_k: with w^2 for the distance from the
/// nearer of the two P_k around p it is smooth, so that Newton's steps converge, and s_k there is w itself with all its digits, down to zero. A step that
/// leaves the bracket, or is more than half of the one before the last, halves it instead. Where all orifices are shut only b - G*p is left. Needs
/// select, signed_root, is_certain.
template <class Scalar, std::size_t n>
std::array<Scalar, n> junction_root(const std::array<Scalar, 2 * n + 2>& data) noexcept {
    using std::abs;
    using std::sqrt;
    const Scalar infinity = Scalar(std::numeric_limits<double>::infinity());
    const Scalar zero = Scalar(0);
    Scalar below = -infinity, above = infinity;
    for (std::size_t k = 0; k < n; ++k) {
        const Scalar P = data[2 * k + 2];
        const Scalar surplus = junction_surplus<Scalar, n>(data, P, zero);
        const auto is_open = data[2 * k + 3] > zero;
        const Scalar lower = select(is_open, select(surplus >= zero, P, Scalar(-infinity)), Scalar(-infinity));
        const Scalar upper = select(is_open, select(surplus < zero, P, infinity), infinity);
        below = select(lower > below, lower, below);
        above = select(upper < above, upper, above);
    }
    const auto has_below = below > -infinity;
    const auto has_above = above < infinity;
    const Scalar half = select(has_below, select(has_above, Scalar((above - below) / Scalar(2)), infinity), infinity);
    const Scalar first = data[2];
    const Scalar middle = junction_surplus<Scalar, n>(data, select(has_below, below, first), select(half < infinity, half, zero));
    // Upwards from `below` or downwards from `above`; where all is shut, from anywhere.
    const Scalar direction = select(has_below, select(has_above, select(middle > zero, Scalar(-1), Scalar(1)), Scalar(1)),
                                    select(has_above, Scalar(-1), select(middle < zero, Scalar(-1), Scalar(1))));
    const Scalar reference = select(direction > zero, select(has_below, below, first), select(has_above, above, first));
    const Scalar surplus = direction * junction_surplus<Scalar, n>(data, reference, zero);
    Scalar own = zero;
    for (std::size_t k = 0; k < n; ++k) own += select(data[2 * k + 2] == reference, data[2 * k + 3], zero);
    Scalar high = select(own > zero, Scalar(surplus / own), sqrt(Scalar(surplus / data[0])));
    high = select(half < high * high, sqrt(half), high);
    Scalar low = zero;
    Scalar w = high;
    const Scalar enough = sqrt(std::numeric_limits<Scalar>::is_specialized ? std::numeric_limits<Scalar>::epsilon() : Scalar(std::numeric_limits<double>::epsilon()));
    constexpr int most_steps = 128;
    Scalar last = high, before_last = high;
    for (int step = 0; step < most_steps; ++step) {
        const Scalar sum = direction * junction_surplus<Scalar, n>(data, reference, Scalar(direction * w * w));
        Scalar slope = Scalar(2) * data[0] * w;
        for (std::size_t k = 0; k < n; ++k) {
            const Scalar root = sqrt(abs(Scalar((data[2 * k + 2] - reference) - direction * w * w)));
            slope += data[2 * k + 3] * select(root > zero, Scalar(w / select(root > zero, root, Scalar(1))), Scalar(1));
        }
        low = select(sum >= zero, w, low);
        high = select(sum <= zero, w, high);
        const Scalar change = sum / select(slope > zero, slope, Scalar(1));
        const Scalar newton = w + change;
        const Scalar halved = (low + high) / Scalar(2);
        const Scalar inside = select(newton < low, halved, select(newton > high, halved, newton));
        const auto is_close = abs(change) <= enough * w;
        const Scalar next = select(is_close, inside, select(abs(change) * Scalar(2) > before_last, halved, inside));
        before_last = last;
        last = abs(Scalar(next - w));
        w = next;
        if (is_certain(is_close, 0)) break;
    }
    std::array<Scalar, n> roots{};
    for (std::size_t k = 0; k < n; ++k) roots[k] = signed_root<Scalar>(Scalar((data[2 * k + 2] - reference) - direction * w * w));
    return roots;
}
// end junction_root

}  // namespace detail

using detail::junction_root;

}  // namespace v1
}  // namespace dalembert
