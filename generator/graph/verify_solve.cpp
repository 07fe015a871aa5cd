// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/verify_solve.hpp"

#include "graph/factorisation.hpp"
#include "graph/raise.hpp"
#include "elements/verdict.hpp"
#include "prove/normal_form.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

Comparison is_zero_by_normal_form(const ex& difference) {
    try {
        return {NormalForm().is_zero(difference) ? Verdict::proven : Verdict::wrong};
    } catch (const NoNormalForm& reason) {
        return {Verdict::not_checkable, reason.what()};
    }
}

}  // namespace

/// The letters are x, D and V = L*D below the diagonal, from which M and b are made; they stand for any such M and, as that has an inverse,
/// for any b. What is proven becomes a letter in what comes after it, so that nothing grows.
Comparison solve_gives_solution(std::size_t n, std::size_t constraints, const std::vector<bool>& is_zero, const Atoms& atoms) {
    Comparison worst{Verdict::proven};
    // The empty corner of constraints stands for any.
    const auto has_zero = [&](std::size_t i, std::size_t j) { return is_zero[lower_index(i, j)] && j + constraints < n; };
    int count = 0;
    const auto letter = [&] { return GiNaC::realsymbol("x" + std::to_string(count++)); };
    std::vector<ex> v(is_zero.size(), 0);  // on the diagonal: D
    std::vector<ex> meaning(is_zero.size(), 0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            ex fill = 0;
            for (std::size_t k = 0; k < j; ++k) fill += v[lower_index(i, k)] * v[lower_index(j, k)] / v[lower_index(k, k)];
            // Where M has a zero, V follows from the fill-in.
            v[lower_index(i, j)] = has_zero(i, j) ? ex(-fill) : ex(letter());
            meaning[lower_index(i, j)] = v[lower_index(i, j)] + fill;
        }
    std::vector<ex> x;
    for (std::size_t i = 0; i < n; ++i) x.push_back(letter());
    Program program;
    std::vector<NodeId> mass, right;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            mass.push_back(has_zero(i, j) ? program.constant(0) : program.cached(static_cast<std::uint32_t>(lower_index(i, j))));
    for (std::size_t i = 0; i < n; ++i) {
        ex b = 0;
        for (std::size_t j = 0; j < n; ++j) b += meaning[i >= j ? lower_index(i, j) : lower_index(j, i)] * x[j];
        right.push_back(program.cached(static_cast<std::uint32_t>(meaning.size())));
        meaning.push_back(b);
    }
    const std::vector<NodeId> factors = factorise(program, n, constraints, mass);
    const std::vector<NodeId> halfway = solve_lower(program, n, factors, right);
    const std::vector<NodeId> solved = solve(program, n, factors, right);
    Raiser raise(program, atoms, [&](std::uint32_t i) { return meaning[i]; });
    const auto is_proven = [&](NodeId node, const ex& expected) {
        Comparison result = is_zero_by_normal_form(raise(node) - expected);
        if (result.verdict == Verdict::proven) raise.define(node, expected);
        else if (is_worse(result.verdict, worst.verdict)) worst = std::move(result);
    };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            is_proven(factors[lower_index(i, j)], (i == j ? ex(1) : v[lower_index(i, j)]) / v[lower_index(j, j)]);
    for (std::size_t i = 0; i < n; ++i) {
        ex half = v[lower_index(i, i)] * x[i];
        for (std::size_t k = i + 1; k < n; ++k) half += v[lower_index(k, i)] * x[k];
        is_proven(halfway[i], half);
    }
    for (std::size_t i = n; i-- > 0;) is_proven(solved[i], x[i]);
    return worst;
}

bool leaves_out_any(std::size_t n, std::size_t constraints, const std::vector<bool>& is_zero) {
    for (std::size_t out = n - constraints; out < n; ++out) {
        Program program;
        std::vector<NodeId> mass, right, mass_without, right_without, chosen(constraints, program.constant(1));
        chosen[out + constraints - n] = program.constant(0);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                mass.push_back(is_zero[lower_index(i, j)] ? program.constant(0)
                                                          : program.cached(static_cast<std::uint32_t>(lower_index(i, j))));
                if (i != out && j != out) mass_without.push_back(mass.back());
            }
            right.push_back(program.cached(static_cast<std::uint32_t>(is_zero.size() + i)));
            if (i != out) right_without.push_back(right.back());
        }
        std::vector<NodeId> x = solve(program, n, factorise(program, n, constraints, mass, nullptr, chosen), right);
        if (!program.is_constant(x[out], 0)) return false;
        x.erase(x.begin() + static_cast<std::ptrdiff_t>(out));
        if (x != solve(program, n - 1, factorise(program, n - 1, constraints - 1, mass_without), right_without)) return false;
    }
    return true;
}

}  // namespace dalembert
