// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/factorisation.hpp"

#include <algorithm>
#include <optional>
#include <set>

namespace dalembert {

namespace {

constexpr std::size_t always_unrolled = 7;  ///< found by timing chains and arms
constexpr std::size_t most_entries_per_row = 3;

/// a - sum of b_k*c_k, products with zero left out.
NodeId minus_products(Program& program, NodeId a, const std::vector<std::pair<NodeId, NodeId>>& products) {
    std::vector<std::pair<bool, NodeId>> terms{{false, a}};
    for (const auto& [b, c] : products)
        if (!program.is_constant(b, 0) && !program.is_constant(c, 0)) terms.emplace_back(true, program.product({b, c}));
    return terms.size() == 1 ? a : program.sum(std::move(terms));
}

}  // namespace

bool should_unroll(std::size_t n, const std::vector<bool>& is_zero) {
    if (n <= always_unrolled) return true;
    // Fill-in of L: an entry is there when M has it or two earlier ones in its row and column meet.
    std::vector<bool> filled(is_zero.size());
    std::size_t entries = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            bool there = !is_zero[lower_index(i, j)];
            for (std::size_t k = 0; k < j && !there; ++k) there = filled[lower_index(i, k)] && filled[lower_index(j, k)];
            filled[lower_index(i, j)] = there;
            entries += there ? 1 : 0;
        }
    return entries <= most_entries_per_row * n && n <= 32;
}

std::vector<NodeId> factorise(Program& program, std::size_t n, std::size_t multipliers, const std::vector<NodeId>& mass,
                              const Reciprocal& reciprocal, const std::vector<NodeId>& chosen, std::vector<NodeId>* scaled) {
    std::vector<NodeId> factors(mass.size(), program.constant(0));
    if (scaled != nullptr) *scaled = factors;
    std::vector<NodeId> v(n, program.constant(0));  // L_ij*D_j of the current row
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            std::vector<std::pair<NodeId, NodeId>> products;
            for (std::size_t k = 0; k < j; ++k) products.emplace_back(v[k], factors[lower_index(j, k)]);
            v[j] = minus_products(program, mass[lower_index(i, j)], products);
            if (scaled != nullptr) (*scaled)[lower_index(i, j)] = v[j];
        }
        std::vector<std::pair<NodeId, NodeId>> products;
        NodeId alone{};  // what the pivot of a constraint would be without those before it
        for (std::size_t j = 0; j < i; ++j) {
            if (j + multipliers == n) alone = minus_products(program, mass[lower_index(i, i)], products);
            factors[lower_index(i, j)] = program.product({v[j], factors[lower_index(j, j)]});
            products.emplace_back(v[j], factors[lower_index(i, j)]);
        }
        const NodeId pivot = minus_products(program, mass[lower_index(i, i)], products);
        if (i + multipliers < n) {
            factors[lower_index(i, i)] = reciprocal ? reciprocal(pivot) : program.reciprocal(pivot);
            continue;
        }
        const NodeId left = chosen.empty() ? pivot : program.product({chosen[i + multipliers - n], pivot});
        if (!program.is_constant(left, 0))
            factors[lower_index(i, i)] = program.function(Op::independent_inverse, {left, i + multipliers == n ? pivot : alone});
    }
    return factors;
}

std::vector<NodeId> solve_lower(Program& program, std::size_t n, const std::vector<NodeId>& factors, std::vector<NodeId> b) {
    for (std::size_t i = 0; i < n; ++i) {
        std::vector<std::pair<NodeId, NodeId>> products;
        for (std::size_t k = 0; k < i; ++k) products.emplace_back(factors[lower_index(i, k)], b[k]);
        b[i] = minus_products(program, b[i], products);
    }
    return b;
}

std::vector<NodeId> solve(Program& program, std::size_t n, const std::vector<NodeId>& factors, std::vector<NodeId> b) {
    b = solve_lower(program, n, factors, std::move(b));
    for (std::size_t i = n; i-- > 0;) {
        std::vector<std::pair<NodeId, NodeId>> products;
        for (std::size_t k = i + 1; k < n; ++k) products.emplace_back(factors[lower_index(k, i)], b[k]);
        b[i] = minus_products(program, program.product({b[i], factors[lower_index(i, i)]}), products);
    }
    return b;
}

std::vector<std::vector<NodeId>> solve_columns(Program& program, std::size_t n, const std::vector<NodeId>& factors,
                                               const std::vector<std::vector<NodeId>>& columns) {
    const auto is_zero = [&](NodeId id) { return program.is_constant(id, 0); };
    const auto only_entry = [&](const std::vector<NodeId>& b) -> std::optional<std::size_t> {
        if (std::count_if(b.begin(), b.end(), is_zero) + 1 != static_cast<std::ptrdiff_t>(n)) return {};
        return static_cast<std::size_t>(std::find_if_not(b.begin(), b.end(), is_zero) - b.begin());
    };
    std::vector<std::set<NodeId>> uses(n);
    for (const std::vector<NodeId>& b : columns)
        if (const auto row = only_entry(b)) uses[*row].insert(b[*row]);
    std::vector<std::vector<NodeId>> units(n), result;
    for (const std::vector<NodeId>& b : columns) {
        const auto row = only_entry(b);
        const bool is_short = row && n < 3 && *row + 1 == n;  // of two, the last costs two products either way
        if (!row || is_short || uses[*row].size() < 2) {
            result.push_back(solve(program, n, factors, b));
            continue;
        }
        if (units[*row].empty()) {
            std::vector<NodeId> unit(n, program.constant(0));
            unit[*row] = program.constant(1);
            units[*row] = solve(program, n, factors, std::move(unit));
        }
        result.emplace_back();
        for (const NodeId entry : units[*row]) result.back().push_back(program.product({entry, b[*row]}));
    }
    return result;
}

}  // namespace dalembert
