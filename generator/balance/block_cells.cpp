// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/block_cells.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

ex BlockBand::middle(const ex& number) const {
    return (from + width * (2 * (number - static_cast<unsigned long>(first)) + 1) / 2).expand();
}

BlockCells::BlockCells(const Block& block, const Scene& scene, const Translator& translate, Symbols& symbols)
    : block_(block), scene_(scene), translate_(translate), symbols_(symbols), depth_(value(block.depth)) {
    const Field* field = scene.find_field(block);
    check_counts(field != nullptr ? static_cast<long long>(field->to) - field->from + 1 : static_cast<long long>(states().size()));
    bands_[x] = bands_of(block.columns);
    bands_[y] = bands_of(block.rows);
}

/// How many cells a column or row of pieces has.
long long BlockCells::cells_of(const std::vector<BlockPiece>& pieces, const char* what) const {
    long long sum = 0;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const int cells = index_value(*pieces[p].cells, scene_, {});
        if (cells < 1)
            throw Failure(
                Diagnostic{Id::value_out_of_range, pieces[p].cells->span,
                           fmt::format("{} {} of block '{}' has {} cells, but needs at least 1", what, p + 1, block_.name, cells)});
        sum += cells;
    }
    return sum;
}

/// `members`: of the family of states.
void BlockCells::check_counts(long long members) const {
    const long long along_x = cells_of(block_.columns, "column"), along_y = cells_of(block_.rows, "row");
    const Span& place = block_.temperature.span;
    const bool has_none = along_x == 0 || along_y == 0;
    if (has_none || (along_x == 1 && along_y == 1))
        throw Failure(Diagnostic{Id::value_out_of_range, place,
                                 fmt::format("block '{}' has {}, but needs at least 2", block_.name, has_none ? "no cells" : "1 cell")});
    if (members % along_x != 0 || members / along_x != along_y)  // the product may be too large for any number
        throw Failure(Diagnostic{Id::value_out_of_range, place,
                                 fmt::format("block '{}' has {} times {} cells along x and y, but '{}' has {} members", block_.name,
                                             along_x, along_y, block_.temperature.name, members)});
}

BlockCells::Bands BlockCells::bands_of(const std::vector<BlockPiece>& pieces) const {
    Bands result;
    ex from = 0;
    std::size_t first = 0;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const ex length = value(pieces[p].length);
        const int cells = index_value(*pieces[p].cells, scene_, {});
        result.push_back({p, first, static_cast<std::size_t>(cells), from, length / cells});
        from += length;
        first += static_cast<std::size_t>(cells);
    }
    return result;
}

const BlockBand& BlockCells::band_of(Direction along, std::size_t number) const {
    const Bands& bands = bands_[along];
    return *std::find_if(bands.begin(), bands.end(), [&](const BlockBand& band) { return number < band.first + band.cells; });
}

BlockExtent BlockCells::extent(const BlockBand& column, const BlockBand& row) const {
    const ex resistivity = 1 / value(Block::at(block_.conductivity, column.piece, row.piece));
    return {{row.width * depth_, column.width * depth_}, {column.width * resistivity / 2, row.width * resistivity / 2}};
}

void BlockCells::fill(NodeState& node, const BlockBand& column, const ex& i, const BlockBand& row, const ex& j) const {
    const ex volume = column.width * row.width * depth_;
    const ExpressionPtr& heat_capacity = Block::at(block_.heat_capacity, column.piece, row.piece);
    store(node, {{}, heat_capacity, heat_capacity->span}, value(Block::at(block_.density, column.piece, row.piece)) * volume, translate_,
          symbols_, {});
    if (!block_.source) return;
    const auto& variables = block_.source->variables;
    const Letters place = variables.empty() ? Letters{} : Letters{{variables[0], column.middle(i)}, {variables[1], row.middle(j)}};
    node.source += translate_(*block_.source->body, {}, place) * volume;
}

NodeState BlockCells::node_of(const Variable& state) const {
    return {NodeState::Kind::storing,       fmt::format("{}[{}]", block_.name, state.index), &block_, block_.temperature.span,
            warmth_of(state.symbol), state.position};
}

std::vector<const Variable*> BlockCells::states() const {
    std::vector<const Variable*> states;
    for (const auto& member : scene_.states)
        if (member.item->name == block_.temperature.name)
            states.push_back(symbols_.find(SymbolKind::state, member.item->name, member.index));
    return states;
}

ex BlockCells::flux_into(const Boundary& side, const ex& area) const { return side.flux ? value(side.flux) * area : ex(0); }

ex BlockCells::convected(const Boundary& side, const BlockExtent& extent, Direction across, const Warmth& cell) const {
    const ex &area = extent.face[across], flux = flux_into(side, area);
    if (!side.coefficient) return flux;
    return (flux + taken_up(cell, area, side.coefficient, nullptr, side.ambient, translate_)) /
           (1 + value(side.coefficient) * extent.half[across]);
}

ex BlockCells::between(const BlockExtent& a, const BlockExtent& b, Direction along, const Warmth& from, const Warmth& to) {
    return exchange(a.face[along] / (a.half[along] + b.half[along]), from, to);
}

ex BlockCells::from_side(const Warmth& side, const BlockExtent& extent, Direction across, const Warmth& cell) {
    return exchange(extent.face[across] / extent.half[across], side, cell);
}

}  // namespace dalembert
