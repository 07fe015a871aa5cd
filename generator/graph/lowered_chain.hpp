// SPDX-License-Identifier: GPL-3.0-or-later
// A chain of bodies as polynomials over atoms, with the slopes of what each link is made of.
#pragma once

#include "form/jacobian.hpp"
#include "graph/atoms.hpp"

namespace dalembert {

struct LoweredLink {
    std::vector<Polynomial> letters, parts;  ///< values of its letters; ChainLink::parts
    /// By one of its own letters or its base's, or by a column of a Jacobian. What is zero in all is left out.
    struct Slope {
        std::size_t of;
        std::vector<Polynomial> letters, parts;
    };
    std::vector<Slope> by_base, by_own;
    std::array<std::vector<Slope>, 4> by;
};

struct LoweredChain {
    std::vector<LoweredLink> links;
    std::vector<Polynomial> ground, rest;
    struct Column {
        std::size_t of;
        std::vector<Polynomial> ground, rest;
    };
    std::array<std::vector<Column>, 4> by;
};

/// With slopes by the columns of these Jacobians.
LoweredChain lower_chain(const System& system, Atoms& atoms, const std::vector<By>& jacobians);

/// Calls visit(polynomial) for each.
template <class Visit>
void each_polynomial(LoweredChain& chain, const Visit& visit) {
    const auto list = [&](std::vector<Polynomial>& polynomials) {
        for (Polynomial& p : polynomials) visit(p);
    };
    const auto slopes = [&](std::vector<LoweredLink::Slope>& of) {
        for (LoweredLink::Slope& slope : of) {
            list(slope.letters);
            list(slope.parts);
        }
    };
    for (LoweredLink& link : chain.links) {
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
