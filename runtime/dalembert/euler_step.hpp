// SPDX-License-Identifier: BSL-1.0
// The largest step for which the explicit Euler method is stable, from the eigenvalues of df/dx at a point. Of the heat equation on a
// uniform grid without side and ends it is the bound (4.99), dx^2/(2a); with convection it is smaller.
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <vector>

#include "dalembert/linear/jacobian_pattern.hpp"
#include "dalembert/matrices.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// A matrix with three diagonals and products of neighbours across the diagonal that are not negative: its eigenvalues are real.
struct ThreeDiagonals {
    std::vector<double> diagonal, products;
    bool are_real = true;

    /// How many eigenvalues are below a number (Sturm's sequence).
    std::size_t count_below(double number) const {
        std::size_t count = 0;
        double pivot = 1;
        for (std::size_t i = 0; i < diagonal.size(); ++i) {
            pivot = diagonal[i] - number - (i > 0 ? products[i - 1] / pivot : 0.0);
            if (pivot == 0) pivot = std::numeric_limits<double>::min();
            if (pivot < 0) ++count;
        }
        return count;
    }

    /// The k-th smallest eigenvalue, by bisection to rounding.
    double eigenvalue(std::size_t k) const {
        double low = 0, high = 0;
        for (std::size_t i = 0; i < diagonal.size(); ++i) {
            const double radius = (i > 0 ? std::sqrt(products[i - 1]) : 0) + (i + 1 < diagonal.size() ? std::sqrt(products[i]) : 0);
            low = std::min(low, diagonal[i] - radius);
            high = std::max(high, diagonal[i] + radius);
        }
        for (int step = 0; step < 200 && low < high; ++step) {
            const double middle = low + (high - low) / 2;
            if (middle == low || middle == high) break;
            (count_below(middle) > k ? high : low) = middle;
        }
        return low + (high - low) / 2;
    }
};

template <class System>
ThreeDiagonals three_diagonals(const typename System::JacobianX& J, std::size_t n) {
    ThreeDiagonals result{std::vector<double>(n, 0), std::vector<double>(n > 0 ? n - 1 : 0, 0), true};
    std::vector<double> above = result.products, below = result.products;
    for (std::size_t column = 0; column < n; ++column)
        for_each_in_column<typename System::PatternX>(J, n, column, [&](std::size_t row, const auto& value) {
            (row == column ? result.diagonal[row] : row < column ? above[row] : below[column]) = static_cast<double>(value);
        });
    for (std::size_t i = 0; i + 1 < n; ++i) {
        result.products[i] = above[i] * below[i];
        result.are_real = result.are_real && result.products[i] >= 0;
    }
    return result;
}

/// |1 + h*(a + ib)| <= 1 up to this h; infinite for an eigenvalue zero, zero for a motion that grows or oscillates undamped.
inline double euler_step(double real, double imaginary, double negligible) {
    const double square = real * real + imaginary * imaginary;
    if (square <= negligible * negligible) return std::numeric_limits<double>::infinity();
    return real < 0 ? -2 * real / square : 0;
}

}  // namespace detail

/// In seconds; NaN where the Jacobian is not finite, or is neither small nor three diagonals wide.
template <class System>
double largest_euler_step(const System& system, const typename System::State& x, const typename System::Input& u,
                          typename System::scalar_type t) {
    const std::size_t n = x.size();
    constexpr std::size_t largest_dense = 300;
    const detail::Bandwidth band = detail::bandwidth<typename System::PatternX>(n);
    const double epsilon = std::numeric_limits<double>::epsilon() * static_cast<double>(n);
    if (n > 0 && band.lower <= 1 && band.upper <= 1) {
        typename System::JacobianX J;
        system.jacobian_x(x, u, t, J);
        const detail::ThreeDiagonals matrix = detail::three_diagonals<System>(J, n);
        if (matrix.are_real) {
            const double least = matrix.eigenvalue(0);
            const double greatest = matrix.eigenvalue(n - 1);
            const double size = std::max(std::fabs(least), std::fabs(greatest));
            return std::min(detail::euler_step(least, 0, epsilon * size), detail::euler_step(greatest, 0, epsilon * size));
        }
    }
    if (n <= largest_dense) {
        const Eigen::MatrixXd A = jacobian_x(system, x, u, t).template cast<double>();
        if (!A.allFinite()) return std::numeric_limits<double>::quiet_NaN();
        const auto values = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues().eval();
        const double size = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0;
        double step = std::numeric_limits<double>::infinity();
        for (Eigen::Index i = 0; i < values.size(); ++i)
            step = std::min(step, detail::euler_step(values[i].real(), values[i].imag(), epsilon * size));
        return step;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace v1
}  // namespace dalembert
