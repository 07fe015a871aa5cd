// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/block.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "balance/field.hpp"
#include "elements/conduction.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class BlockMaking {
public:
    BlockMaking(HeatNetwork& network, const Block& block, const Scene& scene, const Translator& translate, Symbols& symbols)
        : network_(network),
          block_(block),
          scene_(scene),
          translate_(translate),
          symbols_(symbols),
          field_(scene.find_field(block)),
          depth_(value(block.depth)) {}

    void run() {
        const auto states = states_of_cells();
        columns_ = bands(block_.columns);
        rows_ = bands(block_.rows);
        if (field_ != nullptr) {
            network_.fields.push_back(field(states));
            return;
        }
        for (const Band& row : rows_)
            for (std::size_t j = 0; j < row.cells; ++j)
                for (const Band& column : columns_)
                    for (std::size_t i = 0; i < column.cells; ++i) cells_.push_back(cell(*states[cells_.size()], column, i, row, j));
        const std::size_t m = cells_along(columns_), n = cells_along(rows_);
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
    /// Columns or rows of a piece.
    struct Band {
        std::size_t piece, first, cells;
        ex from;   ///< m, from the left or the bottom
        ex width;  ///< of one, m

        /// The middle of the one with this number, m.
        ex middle(const ex& number) const {
            return (from + width * (2 * (number - static_cast<unsigned long>(first)) + 1) / 2).expand();
        }
    };

    enum Direction : std::size_t { x, y };

    /// Of a cell where a column meets a row.
    struct Extent {
        ex face[2];  ///< across x and y, m^2
        ex half[2];  ///< from its middle to a face, K*m^2/W
    };

    struct Cell {
        NodeState* node;
        Extent extent;
    };

    ex value(const ExpressionPtr& e) const { return translate_(e, {}); }

    Cell& at(std::size_t i, std::size_t j) { return cells_[j * cells_along(columns_) + i]; }

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
        const auto members =
            field_ != nullptr ? static_cast<long long>(field_->to) - field_->from + 1 : static_cast<long long>(states.size());
        if (members % along_x != 0 || members / along_x != along_y)  // the product may be too large for any number
            throw Failure(Diagnostic{Id::value_out_of_range, place,
                                     fmt::format("block '{}' has {} times {} cells along x and y, but '{}' has {} members", block_.name,
                                                 along_x, along_y, block_.temperature.name, members)});
        return states;
    }

    std::vector<Band> bands(const std::vector<BlockPiece>& pieces) const {
        std::vector<Band> result;
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

    static std::size_t cells_along(const std::vector<Band>& bands) { return bands.back().first + bands.back().cells; }

    const ExpressionPtr& of_piece(const Block::Table& table, const Band& column, const Band& row) const {
        return Block::at(table, column.piece, row.piece);
    }

    Extent extent(const Band& column, const Band& row) const {
        const ex resistivity = 1 / value(of_piece(block_.conductivity, column, row));
        return {{row.width * depth_, column.width * depth_}, {column.width * resistivity / 2, row.width * resistivity / 2}};
    }

    /// Stores what the material of a cell stores, and takes up its source.
    void fill(NodeState& node, const Band& column, const ex& i, const Band& row, const ex& j) {
        const ex volume = column.width * row.width * depth_;
        const ExpressionPtr& heat_capacity = of_piece(block_.heat_capacity, column, row);
        store(node, {{}, heat_capacity, heat_capacity->span}, value(of_piece(block_.density, column, row)) * volume, translate_, symbols_,
              {});
        if (!block_.source) return;
        const auto& variables = block_.source->variables;
        const Letters place = variables.empty() ? Letters{} : Letters{{variables[0], column.middle(i)}, {variables[1], row.middle(j)}};
        node.source += translate_(*block_.source->body, {}, place) * volume;
    }

    Cell cell(const Variable& state, const Band& column, std::size_t i, const Band& row, std::size_t j) {
        NodeState& node = network_.nodes.emplace_back(NodeState{NodeState::Kind::storing, fmt::format("{}[{}]", block_.name, state.index),
                                                                &block_, block_.temperature.span, warmth_of(state.symbol), state.position});
        fill(node, column, static_cast<unsigned long>(column.first + i), row, static_cast<unsigned long>(row.first + j));
        return {&node, extent(column, row)};
    }

    static ex between(const Extent& a, const Extent& b, Direction along, const Warmth& from, const Warmth& to) {
        return exchange(a.face[along] / (a.half[along] + b.half[along]), from, to);
    }

    void join(const Cell& a, const Cell& b, Direction along) {
        add_link(network_, block_, *a.node, *b.node, between(a.extent, b.extent, along, a.node->warmth, b.node->warmth));
    }

    /// The cells of a side lie across a direction, in the column or row `number`.
    void side(const std::optional<Side>& what, const char* which, Direction across, std::size_t number) {
        BorderState border{fmt::format("{}.{}", block_.name, which)};
        if (what) {
            const NodeState* neighbour = neighbour_at(*what, border.name);
            const std::size_t count = cells_along(across == x ? rows_ : columns_);
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
        const ex heat = exchange(cell.extent.face[across] / cell.extent.half[across], neighbour.warmth, cell.node->warmth);
        add_link(network_, block_, neighbour, *cell.node, heat);
        return heat;
    }

    /// What radiates needs the temperature of the surface.
    ex from_around(const Boundary& what, const Cell& cell, Direction across, std::string name) {
        if (what.emissivity) {
            const ex& area = cell.extent.face[across];
            NodeState& surface = add_sought(network_, std::move(name), block_, what.span, symbols_);
            surface.radiates = surface.is_surface = true;
            surface.source =
                flux_into(what, area) + taken_up(surface.warmth, area, what.coefficient, what.emissivity, what.ambient, translate_);
            from_neighbour(surface, cell, across);
            return surface.source;
        }
        const ex heat = convected(what, cell.extent, across, cell.node->warmth);
        cell.node->source += heat;
        return heat;
    }

    ex flux_into(const Boundary& what, const ex& area) const { return what.flux ? value(what.flux) * area : ex(0); }

    /// Half a cell and the film stand in series.
    ex convected(const Boundary& what, const Extent& extent, Direction across, const Warmth& cell) const {
        const ex &area = extent.face[across], flux = flux_into(what, area);
        if (!what.coefficient) return flux;
        return (flux + taken_up(cell, area, what.coefficient, nullptr, what.ambient, translate_)) /
               (1 + value(what.coefficient) * extent.half[across]);
    }

    CellField field(const std::vector<const Variable*>& states) {
        const auto letter = [&](const char* name) { return symbols_.grid_letter(fmt::format("{}[{}]", name, block_.name)); };
        const BlockLetters place{letter("column"), letter("row")};
        CellField f = make_field(*field_, translate_, symbols_, place);
        const std::size_t stride = f.columns;
        for (const Band& row : rows_)
            for (const Band& column : columns_) {
                const CellRange cells{row.first * stride + column.first, column.cells, row.cells, stride};
                NodeState generic{NodeState::Kind::storing, block_.name, &block_, block_.span, warmth_of(f.here), {}};
                fill(generic, column, place.column, row, place.row);
                f.laws.push_back({cells, generic.source, generic.capacity, generic.stored_energy});
            }
        for (const Direction along : {x, y}) add_faces(f, along);
        add_side(f, block_.left, "left", x, false);
        add_side(f, block_.right, "right", x, true);
        add_side(f, block_.bottom, "bottom", y, false);
        add_side(f, block_.top, "top", y, true);
        for (const Variable* state : states) {
            NodeState& node = network_.nodes.emplace_back(
                NodeState{NodeState::Kind::storing, fmt::format("{}[{}]", block_.name, state->index), &block_, block_.temperature.span,
                          warmth_of(state->symbol), state->position});
            const auto cell = static_cast<std::size_t>(state->index - field_->from);
            fill(node, band_of(columns_, cell % stride), 0, band_of(rows_, cell / stride), 0);
            node.source = 0;  // the loops add it
            node.is_tapped = true;
            f.tapped.push_back(&node);
        }
        refuse_states(f, symbols_);
        return f;
    }

    static const Band& band_of(const std::vector<Band>& bands, std::size_t number) {
        return *std::find_if(bands.begin(), bands.end(), [&](const Band& band) { return number < band.first + band.cells; });
    }

    /// Between cells of one material, and where two meet.
    void add_faces(CellField& f, Direction along) {
        const std::vector<Band>&bands = along == x ? columns_ : rows_, &others = along == x ? rows_ : columns_;
        const std::size_t step = along == x ? 1 : f.columns, step_of_others = along == x ? f.columns : 1;
        const auto add = [&](const Band& other, std::size_t first, std::size_t count, const Band& from, const Band& to) {
            if (count == 0) return;
            CellRange cells{first * step + other.first * step_of_others, count, other.cells, f.columns};
            if (along == y) std::swap(cells.columns, cells.rows);
            const auto extent_of = [&](const Band& band) { return along == x ? extent(band, other) : extent(other, band); };
            f.faces.push_back({cells, step, between(extent_of(from), extent_of(to), along, warmth_of(f.here), warmth_of(f.next))});
        };
        for (const Band& other : others)
            for (std::size_t p = 0; p < bands.size(); ++p) {
                add(other, bands[p].first, bands[p].cells - 1, bands[p], bands[p]);
                if (p + 1 < bands.size()) add(other, bands[p + 1].first - 1, 1, bands[p], bands[p + 1]);
            }
    }

    void add_side(CellField& f, const std::optional<Side>& what, const char* which, Direction across, bool is_last) {
        BorderState border{fmt::format("{}.{}", block_.name, which)};
        if (what) {
            if (what->node || what->emissivity)
                throw Failure(Diagnostic{Id::not_allowed_here, what->span,
                                         fmt::format("block '{}' has {} cells, which a loop computes; its sides must not {}. loops = false "
                                                     "writes the cells out",
                                                     block_.name, f.cells, what->node ? "be joined to a node" : "radiate")});
            const Warmth here = warmth_of(f.here);
            for (const Band& band : across == x ? rows_ : columns_) {
                const std::vector<Band>& bands = across == x ? columns_ : rows_;
                const Band& end = is_last ? bands.back() : bands.front();
                const std::size_t number = is_last ? cells_along(bands) - 1 : 0;
                const Extent nearest = across == x ? extent(end, band) : extent(band, end);
                const CellRange cells = across == x ? CellRange{band.first * f.columns + number, 1, band.cells, f.columns} :
                                                      CellRange{number * f.columns + band.first, band.cells, 1, f.columns};
                f.sides.push_back({cells, border.name,
                                   what->temperature ? exchange(nearest.face[across] / nearest.half[across],
                                                                warmth_of(value(what->temperature)), here) :
                                                       convected(*what, nearest, across, here)});
            }
        }
        network_.borders.push_back(std::move(border));
    }

    HeatNetwork& network_;
    const Block& block_;
    const Scene& scene_;
    const Translator& translate_;
    Symbols& symbols_;
    const Field* field_;  ///< null: every cell is a node
    ex depth_;
    std::vector<Band> columns_, rows_;
    std::vector<Cell> cells_;
};

}  // namespace

void add_block(HeatNetwork& network, const Block& block, const Scene& scene, const Translator& translate, Symbols& symbols) {
    BlockMaking(network, block, scene, translate, symbols).run();
}

}  // namespace dalembert
