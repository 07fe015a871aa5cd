// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/factorisation.hpp"

namespace dalembert {

namespace {

constexpr std::size_t always_unrolled = 4;
constexpr std::size_t most_entries_per_row = 3;

/// a - sum of b_k*c_k, products with zero left out.
NodeId minus_products(Program& program, NodeId a, const std::vector<std::pair<NodeId, NodeId>>& products) {
    std::vector<std::pair<bool, NodeId>> terms{{false, a}};
    for (const auto& [b, c] : products) terms.emplace_back(true, program.product({b, c}));
    return program.sum(std::move(terms));
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

std::vector<NodeId> factorise(Program& program, std::size_t n, std::size_t multipliers, const std::vector<NodeId>& mass, const Reciprocal& reciprocal) {
    std::vector<NodeId> factors(mass.size(), program.constant(0));
    std::vector<NodeId> v(n, program.constant(0));  // L_ij*D_j of the current row
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            std::vector<std::pair<NodeId, NodeId>> products;
            for (std::size_t k = 0; k < j; ++k) products.emplace_back(v[k], factors[lower_index(j, k)]);
            v[j] = minus_products(program, mass[lower_index(i, j)], products);
        }
        std::vector<std::pair<NodeId, NodeId>> products;
        NodeId alone{};  // what the pivot of a constraint would be without those before it
        for (std::size_t j = 0; j < i; ++j) {
            if (j + multipliers == n) alone = minus_products(program, mass[lower_index(i, i)], products);
            factors[lower_index(i, j)] = program.product({v[j], factors[lower_index(j, j)]});
            products.emplace_back(v[j], factors[lower_index(i, j)]);
        }
        const NodeId pivot = minus_products(program, mass[lower_index(i, i)], products);
        if (i + multipliers < n) factors[lower_index(i, i)] = reciprocal ? reciprocal(pivot) : program.reciprocal(pivot);
        else factors[lower_index(i, i)] = program.function(Op::independent_inverse, {pivot, i + multipliers == n ? pivot : alone});
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

}  // namespace dalembert
