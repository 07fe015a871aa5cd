// SPDX-License-Identifier: BSL-1.0
// Derivatives from central differences with steps that are halved (Ridders: Accurate computation of F'(x) and F'(x)F''(x), Advances in
// Engineering Software 4, 1982).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dalembert {
inline namespace v1 {
namespace detail {

/// A derivative and an estimate of its error, which is infinite where differences tell nothing.
template <class Scalar>
struct Extrapolated {
    Scalar value = std::numeric_limits<Scalar>::quiet_NaN(), doubt = std::numeric_limits<Scalar>::infinity();
};

/// `differences` begin with the longest step, and each step is half of the one before. What is not finite is passed over.
template <class Scalar, std::size_t levels>
Extrapolated<Scalar> extrapolated(const std::array<Scalar, levels>& differences) {
    using std::abs;
    using std::isfinite;
    std::array<Extrapolated<Scalar>, levels*(levels - 1) / 2> found;
    std::array<Scalar, levels> above{}, row{};
    std::size_t count = 0, length = 0;
    for (const Scalar& difference : differences) {
        row[0] = difference;
        Scalar power(1);
        for (std::size_t j = 0; j < length; ++j) {
            power *= Scalar(4);  // errors go with even powers of the step
            row[j + 1] = (power * row[j] - above[j]) / (power - Scalar(1));
            const Scalar doubt = std::max(Scalar(abs(row[j + 1] - row[j])), Scalar(abs(row[j + 1] - above[j])));
            if (isfinite(doubt)) found[count++] = {row[j + 1], doubt};
        }
        length = isfinite(difference) ? length + 1 : 0;
        above = row;
    }
    // Two may agree by chance; four hardly do.
    constexpr std::size_t agreeing = 4;
    if (count < agreeing) return {};
    std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count),
              [](const auto& a, const auto& b) { return a.doubt < b.doubt; });
    Extrapolated<Scalar> best = found.front();
    for (std::size_t k = 1; k < agreeing; ++k) best.doubt = std::max(best.doubt, Scalar(abs(found[k].value - best.value)));
    return best;
}

/// How many steps differences are made with, and the part of its size by which what is varied is moved in the longest of them.
inline constexpr std::size_t steps_of_extrapolation = 7;
inline constexpr double longest_step_of_extrapolation = 1.0 / 64;

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
