// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/block_field.hpp"

#include <fmt/format.h>

#include "balance/field.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

class FieldOfBlock {
public:
    FieldOfBlock(HeatNetwork& network, const Block& block, const BlockCells& cells, const Field& field, const Translator& translate,
                 Symbols& symbols)
        : network_(network),
          block_(block),
          cells_(cells),
          symbols_(symbols),
          place_{letter("column"), letter("row")},
          field_(make_field(field, translate, symbols, place_)),
          here_(warmth_of(field_.here)) {}

    void run() {
        for (const BlockBand& row : cells_.bands(y))
            for (const BlockBand& column : cells_.bands(x)) {
                NodeState generic{NodeState::Kind::storing, block_.name, &block_, block_.span, here_, {}};
                cells_.fill(generic, column, place_.column, row, place_.row);
                field_.laws.push_back({range(column.first, column.cells, row.first, row.cells), generic.source, generic.capacity,
                                       generic.stored_energy});
            }
        faces(x);
        faces(y);
        side(block_.left, "left", x, false);
        side(block_.right, "right", x, true);
        side(block_.bottom, "bottom", y, false);
        side(block_.top, "top", y, true);
        for (const Variable* state : cells_.states()) tap(*state);
        refuse_variables_outside(field_, symbols_);
        network_.fields.push_back(std::move(field_));
    }

private:
    using Direction = BlockCells::Direction;
    static constexpr Direction x = BlockCells::x, y = BlockCells::y;

    GiNaC::ex letter(const char* name) { return symbols_.grid_letter(fmt::format("{}[{}]", name, block_.name)); }

    CellRange range(std::size_t column, std::size_t columns, std::size_t row, std::size_t rows) const {
        return {row * field_.columns + column, columns, rows, field_.columns};
    }
    /// The same along a direction, and across it.
    CellRange range(Direction along, std::size_t first, std::size_t count, const BlockBand& across) const {
        return along == x ? range(first, count, across.first, across.cells) : range(across.first, across.cells, first, count);
    }
    BlockExtent extent(Direction along, const BlockBand& band, const BlockBand& across) const {
        return along == x ? cells_.extent(band, across) : cells_.extent(across, band);
    }

    /// Between cells of one material, and where two meet.
    void faces(Direction along) {
        const BlockCells::Bands& bands = cells_.bands(along);
        for (const BlockBand& across : cells_.bands(along == x ? y : x))
            for (std::size_t p = 0; p < bands.size(); ++p) {
                const auto add = [&](std::size_t first, std::size_t count, const BlockBand& to) {
                    field_.faces.push_back({range(along, first, count, across), along == x ? 1 : field_.columns,
                                            BlockCells::between(extent(along, bands[p], across), extent(along, to, across), along, here_,
                                                                warmth_of(field_.next))});
                };
                const BlockBand& band = bands[p];
                if (band.cells > 1) add(band.first, band.cells - 1, band);
                if (p + 1 < bands.size()) add(band.first + band.cells - 1, 1, bands[p + 1]);
            }
    }

    void side(const std::optional<Side>& what, const char* which, Direction across, bool is_last) {
        BorderState border{fmt::format("{}.{}", block_.name, which)};
        if (what) {
            if (what->node || what->emissivity)
                throw Failure(Diagnostic{Id::not_allowed_here, what->span,
                                         fmt::format("{} has {} cells, which a loop computes; its sides must not {}. loops = false writes "
                                                     "the cells out",
                                                     field_.written(), field_.cells, what->node ? "be joined to a node" : "radiate")});
            const BlockBand& end = is_last ? cells_.bands(across).back() : cells_.bands(across).front();
            const std::size_t number = is_last ? cells_.count(across) - 1 : 0;
            for (const BlockBand& band : cells_.bands(across == x ? y : x)) {
                const BlockExtent nearest = extent(across, end, band);
                field_.sides.push_back({range(across, number, 1, band), border.name,
                                        what->temperature
                                            ? BlockCells::from_side(warmth_of(cells_.value(what->temperature)), nearest, across, here_)
                                            : cells_.convected(*what, nearest, across, here_)});
            }
        }
        network_.borders.push_back(std::move(border));
    }

    /// A cell that something else needs. It stores; its source is what the loops add.
    void tap(const Variable& state) {
        NodeState& node = network_.nodes.emplace_back(cells_.node_of(state));
        const auto cell = static_cast<std::size_t>(state.index - field_.first_index);
        cells_.fill(node, cells_.band_of(x, cell % field_.columns), 0, cells_.band_of(y, cell / field_.columns), 0);
        node.source = 0;
        node.is_tapped = true;
        field_.tapped.push_back(&node);
    }

    HeatNetwork& network_;
    const Block& block_;
    const BlockCells& cells_;
    Symbols& symbols_;
    const BlockLetters place_;
    CellField field_;
    const Warmth here_;
};

}  // namespace

void add_block_field(HeatNetwork& network, const Block& block, const BlockCells& cells, const Field& field, const Translator& translate,
                     Symbols& symbols) {
    FieldOfBlock(network, block, cells, field, translate, symbols).run();
}

}  // namespace dalembert
