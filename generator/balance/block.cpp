// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/block.hpp"

#include <fmt/format.h>

#include "elements/conduction.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class BlockMaking {
public:
    BlockMaking(HeatNetwork& network, const Block& block, const Scene& scene, const Translator& translate, Symbols& symbols)
        : network_(network), block_(block), scene_(scene), translate_(translate), symbols_(symbols), depth_(value(block.depth)) {}

    void run() {
        const auto states = states_of_cells();
        columns_ = bands(block_.columns);
        rows_ = bands(block_.rows);
        for (std::size_t j = 0; j < rows_.size(); ++j)
            for (std::size_t i = 0; i < columns_.size(); ++i) cells_.push_back(cell(*states[cells_.size()], columns_[i], rows_[j]));
        for (std::size_t j = 0; j < rows_.size(); ++j)
            for (std::size_t i = 0; i + 1 < columns_.size(); ++i) join(at(i, j), at(i + 1, j), x);
        for (std::size_t j = 0; j + 1 < rows_.size(); ++j)
            for (std::size_t i = 0; i < columns_.size(); ++i) join(at(i, j), at(i, j + 1), y);
        side(block_.left, "left", x, 0);
        side(block_.right, "right", x, columns_.size() - 1);
        side(block_.bottom, "bottom", y, 0);
        side(block_.top, "top", y, rows_.size() - 1);
    }

private:
    /// A column or row of cells.
    struct Band {
        std::size_t piece;
        ex width;   ///< m
        ex middle;  ///< m, from the left or the bottom
    };

    enum Direction : std::size_t { x, y };

    struct Cell {
        NodeState* node;
        ex face[2];  ///< across x and y, m^2
        ex half[2];  ///< from its middle to a face, K*m^2/W
    };

    ex value(const ExpressionPtr& e) const { return translate_(e, {}); }

    Cell& at(std::size_t i, std::size_t j) { return cells_[j * columns_.size() + i]; }

    /// How many cells a column or row of pieces has.
    long long count(const std::vector<BlockPiece>& pieces, const char* what) const {
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

    std::vector<const Variable*> states_of_cells() const {
        std::vector<const Variable*> states;
        for (const auto& member : scene_.states)
            if (member.item->name == block_.temperature.name)
                states.push_back(symbols_.find(SymbolKind::state, member.item->name, member.index));
        const long long along_x = count(block_.columns, "column"), along_y = count(block_.rows, "row");
        const Span& place = block_.temperature.span;
        const bool has_none = along_x == 0 || along_y == 0;
        if (has_none || (along_x == 1 && along_y == 1))
            throw Failure(
                Diagnostic{Id::value_out_of_range, place,
                           fmt::format("block '{}' has {}, but needs at least 2", block_.name, has_none ? "no cells" : "1 cell")});
        const auto members = static_cast<long long>(states.size());
        if (members % along_x != 0 || members / along_x != along_y)  // the product may be too large for any number
            throw Failure(Diagnostic{Id::value_out_of_range, place,
                                     fmt::format("block '{}' has {} times {} cells along x and y, but '{}' has {} members", block_.name,
                                                 along_x, along_y, block_.temperature.name, members)});
        return states;
    }

    std::vector<Band> bands(const std::vector<BlockPiece>& pieces) const {
        std::vector<Band> result;
        ex from = 0;
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            const ex length = value(pieces[p].length);
            const int cells = index_value(*pieces[p].cells, scene_, {});
            for (int k = 0; k < cells; ++k)
                result.push_back({p, length / cells, (from + length * GiNaC::numeric(2 * k + 1, 2 * cells)).expand()});
            from += length;
        }
        return result;
    }

    Cell cell(const Variable& state, const Band& column, const Band& row) {
        const auto of_piece = [&](const Block::Table& table) -> const ExpressionPtr& { return Block::at(table, column.piece, row.piece); };
        NodeState& node = network_.nodes.emplace_back(NodeState{NodeState::Kind::storing, fmt::format("{}[{}]", block_.name, state.index),
                                                                &block_, block_.temperature.span, warmth_of(state.symbol), state.position});
        const ex volume = column.width * row.width * depth_;
        const ExpressionPtr& heat_capacity = of_piece(block_.heat_capacity);
        store(node, {{}, heat_capacity, heat_capacity->span}, value(of_piece(block_.density)) * volume, translate_, symbols_, {});
        if (block_.source) {
            const auto& variables = block_.source->variables;
            const Letters place = variables.empty() ? Letters{} : Letters{{variables[0], column.middle}, {variables[1], row.middle}};
            node.source += translate_(*block_.source->body, {}, place) * volume;
        }
        const ex resistivity = 1 / value(of_piece(block_.conductivity));
        return {&node, {row.width * depth_, column.width * depth_}, {column.width * resistivity / 2, row.width * resistivity / 2}};
    }

    void join(const Cell& a, const Cell& b, Direction along) {
        add_link(network_, block_, *a.node, *b.node,
                 exchange(a.face[along] / (a.half[along] + b.half[along]), a.node->warmth, b.node->warmth));
    }

    /// The cells of a side lie across a direction, in the column or row `number`.
    void side(const std::optional<Side>& what, const char* which, Direction across, std::size_t number) {
        BorderState border{fmt::format("{}.{}", block_.name, which)};
        if (what) {
            const NodeState* neighbour = neighbour_at(*what, border.name);
            const std::size_t count = across == x ? rows_.size() : columns_.size();
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
                NodeState{NodeState::Kind::held, name, &block_, what.temperature->span, warmth_of(value(what.temperature)), {}});
        if (!what.node) return nullptr;
        const std::string node =
            what.node->index ? fmt::format("{}[{}]", what.node->name, index_value(*what.node->index, scene_, {})) : what.node->name;
        if (const NodeState* found = network_.find_node(node)) return found;
        throw Failure(Diagnostic{Id::index_out_of_range, what.node->span, fmt::format("the scene has no '{}'", node)});
    }

    ex from_neighbour(const NodeState& neighbour, const Cell& cell, Direction across) {
        const ex heat = exchange(cell.face[across] / cell.half[across], neighbour.warmth, cell.node->warmth);
        add_link(network_, block_, neighbour, *cell.node, heat);
        return heat;
    }

    /// What radiates needs the temperature of the surface; else half a cell and the film stand in series.
    ex from_around(const Boundary& what, const Cell& cell, Direction across, std::string name) {
        const ex& area = cell.face[across];
        const ex flux = what.flux ? value(what.flux) * area : ex(0);
        if (what.emissivity) {
            NodeState& surface = add_sought(network_, std::move(name), block_, what.span, symbols_);
            surface.radiates = surface.is_surface = true;
            surface.source = flux + taken_up(surface.warmth, area, what.coefficient, what.emissivity, what.ambient, translate_);
            from_neighbour(surface, cell, across);
            return surface.source;
        }
        ex heat = flux;
        if (what.coefficient)
            heat = (flux + taken_up(cell.node->warmth, area, what.coefficient, nullptr, what.ambient, translate_)) /
                   (1 + value(what.coefficient) * cell.half[across]);
        cell.node->source += heat;
        return heat;
    }

    HeatNetwork& network_;
    const Block& block_;
    const Scene& scene_;
    const Translator& translate_;
    Symbols& symbols_;
    ex depth_;
    std::vector<Band> columns_, rows_;
    std::vector<Cell> cells_;
};

}  // namespace

void add_block(HeatNetwork& network, const Block& block, const Scene& scene, const Translator& translate, Symbols& symbols) {
    BlockMaking(network, block, scene, translate, symbols).run();
}

}  // namespace dalembert
