// SPDX-License-Identifier: GPL-3.0-or-later
// Fields: the cells of a rod or block that are computed in loops. Only those that something else needs are nodes; what all cells do is
// said once, with letters for the place on the grid and for the temperatures of a cell and of its neighbour.
#pragma once

#include <variant>

#include "balance/heat_network.hpp"
#include "balance/rod_geometry.hpp"

namespace dalembert {

/// Cells in a rectangle: first + i + stride*j, with i < columns and j < rows. Counted from 0.
struct CellRange {
    std::size_t first = 0, columns = 0, rows = 1, stride = 0;
    std::size_t count() const { return columns * rows; }
    bool contains(std::size_t cell) const;
    friend bool operator==(const CellRange&, const CellRange&) = default;
};

/// What each cell of a range does by itself.
struct CellLaw {
    CellRange cells;
    GiNaC::ex source;    ///< heat from outside, W
    GiNaC::ex capacity;  ///< J/K
    GiNaC::ex energy;    ///< J
};

/// From each cell of a range to the one that stands `offset` behind it.
struct FaceLaw {
    CellRange cells;
    std::size_t offset;
    GiNaC::ex heat;  ///< W
};

/// Into each cell of a range, through a side of the field.
struct SideLaw {
    CellRange cells;
    std::string border;  ///< "plate.left"
    GiNaC::ex heat;      ///< W
};

/// Letters for the place of a cell. Of a rod: numbers of points or faces on its grid, `beyond` being the right face or neighbour of the
/// next cell.
struct RodLetters {
    RodGeometry geometry;
    GridPlace place;
    GiNaC::ex beyond;
};
/// Of a block: its column and row, counted from 0.
struct BlockLetters {
    GiNaC::ex column, row;
};

/// An equation of a field, for the reader.
struct FieldPart {
    std::string key;    ///< "heat_to_next"
    std::string what;   ///< "heat to the next"
    CellRange cells;
    GiNaC::ex value;
};

/// What all of it does.
struct CellField {
    const Item* body;
    std::string_view kind;         ///< "rod", "block"
    const State* states;
    int first_index;               ///< of the family of states
    std::size_t cells, columns;    ///< all of them; those in a row
    std::variant<RodLetters, BlockLetters> place;
    GiNaC::ex number;              ///< letter for the index of the state
    GiNaC::ex here, next;          ///< letters for the temperatures
    std::vector<CellLaw> laws;     ///< each cell has one
    std::vector<FaceLaw> faces;
    std::vector<SideLaw> sides;
    GiNaC::ex start;               ///< K
    std::vector<const NodeState*> tapped;  ///< the cells that are nodes too

    std::string written() const;   ///< "rod 'bar'"
    int last_index() const { return first_index + static_cast<int>(cells) - 1; }
    /// All cells: of a rod in one row, of a block in its rows.
    CellRange all() const { return is_block() ? CellRange{0, columns, cells / columns, columns} : CellRange{0, cells}; }
    /// Letters for the place, which grow along a rod.
    std::vector<GiNaC::ex> letters() const;
    /// What they are for a cell.
    GiNaC::exmap place_of(std::size_t cell) const;
    /// Of all laws.
    std::vector<GiNaC::ex> expressions() const;
    bool is_block() const { return std::holds_alternative<BlockLetters>(place); }
    /// Faces, sides, and what cells do by themselves.
    std::vector<FieldPart> parts() const;
    /// "heat to the right, columns 1 to 4, rows 1 to 2"
    std::string title(const FieldPart& part) const;
    /// What the rate of a cell is made of, in words.
    std::string balance() const;
};

/// A sum over cells in loops.
struct CellSum {
    std::size_t field;         ///< of the heat network
    CellRange cells;
    GiNaC::ex term;            ///< of one cell
    GiNaC::ex letter;
};

/// Makes the letters of a field of the scene, without what they stand in. Throws Failure (not-allowed-here: a list of start values).
CellField make_field(const Field& field, const Translator& translate, Symbols& symbols, std::variant<RodLetters, BlockLetters> place);
/// What an expression of a cell depends on besides its own temperatures, place, parameters, inputs and time; null where on nothing.
const Variable* variable_outside(const CellField& field, const Symbols& symbols, const GiNaC::ex& e);
/// Throws Failure (not-allowed-here) where a law depends on such: df/dx would have columns that the loops do not fill.
void refuse_variables_outside(const CellField& field, const Symbols& symbols);

}  // namespace dalembert
