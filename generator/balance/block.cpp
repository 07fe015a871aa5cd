// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/block.hpp"

#include <fmt/format.h>

#include "balance/block_cells.hpp"
#include "balance/block_field.hpp"
#include "balance/field.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Writes the cells out.
class BlockMaking {
public:
    BlockMaking(HeatNetwork& network, const Block& block, const BlockCells& cells, const Scene& scene, const Translator& translate,
                Symbols& symbols)
        : network_(network), block_(block), cells_(cells), scene_(scene), translate_(translate), symbols_(symbols) {}

    void run() {
        const auto states = cells_.states();
        for (const BlockBand& row : cells_.bands(y))
            for (std::size_t j = 0; j < row.cells; ++j)
                for (const BlockBand& column : cells_.bands(x))
                    for (std::size_t i = 0; i < column.cells; ++i) all_.push_back(cell(*states[all_.size()], column, i, row, j));
        const std::size_t m = cells_.count(x), n = cells_.count(y);
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i + 1 < m; ++i) join(at(i, j), at(i + 1, j), x);
        for (std::size_t j = 0; j + 1 < n; ++j)
            for (std::size_t i = 0; i < m; ++i) join(at(i, j), at(i, j + 1), y);
        side(block_.left, "left", x, 0);
        side(block_.right, "right", x, m - 1);
        side(block_.bottom, "bottom", y, 0);
        side(block_.top, "top", y, n - 1);
    }

private:
    using Direction = BlockCells::Direction;
    static constexpr Direction x = BlockCells::x, y = BlockCells::y;

    struct Cell {
        NodeState* node;
        BlockExtent extent;
    };

    Cell& at(std::size_t i, std::size_t j) { return all_[j * cells_.count(x) + i]; }

    Cell cell(const Variable& state, const BlockBand& column, std::size_t i, const BlockBand& row, std::size_t j) {
        NodeState& node = network_.nodes.emplace_back(cells_.node_of(state));
        cells_.fill(node, column, static_cast<unsigned long>(column.first + i), row, static_cast<unsigned long>(row.first + j));
        return {&node, cells_.extent(column, row)};
    }

    void join(const Cell& a, const Cell& b, Direction along) {
        add_link(network_, block_, *a.node, *b.node, BlockCells::between(a.extent, b.extent, along, a.node->warmth, b.node->warmth));
    }

    /// The cells of a side lie across a direction, in the column or row `number`.
    void side(const std::optional<Side>& what, const char* which, Direction across, std::size_t number) {
        BorderState border{fmt::format("{}.{}", block_.name, which)};
        if (what) {
            const NodeState* neighbour = neighbour_at(*what, border.name);
            const std::size_t count = cells_.count(across == x ? y : x);
            for (std::size_t k = 0; k < count; ++k) {
                const Cell& nearest = across == x ? at(number, k) : at(k, number);
                border.heat += neighbour != nullptr ? from_neighbour(*neighbour, nearest, across)
                                                    : from_around(*what, nearest, across, fmt::format("{}[{}]", border.name, k + 1));
            }
        }
        network_.borders.push_back(std::move(border));
    }

    /// What holds the whole side at its temperature, if anything does.
    const NodeState* neighbour_at(const Side& what, const std::string& name) {
        if (what.temperature)
            return &network_.nodes.emplace_back(
                NodeState{NodeState::Kind::held, name, &block_, what.temperature->span, warmth_of(cells_.value(what.temperature)), {}});
        if (!what.node) return nullptr;
        const std::string node =
            what.node->index ? fmt::format("{}[{}]", what.node->name, index_value(*what.node->index, scene_, {})) : what.node->name;
        if (const NodeState* found = network_.find_node(node)) return found;
        throw Failure(Diagnostic{Id::index_out_of_range, what.node->span, fmt::format("the scene has no '{}'", node)});
    }

    ex from_neighbour(const NodeState& neighbour, const Cell& cell, Direction across) {
        const ex heat = BlockCells::from_side(neighbour.warmth, cell.extent, across, cell.node->warmth);
        add_link(network_, block_, neighbour, *cell.node, heat);
        return heat;
    }

    /// What radiates needs the temperature of the surface.
    ex from_around(const Boundary& what, const Cell& cell, Direction across, std::string name) {
        if (what.emissivity) {
            const ex& area = cell.extent.face[across];
            NodeState& surface = add_sought(network_, std::move(name), block_, what.span, symbols_);
            surface.radiates = surface.is_surface = true;
            surface.source = cells_.flux_into(what, area) +
                             taken_up(surface.warmth, area, what.coefficient, what.emissivity, what.ambient, translate_);
            from_neighbour(surface, cell, across);
            return surface.source;
        }
        const ex heat = cells_.convected(what, cell.extent, across, cell.node->warmth);
        cell.node->source += heat;
        return heat;
    }

    HeatNetwork& network_;
    const Block& block_;
    const BlockCells& cells_;
    const Scene& scene_;
    const Translator& translate_;
    Symbols& symbols_;
    std::vector<Cell> all_;
};

}  // namespace

void add_block(HeatNetwork& network, const Block& block, const Scene& scene, const Translator& translate, Symbols& symbols) {
    const BlockCells cells(block, scene, translate, symbols);
    if (const Field* field = scene.find_field(block)) add_block_field(network, block, cells, *field, translate, symbols);
    else BlockMaking(network, block, cells, scene, translate, symbols).run();
}

}  // namespace dalembert
