// SPDX-License-Identifier: GPL-3.0-or-later
#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "dalembert/ldlt.hpp"

namespace {

/// Solves with a matrix whose smallest eigenvalue is about `smallest`; the backward error is what a stable method must keep small.
template <std::size_t n>
void check_backward_error(double smallest) {
    using Matrix = Eigen::Matrix<double, n, n>;
    using Vector = Eigen::Matrix<double, n, 1>;
    std::srand(5);
    for (int repetition = 0; repetition < 50; ++repetition) {
        const Matrix R = Matrix::Random();
        const Matrix M = R * R.transpose() + smallest * Matrix::Identity();
        const Vector b = Vector::Random();
        std::array<double, n * (n + 1) / 2> m;
        for (Eigen::Index i = 0, k = 0; i < M.rows(); ++i)
            for (Eigen::Index j = 0; j <= i; ++j) m[static_cast<std::size_t>(k++)] = M(i, j);
        Vector x = b;
        dalembert::detail::ldlt_factor<double, n>(m);
        dalembert::detail::ldlt_solve<double, n>(m, x.data());
        CHECK((M * x - b).norm() <= 1e-14 * static_cast<double>(n) * (M.norm() * x.norm() + b.norm()));
        const Vector reference = M.llt().solve(b);
        if (smallest > 0.1) CHECK((x - reference).norm() <= 1e-12 * reference.norm());
    }
}

}  // namespace

TEST_CASE("columns side by side are solved as one by one") {
    constexpr std::size_t n = 7, count = 19;
    std::array<double, n * (n + 1) / 2> m{};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) m[i * (i + 1) / 2 + j] = i == j ? 3.0 : 1.0 / static_cast<double>(1 + i + j);
    dalembert::detail::ldlt_factor<double, n>(m);
    std::array<double, count*(n + 2)> values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i * i));
    std::array<std::size_t, count> starts;
    for (std::size_t c = 0; c < count; ++c) starts[c] = (count - 1 - c) * (n + 2) + 1;
    auto one_by_one = values;
    for (const std::size_t start : starts) dalembert::detail::ldlt_solve<double, n>(m, one_by_one.data() + start);
    dalembert::detail::ldlt_solve_columns<double, n>(m, values.data(), starts);
    for (std::size_t i = 0; i < values.size(); ++i) CHECK(values[i] == doctest::Approx(one_by_one[i]).epsilon(1e-14));
}

TEST_CASE("L D L' solves what Eigen solves") {
    check_backward_error<1>(1);
    check_backward_error<2>(1);
    check_backward_error<7>(1);
    check_backward_error<12>(1);
    check_backward_error<13>(1);
    check_backward_error<20>(1);
}

TEST_CASE("L D L' is backward stable for nearly singular mass matrices") {
    check_backward_error<2>(1e-12);
    check_backward_error<7>(1e-12);
    check_backward_error<20>(1e-12);
}

TEST_CASE("a singular matrix gives no number that looks good") {
    std::array<double, 3> m{1, 1, 1};
    std::array<double, 2> b{1, 2};
    dalembert::detail::ldlt_factor<double, 2>(m);
    dalembert::detail::ldlt_solve<double, 2>(m, b.data());
    CHECK_FALSE(std::isfinite(b[0]));
}
