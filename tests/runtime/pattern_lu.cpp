// SPDX-License-Identifier: GPL-3.0-or-later
// Straight-line factors on a pattern against dense ones with row exchanges.
#include <doctest/doctest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "dalembert/linear/jacobian_pattern.hpp"

namespace {

using namespace dalembert::detail;

/// Between -1 and 1, the same in every run.
struct Numbers {
    std::uint64_t state = 12345;
    double operator()() {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state >> 11) / 4503599627370496.0 - 1;
    }
};

template <std::size_t n>
struct Chain {
    static constexpr bool is_sparse = false;
    static constexpr std::array<unsigned, n> make() {
        std::array<unsigned, n> bits{};
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < n; ++i)
                if (i + 1 >= j && i <= j + 1) bits[j] |= 1U << i;
        return bits;
    }
    static constexpr std::array<unsigned, n> nonzero = make();
};

/// A full first row and column.
template <std::size_t n>
struct Arrow {
    static constexpr bool is_sparse = false;
    static constexpr std::array<unsigned, n> make() {
        std::array<unsigned, n> bits{};
        for (std::size_t j = 0; j < n; ++j) bits[j] = j == 0 ? (1U << n) - 1 : 1U | 1U << j;
        return bits;
    }
    static constexpr std::array<unsigned, n> nonzero = make();
};

/// Positions above, full accelerations below: dx/dt = v.
struct Machine {
    static constexpr bool is_sparse = false;
    static constexpr std::array<unsigned, 6> nonzero{0x38, 0x38, 0x38, 0x39, 0x3a, 0x3c};
};
struct Full {
    static constexpr bool is_sparse = false;
};
struct Columns {
    static constexpr bool is_sparse = true;
    static constexpr std::array<std::size_t, 6> column_starts{0, 2, 3, 3, 5, 6};
    static constexpr std::array<std::size_t, 6> row_indices{1, 4, 3, 0, 2, 1};
};

/// Both solve A x = b, and to the same digits.
template <class Scalar, class Pattern, std::size_t n>
void compare(Numbers& numbers, double diagonal, double accuracy) {
    PatternLu<Scalar, Pattern, n> straight;
    DenseLu<Scalar, n> dense;
    dense.clear();
    straight.clear();
    std::array<Scalar, n> x{}, y{};
    constexpr auto places = places_of<Pattern, n>();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            if (!places.at[i][j]) continue;
            const Scalar value = Scalar(numbers()) + (i == j ? Scalar(diagonal) : Scalar(0));
            straight.add(i, j, value);
            dense.add(i, j, value);
        }
    for (Scalar& value : x) value = Scalar(numbers());
    y = x;
    REQUIRE(straight.factor());
    REQUIRE(dense.factor());
    straight.solve(x);
    dense.solve(y);
    Scalar size = 0;
    for (const Scalar& value : y) size = std::max<Scalar>(size, abs(value));
    for (std::size_t i = 0; i < n; ++i) CHECK(abs(x[i] - y[i]) <= Scalar(accuracy) * size);
}

}  // namespace

TEST_CASE("a chain and an arrow fill nothing") {
    using Long = EliminationPlan<Chain<12>, 12>;
    static_assert(Long::entries == 34 && Long::updates == 11);
    using Star = EliminationPlan<Arrow<8>, 8>;
    static_assert(Star::entries == 22 && Star::updates == 7);
    static_assert(EliminationPlan<Full, 4>::updates == 9 + 4 + 1);
    // From both ends: the second unknown that is eliminated is not the neighbour of the first.
    CHECK(Star::elimination.order[0] != 0);
    CHECK(Long::elimination.order[0] == 0);
    CHECK(Long::elimination.order[1] == 11);
}

TEST_CASE("straight-line factors solve as dense ones do, in every arithmetic") {
    Numbers numbers;
    for (int repetition = 0; repetition < 50; ++repetition) {
        for (const double diagonal : {4.0, 40.0, 1e6}) {
            compare<double, Chain<12>, 12>(numbers, diagonal, 1e-13);
            compare<double, Arrow<8>, 8>(numbers, 3 * diagonal, 1e-13);
            compare<double, Machine, 6>(numbers, diagonal, 1e-13);
            compare<double, Full, 5>(numbers, 2 * diagonal, 1e-13);
            compare<double, Columns, 5>(numbers, diagonal, 1e-13);
            compare<float, Chain<12>, 12>(numbers, diagonal, 1e-5);
            compare<long double, Machine, 6>(numbers, diagonal, 1e-16);
        }
    }
    compare<boost::multiprecision::cpp_bin_float_50, Columns, 5>(numbers, 4, 1e-46);
}

TEST_CASE("without a large diagonal too, if need be by row exchanges") {
    Numbers numbers;
    for (int repetition = 0; repetition < 200; ++repetition) {
        compare<double, Machine, 6>(numbers, 0, 1e-5);
        compare<double, Full, 5>(numbers, 0, 1e-5);
    }
}

TEST_CASE("a pivot that vanishes, at the start or by cancellation, is exchanged") {
    for (const double pivot : {0.0, 1.0, 1.0 + 1e-15}) {
        PatternLu<double, Full, 3> lu;
        // With the pivot 1 what is left of the second one is zero, or a last digit: 1 - pivot.
        const double columns[3][3] = {{pivot, 1, 2}, {1, 1, 1}, {0, 3, 1}};
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t i = 0; i < 3; ++i) lu.add(i, j, columns[j][i]);
        REQUIRE(lu.factor());
        std::array<double, 3> b{};
        for (std::size_t i = 0; i < 3; ++i) b[i] = columns[0][i] + 2 * columns[1][i] - columns[2][i];
        lu.solve(b);
        CHECK(b[0] == doctest::Approx(1).epsilon(1e-14));
        CHECK(b[1] == doctest::Approx(2).epsilon(1e-14));
        CHECK(b[2] == doctest::Approx(-1).epsilon(1e-14));
    }
}

TEST_CASE("an entry outside the pattern counts") {
    PatternLu<double, Chain<5>, 5> lu;
    for (int repetition = 0; repetition < 2; ++repetition) {
        lu.clear();
        for (std::size_t i = 0; i < 5; ++i) lu.add(i, i, 2);
        lu.add(0, 1, 1);
        if (repetition == 0) lu.add(4, 0, 3);
        lu.add(2, 1, 1);
        REQUIRE(lu.factor());
        std::array<double, 5> b{2 + 1, 2, 2 + 1, 2, 2.0 + (repetition == 0 ? 3 : 0)};
        lu.solve(b);
        for (const double value : b) CHECK(value == doctest::Approx(1).epsilon(1e-15));
    }
}

TEST_CASE("what is singular or no number is refused by straight-line factors") {
    const auto refuses = [](std::vector<double> columns) {
        PatternLu<double, Full, 2> lu;
        for (std::size_t i = 0; i < 4; ++i) lu.add(i % 2, i / 2, columns[i]);
        return !lu.factor();
    };
    CHECK_FALSE(refuses({1, 0, 0, 1}));
    CHECK_FALSE(refuses({0, 1, 1, 0}));
    CHECK(refuses({0, 0, 0, 0}));
    CHECK(refuses({1, 2, 2, 4}));
    CHECK(refuses({NAN, 0, 0, 1}));
    CHECK(refuses({1, NAN, 1, 1}));
    CHECK(refuses({1, 0, 0, INFINITY}));
    CHECK(refuses({1, 0, 0, std::numeric_limits<double>::denorm_min()}));
}
