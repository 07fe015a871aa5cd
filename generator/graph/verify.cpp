// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/verify.hpp"

#include "graph/lowered_system.hpp"
#include "graph/raise.hpp"
#include "model/verdict.hpp"
#include "prove/normal_form.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class Verification {
public:
    explicit Verification(const Code& code) : code_(code), system_(code.system), prover_(code.system), cached_(cached_meaning(code)) {}

    std::vector<AuditEntry> run() {
        motion(Function::rhs);
        motion(Function::rhs_and_jacobian);
        columns(Function::rhs_and_jacobian, By::state);
        columns(Function::jacobian_u, By::input);
        columns(Function::jacobian_p, By::parameter);
        columns(Function::jacobian_t, By::time);
        values(Function::mass_matrix, lower_triangle(system_.mass));
        values(Function::bias, system_.bias);
        values(Function::generalised_force, system_.supplied);
        std::vector<ex> outputs;
        for (const OutputEquation& output : system_.outputs) outputs.push_back(system_.with_rates(output.value));
        values(Function::output, outputs);
        output_columns(Function::output_jacobian_x, By::state);
        output_columns(Function::output_jacobian_u, By::input);
        values(Function::kinetic_energy, {system_.kinetic_energy});
        values(Function::potential_energy, {system_.potential_energy});
        values(Function::supplied_power, {system_.supplied_power});
        values(Function::dissipated_power, {system_.dissipated_power});
        values(Function::prescribed_power, {system_.prescribed_power});
        values(Function::internal_energy, {system_.internal_energy});
        values(Function::exchanged_power, {system_.exchanged_power});
        std::vector<ex> guards;
        for (const Guard& guard : system_.fluids.guards) guards.push_back(guard.value);
        values(Function::guards, guards);
        switching();
        definitions();
        values(Function::start_state, start_values(system_));
        if (code_.solve.unrolled && code_.solve.n > 0) {
            solve_is_right();
            if (code_.solve.is_constant) cached_factors();
            for (const Function f : {Function::rhs, Function::rhs_and_jacobian, Function::jacobian_u, Function::jacobian_p, Function::jacobian_t, Function::resets}) solve_is_that_one(f);
        }
        return std::move(entries_);
    }

private:
    AuditEntry& entry(const std::string& name) {
        for (AuditEntry& known : entries_)
            if (known.name == name) return known;
        entries_.push_back({name, {Verdict::proven}});
        return entries_.back();
    }

    void compare(Function function, const ex& emitted, const ex& derived) {
        AuditEntry& e = entry(std::string("emitted = derived, ") + name_of(function));
        if (prover_.proven_equal(emitted, derived)) return;
        Comparison result = prover_.equal(emitted, derived);
        if (is_worse(result.verdict, e.result.verdict)) e.result = std::move(result);
    }

    void definitions() {
        const FunctionCode& f = code_[Function::update];
        Raiser raise(f.program, code_.atoms, cached_);
        for (std::size_t i = 0; i < code_.definition_order.size(); ++i)
            compare(Function::update, raise(f.results[i]), system_.symbols.definition_values()[code_.definition_order[i]]);
    }

    static std::vector<ex> lower_triangle(const GiNaC::matrix& matrix) {
        std::vector<ex> lower;
        for (unsigned i = 0; i < matrix.rows(); ++i)
            for (unsigned j = 0; j <= i; ++j) lower.push_back(matrix(i, j));
        return lower;
    }

    const ex& acceleration(std::size_t j) const { return system_.symbols.get(SymbolKind::acceleration, j); }

    void motion(Function function) {
        const FunctionCode& f = code_[function];
        Raiser raise(f.program, code_.atoms, cached_);
        const std::vector<ex> derived_mass = lower_triangle(system_.motion.mass);
        const FunctionCode& m = code_.solve.is_constant ? code_[Function::update] : f;
        Raiser raise_mass(m.program, code_.atoms, cached_);
        for (std::size_t i = 0; i < derived_mass.size(); ++i) compare(function, raise_mass(m.mass[i]), derived_mass[i]);
        for (std::size_t j = 0; j < code_.solve.n; ++j) compare(function, raise(f.force[j]), system_.motion.force[j]);
        GiNaC::exmap solutions;
        for (const std::size_t k : system_.motion.free) solutions[acceleration(k)] = raise(f.accelerations[k]);
        for (const auto& [j, derived] : system_.motion.accelerations) compare(function, raise(f.accelerations[j]), derived.subs(solutions, GiNaC::subs_options::no_pattern));
        for (std::size_t i = 0; i < f.results.size(); ++i) compare(function, raise(f.results[i]), system_.state_rates[i]);
    }

    /// In the code of the joint function accelerations are solutions; for the comparison they are letters again. Where the same
    /// operations happen to stand for an acceleration and for something else, the solutions are put into the derivation instead.
    void columns(Function function, By by) {
        const FunctionCode& f = code_[function];
        Raiser with_letters(f.program, code_.atoms, cached_);
        Raiser with_solutions(f.program, code_.atoms, cached_);
        const std::vector<std::size_t>& free = f.accelerations.empty() ? std::vector<std::size_t>() : system_.motion.free;
        for (const std::size_t j : free) with_letters.define(f.accelerations[j], acceleration(j));
        const auto check = [&](NodeId node, const ex& derived) {
            if (prover_.proven_equal(with_letters(node), derived)) return compare(function, derived, derived);
            GiNaC::exmap solutions;
            for (const std::size_t j : free) solutions[acceleration(j)] = with_solutions(f.accelerations[j]);
            compare(function, with_solutions(node), derived.subs(solutions, GiNaC::subs_options::no_pattern));
        };
        const Partials p = partials(system_, by);
        for (std::size_t c = 0; c < p.residual.size(); ++c) {
            for (std::size_t j = 0; j < p.residual[c].size(); ++j) check(f.right.at(j, c), -p.residual[c][j]);
            for (std::size_t i = 0; i < p.state_rate[c].size(); ++i) check(f.below.at(i, c), p.state_rate[c][i]);
            held_column(function, f, c, p.held[c]);
        }
    }

    /// By the chain rule through the free accelerations, whose slopes are letters here.
    void held_column(Function function, const FunctionCode& f, std::size_t c, const std::vector<ex>& at_fixed) {
        const Motion& motion = system_.motion;
        if (motion.accelerations.empty()) return;
        Raiser raise(f.program, code_.atoms, cached_);
        const auto solution = [&](std::size_t j) { return f.accelerations.empty() ? acceleration(j) : raise(f.accelerations[j]); };
        GiNaC::exmap solutions;
        for (const std::size_t k : motion.free) solutions[acceleration(k)] = solution(k);
        for (std::size_t i = 0; i < motion.accelerations.size(); ++i) {
            const auto& [j, derived] = motion.accelerations[i];
            ex slope = at_fixed[i];
            for (const std::size_t k : motion.free) slope += partial(derived, acceleration(k)) * raise(f.solved.at(k, c));
            compare(function, raise(f.solved.at(j, c)), slope.subs(solutions, GiNaC::subs_options::no_pattern));
        }
    }

    void switching() {
        std::vector<ex> guards, rates, asked;
        for (const EventEquation& event : system_.events) {
            guards.push_back(event.guard);
            rates.push_back(event.rate);
        }
        values(Function::events, guards);
        values(Function::event_rates, rates);
        if (!system_.scene.modes.empty())
            asked = condition_values(system_);
        values(Function::conditions, asked);
        for (std::size_t e = 0; e < system_.events.size(); ++e) {
            reset(code_.resets[e], system_.events[e].reset);
            reset(code_.rests[e], system_.events[e].rest);
        }
    }

    /// Of an impact the rate afterwards is compared with what it should be, and that the velocities change along M^-1*direction.
    void reset(const ResetCode& code, const Reset& derived) {
        const FunctionCode& f = code_[Function::resets];
        const Motion& motion = system_.motion;
        Raiser raise(f.program, code_.atoms, cached_);
        for (std::size_t i = 0; i < derived.values.size(); ++i) compare(Function::resets, raise(f.results[code.first + i]), derived.values[i].second);
        if (!derived.impact) return;
        std::vector<ex> slope;
        for (std::size_t i = 0; i < motion.free.size(); ++i) {
            // What is a number is no letter: it stands for that number elsewhere, too.
            const NodeId node = f.solved.at(i, *code.impact);
            if (f.program[node].kind != Node::Kind::constant) raise.define(node, GiNaC::realsymbol("s" + std::to_string(i)));
            slope.push_back(raise(node));
        }
        const auto velocity = [&](std::size_t i) { return system_.symbols.get(SymbolKind::velocity, motion.free[i]); };
        ex before = derived.impact->drift, after = derived.impact->drift, along = 0;
        std::vector<ex> changed;
        const std::size_t first = code.first + derived.values.size();
        for (std::size_t i = 0; i < motion.free.size(); ++i) {
            changed.push_back(raise(f.results[first + i]));
            before += derived.impact->direction[i] * velocity(i);
            after += derived.impact->direction[i] * changed[i];
            along += derived.impact->direction[i] * slope[i];
        }
        compare(Function::resets, after, -derived.impact->restitution * before);
        for (std::size_t i = 0; i < motion.free.size(); ++i)
            compare(Function::resets, (changed[i] - velocity(i)) * along, -slope[i] * (1 + derived.impact->restitution) * before);
        for (std::size_t h = 0; h < motion.velocities.size(); ++h) {
            ex held = motion.velocities[h].second.drift;
            for (std::size_t i = 0; i < motion.free.size(); ++i) held += motion.velocities[h].second.jacobian[i] * changed[i];
            compare(Function::resets, raise(f.results[first + motion.free.size() + h]), held);
        }
    }

    void values(Function function, const std::vector<ex>& derived) {
        const FunctionCode& f = code_[function];
        Raiser raise(f.program, code_.atoms, cached_);
        for (std::size_t i = 0; i < derived.size(); ++i) compare(function, raise(f.results[i]), derived[i]);
    }

    void output_columns(Function function, By by) {
        const FunctionCode& f = code_[function];
        Raiser raise(f.program, code_.atoms, cached_);
        const Partials p = partials(system_, by);
        const auto by_acceleration = output_by_acceleration(system_);
        for (std::size_t i = 0; i < system_.outputs.size(); ++i) {
            for (std::size_t c = 0; c < p.output.size(); ++c) compare(function, raise(f.by_output.at(i, c)), p.output[c][i]);
            for (std::size_t c = 0; c < by_acceleration.size(); ++c) compare(function, raise(f.by_acceleration.at(i, c)), by_acceleration[c][i]);
        }
    }

    /// The solve written out gives M*x = b for every M with a factorisation L*D*L' and the zeros of this one. The letters are D and
    /// V = L*D below the diagonal, from which M is made; they stand for any such M, and keep denominators down to letters.
    void solve_is_right() {
        const Solve& s = code_.solve;
        int count = 0;
        const auto letter = [&] { return GiNaC::realsymbol("x" + std::to_string(count++)); };
        std::vector<ex> v(s.is_zero.size(), 0);  // on the diagonal: D
        std::vector<ex> m(s.is_zero.size(), 0);
        for (std::size_t i = 0; i < s.n; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                ex fill = 0;
                for (std::size_t k = 0; k < j; ++k) fill += v[lower_index(i, k)] * v[lower_index(j, k)] / v[lower_index(k, k)];
                // Where M has a zero, V follows from the fill-in.
                v[lower_index(i, j)] = s.is_zero[lower_index(i, j)] ? ex(-fill) : ex(letter());
                m[lower_index(i, j)] = v[lower_index(i, j)] + fill;
            }
        Program program;
        std::vector<NodeId> mass;
        std::vector<NodeId> right;
        for (std::uint32_t i = 0; i < m.size(); ++i) mass.push_back(s.is_zero[i] ? program.constant(0) : program.cached(i));
        for (std::size_t j = 0; j < s.n; ++j) {
            right.push_back(program.cached(static_cast<std::uint32_t>(m.size())));
            m.emplace_back(letter());
        }
        const std::vector<NodeId> x = solve(program, s.n, factorise(program, s.n, mass), right);
        Raiser raise(program, code_.atoms, [&](std::uint32_t i) { return m[i]; });
        AuditEntry& e = entry("emitted solve: M*x = b");
        for (std::size_t i = 0; i < s.n; ++i) {
            ex left = -raise(right[i]);
            for (std::size_t j = 0; j < s.n; ++j) left += raise(mass[i >= j ? lower_index(i, j) : lower_index(j, i)]) * raise(x[j]);
            Comparison result{Verdict::wrong};
            try {
                if (NormalForm().is_zero(left)) continue;
            } catch (const NoNormalForm& reason) {
                result = {Verdict::not_checkable, reason.what()};
            }
            if (is_worse(result.verdict, e.result.verdict)) e.result = std::move(result);
        }
    }

    void require(bool holds) {
        if (!holds) entry("emitted solve: M*x = b").result = {Verdict::wrong};
    }

    /// The factors of a constant M that update() computes are those of the solve that was proven. Equal operations are one node.
    void cached_factors() {
        const FunctionCode& update = code_[Function::update];
        Program program = update.program;
        const std::vector<NodeId> expected = factorise(program, code_.solve.n, update.mass);
        for (std::size_t i = 0; i < expected.size(); ++i)
            require(update.results[code_.definition_order.size() + code_.solve.first_cached + i] == expected[i]);
    }

    /// The operations of a function on its M and its right sides are those of the solve that was proven.
    void solve_is_that_one(Function function) {
        const Solve& s = code_.solve;
        const FunctionCode& f = code_[function];
        if (f.factors.empty()) return;  // without an impact nothing is solved
        Program program = f.program;
        if (s.is_constant) {
            const FunctionCode& update = code_[Function::update];
            for (std::size_t i = 0; i < f.factors.size(); ++i) {
                const Node& node = program[f.factors[i]];
                const NodeId computed = update.results[code_.definition_order.size() + s.first_cached + i];
                const bool is_cached = node.kind == Node::Kind::cached && node.index == s.first_cached + i;
                require(is_cached || (f.is_zero(f.factors[i]) && update.is_zero(computed)));
            }
        } else {
            std::size_t row = 0;
            Raiser raise(f.program, code_.atoms, cached_);
            const auto reciprocal = [&](NodeId pivot) {
                const NodeId emitted = f.factors[lower_index(row, row)];
                ++row;
                const bool is_reciprocal = program.reciprocal(pivot) == emitted;
                require(is_reciprocal || prover_.proven_equal(raise(emitted) * raise(pivot), 1));
                return emitted;
            };
            require(factorise(program, s.n, f.mass, reciprocal) == f.factors);
        }
        const auto free = [&](const auto& of) {
            std::vector<NodeId> entries;
            for (const std::size_t j : system_.motion.free) entries.push_back(of(j));
            return entries;
        };
        if (!f.accelerations.empty()) require(solve(program, s.n, f.factors, f.force) == free([&](std::size_t j) { return f.accelerations[j]; }));
        for (std::size_t c = 0; c < f.solved.columns; ++c) {
            const auto column = [&](const CodeMatrix& matrix) {
                std::vector<NodeId> entries;
                for (std::size_t j = 0; j < matrix.rows; ++j) entries.push_back(matrix.at(j, c));
                return entries;
            };
            const bool has_held = f.solved.rows != s.n;
            require(solve(program, s.n, f.factors, column(f.right)) == (has_held ? free([&](std::size_t j) { return f.solved.at(j, c); }) : column(f.solved)));
        }
    }

    const Code& code_;
    const System& system_;
    Prover prover_;
    CachedMeaning cached_;
    std::vector<AuditEntry> entries_;
};

}  // namespace

std::vector<AuditEntry> verify(const Code& code) { return Verification(code).run(); }

}  // namespace dalembert
