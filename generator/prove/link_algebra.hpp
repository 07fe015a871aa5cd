// SPDX-License-Identifier: GPL-3.0-or-later
// What proofs about one link of a chain, and the one that it is placed on, are made of.
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

/// Six letters, for any twist, or any moment and force.
Twist letters(const char* name);

class LinkAlgebra {
public:
    LinkAlgebra(const System& system, Prover& prover)
        : system_(system), symbols_(system.symbols), chain_(*system.chain), prover_(prover) {}

protected:
    using ex = GiNaC::ex;

    bool same(const ex& a, const ex& b) const;
    bool same(const Twist& a, const Twist& b) const;

    const BodyMotion& body_of(const ChainLink& link) const { return system_.bodies[link.body]; }
    bool has_axes(const ChainLink& link) const { return body_of(link).frame != nullptr; }
    /// Null: the ground.
    const ChainLink* base_of(const ChainLink& link) const { return link.base ? &chain_.links[*link.base] : nullptr; }
    /// The letters of a link, and their values; of the ground zero.
    static Twist twist_of(const ChainLink* link);
    static Twist value_of(const ChainLink& link);
    /// Of one of its own coordinates.
    static const Twist& direction(const ChainLink& link, std::size_t coordinate);

    const System& system_;
    const Symbols& symbols_;
    const Chain& chain_;
    Prover& prover_;
};

}  // namespace dalembert
