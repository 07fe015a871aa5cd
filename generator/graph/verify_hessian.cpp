// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "elements/verdict.hpp"
#include "form/hessian.hpp"
#include "graph/hessian_code.hpp"
#include "graph/verification.hpp"

namespace dalembert {

using GiNaC::ex;

void Verification::hessian() {
    constexpr Function function = Function::hessian;
    const FunctionCode& f = code_[function];
    const SecondPartials derived = second_partials(system_);
    solved_motion(function);
    MovingRaisers raise = moving_raisers(f);
    std::size_t c = 0;
    for (const By by : {By::state, By::input}) {
        const Partials& p = code_.partials(by);
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

GiNaC::exmap Verification::define_adjoints(const FunctionCode& f, MovingRaisers& raise) const {
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

}  // namespace dalembert
