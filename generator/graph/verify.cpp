// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/verify.hpp"

#include <algorithm>
#include <set>

#include "form/hessian.hpp"
#include "graph/derived_values.hpp"
#include "graph/raise.hpp"
#include "graph/verify_chain.hpp"
#include "graph/verify_operations.hpp"
#include "graph/verify_resets.hpp"
#include "graph/verify_solve.hpp"
#include "elements/verdict.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class Verification {
public:
    explicit Verification(const Code& code) : code_(code), system_(code.system), prover_(code.system), cached_(cached_meaning(code)) {}

    std::vector<AuditEntry> run() {
        for (const HeaderFunction& row : header_functions()) prove(row);
        if (code_.solve.unrolled && code_.solve.n > 0) {
            solve_is_right("emitted solve: M*x = b", code_.solve.n, code_.solve.multipliers, code_.solve.is_zero);
            if (!operations_are_proven(code_, prover_, cached_)) entry("emitted solve: M*x = b").result = {Verdict::wrong};
        }
        for (std::size_t f = 0; f < function_count; ++f) chain_is_solved(static_cast<Function>(f));
        return std::move(entries_);
    }

private:
    using Kind = HeaderFunction::Kind;

    void prove(const HeaderFunction& row) {
        switch (row.kind) {
            case Kind::update: return definitions();
            case Kind::motion: motion(row.function); [[fallthrough]];
            case Kind::jacobian:
                if (row.by) columns(row.function, *row.by);
                return;
            case Kind::output_jacobian: return output_columns(row.function, *row.by);
            case Kind::together:
                if (code_.wished.contains(row.function)) together();
                return;
            case Kind::hessian:
                if (code_.wished.contains(row.function)) hessian();
                return;
            case Kind::resets: return resets();
            case Kind::correction:
                if (system_.needs_projection()) correction();
                return;
            case Kind::start:
            case Kind::symmetric:
            case Kind::values:
            case Kind::number:
            case Kind::matrix:
            case Kind::event_values:
            case Kind::conditions: return values(row.function, row.values(system_));
        }
    }

    AuditEntry& entry(const std::string& name) {
        for (AuditEntry& known : entries_)
            if (known.name == name) return known;
        entries_.push_back({name, {Verdict::proven}});
        return entries_.back();
    }

    void compare(Function function, const ex& emitted, const ex& derived) {
        AuditEntry& e = entry(std::string("emitted = derived, ") + name_of(function));
        if (e.result.verdict == Verdict::wrong || prover_.proven_equal(emitted, derived)) return;  // it gets no worse
        Comparison result = prover_.equal(emitted, derived);
        if (is_worse(result.verdict, e.result.verdict)) e.result = std::move(result);
    }

    void definitions() {
        const FunctionCode& f = code_[Function::update];
        Raiser raise(f.program, code_.atoms, cached_);
        for (std::size_t i = 0; i < code_.definition_order.size(); ++i)
            compare(Function::update, raise(f.results[i]), system_.symbols.definition_values()[code_.definition_order[i]]);
    }

    const ex& acceleration(std::size_t j) const { return system_.symbols.get(SymbolKind::acceleration, j); }

    GiNaC::exmap solutions(const FunctionCode& f, Raiser& raise) const {
        GiNaC::exmap map;
        const std::vector<ex> unknowns = system_.unknowns();
        const std::vector<std::size_t> places = system_.unknown_places();
        for (std::size_t i = 0; !solved_for(f).empty() && i < unknowns.size(); ++i) map[unknowns[i]] = raise(solved_for(f)[places[i]]);
        return map;
    }

    /// M and the right sides, the accelerations that follow from what is solved for, and rates of states.
    void motion(Function function) {
        const FunctionCode& f = code_[function];
        solved_motion(function);
        Raiser raise(f.program, code_.atoms, cached_);
        for (std::size_t i = 0; i < system_.state_rates.size(); ++i) compare(function, raise(f.results[i]), system_.state_rates[i]);
    }

    void solved_motion(Function function) {
        const FunctionCode& f = code_[function];
        if (solved_for(f).empty()) return;
        Raiser raise(f.program, code_.atoms, cached_);
        if (f.chain) return chain_motion(function, raise);
        const SolvedMotion derived = system_.solved_motion();
        const std::vector<ex> derived_mass = lower_triangle(derived.matrix);
        const FunctionCode& m = code_.solve.is_constant ? code_[Function::update] : f;
        Raiser raise_mass(m.program, code_.atoms, cached_);
        for (std::size_t i = 0; i < derived_mass.size(); ++i) compare(function, raise_mass(m.mass[i]), derived_mass[i]);
        for (std::size_t j = 0; j < code_.solve.n; ++j) compare(function, raise(f.force[j]), derived.force[j]);
        if (system_.motion.accelerations.empty()) return;
        const GiNaC::exmap known = solutions(f, raise);
        for (const auto& [j, acceleration] : system_.motion.accelerations)
            compare(function, raise(solved_for(f)[j]), acceleration.subs(known, GiNaC::subs_options::no_pattern));
    }

    /// The equations of the links mean M and Q - bias; what solves them was proven to.
    void chain_motion(Function function, Raiser& raise) {
        const FunctionCode& f = code_[function];
        const MeantMotion meant = meant_motion(f.chain->links, f.chain->loads, raise);
        for (unsigned i = 0; i < meant.force.size(); ++i) {
            for (unsigned j = 0; j < meant.force.size(); ++j) compare(function, meant.mass[i][j], system_.motion.matrix(i, j));
            compare(function, meant.force[i], system_.motion.force[i]);
        }
    }

    /// The loads of each column, in the same equations, are what the residual changes by.
    void chain_columns(Function function, By by) {
        const FunctionCode& f = code_[function];
        const Partials p = partials(system_, by);
        Raiser plain(f.program, code_.atoms, cached_);
        const MeantColumns columns(f, system_, plain);
        const GiNaC::exmap known = solutions(f, plain);
        const auto with_solutions = [&](const ex& e) { return e.subs(known, GiNaC::subs_options::no_pattern); };
        const AuditEntry& e = entry(std::string("emitted = derived, ") + name_of(function));
        const auto is_open = [&] { return e.result.verdict != Verdict::wrong; };  // with solutions for letters comparisons take long
        for (std::size_t c = 0; c < p.residual.size() && is_open(); ++c) {
            const std::vector<ex> meant = columns.with_letters(c);
            for (std::size_t j = 0; j < meant.size() && is_open(); ++j)
                if (!prover_.proven_equal(meant[j], -p.residual[c][j]))
                    compare(function, columns.with_solutions(c)[j], with_solutions(-p.residual[c][j]));
            for (std::size_t i = 0; i < p.state_rate[c].size(); ++i)
                compare(function, plain(f.below.at(i, c)), with_solutions(p.state_rate[c][i]));
        }
    }

    void chain_is_solved(Function function) {
        const FunctionCode& f = code_[function];
        if (!f.chain) return;
        AuditEntry& e = entry("emitted solve from body to body");
        Comparison result = chain_solve_is_right(f, code_.atoms);
        Raiser raise(f.program, code_.atoms, cached_);
        const auto is_reciprocal = [&](NodeId reciprocal, NodeId pivot) {
            return pivot < f.program.size() && prover_.proven_equal(raise(reciprocal) * raise(pivot), 1);
        };
        if (!chain_is_solved_so(f, is_reciprocal)) result = {Verdict::wrong};
        if (is_worse(result.verdict, e.result.verdict)) e.result = std::move(result);
    }

    /// In the code of the joint function accelerations are solutions; for the comparison they are letters again. Where the same
    /// operations happen to stand for an acceleration and for something else, the solutions are put into the derivation instead.
    void columns(Function function, By by) {
        const FunctionCode& f = code_[function];
        if (f.loop) return chain_columns(function, by);
        if (function != Function::rhs_and_jacobian && function != Function::together) solved_motion(function);
        MovingRaisers raise = moving_raisers(f);
        const Partials p = partials(system_, by);
        for (std::size_t c = 0; c < p.residual.size(); ++c) {
            for (std::size_t j = 0; j < p.residual[c].size(); ++j) compare_moving(function, raise, f.right.at(j, c), -p.residual[c][j]);
            for (std::size_t i = 0; i < p.state_rate[c].size(); ++i) compare_moving(function, raise, f.below.at(i, c), p.state_rate[c][i]);
            held_column(function, f, c, p.held[c]);
        }
    }

    struct MovingRaisers {
        Raiser with_letters, with_solutions;
    };

    MovingRaisers moving_raisers(const FunctionCode& f) const {
        MovingRaisers raise{Raiser(f.program, code_.atoms, cached_), Raiser(f.program, code_.atoms, cached_)};
        const std::vector<ex> unknowns = system_.unknowns();
        const std::vector<std::size_t> places = system_.unknown_places();
        for (std::size_t i = 0; !solved_for(f).empty() && i < unknowns.size(); ++i)
            raise.with_letters.define(solved_for(f)[places[i]], unknowns[i]);
        return raise;
    }

    void compare_moving(Function function, MovingRaisers& raise, NodeId node, const ex& derived) {
        if (prover_.proven_equal(raise.with_letters(node), derived)) return compare(function, derived, derived);
        compare(function, raise.with_solutions(node),
                derived.subs(solutions(code_[function], raise.with_solutions), GiNaC::subs_options::no_pattern));
    }

    /// Rates and Jacobian, and behind them outputs and energies.
    void together() {
        const FunctionCode& f = code_[Function::together];
        motion(Function::together);
        columns(Function::together, By::state);
        MovingRaisers raise = moving_raisers(f);
        GiNaC::exmap held;
        for (const auto& [j, acceleration] : system_.motion.accelerations) held[this->acceleration(j)] = acceleration;
        std::vector<ex> values = output_values(system_);
        for (const HeaderFunction& row : header_functions())
            if (row.energy != nullptr) values.push_back(row.values(system_).front());
        for (std::size_t i = 0; i < values.size(); ++i)
            compare_moving(Function::together, raise, f.results[system_.state_rates.size() + i],
                           values[i].subs(held, GiNaC::subs_options::no_pattern));
    }

    /// Its parts as they are derived, in letters of the unknowns and of w, and made of them as note [Hessian] says.
    void hessian() {
        constexpr Function function = Function::hessian;
        const FunctionCode& f = code_[function];
        const SecondPartials derived = second_partials(system_);
        solved_motion(function);
        MovingRaisers raise = moving_raisers(f);
        std::size_t c = 0;
        for (const By by : {By::state, By::input}) {
            const Partials p = partials(system_, by);
            for (std::size_t k = 0; k < p.residual.size(); ++k, ++c) {
                for (std::size_t j = 0; j < p.residual[k].size(); ++j) compare_moving(function, raise, f.right.at(j, c), -p.residual[k][j]);
                held_column(function, f, c, p.held[k]);
            }
        }
        for (std::size_t i = 0; i < derived.adjoint.size(); ++i) compare_moving(function, raise, f.second->right[i], derived.adjoint[i]);
        const GiNaC::exmap known = define_adjoints(f, raise);
        const auto compare_part = [&](NodeId node, const ex& part) {
            compare_moving(function, raise, node, part.subs(known, GiNaC::subs_options::no_pattern));
        };
        for (std::size_t i = 0; i < derived.direct.size(); ++i) compare_part(f.second->direct[i], derived.direct[i]);
        for (c = 0; c < derived.mixed.size(); ++c)
            for (std::size_t i = 0; i < derived.mixed[c].size(); ++i) compare_part(f.second->mixed.at(i, c), derived.mixed[c][i]);
        Program program = f.program;
        if (hessian_of(program, f, system_.unknown_places()) != f.results)
            entry(std::string("emitted = derived, ") + name_of(function)).result = {Verdict::wrong};
    }

    /// Each w is a letter again, unless its node stands for something else as well: then the letter is what the node is.
    GiNaC::exmap define_adjoints(const FunctionCode& f, MovingRaisers& raise) const {
        GiNaC::exmap known;
        std::set<NodeId> taken;
        for (std::size_t i = 0; i < f.second->solved.size(); ++i) {
            const NodeId node = f.second->solved[i];
            const ex& letter = system_.symbols.get(SymbolKind::adjoint, i);
            const Node::Kind kind = f.program[node].kind;
            if (kind == Node::Kind::constant || kind == Node::Kind::symbol || kind == Node::Kind::cached || !taken.insert(node).second) {
                known[letter] = raise.with_letters(node);
                continue;
            }
            raise.with_letters.define(node, letter);
            raise.with_solutions.define(node, letter);
        }
        return known;
    }

    /// By the chain rule through the free accelerations, whose slopes are letters here.
    void held_column(Function function, const FunctionCode& f, std::size_t c, const std::vector<ex>& at_fixed) {
        const Motion& motion = system_.motion;
        if (motion.accelerations.empty()) return;
        Raiser raise(f.program, code_.atoms, cached_);
        const GiNaC::exmap known = solutions(f, raise);
        for (std::size_t i = 0; i < motion.accelerations.size(); ++i) {
            const auto& [j, derived] = motion.accelerations[i];
            ex slope = at_fixed[i];
            for (const std::size_t k : motion.free) slope += partial(derived, acceleration(k)) * raise(f.solved.at(k, c));
            compare(function, raise(f.solved.at(j, c)), slope.subs(known, GiNaC::subs_options::no_pattern));
        }
    }

    /// The correction that brings a run back to constraints.
    void correction() {
        const FunctionCode& f = code_[Function::correction];
        Raiser raise(f.program, code_.atoms, cached_);
        std::vector<std::size_t> holding;
        for (std::size_t i = 0; i < system_.constraints.size(); ++i)
            if (system_.constraints[i].holds) holding.push_back(i);
        const std::size_t n = system_.symbols.degrees(), constraints = holding.size();
        const std::vector<ex> mass = lower_triangle(system_.metric()), jacobian = constraint_jacobian(system_);
        std::vector<bool> is_zero;
        for (std::size_t i = 0; i < n + constraints; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                const NodeId node = f.mass[lower_index(i, j)];
                is_zero.push_back(f.is_zero(node));
                compare(Function::correction, raise(node),
                        i < n   ? mass[lower_index(i, j)]
                        : j < n ? ex(-jacobian[holding[i - n] * n + j])
                                : ex(0));
            }
        for (std::size_t i = 0; i < n + constraints; ++i)
            compare(Function::correction, raise(f.force[i]),
                    i < n ? ex(0) : ex(-system_.symbols.get(SymbolKind::residual, holding[i - n])));
        solve_is_right("emitted solve of constraints: M*x = b", n + constraints, constraints, is_zero);
        Program program = f.program;
        const bool is_that_one =
            factorise(program, n + constraints, constraints, f.mass, nullptr, chosen_of_held(program, code_, holding)) == f.factors &&
            solve(program, n + constraints, f.factors, f.force) == f.solved_for;
        if (!is_that_one) entry("emitted solve of constraints: M*x = b").result = {Verdict::wrong};
    }

    void resets() {
        const auto compare_one = [this](const ex& emitted, const ex& derived) { compare(Function::resets, emitted, derived); };
        for (std::size_t e = 0; e < system_.events.size(); ++e) {
            compare_reset(code_, cached_, code_.resets[e], system_.events[e].reset, compare_one);
            compare_reset(code_, cached_, code_.rests[e], system_.events[e].rest, compare_one);
        }
    }

    /// Values may contain what was solved for on the way, and its rates; these are letters in the comparison.
    void values(Function function, const std::vector<ex>& derived) {
        const FunctionCode& f = code_[function];
        solved_motion(function);
        Raiser raise(f.program, code_.atoms, cached_);
        Raiser plain(f.program, code_.atoms, cached_);
        define_solutions(f, raise);
        GiNaC::exmap held;
        if (!f.solved_for.empty())
            for (const auto& [j, acceleration] : system_.motion.accelerations) held[this->acceleration(j)] = acceleration;
        if (!f.rates_solved_for.empty()) {
            const std::vector<ex> rates = motion_rates(system_), jerks = held_jerks(system_);
            for (std::size_t i = 0; i < rates.size(); ++i)
                compare(function, plain(f.right.at(i, 0)),
                        rates[i].subs(held, GiNaC::subs_options::no_pattern).subs(solutions(f, plain), GiNaC::subs_options::no_pattern));
            for (std::size_t i = 0; i < jerks.size(); ++i)
                held[system_.symbols.get(SymbolKind::jerk, system_.motion.accelerations[i].first)] =
                    jerks[i].subs(held, GiNaC::subs_options::no_pattern);
        }
        for (std::size_t i = 0; i < derived.size(); ++i) {
            const ex expected = held.empty() ? derived[i] : derived[i].subs(held, GiNaC::subs_options::no_pattern);
            if (f.solved_for.empty() || prover_.proven_equal(raise(f.results[i]), expected))
                compare(function, raise(f.results[i]), expected);
            else
                compare(function, plain(f.results[i]),
                        expected.subs(rate_solutions(f, plain), GiNaC::subs_options::no_pattern)
                            .subs(solutions(f, plain), GiNaC::subs_options::no_pattern));
        }
    }

    std::vector<ex> rates_of_unknowns() const {
        std::vector<ex> letters;
        for (const std::size_t k : system_.motion.free) letters.push_back(system_.symbols.get(SymbolKind::jerk, k));
        for (const std::size_t constraint : system_.motion.multipliers)
            letters.push_back(system_.symbols.get(SymbolKind::multiplier_rate, constraint));
        return letters;
    }

    GiNaC::exmap rate_solutions(const FunctionCode& f, Raiser& raise) const {
        GiNaC::exmap map;
        if (f.rates_solved_for.empty()) return map;
        const std::vector<ex> letters = rates_of_unknowns();
        for (std::size_t i = 0; i < letters.size(); ++i) map[letters[i]] = raise(f.rates_solved_for[i]);
        return map;
    }

    /// What was solved for on the way becomes letters again.
    void define_solutions(const FunctionCode& f, Raiser& raise) const {
        if (f.solved_for.empty()) return;
        const std::vector<ex> unknowns = system_.unknowns();
        const std::vector<std::size_t> places = system_.unknown_places();
        for (std::size_t i = 0; i < unknowns.size(); ++i) raise.define(f.solved_for[places[i]], unknowns[i]);
        const std::vector<ex> rates = f.rates_solved_for.empty() ? std::vector<ex>() : rates_of_unknowns();
        for (std::size_t i = 0; i < rates.size(); ++i) raise.define(f.rates_solved_for[i], rates[i]);
    }

    void output_columns(Function function, By by) {
        const FunctionCode& f = code_[function];
        Raiser raise(f.program, code_.atoms, cached_);
        const Partials p = partials(system_, by);
        const auto by_acceleration = output_by_acceleration(system_);
        solved_motion(function);
        const GiNaC::exmap known = solutions(f, raise);
        GiNaC::exmap held;
        if (!f.solved_for.empty())
            for (const auto& [j, acceleration] : system_.motion.accelerations) held[this->acceleration(j)] = acceleration;
        const auto with = [&](const ex& e) {
            return known.empty() ? e : e.subs(held, GiNaC::subs_options::no_pattern).subs(known, GiNaC::subs_options::no_pattern);
        };
        for (std::size_t i = 0; i < system_.outputs.size(); ++i) {
            for (std::size_t c = 0; c < p.output.size(); ++c) compare(function, raise(f.by_output.at(i, c)), with(p.output[c][i]));
            for (std::size_t c = 0; c < by_acceleration.size(); ++c)
                compare(function, raise(f.by_acceleration.at(i, c)), with(by_acceleration[c][i]));
        }
        if (!f.whole_output.entries.empty()) whole_output(function, f, p);
    }

    /// The slopes of outputs are made of those that were compared, by the chain rule.
    void whole_output(Function function, const FunctionCode& f, const Partials& p) {
        for (std::size_t c = 0; c < p.residual.size(); ++c) {
            Raiser raise(f.program, code_.atoms, cached_);
            const GiNaC::exmap known = solutions(f, raise);
            for (std::size_t j = 0; j < p.residual[c].size(); ++j)
                compare(function, raise(f.right.at(j, c)), (-p.residual[c][j]).subs(known, GiNaC::subs_options::no_pattern));
        }
        Program program = f.program;
        for (std::size_t c = 0; c < f.whole_output.columns; ++c)
            for (std::size_t r = 0; r < f.whole_output.rows; ++r) {
                std::vector<std::pair<bool, NodeId>> terms{{false, f.by_output.at(r, c)}};
                for (std::size_t k = 0; k < f.solved.rows; ++k)
                    terms.emplace_back(false, program.product({f.by_acceleration.at(r, k), f.solved.at(k, c)}));
                if (program.sum(std::move(terms)) != f.whole_output.at(r, c))
                    entry(std::string("emitted = derived, ") + name_of(function)).result = {Verdict::wrong};
            }
    }

    void solve_is_right(const std::string& name, std::size_t n, std::size_t multipliers, const std::vector<bool>& is_zero) {
        Program program;
        const SolveNodes nodes = solve_in_letters(program, n, multipliers, is_zero);
        Comparison result = solve_gives_solution(program, nodes, n, multipliers, is_zero, code_.atoms);
        if (code_.solve.left_out > 0 && !leaves_out_any(n, multipliers, is_zero)) result = {Verdict::wrong};
        AuditEntry& e = entry(name);
        if (is_worse(result.verdict, e.result.verdict)) e.result = std::move(result);
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
