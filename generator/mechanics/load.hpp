// SPDX-License-Identifier: GPL-3.0-or-later
// Forces and moments on rigid bodies and joints, and their moments about a point (2.28)-(2.38).
#pragma once

#include "mechanics/frame.hpp"

namespace dalembert {

/// What one force, moment or bar of a load gives to one of its bodies: a force, and its moment about the point of reference.
struct LoadShare {
    const Item* part;
    std::size_t body;    ///< its place in load_bodies()
    SpaceVector force;   ///< N
    SpaceVector moment;  ///< N m
};

/// What is in equilibrium by itself. A joint is a point, so that its moments are balanced where its forces are.
struct LoadBody {
    std::string name;  ///< empty: the load is one body
    bool is_joint = false;
    std::size_t balances() const { return is_joint ? 3 : 6; }
};

/// The bodies of a load, then its joints.
std::vector<LoadBody> load_bodies(const Load& load);

/// With letters for the unknowns. The two ends of a bar are two shares.
std::vector<LoadShare> load_shares(const Load& load, const Translator& translate, const Letters& unknowns);

/// The length of each bar, m.
std::vector<GiNaC::ex> bar_lengths(const Load& load, const Translator& translate, const Letters& unknowns);

}  // namespace dalembert
