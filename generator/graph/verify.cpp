// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/verify.hpp"

#include "elements/verdict.hpp"
#include "form/chain_motion.hpp"
#include "graph/verification.hpp"
#include "graph/verify_chain.hpp"
#include "graph/verify_operations.hpp"
#include "prove/composite_proof.hpp"

namespace dalembert {

using GiNaC::ex;

std::vector<AuditEntry> Verification::run() {
    for (const HeaderFunction& row : header_functions()) prove(row);
    if (code_.solve.unrolled && code_.solve.n > 0) {
        solve_is_right("emitted solve: M*x = b", code_.solve.n, code_.solve.multipliers, code_.solve.is_zero);
        if (!operations_are_proven(code_, prover_, cached_)) entry("emitted solve: M*x = b").result = {Verdict::wrong};
    }
    for (std::size_t f = 0; f < function_count; ++f) chain_is_solved(static_cast<Function>(f));
    return std::move(entries_);
}

void Verification::prove(const HeaderFunction& row) {
    if (!is_made(row, system_, code_.wished)) return;
    switch (row.kind) {
        case Kind::update: return definitions();
        case Kind::motion: motion(row.function); [[fallthrough]];
        case Kind::jacobian:
            if (row.by) columns(row.function, *row.by);
            return;
        case Kind::output_jacobian: return output_columns(row.function, *row.by);
        case Kind::together: return together();
        case Kind::sample: return sample();
        case Kind::hessian: return hessian();
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

AuditEntry& Verification::entry(const std::string& name) {
    for (AuditEntry& known : entries_)
        if (known.name == name) return known;
    entries_.push_back({name, {Verdict::proven}});
    return entries_.back();
}

void Verification::compare(Function function, const ex& emitted, const ex& derived) {
    AuditEntry& e = entry(std::string("emitted = derived, ") + name_of(function));
    if (e.result.verdict == Verdict::wrong || prover_.proven_equal(emitted, derived)) return;  // it gets no worse
    Comparison result = prover_.equal(emitted, derived);
    if (is_worse(result.verdict, e.result.verdict)) e.result = std::move(result);
}

void Verification::definitions() {
    const FunctionCode& f = code_[Function::update];
    Raiser raise = raiser(f);
    for (std::size_t i = 0; i < code_.definition_order.size(); ++i)
        compare(Function::update, raise(f.results[i]), system_.symbols.definition_values()[code_.definition_order[i]]);
}

GiNaC::exmap Verification::solutions(const FunctionCode& f, Raiser& raise) const {
    GiNaC::exmap map;
    const std::vector<ex> unknowns = system_.unknowns();
    const std::vector<std::size_t> places = system_.unknown_places();
    for (std::size_t i = 0; !solved_for(f).empty() && i < unknowns.size(); ++i) map[unknowns[i]] = raise(solved_for(f)[places[i]]);
    return map;
}

void Verification::motion(Function function) {
    const FunctionCode& f = code_[function];
    solved_motion(function);
    Raiser raise = raiser(f);
    for (std::size_t i = 0; i < system_.state_rates.size(); ++i) compare(function, raise(f.results[i]), system_.state_rates[i]);
}

void Verification::solved_motion(Function function) {
    const FunctionCode& f = code_[function];
    if (solved_for(f).empty()) return;
    Raiser raise = raiser(f);
    if (f.chain) {
        link_proof(function);
        return;
    }
    const SolvedMotion derived = system_.solved_motion();
    const std::vector<ex> derived_mass = lower_triangle(derived.matrix);
    const FunctionCode& m = code_.solve.is_constant ? code_[Function::update] : f;
    Raiser raise_mass = raiser(m), kept_mass = raiser(m, Raiser::Sums::kept_whole), kept = raiser(f, Raiser::Sums::kept_whole);
    for (std::size_t i = 0; i < derived_mass.size(); ++i) compare(function, raise_mass, kept_mass, m.mass[i], derived_mass[i]);
    for (std::size_t j = 0; j < code_.solve.n; ++j) compare(function, raise, kept, f.force[j], derived.force[j]);
    if (system_.motion.accelerations.empty()) return;
    const GiNaC::exmap known = solutions(f, raise);
    for (const auto& [j, acceleration] : system_.motion.accelerations)
        compare(function, raise(solved_for(f)[j]), acceleration.subs(known, GiNaC::subs_options::no_pattern));
}

const Comparison& Verification::equations_of_links() {
    if (of_links_) return *of_links_;
    of_links_ = Comparison{Verdict::proven};
    const auto compare = [&](const ex& meant, const ex& derived) {
        if (of_links_->verdict == Verdict::wrong || by_sums_.proven_equal(meant, derived) || prover_.proven_equal(meant, derived)) return;
        Comparison result = prover_.equal(meant, derived);
        if (is_worse(result.verdict, of_links_->verdict)) of_links_ = std::move(result);
    };
    const bool by_composites = system_.composites && composites_stand_for_links(system_, prover_);
    const MeantMotion meant = by_composites ? meant_motion(*system_.chain, *system_.composites) : meant_motion(*system_.chain);
    for (unsigned i = 0; i < meant.force.size(); ++i) {
        for (unsigned j = 0; j < meant.force.size(); ++j) compare(meant.mass[i][j], system_.motion.matrix(i, j));
        compare(meant.force[i], system_.motion.force[i]);
    }
    return *of_links_;
}

LinkProof Verification::link_proof(Function function) {
    const std::string name = std::string("emitted = derived, ") + name_of(function);
    LinkProof proof(code_[function], code_, cached_, prover_, by_sums_,
                    [=, this](const Prover::Evaluation& evaluate, const ex& emitted, const ex& derived) {
                        if (entry(name).result.verdict == Verdict::wrong) return;  // nothing gets worse
                        Comparison result = prover_.compare_at_points(evaluate, emitted, derived);
                        AuditEntry& e = entry(name);
                        if (is_worse(result.verdict, e.result.verdict)) e.result = std::move(result);
                    });
    proof.links();
    AuditEntry& e = entry(name);
    if (const Comparison& result = equations_of_links(); is_worse(result.verdict, e.result.verdict)) e.result = result;
    return proof;
}

void Verification::chain_columns(Function function, By by) {
    const FunctionCode& f = code_[function];
    link_proof(function).columns(chain_slopes(system_, {by}), by);
    Raiser plain = raiser(f);
    const GiNaC::exmap known = solutions(f, plain);
    const Partials& p = code_.partials(by, false);
    for (std::size_t c = 0; c < p.state_rate.size(); ++c)
        for (std::size_t i = 0; i < p.state_rate[c].size(); ++i)
            compare(function, plain(f.below.at(i, c)), p.state_rate[c][i].subs(known, GiNaC::subs_options::no_pattern));
}

void Verification::chain_is_solved(Function function) {
    const FunctionCode& f = code_[function];
    if (!f.chain) return;
    AuditEntry& e = entry("emitted solve from body to body");
    Comparison result = chain_solve_is_right(f, code_.atoms);
    Raiser raise = raiser(f);
    const auto is_reciprocal = [&](NodeId reciprocal, NodeId pivot) {
        return pivot < f.program.size() && prover_.proven_equal(raise(reciprocal) * raise(pivot), 1);
    };
    if (!chain_is_solved_so(f, is_reciprocal)) result = {Verdict::wrong};
    if (is_worse(result.verdict, e.result.verdict)) e.result = std::move(result);
}

void Verification::columns(Function function, By by) {
    const FunctionCode& f = code_[function];
    if (f.loop) return chain_columns(function, by);
    if (function != Function::rhs_and_jacobian && function != Function::together) solved_motion(function);
    MovingRaisers raise = moving_raisers(f);
    const Partials& p = code_.partials(by);
    for (std::size_t c = 0; c < p.residual.size(); ++c) {
        for (std::size_t j = 0; j < p.residual[c].size(); ++j) compare_moving(function, raise, f.right.at(j, c), -p.residual[c][j]);
        for (std::size_t i = 0; i < p.state_rate[c].size(); ++i) compare_moving(function, raise, f.below.at(i, c), p.state_rate[c][i]);
        held_column(function, f, c, p.held[c]);
    }
}

Verification::MovingRaisers Verification::moving_raisers(const FunctionCode& f) const {
    MovingRaisers raise{raiser(f), raiser(f, Raiser::Sums::kept_whole), raiser(f)};
    const std::vector<ex> unknowns = system_.unknowns();
    const std::vector<std::size_t> places = system_.unknown_places();
    for (std::size_t i = 0; !solved_for(f).empty() && i < unknowns.size(); ++i) {
        raise.with_letters.define(solved_for(f)[places[i]], unknowns[i]);
        raise.with_sums.define(solved_for(f)[places[i]], unknowns[i]);
    }
    return raise;
}

void Verification::compare_moving(Function function, MovingRaisers& raise, NodeId node, const ex& derived) {
    if (is_proven_by_sums(raise.with_sums, node, derived) || prover_.proven_equal(raise.with_letters(node), derived))
        return compare(function, derived, derived);
    compare(function, raise.with_solutions(node),
            derived.subs(solutions(code_[function], raise.with_solutions), GiNaC::subs_options::no_pattern));
}

void Verification::together() {
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

void Verification::sample() {
    motion(Function::sample);
    const FunctionCode& f = code_[Function::sample];
    Raiser raise = raiser(f);
    const std::vector<ex> outputs = output_values(system_);
    for (std::size_t i = 0; i < outputs.size(); ++i)
        compare(Function::sample, raise(f.results[system_.state_rates.size() + i]), outputs[i]);
}

void Verification::held_column(Function function, const FunctionCode& f, std::size_t c, const std::vector<ex>& at_fixed) {
    const Motion& motion = system_.motion;
    if (motion.accelerations.empty()) return;
    Raiser raise = raiser(f);
    const GiNaC::exmap known = solutions(f, raise);
    for (std::size_t i = 0; i < motion.accelerations.size(); ++i) {
        const auto& [j, derived] = motion.accelerations[i];
        ex slope = at_fixed[i];
        for (const std::size_t k : motion.free) slope += partial(derived, acceleration(k)) * raise(f.solved.at(k, c));
        compare(function, raise(f.solved.at(j, c)), slope.subs(known, GiNaC::subs_options::no_pattern));
    }
}

void Verification::solve_is_right(const std::string& name, std::size_t n, std::size_t multipliers, const std::vector<bool>& is_zero) {
    Program program;
    const SolveNodes nodes = solve_in_letters(program, n, multipliers, is_zero);
    Comparison result = solve_gives_solution(program, nodes, n, multipliers, is_zero, code_.atoms);
    if (code_.solve.left_out > 0 && !leaves_out_any(n, multipliers, is_zero)) result = {Verdict::wrong};
    AuditEntry& e = entry(name);
    if (is_worse(result.verdict, e.result.verdict)) e.result = std::move(result);
}

std::vector<AuditEntry> verify(const Code& code) { return Verification(code).run(); }

}  // namespace dalembert
