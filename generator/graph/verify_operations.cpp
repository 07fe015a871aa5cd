// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/verify_operations.hpp"

#include <algorithm>

namespace dalembert {

namespace {

class Operations {
public:
    Operations(const Code& code, Prover& prover, const CachedMeaning& cached)
        : code_(code), update_(code[Function::update]), solve_(code.solve), prover_(prover), cached_(cached) {}

    bool cached_are_those() const {
        Program program = update_.program;
        const std::vector<NodeId> expected = factorise(program, solve_.n, solve_.multipliers, update_.mass);
        for (std::size_t i = 0; i < expected.size(); ++i)
            if (cached_factor(i) != expected[i]) return false;
        return true;
    }

    bool are_those(Function function) {
        const FunctionCode& f = code_[function];
        if (f.factors.empty()) return true;  // without an impact nothing is solved
        Program program = f.program;
        return (solve_.is_constant ? factors_are_cached(f) : factors_are_those(f, program)) && solutions_are_those(f, program) &&
               columns_are_those(f, program, function == Function::resets && f.solved.rows == solve_.n);
    }

private:
    NodeId cached_factor(std::size_t i) const { return update_.results[code_.definition_order.size() + solve_.first_cached + i]; }

    bool factors_are_cached(const FunctionCode& f) const {
        for (std::size_t i = 0; i < f.factors.size(); ++i) {
            const Node& node = f.program[f.factors[i]];
            const bool is_cached = node.kind == Node::Kind::cached && node.index == solve_.first_cached + i;
            if (!is_cached && !(f.is_zero(f.factors[i]) && update_.is_zero(cached_factor(i)))) return false;
        }
        return true;
    }

    bool factors_are_those(const FunctionCode& f, Program& program) {
        std::size_t row = 0;
        bool are_reciprocals = true;
        Raiser raise(f.program, code_.atoms, cached_);
        const auto reciprocal = [&](NodeId pivot) {
            const NodeId emitted = f.factors[lower_index(row, row)];
            ++row;
            are_reciprocals =
                are_reciprocals && (program.reciprocal(pivot) == emitted || prover_.proven_equal(raise(emitted) * raise(pivot), 1));
            return emitted;
        };
        return factorise(program, solve_.n, solve_.multipliers, f.mass, reciprocal, chosen(program, solve_)) == f.factors &&
               are_reciprocals;
    }

    /// Entries of a list of all accelerations and multipliers.
    template <class Entry>
    std::vector<NodeId> of_unknowns(const Entry& entry) const {
        std::vector<NodeId> entries;
        for (const std::size_t j : code_.system.unknown_places()) entries.push_back(entry(j));
        return entries;
    }

    bool solutions_are_those(const FunctionCode& f, Program& program) const {
        if (!solved_for(f).empty() &&
            solve(program, solve_.n, f.factors, f.force) != of_unknowns([&](std::size_t j) { return solved_for(f)[j]; }))
            return false;
        if (f.second && solve(program, solve_.n, f.factors, f.second->right) != f.second->solved) return false;
        return f.rates_solved_for.empty() || solve(program, solve_.n, f.factors, f.right.entries) == f.rates_solved_for;
    }

    bool columns_are_those(const FunctionCode& f, Program& program, bool is_everything) const {
        for (std::size_t c = 0; c < f.solved.columns; ++c) {
            const auto column = [&](const CodeMatrix& matrix) {
                std::vector<NodeId> entries;
                for (std::size_t j = 0; j < matrix.rows; ++j) entries.push_back(matrix.at(j, c));
                return entries;
            };
            const std::vector<NodeId> right = column(f.right);
            const std::vector<NodeId> emitted =
                is_everything ? column(f.solved) : of_unknowns([&](std::size_t j) { return f.solved.at(j, c); });
            if (solve(program, solve_.n, f.factors, right) != emitted &&
                !is_multiple_of_a_unit_solution(program, f.factors, right, emitted))
                return false;
        }
        return true;
    }

    /// Whether x is M^-1 of a unit vector, times the one entry that b has.
    static bool is_multiple_of_a_unit_solution(Program& program, const std::vector<NodeId>& factors, const std::vector<NodeId>& b,
                                               const std::vector<NodeId>& x) {
        const auto is_entry = [&](NodeId id) { return !program.is_constant(id, 0); };
        const auto entry = std::find_if(b.begin(), b.end(), is_entry);
        if (std::count_if(b.begin(), b.end(), is_entry) != 1) return false;
        std::vector<NodeId> unit(b.size(), program.constant(0));
        unit[static_cast<std::size_t>(entry - b.begin())] = program.constant(1);
        std::vector<NodeId> product;
        for (const NodeId one : solve(program, b.size(), factors, std::move(unit))) product.push_back(program.product({one, *entry}));
        return product == x;
    }

    const Code& code_;
    const FunctionCode& update_;
    const Solve& solve_;
    Prover& prover_;
    const CachedMeaning& cached_;
};

}  // namespace

bool operations_are_proven(const Code& code, Prover& prover, const CachedMeaning& cached) {
    Operations operations(code, prover, cached);
    if (code.solve.is_constant && !operations.cached_are_those()) return false;
    for (const HeaderFunction& row : header_functions())
        if (row.kind != HeaderFunction::Kind::correction && !operations.are_those(row.function)) return false;
    return true;
}

}  // namespace dalembert
