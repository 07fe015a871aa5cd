// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes, links, rods, blocks and enclosures as they were written.
#pragma once

#include <array>

#include "elements/item.hpp"

namespace dalembert {

/// Of a liquid: at a temperature, heat makes steam of it, which leaves.
struct Boiling {
    ExpressionPtr temperature;
    ExpressionPtr enthalpy;  ///< J/kg, of evaporation
    ExpressionPtr mass;      ///< the state that is what is left
};

/// A place with one temperature. With a capacity the temperature is a state, which a scene may leave out; without one it is held at
/// an expression, or, where none is given, follows from the balance of what flows in.
struct HeatNode : Item {
    ExpressionPtr temperature;
    std::optional<Property> capacity;  ///< J/K, or a law "T -> ..."
    std::optional<Boiling> boiling;
    ExpressionPtr heat;                ///< W into it, from outside

    bool is_held() const { return temperature && !capacity; }
};

/// Heat from one node, volume, reservoir or cell of a rod or block to another.
struct Link : Item {
    enum class Law { given, linear, conduction, convection, radiation };
    Law law = Law::given;
    Reference from;
    Reference to;
    ExpressionPtr heat;
    ExpressionPtr conductance;
    ExpressionPtr resistance;
    std::optional<Property> conductivity;  ///< W/(m K), or a law "T -> ..."
    ExpressionPtr area;
    ExpressionPtr length;
    ExpressionPtr coefficient;
    ExpressionPtr emissivity;
};

/// What holds at one end of a rod or side of a block: nothing (insulated), or some of these.
struct Boundary {
    ExpressionPtr temperature;      ///< first kind (4.9a)
    ExpressionPtr flux;             ///< second kind (4.9b), W/m^2 into the body
    ExpressionPtr coefficient;      ///< third kind (4.9c)
    ExpressionPtr emissivity;       ///< radiation to a large surrounding
    ExpressionPtr ambient;          ///< temperature of the surrounding, for the last two
    std::optional<Reference> node;  ///< in perfect contact with it; of a block
    Span span;
};

/// A body in which heat flows in one direction: a bar, the wall of a pipe, a shell. Its temperatures are a family of states.
struct Rod : Item {
    enum class Scheme { points, cells };
    enum class Shape { bar, cylinder, sphere };
    Scheme scheme = Scheme::points;
    Shape shape = Shape::bar;
    Reference temperature;
    ExpressionPtr length;
    std::optional<Property> area;  ///< of a bar: an expression, or a law "x -> ..."
    ExpressionPtr inner, outer;    ///< radii of a cylinder or sphere
    ExpressionPtr height;          ///< of a cylinder
    std::optional<Law> grid;       ///< from 0..1 to 0..1: where the cells lie; uniform without
    std::optional<Property> conductivity;   ///< an expression, or a law "T -> ..."
    ExpressionPtr density;
    std::optional<Property> heat_capacity;  ///< likewise
    std::optional<Property> source;         ///< W/m^3, an expression or a law "x -> ..."
    ExpressionPtr perimeter;
    ExpressionPtr side_coefficient;
    ExpressionPtr side_emissivity;
    ExpressionPtr ambient;
    std::optional<bool> loops;     ///< whether its cells are computed in loops; decided by their number without
    std::optional<Boundary> first;
    std::optional<Boundary> last;
};

/// A stretch of a block along x or y, cut into equal cells.
struct BlockPiece {
    ExpressionPtr length;  ///< m
    ExpressionPtr cells;
};

/// A rectangle in which heat flows in two directions, pieced together of columns and rows, each meeting of which has its material. Its
/// temperatures are a family of states, row by row from the bottom, each from the left.
struct Block : Item {
    /// One expression for all (a single entry), or one for each piece: [column][row].
    using Table = std::vector<std::vector<ExpressionPtr>>;
    Reference temperature;
    std::vector<BlockPiece> columns, rows;
    ExpressionPtr depth;
    Table conductivity, density, heat_capacity;
    Span conductivity_span, density_span, heat_capacity_span;
    std::optional<Property> source;  ///< W/m^3, an expression or a law "(x, y) -> ..."
    std::optional<Boundary> left, right, bottom, top;

    static const ExpressionPtr& at(const Table& table, std::size_t column, std::size_t row) { return table.size() == 1 && table[0].size() == 1 ? table[0][0] : table[column][row]; }
};

/// Grey diffuse surfaces that see each other and nothing else. Their view factors are given, or follow from the cross section of a
/// prism: surface i goes from corner i to corner i + 1.
struct Enclosure : Item {
    std::vector<Reference> surfaces;
    std::vector<ExpressionPtr> emissivities;
    Span emissivities_span;
    std::vector<ExpressionPtr> areas;
    Span areas_span;
    std::vector<std::vector<ExpressionPtr>> view_factors;  ///< null: to be completed
    Span view_factors_span;
    std::vector<std::array<ExpressionPtr, 2>> polygon;
    Span polygon_span;
    ExpressionPtr height;

    bool is_prism() const { return !polygon.empty(); }
};

}  // namespace dalembert
