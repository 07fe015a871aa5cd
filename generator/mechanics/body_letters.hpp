// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mechanics/kinematics.hpp"
#include "symbolic/parts.hpp"

namespace dalembert {

/// Sums that stay letters where a body stands on one that stands on another: along a chain they would grow without end. Of shorter ones
/// less is computed when they are written out.
inline SpaceVector as_letters(const SpaceVector& v, const Frame& own) { return own.base && own.base->base ? kept(v) : v; }

/// force*dv/dqd_j of each coordinate: the generalised forces of a force on what moves with v, both in the same axes.
inline std::vector<GiNaC::ex> slopes_of_power(const SpaceVector& force, const SpaceVector& v, const Symbols& symbols) {
    const LettersInside moving = letters_in(GiNaC::lst{v[0], v[1], v[2]});
    std::vector<GiNaC::ex> result;
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        const GiNaC::ex& qd = symbols.get(SymbolKind::velocity, j);
        result.push_back(moving.contains(qd) ? dot(force, partial_of_kept(v, qd)) : GiNaC::ex(0));
    }
    return result;
}

}  // namespace dalembert
