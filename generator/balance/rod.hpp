// SPDX-License-Identifier: GPL-3.0-or-later
// Rods: the heat equation (4.4) in one direction, cut into cells that balance their heat. Each is a node, and each face between two
// cells a link, so that steady heat flows of constant or temperature-dependent conductivity are exact. Of a rod with many cells only
// those that something else needs are nodes; what all cells do among themselves is said once, with letters for the place on the grid.
#pragma once

#include "balance/heat_network.hpp"
#include "balance/rod_geometry.hpp"

namespace dalembert {

/// What the cells of a rod do, in letters: for one cell, and for the heat from it to the next.
struct RodField {
    const Rod* rod;
    const State* states;
    int first_index;               ///< of the family of states
    RodGeometry geometry;
    GridPlace place;               ///< letters
    GiNaC::ex beyond;              ///< the right face or neighbour of the next cell
    GiNaC::ex number;              ///< letter for the index of the state
    GiNaC::ex here, next;          ///< letters for the temperatures
    GiNaC::ex link;                ///< heat to the next cell, W
    GiNaC::ex source;              ///< heat from outside, W
    GiNaC::ex capacity;            ///< J/K
    GiNaC::ex energy;              ///< J
    GiNaC::ex start;               ///< K
    std::vector<const NodeState*> tapped;  ///< the cells that are nodes too
};

/// A sum over cells of a rod in loops.
struct CellSum {
    std::size_t field;         ///< of the heat network
    std::size_t first, last;   ///< the cells, counted from 0
    GiNaC::ex term;            ///< of one cell
    GiNaC::ex letter;
};

/// Adds the cells of a rod, "bar[k]" with k as in its states, the links between them, and what holds at its ends and sides. Ends at
/// which a temperature is given, and with the scheme "cells" surfaces that exchange heat, are nodes "bar.first" and "bar.last".
/// Throws Failure (value-out-of-range: fewer than two cells; cannot-integrate; not-allowed-here).
void add_rod(HeatNetwork& network, const Rod& rod, const Scene& scene, const Translator& translate, Symbols& symbols);

}  // namespace dalembert
