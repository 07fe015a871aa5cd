// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/hessian_code.hpp"

namespace dalembert {

std::vector<NodeId> hessian_of(Program& program, const FunctionCode& f, const std::vector<std::size_t>& unknowns) {
    const FunctionCode::SecondOrder& second = *f.second;
    std::vector<NodeId> results;
    for (std::size_t c = 0; c < second.mixed.columns; ++c)
        for (std::size_t d = 0; d <= c; ++d) {
            std::vector<std::pair<bool, NodeId>> terms{{false, second.direct[lower_index(c, d)]}};
            for (std::size_t i = 0; i < unknowns.size(); ++i) {
                terms.emplace_back(false, program.product({second.mixed.at(i, c), f.solved.at(unknowns[i], d)}));
                terms.emplace_back(false, program.product({second.mixed.at(i, d), f.solved.at(unknowns[i], c)}));
            }
            results.push_back(program.sum(std::move(terms)));
        }
    return results;
}

void make_hessian(Code& code, const LoweredSystem& lowered, MotionCode& motion) {
    code.wished.insert(Function::hessian);
    FunctionCode& f = code[Function::hessian];
    LoweredSystem::Columns columns = lowered.partial(By::state);
    const auto append_columns = [](auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); };
    const LoweredSystem::Columns& by_input = lowered.partial(By::input);
    append_columns(columns.residual, by_input.residual);
    append_columns(columns.held, by_input.held);
    append_columns(columns.state_rate, by_input.state_rate);
    ProgramBuilder builder(code.atoms, code.cache, header_function(Function::hessian).parts, f.program, code.passes);
    Roots roots;
    const MotionCode::MotionRoots parts = motion.add_motion(roots);
    const MotionCode::ColumnRoots column_parts = motion.add_columns(roots, columns);
    const std::size_t adjoint = roots.add(lowered.second.adjoint), direct = roots.add(lowered.second.direct),
                      mixed = roots.add(lowered.second.mixed);
    builder.prepare(roots.polynomials());
    f.solved_for = motion.solve_motion(f, builder, parts);
    FunctionCode::SecondOrder& second = f.second.emplace();
    const std::size_t n = code.solve.n;
    for (std::size_t i = 0; i < n; ++i) second.right.push_back(builder.root(adjoint + i));
    second.solved = solve(f.program, n, f.factors, second.right);
    for (std::size_t i = 0; i < n; ++i) builder.define(motion.letter(SymbolKind::adjoint, i), second.solved[i]);
    motion.take_columns(f, builder, columns, column_parts);
    f.below = {};
    for (std::size_t i = 0; i < lowered.second.direct.size(); ++i) second.direct.push_back(builder.root(direct + i));
    second.mixed = {n, columns.residual.size(), {}};
    for (std::size_t i = 0; i < n * columns.residual.size(); ++i) second.mixed.entries.push_back(builder.root(mixed + i));
    f.results = hessian_of(f.program, f, code.system.unknown_places());
}

}  // namespace dalembert
