// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/lowered_system.hpp"

#include <algorithm>

#include "graph/derived_values.hpp"
#include "graph/factorisation.hpp"
#include "graph/lower.hpp"
#include "form/hessian.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class Lowerer {
public:
    Lowerer(const System& system, KnownPartials& partials, Atoms& atoms, ChainUse chain)
        : system_(system), partials_(partials), atoms_(atoms), chain_(chain) {}

    LoweredSystem run(bool rewrites, const std::set<Function>& wished) {
        LoweredSystem l;
        for (const HeaderFunction& row : header_functions())
            if (row.values != nullptr) l[row.function] = all(row.values(system_));
        const SolvedMotion solved = system_.solved_motion();
        l.force = all(solved.force);
        constrained(l, solved.matrix);
        l.has_long_chain = has_long_chain(l);
        projected(l);
        switching(l);
        l.state_rate = all(system_.state_rates);
        l.definitions = all(system_.symbols.definition_values());
        for (const By by : {By::state, By::input, By::parameter, By::time}) {
            const Partials& p = partials_(by, !l.has_long_chain);
            auto& columns = l.by[static_cast<std::size_t>(by)];
            for (const auto& column : p.residual) columns.residual.push_back(all(column));
            for (const auto& column : p.state_rate) columns.state_rate.push_back(all(column));
            // Slopes of outputs by parameters can be long beyond measure: radiosities of many surfaces.
            if (by == By::state || by == By::input || (by == By::parameter && wished.contains(Function::output_jacobian_p)) ||
                (by == By::time && wished.contains(Function::output_jacobian_t)))
                for (const auto& column : p.output) columns.output.push_back(all(column));
            for (const auto& column : p.held) columns.held.push_back(all(column));
        }
        for (const auto& column : output_by_acceleration(system_)) l.output_by_acceleration.push_back(all(column));
        if (wished.contains(Function::hessian) && !l.has_long_chain) {
            const SecondPartials s = second_partials(system_);
            l.second.adjoint = all(s.adjoint);
            l.second.direct = all(s.direct);
            for (const auto& column : s.mixed) l.second.mixed.push_back(all(column));
        }
        if (system_.chain && chain_ != ChainUse::never)
            l.chain =
                lower_chain(system_, atoms_,
                            l.has_long_chain ? std::vector<By>{By::state, By::input, By::parameter, By::time} : std::vector<By>{By::state});

        canonicalise(l);
        if (!rewrites) return l;
        // Behind it, because what is computed in double depends on the order of terms, and GiNaC's is another one on every run.
        LoweredSystem::Second second = std::move(l.second);  // in letters that points for rewriting have no values of
        l.second = {};
        rewrite(l);
        l.second = std::move(second);
        canonicalise(l);
        return l;
    }

private:
    /// Up to this order and size of M code from body to body is compared with code that solves with M; beyond, it is shorter in any case.
    static constexpr std::size_t most_compared = 8, most_terms_a_row = 200;

    bool has_long_chain(const LoweredSystem& l) const {
        std::vector<bool> is_zero;
        if (!system_.chain || chain_ != ChainUse::where_shorter) return system_.chain && chain_ == ChainUse::wherever_possible;
        std::size_t terms = 0;
        for (const Polynomial& p : l.solve_mass) {
            is_zero.push_back(p.is_zero());
            terms += p.size();
        }
        const std::size_t n = system_.motion.unknowns();
        return (n > most_compared && !should_unroll(n, is_zero)) || terms > most_terms_a_row * n;
    }

    void constrained(LoweredSystem& l, const GiNaC::matrix& solved) {
        const Motion& motion = system_.motion;
        const std::size_t n = system_.symbols.degrees();
        const std::vector<Polynomial>& mass = l[Function::mass_matrix];
        for (unsigned i = 0; i < motion.unknowns(); ++i)
            for (unsigned j = 0; j <= i; ++j) {
                const bool is_in_mass = motion.accelerations.empty() && motion.weight.is_zero() && i < n;
                l.solve_mass.push_back(
                    is_in_mass ? mass[lower_index(std::max(motion.free[i], motion.free[j]), std::min(motion.free[i], motion.free[j]))]
                               : one(solved(i, j)));
            }
        for (const auto& [coordinate, acceleration] : motion.accelerations) {
            l.held.push_back(one(acceleration));
            for (const std::size_t k : motion.free)
                l.held_by_free.push_back(one(partial(acceleration, system_.symbols.get(SymbolKind::acceleration, k))));
        }
        for (const auto& [coordinate, rate] : motion.velocities) {
            l.held_drift.push_back(one(rate.drift));
            for (const ex& factor : rate.jacobian) l.held_factors.push_back(one(factor));
        }
    }

    void projected(LoweredSystem& l) {
        if (!system_.motion.multipliers.empty() && !system_.scene.modes.empty()) {
            l.motion_rate = all(motion_rates(system_));
            l.held_jerks = all(held_jerks(system_));
        }
        if (!system_.needs_projection()) return;
        LoweredSystem::Projection& p = l.projection;
        const std::vector<Polynomial>& jacobian = l[Function::constraint_jacobian];
        const std::size_t n = system_.symbols.degrees();
        p.bordered = system_.motion.weight.is_zero() ? l[Function::mass_matrix] : all(lower_triangle(system_.metric()));
        for (std::size_t i = 0; i < system_.constraints.size(); ++i) {
            if (!system_.constraints[i].holds) continue;
            for (std::size_t j = 0; j < n; ++j) p.bordered.push_back(Polynomial(jacobian[i * n + j]) *= Rational(-1));
            p.holding.push_back(i);
            p.bordered.resize(p.bordered.size() + p.holding.size());
        }
    }

    void switching(LoweredSystem& l) {
        for (const EventEquation& event : system_.events) {
            l.resets.push_back(reset(event.reset));
            l.rests.push_back(reset(event.rest));
        }
    }

    LoweredSystem::Reset reset(const Reset& reset) {
        LoweredSystem::Reset result;
        for (const auto& [place, value] : reset.values) result.values.push_back(one(value));
        if (!reset.impact) return result;
        result.direction = all(reset.impact->direction);
        result.drift = one(reset.impact->drift);
        result.restitution = one(reset.impact->restitution);
        result.least = one(reset.impact->least);
        return result;
    }

    Polynomial one(const ex& e) { return lower(e, atoms_, sums_); }
    std::vector<Polynomial> all(const std::vector<ex>& expressions) {
        std::vector<Polynomial> result;
        for (const ex& e : expressions) result.push_back(one(e));
        return result;
    }

    void canonicalise(LoweredSystem& l) {
        std::vector<Polynomial*> everything;
        each(l, [&](Polynomial& p, const char*) { everything.push_back(&p); });
        if (l.chain) each_polynomial(*l.chain, [&](Polynomial& p) { everything.push_back(&p); });
        atoms_.canonicalise(everything);
    }

    void rewrite(LoweredSystem& l) {
        Rewriter rewriter(system_, atoms_, l.definitions, l[Function::guards]);
        each(l, [&](Polynomial& p, const char* where) { p = rewriter(p, where); });
        l.rewritten = rewriter.log();
    }

    /// Every polynomial, with the name of what it belongs to.
    template <class Visit>
    static void each(LoweredSystem& l, const Visit& visit) {
        const char* where = "";
        const auto one = [&](Polynomial& p) { visit(p, where); };
        const auto list = [&](std::vector<Polynomial>& polynomials) { std::for_each(polynomials.begin(), polynomials.end(), one); };
        const auto of_group = [&](const std::string_view group) {
            where = group.data();
            for (const HeaderFunction& row : header_functions())
                if (row.group == group) list(l[row.function]);
        };
        of_group("motion");
        for (auto* part :
             {&l.force, &l.solve_mass, &l.motion_rate, &l.held_jerks, &l.held, &l.held_by_free, &l.held_drift, &l.held_factors})
            list(*part);
        where = "rates of states";
        list(l.state_rate);
        of_group("outputs");
        where = "definitions";
        list(l.definitions);
        for (const char* group : {"start", "guards and events", "energies and powers", "constraints"}) of_group(group);
        where = "constraints";
        list(l.projection.bordered);
        where = "resets";
        for (auto* resets : {&l.resets, &l.rests})
            for (LoweredSystem::Reset& reset : *resets) {
                list(reset.values);
                list(reset.direction);
                one(reset.drift);
                one(reset.restitution);
                one(reset.least);
            }
        where = "Jacobians";
        for (auto& columns : l.by)
            for (auto* part : {&columns.residual, &columns.state_rate, &columns.output, &columns.held})
                std::for_each(part->begin(), part->end(), list);
        std::for_each(l.output_by_acceleration.begin(), l.output_by_acceleration.end(), list);
        list(l.second.adjoint);
        list(l.second.direct);
        std::for_each(l.second.mixed.begin(), l.second.mixed.end(), list);
    }

    const System& system_;
    KnownPartials& partials_;
    Atoms& atoms_;
    ChainUse chain_;
    LoweredSums sums_;
};

}  // namespace

LoweredSystem lower_system(const System& system, KnownPartials& partials, Atoms& atoms, bool rewrites, ChainUse chain,
                           const std::set<Function>& wished) {
    return Lowerer(system, partials, atoms, chain).run(rewrites, wished);
}

}  // namespace dalembert
