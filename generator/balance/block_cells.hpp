// SPDX-License-Identifier: GPL-3.0-or-later
// What cells of a block are and take up, by the column and row of pieces in which they lie; for cells that are written out and for loops.
#pragma once

#include "balance/heat_network.hpp"
#include "elements/conduction.hpp"

namespace dalembert {

/// Columns or rows of a piece.
struct BlockBand {
    std::size_t piece, first, cells;
    GiNaC::ex from;   ///< m, from the left or the bottom
    GiNaC::ex width;  ///< of one, m
    /// The middle of the one with this number, m.
    GiNaC::ex middle(const GiNaC::ex& number) const;
};

/// Of a cell, across x and y.
struct BlockExtent {
    GiNaC::ex face[2];  ///< m^2
    GiNaC::ex half[2];  ///< from its middle to a face, K*m^2/W
};

class BlockCells {
public:
    enum Direction : std::size_t { x, y };
    using Bands = std::vector<BlockBand>;

    /// Throws Failure (value-out-of-range: too few cells, or not as many as there are states).
    BlockCells(const Block& block, const Scene& scene, const Translator& translate, Symbols& symbols);

    /// Columns along x, rows along y.
    const Bands& bands(Direction along) const { return bands_[along]; }
    std::size_t count(Direction along) const { return bands_[along].back().first + bands_[along].back().cells; }
    const BlockBand& band_of(Direction along, std::size_t number) const;

    BlockExtent extent(const BlockBand& column, const BlockBand& row) const;
    /// Lets a node store what the material stores, and take up the source, at the column i and the row j.
    void fill(NodeState& node, const BlockBand& column, const GiNaC::ex& i, const BlockBand& row, const GiNaC::ex& j) const;
    /// A node for the cell of a state, without what fills it.
    NodeState node_of(const Variable& state) const;
    /// The states of the cells that the scene has.
    std::vector<const Variable*> states() const;

    /// Through the flux that is given, W.
    GiNaC::ex flux_into(const Boundary& side, const GiNaC::ex& area) const;
    /// Through half a cell and the film, which stand in series, and the flux that is given; W.
    GiNaC::ex convected(const Boundary& side, const BlockExtent& extent, Direction across, const Warmth& cell) const;
    GiNaC::ex value(const ExpressionPtr& e) const { return translate_(e, {}); }

    /// From a cell to the next along a direction, W.
    static GiNaC::ex between(const BlockExtent& a, const BlockExtent& b, Direction along, const Warmth& from, const Warmth& to);
    /// From a side that is held at a temperature, W.
    static GiNaC::ex from_side(const Warmth& side, const BlockExtent& extent, Direction across, const Warmth& cell);

private:
    Bands bands_of(const std::vector<BlockPiece>& pieces) const;
    long long cells_of(const std::vector<BlockPiece>& pieces, const char* what) const;
    void check_counts(long long members) const;

    const Block& block_;
    const Scene& scene_;
    const Translator& translate_;
    Symbols& symbols_;
    GiNaC::ex depth_;
    Bands bands_[2];
};

}  // namespace dalembert
