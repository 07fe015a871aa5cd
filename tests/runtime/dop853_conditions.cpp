// SPDX-License-Identifier: GPL-3.0-or-later
// The coefficients of dop853 in 100 digits against the conditions that make its order: Butcher's theory, Hairer, Norsett, Wanner: Solving
// Ordinary Differential Equations I, section II.2. What the decimals leave over is measured.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <string>
#include <vector>

#include "dalembert/methods/dop853_coefficients.hpp"

namespace {

using Digits = boost::multiprecision::cpp_bin_float_100;
using Table = dalembert::detail::Dop853Coefficients;
using Weights = std::array<Digits, Table::stages>;

/// A row of the table with its zeros.
Weights row(std::size_t number) {
    static const dalembert::detail::Dop853Table<Digits> table;
    Weights result{};
    for (std::size_t i = 0; i < Table::count; ++i)
        if (Table::entries[i].row == number) result[Table::entries[i].stage - 1] = table.factors[i];
    return result;
}

Digits time(std::size_t stage) { return dalembert::detail::from_decimal<Digits>(Table::time[stage - 1]); }

Digits dot(const Weights& a, const Weights& b) {
    Digits sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// A rooted tree: its vertices, gamma (equation (2.17) of II.2), and the sums over the stages that stand beside the weights of the root.
struct Tree {
    int order = 1;
    Digits density = 1;
    Weights sums{};
};

/// All trees by their order, the first of them at [1]: a root and a multiset of smaller trees.
std::vector<std::vector<Tree>> trees(int order) {
    std::array<Weights, Table::stages> A;
    for (std::size_t i = 0; i < A.size(); ++i) A[i] = row(i + 1);
    Tree root;
    root.sums.fill(1);
    std::vector<std::vector<Tree>> all(static_cast<std::size_t>(order) + 1);
    std::vector<Tree> branches;  // in order; the density of a tree without the factor of its own order
    std::vector<Tree> open{root};
    const auto add = [&](const Tree& tree) {
        Tree closed = tree;
        closed.density *= closed.order;
        all[static_cast<std::size_t>(closed.order)].push_back(closed);
    };
    add(root);
    // A branch on all trees that are open so far, as often as there is room: each multiset is made once.
    for (int size = 1; size < order; ++size)
        for (std::size_t k = 0; k < all[static_cast<std::size_t>(size)].size(); ++k) {
            const Tree branch = all[static_cast<std::size_t>(size)][k];
            Weights through;
            for (std::size_t i = 0; i < A.size(); ++i) through[i] = dot(A[i], branch.sums);
            for (std::size_t j = 0; j < open.size(); ++j) {
                Tree tree = open[j];
                if (tree.order + size > order) continue;
                tree.order += size;
                tree.density *= branch.density;
                for (std::size_t i = 0; i < A.size(); ++i) tree.sums[i] *= through[i];
                open.push_back(tree);
                add(tree);
            }
        }
    return all;
}

const std::vector<std::vector<Tree>>& all_trees() {
    static const auto all = trees(9);
    return all;
}

/// Largest deviation over the trees of one order, at the part s of the step.
double deviation(const Weights& weights, std::size_t order, const Digits& s = 1) {
    Digits largest = 0;
    for (const Tree& tree : all_trees()[order]) largest = std::max(largest, Digits(abs(dot(weights, tree.sums) - pow(s, static_cast<int>(order)) / tree.density)));
    return static_cast<double>(largest);
}

/// What the dense output makes of the stages at s: HNW (6.28), resolved for the derivatives.
Weights dense(const Digits& s) {
    const Digits r = 1 - s;
    const Weights result = row(Table::result);
    Weights weights{};
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const Digits begin = (i == 0 ? 1 : 0) - result[i];
        const Digits end = result[i] - (i == 12 ? 1 : 0) - begin;
        const Digits higher = row(Table::dense)[i] + s * (row(Table::dense + 1)[i] + r * (row(Table::dense + 2)[i] + s * row(Table::dense + 3)[i]));
        weights[i] = s * (result[i] + r * (begin + s * (end + r * higher)));
    }
    return weights;
}

}  // namespace

TEST_CASE("there are as many trees as there must be") {
    const std::array<std::size_t, 9> count{1, 1, 2, 4, 9, 20, 48, 115, 286};
    for (std::size_t order = 1; order <= 9; ++order) CHECK(all_trees()[order].size() == count[order - 1]);
}

TEST_CASE("the weights of a stage add up to its time") {
    for (std::size_t stage = 1; stage <= Table::stages; ++stage) {
        Digits sum = 0;
        for (const Digits& weight : row(stage)) sum += weight;
        CAPTURE(stage);
        CHECK(static_cast<double>(abs(sum - time(stage))) < 1e-57);
    }
}

TEST_CASE("powers of time are integrated to the order of the method, and no further") {
    const auto quadrature = [](std::size_t number, int power) {
        Digits sum = 0;
        for (std::size_t i = 0; i < Table::stages; ++i) sum += row(number)[i] * pow(time(i + 1), power);
        return static_cast<double>(abs(sum - Digits(1) / (power + 1)));
    };
    for (int power = 0; power < 8; ++power) CHECK(quadrature(Table::result, power) < 1e-57);
    CHECK(quadrature(Table::result, 8) > 1e-9);
    for (int power = 0; power < 3; ++power) CHECK(quadrature(Table::third, power) < 1e-57);
    CHECK(quadrature(Table::third, 3) > 1e-3);
}

TEST_CASE("all conditions of order 8 of the step, of orders 5 and 3 of the estimates, and of order 7 of the dense output") {
    double step = 0, estimate = 0, output = 0;
    for (std::size_t order = 1; order <= 8; ++order) step = std::max(step, deviation(row(Table::result), order));
    Weights fifth = row(Table::result);
    for (std::size_t i = 0; i < fifth.size(); ++i) fifth[i] -= row(Table::fifth)[i];
    for (std::size_t order = 1; order <= 5; ++order) estimate = std::max(estimate, deviation(fifth, order));
    for (std::size_t order = 1; order <= 3; ++order) estimate = std::max(estimate, deviation(row(Table::third), order));
    for (int k = 1; k <= 9; ++k)
        for (std::size_t order = 1; order <= 7; ++order) output = std::max(output, deviation(dense(Digits(k) / 10), order, Digits(k) / 10));
    MESSAGE("left over: step ", step, ", estimates ", estimate, ", dense output ", output);
    CHECK(step < 1e-57);
    CHECK(estimate < 1e-57);
    CHECK(output < 1e-56);
    // And no more than that.
    CHECK(deviation(row(Table::result), 9) > 1e-8);
    CHECK(deviation(fifth, 6) > 1e-6);
    CHECK(deviation(row(Table::third), 4) > 1e-4);
    CHECK(deviation(dense(Digits(3) / 10), 8, Digits(3) / 10) > 1e-8);
}

TEST_CASE("decimals are read to the last digit") {
    using dalembert::detail::from_decimal;
    CHECK(from_decimal<double>("-0.37454675472269020279518312152e+03") == -0.37454675472269020279518312152e+03);
    CHECK(from_decimal<float>("8.27378916381402288758473766002e-3") == 8.27378916381402288758473766002e-3f);
    CHECK(from_decimal<double>("0.25") == 0.25);
    for (const auto& entry : Table::entries) {
        const Digits exact(entry.digits);
        CAPTURE(std::string(entry.digits));
        CHECK(from_decimal<double>(entry.digits) == static_cast<double>(exact));
        CHECK(from_decimal<float>(entry.digits) == static_cast<float>(exact));
        CHECK(static_cast<double>(abs(Digits(from_decimal<long double>(entry.digits)) / exact - 1)) < 2 * static_cast<double>(std::numeric_limits<long double>::epsilon()));
    }
}
