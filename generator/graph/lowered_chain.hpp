// SPDX-License-Identifier: GPL-3.0-or-later
// A chain of bodies as polynomials over atoms, with the slopes of what each link is made of.
#pragma once

#include "form/chain_slopes.hpp"
#include "graph/atoms.hpp"

namespace dalembert {

using LoweredChain = ChainSlopes<Polynomial>;

/// With slopes by the columns of these Jacobians.
LoweredChain lower_chain(const System& system, Atoms& atoms, const std::vector<By>& jacobians);

/// Calls visit(polynomial) for each.
template <class Visit>
void each_polynomial(LoweredChain& chain, const Visit& visit) {
    const auto list = [&](std::vector<Polynomial>& polynomials) {
        for (Polynomial& p : polynomials) visit(p);
    };
    const auto slopes = [&](std::vector<ChainSlope<Polynomial>>& of) {
        for (ChainSlope<Polynomial>& slope : of) {
            list(slope.letters);
            list(slope.parts);
        }
    };
    for (LinkSlopes<Polynomial>& link : chain.links) {
        list(link.letters);
        list(link.parts);
        slopes(link.by_base);
        slopes(link.by_own);
        for (auto& by : link.by) slopes(by);
    }
    list(chain.ground);
    list(chain.rest);
    for (auto& by : chain.by)
        for (LoweredChain::Column& column : by) {
            list(column.ground);
            list(column.rest);
        }
}

}  // namespace dalembert
