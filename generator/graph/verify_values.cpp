// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "elements/verdict.hpp"
#include "graph/verification.hpp"
#include "graph/verify_resets.hpp"

namespace dalembert {

using GiNaC::ex;

void Verification::correction() {
    const FunctionCode& f = code_[Function::correction];
    Raiser raise = raiser(f);
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

void Verification::resets() {
    const auto compare_one = [this](const ex& emitted, const ex& derived) { compare(Function::resets, emitted, derived); };
    for (std::size_t e = 0; e < system_.events.size(); ++e) {
        compare_reset(code_, cached_, code_.resets[e], system_.events[e].reset, compare_one);
        compare_reset(code_, cached_, code_.rests[e], system_.events[e].rest, compare_one);
    }
}

void Verification::values(Function function, const std::vector<ex>& derived) {
    const FunctionCode& f = code_[function];
    solved_motion(function);
    Raiser raise = raiser(f);
    Raiser plain = raiser(f), kept = raiser(f, Raiser::Sums::kept_whole);
    define_solutions(f, raise);
    define_solutions(f, kept);
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
        if (is_proven_by_sums(kept, f.results[i], expected)) compare(function, expected, expected);
        else if (f.solved_for.empty() || prover_.proven_equal(raise(f.results[i]), expected))
            compare(function, raise(f.results[i]), expected);
        else
            compare(function, plain(f.results[i]),
                    expected.subs(rate_solutions(f, plain), GiNaC::subs_options::no_pattern)
                        .subs(solutions(f, plain), GiNaC::subs_options::no_pattern));
    }
}

std::vector<ex> Verification::rates_of_unknowns() const {
    std::vector<ex> letters;
    for (const std::size_t k : system_.motion.free) letters.push_back(system_.symbols.get(SymbolKind::jerk, k));
    for (const std::size_t constraint : system_.motion.multipliers)
        letters.push_back(system_.symbols.get(SymbolKind::multiplier_rate, constraint));
    return letters;
}

GiNaC::exmap Verification::rate_solutions(const FunctionCode& f, Raiser& raise) const {
    GiNaC::exmap map;
    if (f.rates_solved_for.empty()) return map;
    const std::vector<ex> letters = rates_of_unknowns();
    for (std::size_t i = 0; i < letters.size(); ++i) map[letters[i]] = raise(f.rates_solved_for[i]);
    return map;
}

void Verification::define_solutions(const FunctionCode& f, Raiser& raise) const {
    if (f.solved_for.empty()) return;
    const std::vector<ex> unknowns = system_.unknowns();
    const std::vector<std::size_t> places = system_.unknown_places();
    for (std::size_t i = 0; i < unknowns.size(); ++i) raise.define(f.solved_for[places[i]], unknowns[i]);
    const std::vector<ex> rates = f.rates_solved_for.empty() ? std::vector<ex>() : rates_of_unknowns();
    for (std::size_t i = 0; i < rates.size(); ++i) raise.define(f.rates_solved_for[i], rates[i]);
}

void Verification::output_columns(Function function, By by) {
    const FunctionCode& f = code_[function];
    Raiser raise = raiser(f);
    const Partials& p = code_.partials(by, !f.whole_output.entries.empty());
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

void Verification::whole_output(Function function, const FunctionCode& f, const Partials& p) {
    for (std::size_t c = 0; c < p.residual.size(); ++c) {
        Raiser raise = raiser(f);
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

}  // namespace dalembert
