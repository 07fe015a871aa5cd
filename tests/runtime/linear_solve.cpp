// SPDX-License-Identifier: GPL-3.0-or-later
// LU factors, dense and banded: against Eigen, against each other, and what they must refuse.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "dalembert/linear/run_matrix.hpp"

using dalembert::detail::BandLu;
using dalembert::detail::bandwidth;
using dalembert::detail::DenseLu;
using dalembert::detail::PatternLu;
using dalembert::detail::SquareMatrix;

namespace {

/// Numbers between -1 and 1, the same in every run.
class Numbers {
public:
    double operator()() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1;
    }

private:
    std::uint64_t state_ = 5;
};

/// The residual of A x = b, relative to the sizes of A, x and b.
template <class Scalar, std::size_t n, class Lu>
double backward_error(const std::array<Scalar, n * n>& A, Lu lu, const std::array<Scalar, n>& b) {
    using std::abs;
    for (std::size_t c = 0; c < n; ++c)
        for (std::size_t r = 0; r < n; ++r)
            if (A[c * n + r] != Scalar(0)) lu.add(r, c, A[c * n + r]);
    REQUIRE(lu.factor());
    std::array<Scalar, n> x = b;
    lu.solve(x);
    double largest = 0, size = 0;
    for (std::size_t r = 0; r < n; ++r) {
        Scalar residual = -b[r];
        for (std::size_t c = 0; c < n; ++c) {
            residual += A[c * n + r] * x[c];
            size = std::max(size, static_cast<double>(abs(A[c * n + r] * x[c])));
        }
        largest = std::max(largest, static_cast<double>(abs(residual)));
    }
    return largest / size;
}

template <class Scalar, std::size_t n>
void check_dense(Numbers& numbers) {
    std::array<Scalar, n * n> A;
    std::array<Scalar, n> b;
    for (Scalar& entry : A) entry = Scalar(numbers());
    for (Scalar& entry : b) entry = Scalar(numbers());
    const double rounding = static_cast<double>(n) * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
    CHECK(backward_error<Scalar, n>(A, DenseLu<Scalar, n>(), b) < 20 * rounding);
}

/// A band of numbers; where it is not triangular, its diagonal is too small to go without exchanges.
template <std::size_t n, std::size_t lower, std::size_t upper>
void check_band(Numbers& numbers) {
    CAPTURE(n);
    CAPTURE(lower);
    CAPTURE(upper);
    for (int repetition = 0; repetition < 20; ++repetition) {
        std::array<double, n * n> A{};
        std::array<double, n> b;
        BandLu<double, n, lower, upper> band;
        DenseLu<double, n> dense;
        for (std::size_t c = 0; c < n; ++c)
            for (std::size_t r = 0; r < n; ++r) {
                if (!band.holds(r, c)) continue;
                A[c * n + r] = r == c && lower > 0 && upper > 0 ? 0.01 * numbers() : numbers() + (r == c ? 2 : 0);
                band.add(r, c, A[c * n + r]);
                dense.add(r, c, A[c * n + r]);
            }
        for (double& entry : b) entry = numbers();
        CHECK(backward_error<double, n>(A, BandLu<double, n, lower, upper>(), b) < 1e-12);
        const Eigen::MatrixXd matrix = Eigen::Map<const Eigen::MatrixXd>(A.data(), n, n);
        const double condition = matrix.norm() * matrix.inverse().norm();
        std::array<double, n> x = b, y = b;
        REQUIRE(band.factor());
        REQUIRE(dense.factor());
        band.solve(x);
        dense.solve(y);
        const Eigen::Map<const Eigen::VectorXd> of_band(x.data(), n), of_dense(y.data(), n);
        CHECK((of_band - of_dense).norm() <= 1e-13 * condition * of_dense.norm());
    }
}

struct Tridiagonal {
    static constexpr bool is_sparse = true;
    static constexpr std::array<std::size_t, 9> column_starts{0, 2, 5, 8, 11, 14, 17, 20, 22};
    static constexpr std::array<std::size_t, 22> row_indices{0, 1, 0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 5, 4, 5, 6, 5, 6, 7, 6, 7};
};
/// One entry below the diagonal, one far above it.
struct Corner {
    static constexpr bool is_sparse = true;
    static constexpr std::array<std::size_t, 9> column_starts{0, 1, 1, 1, 1, 1, 1, 1, 2};
    static constexpr std::array<std::size_t, 2> row_indices{1, 0};
};
struct Full {
    static constexpr bool is_sparse = false;
};

}  // namespace

TEST_CASE("dense factors solve, in every scalar type") {
    Numbers numbers;
    for (int repetition = 0; repetition < 20; ++repetition) {
        check_dense<double, 1>(numbers);
        check_dense<double, 2>(numbers);
        check_dense<double, 7>(numbers);
        check_dense<double, 30>(numbers);
        check_dense<float, 7>(numbers);
        check_dense<long double, 7>(numbers);
    }
    check_dense<boost::multiprecision::cpp_bin_float_50, 5>(numbers);
}

TEST_CASE("a pivot that is zero or small is exchanged") {
    DenseLu<double, 2> dense;
    BandLu<double, 2, 1, 1> band;
    for (const double pivot : {0.0, 1e-20}) {
        const auto check = [pivot](auto lu) {
            lu.add(0, 0, pivot);
            lu.add(1, 0, 1);
            lu.add(0, 1, 1);
            lu.add(1, 1, 1);
            REQUIRE(lu.factor());
            std::array<double, 2> b{1, 2};
            lu.solve(b);
            CHECK(b[0] == doctest::Approx(1).epsilon(1e-15));
            CHECK(b[1] == doctest::Approx(1).epsilon(1e-15));
        };
        check(dense);
        check(band);
    }
}

TEST_CASE("banded and dense factors solve the same") {
    Numbers numbers;
    check_band<12, 1, 1>(numbers);
    check_band<12, 2, 1>(numbers);
    check_band<12, 1, 3>(numbers);
    check_band<12, 0, 2>(numbers);
    check_band<12, 3, 0>(numbers);
    check_band<12, 0, 0>(numbers);
    check_band<12, 5, 2>(numbers);
    check_band<3, 2, 2>(numbers);  // a band as wide as the matrix
    check_band<1, 1, 1>(numbers);
    check_band<200, 4, 3>(numbers);
}

TEST_CASE("a matrix is cleared, and takes what is added at one place as a sum") {
    BandLu<double, 3, 1, 1> band;
    for (int repetition = 0; repetition < 2; ++repetition) {
        band.clear();
        for (std::size_t i = 0; i < 3; ++i) band.add(i, i, 1), band.add(i, i, 3);
        band.add(0, 2, 100);  // outside
        REQUIRE(band.factor());
        std::array<double, 3> b{4, 8, 12};
        band.solve(b);
        CHECK(b == std::array<double, 3>{1, 2, 3});
    }
}

TEST_CASE("what is singular or no number is refused") {
    const auto refuses = [](auto lu, std::array<double, 9> columns) {
        for (std::size_t i = 0; i < 9; ++i) lu.add(i % 3, i / 3, columns[i]);
        return !lu.factor();
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const double tiny = std::numeric_limits<double>::denorm_min();
    const auto both = [&](std::array<double, 9> columns) {
        return refuses(DenseLu<double, 3>(), columns) && refuses(BandLu<double, 3, 1, 1>(), columns);
    };
    CHECK_FALSE(both({1, 0, 0, 0, 1, 0, 0, 0, 1}));
    CHECK(both({0, 0, 0, 0, 0, 0, 0, 0, 0}));
    CHECK(both({1, 2, 0, 2, 4, 0, 0, 0, 1}));  // two columns in proportion
    CHECK(both({1, 0, 0, 0, 1, 0, 0, 0, 0}));
    CHECK(both({nan, 0, 0, 0, 1, 0, 0, 0, 1}));
    CHECK(both({1, nan, 0, 1, 1, 0, 0, 0, 1}));
    CHECK(both({1, 0, 0, 0, infinity, 0, 0, 0, 1}));
    CHECK(both({1, 0, 0, 0, -infinity, 0, 0, 0, 1}));
    CHECK(both({1, 0, 0, 0, 1, 0, 0, 0, tiny}));  // whose inverse is infinite
    CHECK(refuses(DenseLu<double, 3>(), {4, 2, 1, 8, 5, 2, 12, 7, 3}));  // the third column is the sum of the others
}

TEST_CASE("the band of a pattern, and the matrix that suits it") {
    static_assert(bandwidth<Tridiagonal>(8).lower == 1 && bandwidth<Tridiagonal>(8).upper == 1);
    static_assert(bandwidth<Corner>(8).lower == 1 && bandwidth<Corner>(8).upper == 7);
    static_assert(bandwidth<Full>(8).lower == 7 && bandwidth<Full>(0).lower == 0);
    static_assert(std::is_same_v<SquareMatrix<double, Tridiagonal, 8>::Looped, BandLu<double, 8, 1, 1>>);
    static_assert(std::is_same_v<SquareMatrix<double, Corner, 8>::Looped, DenseLu<double, 8>>);
    static_assert(std::is_same_v<SquareMatrix<double, Full, 8>::type, PatternLu<double, Full, 8>>);
    static_assert(std::is_same_v<SquareMatrix<double, Full, 20>::type, DenseLu<double, 20>>);  // too long without loops
    static_assert(SquareMatrix<double, Full, 512>::fits && !SquareMatrix<double, Full, 513>::fits);
    CHECK(bandwidth<Corner>(8).height() == 10);
}

namespace {

constexpr std::size_t side = 64, cells = side * side;

/// Of a cell of a square: those beside it, and itself.
template <class Take>
constexpr void for_each_neighbour(std::size_t cell, Take take) {
    if (cell >= side) take(cell - side);
    if (cell % side > 0) take(cell - 1);
    take(cell);
    if ((cell + 1) % side > 0) take(cell + 1);
    if (cell + side < cells) take(cell + side);
}

/// As a plant would have them.
struct Square {
    static constexpr std::size_t n = cells;
    static std::size_t of_run() { return n; }
    static constexpr bool is_sparse = true;
    static constexpr std::size_t entries = 5 * n - 4 * side;
    static constexpr auto column_starts = [] {
        std::array<std::size_t, n + 1> starts{};
        for (std::size_t c = 0; c < n; ++c) {
            starts[c + 1] = starts[c];
            for_each_neighbour(c, [&](std::size_t) { ++starts[c + 1]; });
        }
        return starts;
    }();
    static constexpr auto row_indices = [] {
        std::array<std::size_t, entries> rows{};
        std::size_t next = 0;
        for (std::size_t c = 0; c < n; ++c) for_each_neighbour(c, [&](std::size_t row) { rows[next++] = row; });
        return rows;
    }();
};

}  // namespace

TEST_CASE("large patterns with few entries are eliminated as such, and the same matrices are refused") {
    using dalembert::detail::is_worth_sparse;
    using Vector = dalembert::detail::RunArray<Square, double>;
    CHECK(is_worth_sparse<Square>(Square::n));
    CHECK(!is_worth_sparse<Tridiagonal>(8));
    CHECK(dalembert::detail::MatrixOf<Vector, Square>::fits());
    Numbers number;
    dalembert::detail::RunMatrix<Vector, Square> matrix;
    for (const bool has_corner : {false, true, false}) {  // an entry outside of the pattern, which comes and goes
        Vector x, b;
        for (double& entry : x) entry = number();
        matrix.clear();
        const auto add = [&](std::size_t row, std::size_t column, double value) {
            matrix.add(row, column, value);
            b[row] += value * x[column];
        };
        for (std::size_t c = 0; c < Square::n; ++c)
            for_each_neighbour(c, [&](std::size_t row) { add(row, c, row == c ? 5 + number() : number()); });
        if (has_corner) add(0, Square::n - 1, 2);
        REQUIRE(matrix.factor());
        matrix.solve(b);
        double apart = 0;
        for (std::size_t i = 0; i < x.size(); ++i) apart = std::max(apart, std::fabs(b[i] - x[i]));
        CHECK(apart < 1e-13);
    }
    for (const double entry : {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        matrix.clear();
        for (std::size_t c = 0; c < Square::n; ++c) matrix.add(c, c, c == 7 ? entry : 1);
        CHECK(!matrix.factor());
    }
}
