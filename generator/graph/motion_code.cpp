// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/motion_code.hpp"

namespace dalembert {

MotionCode::MotionCode(Code& code, const LoweredSystem& lowered)
    : code_(code),
      system_(code.system),
      lowered_(lowered),
      n_(system_.motion.unknowns()),
      degrees_(system_.symbols.degrees()),
      multipliers_(system_.motion.multipliers.size()),
      places_(system_.unknown_places()) {}

Letter MotionCode::letter(SymbolKind kind, std::size_t position) const { return code_.atoms.symbol(system_.symbols.all(kind)[position]); }

std::vector<NodeId> MotionCode::factors(Program& program, const std::vector<NodeId>& mass) {
    const Solve& s = code_.solve;
    if (!s.is_constant)
        return factorise(
            program, n_, multipliers_, mass,
            [&](NodeId pivot) { return reciprocal(code_.atoms, code_.cache, program, pivot, code_.passes); }, chosen(program, s));
    // What the factors are is decided in update(); zero factors are known from the pattern there as here.
    std::vector<NodeId> result;
    Program pattern;
    std::vector<NodeId> symbolic;
    for (std::size_t i = 0; i < s.is_zero.size(); ++i)
        symbolic.push_back(s.is_zero[i] ? pattern.constant(0) : pattern.cached(static_cast<std::uint32_t>(i)));
    const std::vector<NodeId> computed = factorise(pattern, n_, multipliers_, symbolic);
    for (std::size_t i = 0; i < computed.size(); ++i)
        result.push_back(pattern.is_constant(computed[i], 0) ? program.constant(0)
                                                             : program.cached(s.first_cached + static_cast<std::uint32_t>(i)));
    return result;
}

Letter MotionCode::unknown(std::size_t i, bool is_rate) const {
    const Motion& motion = system_.motion;
    if (i < motion.free.size()) return letter(is_rate ? SymbolKind::jerk : SymbolKind::acceleration, motion.free[i]);
    return letter(is_rate ? SymbolKind::multiplier_rate : SymbolKind::multiplier, motion.multipliers[i - motion.free.size()]);
}

MotionCode::MotionRoots MotionCode::add_motion(Roots& roots) const {
    MotionRoots parts;
    if (!code_.solve.is_constant) parts.mass = roots.add(lowered_.solve_mass);
    parts.force = roots.add(lowered_.force);
    parts.held = roots.add(lowered_.held);
    return parts;
}

std::vector<NodeId> MotionCode::solve_motion(FunctionCode& f, ProgramBuilder& builder, const MotionRoots& parts) {
    const bool needs_mass = !code_.solve.is_constant;
    for (std::size_t i = 0; needs_mass && i < lowered_.solve_mass.size(); ++i) f.mass.push_back(builder.root(parts.mass + i));
    for (std::size_t j = 0; j < n_; ++j) f.force.push_back(builder.root(parts.force + j));
    f.factors = factors(f.program, f.mass);
    const std::vector<NodeId> solved = solve(f.program, n_, f.factors, f.force);
    std::vector<NodeId> all(degrees_ + multipliers_);
    for (std::size_t i = 0; i < n_; ++i) all[places_[i]] = solved[i];
    for (std::size_t i = 0; i < n_; ++i) builder.define(unknown(i), solved[i]);
    for (std::size_t i = 0; i < lowered_.held.size(); ++i) {
        const std::size_t j = system_.motion.accelerations[i].first;
        all[j] = builder.root(parts.held + i);
        builder.define(acceleration_letter(j), all[j]);
    }
    return all;
}

void MotionCode::take_motion(FunctionCode& f, ProgramBuilder& builder, const MotionRoots& motion) {
    if (code_.solve.unrolled) {
        f.accelerations = solve_motion(f, builder, motion);
        return;
    }
    for (std::size_t i = 0; !code_.solve.is_constant && i < lowered_.solve_mass.size(); ++i)
        f.mass.push_back(builder.root(motion.mass + i));
    for (std::size_t j = 0; j < n_; ++j) f.force.push_back(builder.root(motion.force + j));
    for (std::size_t j = 0; j < degrees_; ++j) f.accelerations.push_back(f.program.symbol(acceleration_letter(j)));
}

MotionCode::ColumnRoots MotionCode::add_columns(Roots& roots, const LoweredSystem::Columns& columns) const {
    ColumnRoots parts;
    parts.residual = roots.add(columns.residual, -1);
    parts.below = roots.add(columns.state_rate);
    parts.held = roots.add(columns.held);
    parts.held_by_free = roots.add(lowered_.held_by_free);
    return parts;
}

/// What constraints determine follows by the chain rule.
void MotionCode::take_columns(FunctionCode& f, ProgramBuilder& builder, const LoweredSystem::Columns& columns, const ColumnRoots& parts) {
    const std::size_t m = lowered_.state_rate.size();
    const std::size_t held = lowered_.held.size();
    f.by_loops = !code_.solve.unrolled;
    f.right = {n_, columns.residual.size(), {}};
    f.solved = {degrees_ + multipliers_, f.by_loops ? 0 : columns.residual.size(), {}};
    f.below = {m, columns.residual.size(), {}};
    std::vector<std::vector<NodeId>> rights(columns.residual.size()), solved;
    for (std::size_t c = 0; c < rights.size(); ++c)
        for (std::size_t j = 0; j < n_; ++j) rights[c].push_back(builder.root(parts.residual + c * n_ + j));
    for (const std::vector<NodeId>& right : rights) f.right.entries.insert(f.right.entries.end(), right.begin(), right.end());
    if (!f.by_loops) solved = solve_columns(f.program, n_, f.factors, rights);
    for (std::size_t c = 0; c < rights.size(); ++c) {
        if (!f.by_loops) {
            std::vector<NodeId> column(degrees_ + multipliers_);
            const std::size_t free = system_.motion.free.size();
            for (std::size_t i = 0; i < n_; ++i) column[places_[i]] = solved[c][i];
            for (std::size_t i = 0; i < held; ++i) {
                std::vector<std::pair<bool, NodeId>> terms{{false, builder.root(parts.held + c * held + i)}};
                for (std::size_t k = 0; k < free; ++k)
                    terms.emplace_back(false, f.program.product({builder.root(parts.held_by_free + i * free + k), solved[c][k]}));
                column[system_.motion.accelerations[i].first] = f.program.sum(std::move(terms));
            }
            f.solved.entries.insert(f.solved.entries.end(), column.begin(), column.end());
        }
        for (std::size_t i = 0; i < m; ++i) f.below.entries.push_back(builder.root(parts.below + c * m + i));
    }
}

}  // namespace dalembert
