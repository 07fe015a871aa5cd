// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/verify_solve.hpp"

#include "elements/verdict.hpp"
#include "graph/factorisation.hpp"
#include "graph/raise.hpp"
#include "prove/normal_form.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

Comparison is_zero_by_normal_form(const ex& difference) {
    if (difference.expand().is_zero()) return {Verdict::proven};
    try {
        return {NormalForm().is_zero(difference) ? Verdict::proven : Verdict::wrong};
    } catch (const NoNormalForm& reason) {
        return {Verdict::not_checkable, reason.what()};
    }
}

/// The empty corner of constraints stands for any.
bool has_zero(std::size_t i, std::size_t j, std::size_t n, std::size_t constraints, const std::vector<bool>& is_zero) {
    return is_zero[lower_index(i, j)] && j + constraints < n;
}

}  // namespace

SolveNodes solve_in_letters(Program& program, std::size_t n, std::size_t constraints, const std::vector<bool>& is_zero) {
    std::vector<NodeId> mass, right;
    const auto cached = [&](std::size_t i) { return program.cached(static_cast<std::uint32_t>(i)); };
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j)
            mass.push_back(has_zero(i, j, n, constraints, is_zero) ? program.constant(0) : cached(lower_index(i, j)));
        right.push_back(cached(is_zero.size() + i));
    }
    SolveNodes nodes;
    nodes.factors = factorise(program, n, constraints, mass, nullptr, {}, &nodes.scaled);
    nodes.halfway = solve_lower(program, n, nodes.factors, right);
    nodes.solved = solve(program, n, nodes.factors, right);
    return nodes;
}

/// The letters are x, D and V = L*D below the diagonal, from which M and b are made; they stand for any such M and, as that has an inverse,
/// for any b. Where M has a zero, V is minus the fill-in: that is proven of the operations, and V stays a letter in what comes after. So
/// does all that is proven, and nothing grows.
Comparison solve_gives_solution(const Program& program, const SolveNodes& nodes, std::size_t n, std::size_t constraints,
                                const std::vector<bool>& is_zero, const Atoms& atoms) {
    int count = 0;
    const auto letter = [&] { return GiNaC::realsymbol("x" + std::to_string(count++)); };
    std::vector<ex> v(is_zero.size(), 0);         // on the diagonal: D
    std::vector<ex> computed(is_zero.size(), 0);  // what v is as the operations find it
    std::vector<ex> meaning(is_zero.size(), 0);   // of M, and behind it b
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            const std::size_t place = lower_index(i, j);
            ex fill = 0;
            for (std::size_t k = 0; k < j; ++k) fill += v[lower_index(i, k)] * v[lower_index(j, k)] / v[lower_index(k, k)];
            const bool is_fill = has_zero(i, j, n, constraints, is_zero);
            if (is_fill && fill.is_zero()) continue;
            v[place] = letter();
            computed[place] = is_fill ? ex(-fill) : v[place];
            meaning[place] = v[place] + fill;
        }
    std::vector<ex> x;
    for (std::size_t i = 0; i < n; ++i) x.push_back(letter());
    for (std::size_t i = 0; i < n; ++i) {
        ex b = 0;
        for (std::size_t j = 0; j < n; ++j) b += meaning[i >= j ? lower_index(i, j) : lower_index(j, i)] * x[j];
        meaning.push_back(b);
    }
    Comparison worst{Verdict::proven};
    Raiser raise(program, atoms, [&](std::uint32_t i) { return meaning[i]; });
    const auto becomes = [&](NodeId node, const ex& expected, const ex& from_now_on) {
        Comparison result = is_zero_by_normal_form(raise(node) - expected);
        if (result.verdict == Verdict::proven)
            raise.define(node, from_now_on);
        else if (is_worse(result.verdict, worst.verdict))
            worst = std::move(result);
    };
    const auto is_proven = [&](NodeId node, const ex& expected) { becomes(node, expected, expected); };
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const std::size_t place = lower_index(i, j);
            becomes(nodes.scaled[place], computed[place], v[place]);
            is_proven(nodes.factors[place], v[place] / v[lower_index(j, j)]);
        }
        const std::size_t own = lower_index(i, i);
        becomes(nodes.factors[own], 1 / computed[own], 1 / v[own]);
    }
    for (std::size_t i = 0; i < n; ++i) {
        ex half = v[lower_index(i, i)] * x[i];
        for (std::size_t k = i + 1; k < n; ++k) half += v[lower_index(k, i)] * x[k];
        is_proven(nodes.halfway[i], half);
    }
    for (std::size_t i = n; i-- > 0;) is_proven(nodes.solved[i], x[i]);
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
