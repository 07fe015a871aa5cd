// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/reset_code.hpp"

#include <algorithm>
#include <optional>

#include "graph/roots.hpp"

namespace dalembert {

namespace {

class ResetMaker {
public:
    ResetMaker(Code& code, const LoweredSystem& lowered, const FactorsOfMass& factors)
        : code_(code),
          system_(code.system),
          lowered_(lowered),
          factors_(factors),
          n_(code.solve.n),
          free_(code.system.motion.free.size()),
          degrees_(code.system.symbols.degrees()) {}

    void run() {
        FunctionCode& f = code_[Function::resets];
        const Solve& s = code_.solve;
        ProgramBuilder builder(code_.atoms, code_.cache, ParameterParts::if_cached, f.program, code_.passes);
        Roots roots;
        const auto is_struck = [](const LoweredSystem::Reset& reset) { return !reset.direction.empty(); };
        const bool any_impact = std::any_of(lowered_.resets.begin(), lowered_.resets.end(), is_struck) ||
                                std::any_of(lowered_.rests.begin(), lowered_.rests.end(), is_struck);
        const std::size_t mass = any_impact && !s.is_constant ? roots.add(lowered_.solve_mass) : 0;
        const std::size_t held_drift = any_impact ? roots.add(lowered_.held_drift) : 0;
        const std::size_t held_factors = any_impact ? roots.add(lowered_.held_factors) : 0;
        std::vector<std::size_t> firsts;
        for (const auto* all : {&lowered_.resets, &lowered_.rests})
            for (const LoweredSystem::Reset& reset : *all) {
                firsts.push_back(roots.add(reset.values));
                roots.add(reset.direction);
                if (is_struck(reset)) roots.add({reset.drift, reset.restitution, reset.least});
            }
        builder.prepare(roots.polynomials());
        if (any_impact) {
            for (std::size_t i = 0; !s.is_constant && i < lowered_.solve_mass.size(); ++i) f.mass.push_back(builder.root(mass + i));
            f.factors = factors_(f.program, f.mass);
            f.right.rows = n_;
            f.solved.rows = n_;
        }
        std::size_t at = 0;
        const auto make = [&](const std::vector<LoweredSystem::Reset>& lowered, const auto& of_event, std::vector<ResetCode>& codes) {
            for (std::size_t e = 0; e < lowered.size(); ++e, ++at) {
                const Reset& reset = of_event(system_.events[e]);
                ResetCode code{{}, f.results.size(), {}};
                for (std::size_t i = 0; i < lowered[e].values.size(); ++i) {
                    code.places.push_back(reset.values[i].first);
                    f.results.push_back(builder.root(firsts[at] + i));
                }
                if (is_struck(lowered[e]))
                    impact(f, builder, code, *reset.impact, firsts[at] + lowered[e].values.size(), held_drift, held_factors);
                codes.push_back(std::move(code));
            }
        };
        make(lowered_.resets, [](const EventEquation& event) -> const Reset& { return event.reset; }, code_.resets);
        make(lowered_.rests, [](const EventEquation& event) -> const Reset& { return event.rest; }, code_.rests);
    }

private:
    /// With s = M^-1*a and the rate w = a*v + b: v+ = v - s*(1 + e)*w/(a*s). `first` is the root of a, behind it stand b and e. Multipliers
    /// go on holding their rates, by impulses of their own.
    void impact(FunctionCode& f, ProgramBuilder& builder, ResetCode& code, const Impact& impact, std::size_t first, std::size_t held_drift,
                std::size_t held_factors) {
        Program& p = f.program;
        std::vector<NodeId> direction, velocity;
        for (std::size_t i = 0; i < free_; ++i) {
            direction.push_back(builder.root(first + i));
            velocity.push_back(p.symbol(code_.atoms.symbol(system_.symbols.all(SymbolKind::velocity)[system_.motion.free[i]])));
        }
        const NodeId drift = builder.root(first + free_);
        const NodeId restitution = builder.root(first + free_ + 1);
        const auto product = [&](const std::vector<NodeId>& a, const std::vector<NodeId>& b, std::optional<std::size_t> without = {}) {
            std::vector<std::pair<bool, NodeId>> terms;
            for (std::size_t i = 0; i < free_; ++i)
                if (i != without) terms.emplace_back(false, p.product({a[i], b[i]}));
            return terms;
        };
        code.impact = f.solved.columns++;
        ++f.right.columns;
        std::vector<NodeId> right = direction;
        right.resize(n_, p.constant(0));
        const std::vector<NodeId> solved = solve(p, n_, f.factors, right);
        f.right.entries.insert(f.right.entries.end(), right.begin(), right.end());
        f.solved.entries.insert(f.solved.entries.end(), solved.begin(), solved.end());
        auto rate = product(direction, velocity);
        rate.emplace_back(false, drift);
        const NodeId along = p.sum(product(direction, solved));
        const auto inverse = [&] {
            if (!impact.takes_roundings) return p.reciprocal(along);
            // Without the multipliers, which may leave nothing of it.
            const NodeId alone = n_ > free_ ? p.sum(product(direction, solve(p, free_, f.factors, direction))) : along;
            return p.function(Op::independent_inverse, {along, alone});
        }();
        NodeId impulse = p.product({p.sum({{false, p.constant(1)}, {false, restitution}}), p.sum(std::move(rate)), inverse});
        if (impact.takes_roundings) {
            std::vector<std::pair<bool, NodeId>> left{{false, p.constant(Rational(1) / Rational(roundings_squared))}};
            for (std::size_t i = 0; i < free_; ++i) {
                const NodeId change = p.product({solved[i], impulse});
                left.emplace_back(true, p.product({change, change}));
            }
            code.impulse = impulse;
            std::vector<std::pair<bool, NodeId>> beyond = product(direction, direction);
            beyond.emplace_back(true, builder.root(first + free_ + 2));
            const NodeId none = p.constant(0);
            const NodeId rounding = p.function(Op::if_else, {p.sum(std::move(left)), impulse, none});
            impulse = *(code.limited = p.function(Op::if_else, {p.sum(std::move(beyond)), rounding, none}));
        }
        std::vector<NodeId> after;
        for (std::size_t i = 0; i < free_; ++i) after.push_back(p.difference(velocity[i], p.product({solved[i], impulse})));
        if (impact.pivot) {
            auto others = product(direction, after, impact.pivot);
            others.emplace_back(false, drift);
            after[*impact.pivot] = p.negated(p.product({p.sum(std::move(others)), p.reciprocal(direction[*impact.pivot])}));
        }
        const auto set = [&](std::size_t coordinate, NodeId value) {
            code.places.push_back(system_.symbols.place(SymbolKind::velocity, coordinate));
            f.results.push_back(value);
        };
        for (std::size_t i = 0; i < free_; ++i) set(system_.motion.free[i], after[i]);
        for (std::size_t h = 0; h < system_.motion.velocities.size(); ++h) {
            std::vector<std::pair<bool, NodeId>> terms{{false, builder.root(held_drift + h)}};
            for (std::size_t i = 0; i < free_; ++i)
                terms.emplace_back(false, p.product({builder.root(held_factors + h * free_ + i), after[i]}));
            set(system_.motion.velocities[h].first, p.sum(std::move(terms)));
        }
    }

    Code& code_;
    const System& system_;
    const LoweredSystem& lowered_;
    const FactorsOfMass& factors_;
    std::size_t n_;        ///< accelerations and multipliers that are solved for
    std::size_t free_;     ///< of them, accelerations
    std::size_t degrees_;
};

}  // namespace

void make_resets(Code& code, const LoweredSystem& lowered, const FactorsOfMass& factors) { ResetMaker(code, lowered, factors).run(); }

}  // namespace dalembert
