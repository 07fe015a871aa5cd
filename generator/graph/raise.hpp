// SPDX-License-Identifier: GPL-3.0-or-later
// From code back to GiNaC, so that what is emitted can be proven equal to what was derived.
#pragma once

#include <ginac/ginac.h>

#include "graph/code.hpp"

namespace dalembert {

/// What a polynomial over atoms stands for.
GiNaC::ex raised(const Polynomial& p, const Atoms& atoms);

/// What cached values stand for.
using CachedMeaning = std::function<GiNaC::ex(std::uint32_t)>;

class Raiser {
public:
    enum class Sums { open, kept_whole };
    Raiser(const Program& program, const Atoms& atoms, CachedMeaning cached, Sums sums = Sums::open)
        : program_(program), atoms_(atoms), cached_(std::move(cached)), sums_(sums) {}
    GiNaC::ex operator()(NodeId id);
    /// Takes a node for a letter instead of raising it.
    void define(NodeId id, const GiNaC::ex& letter) { known_[id] = letter; }

private:
    GiNaC::ex raise(const Node& node);
    GiNaC::ex element(const Node& node) const;

    const Program& program_;
    const Atoms& atoms_;
    CachedMeaning cached_;
    Sums sums_;
    std::map<NodeId, GiNaC::ex> known_;
};

/// The meaning of cached values from the code that fills them.
CachedMeaning cached_meaning(const Code& code);

}  // namespace dalembert
