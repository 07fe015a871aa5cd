// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/verify_resets.hpp"

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

void compare_reset(const Code& code, const CachedMeaning& cached, const ResetCode& emitted, const Reset& derived,
                   const std::function<void(const ex& emitted, const ex& derived)>& compare) {
    const System& system = code.system;
    const FunctionCode& f = code[Function::resets];
    const Motion& motion = system.motion;
    Raiser raise(f.program, code.atoms, cached);
    for (std::size_t i = 0; i < derived.values.size(); ++i) compare(raise(f.results[emitted.first + i]), derived.values[i].second);
    if (!derived.impact) return;
    const Impact& impact = *derived.impact;
    std::vector<ex> slope;
    for (std::size_t i = 0; i < motion.free.size(); ++i) {
        // What is a number is no letter: it stands for that number elsewhere, too.
        const NodeId node = f.solved.at(i, *emitted.impact);
        if (f.program[node].kind != Node::Kind::constant) raise.define(node, GiNaC::realsymbol("s" + std::to_string(i)));
        slope.push_back(raise(node));
    }
    if (emitted.limited) {
        const ex impulse = GiNaC::realsymbol("impulse");
        Raiser of_impulse = raise;
        of_impulse.define(*emitted.impulse, impulse);
        ex left = GiNaC::numeric(1, roundings_squared);
        for (const ex& s : slope) left -= GiNaC::pow(s * impulse, 2);
        ex beyond = -impact.least;
        for (const ex& factor : impact.direction) beyond += GiNaC::pow(factor, 2);
        compare(of_impulse(*emitted.limited), if_else(beyond, if_else(left, impulse, 0), 0));
        raise.define(*emitted.limited, raise(*emitted.impulse));
    }
    const auto velocity = [&](std::size_t i) { return system.symbols.get(SymbolKind::velocity, motion.free[i]); };
    ex before = impact.drift, after = impact.drift, along = 0;
    std::vector<ex> changed;
    const std::size_t first = emitted.first + derived.values.size();
    for (std::size_t i = 0; i < motion.free.size(); ++i) {
        changed.push_back(raise(f.results[first + i]));
        before += impact.direction[i] * velocity(i);
        after += impact.direction[i] * changed[i];
        along += impact.direction[i] * slope[i];
    }
    compare(after, -impact.restitution * before);
    for (std::size_t i = 0; i < motion.free.size(); ++i)
        compare((changed[i] - velocity(i)) * along, -slope[i] * (1 + impact.restitution) * before);
    for (std::size_t h = 0; h < motion.velocities.size(); ++h) {
        ex held = motion.velocities[h].second.drift;
        for (std::size_t i = 0; i < motion.free.size(); ++i) held += motion.velocities[h].second.jacobian[i] * changed[i];
        compare(raise(f.results[first + motion.free.size() + h]), held);
    }
}

}  // namespace dalembert
