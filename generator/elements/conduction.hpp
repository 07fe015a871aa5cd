// SPDX-License-Identifier: GPL-3.0-or-later
// Rods and blocks as they were written, each key in one place.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

/// What holds at one end of a rod or side of a block: nothing (insulated), or some of these.
struct Boundary {
    ExpressionPtr temperature;      ///< first kind (4.9a)
    ExpressionPtr flux;             ///< second kind (4.9b), W/m^2 into the body
    ExpressionPtr coefficient;      ///< third kind (4.9c)
    ExpressionPtr emissivity;       ///< radiation to a large surrounding
    ExpressionPtr ambient;          ///< temperature of the surrounding, for the last two
    Span span;
};

template <class Visitor, ElementOf<Boundary> End>
void describe(Visitor& v, End& end) {
    v("temperature", end.temperature, {.dimension = Dimension::temperature(), .depends = on_plain_states_and_inputs,
        .doc = "given temperature; then no other key"});
    v("flux", end.flux, {.dimension = dimension::heat_flux(), .depends = on_plain_states_and_inputs,
        .doc = "heat flux into the body"});
    v("coefficient", end.coefficient, {.dimension = dimension::heat_transfer(), .depends = on_plain_states_and_inputs,
        .doc = "convection to the ambient: heat transfer coefficient alpha"});
    v("emissivity", end.emissivity, {.dimension = Dimension::none(), .depends = on_plain_states_and_inputs,
        .doc = "radiation to the ambient: emissivity"});
    v("ambient", end.ambient, {.dimension = Dimension::temperature(), .depends = on_plain_states_and_inputs,
        .doc = "ambient temperature"});
}

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

template <>
inline constexpr KindSpec kind_of<Rod>{"rod",
    "Bars, walls, pipes and shells with heat flow in one direction (4.5), divided into cells. heat[NAME.first] and "
    "heat[NAME.last] are the heat flows into the rod through its ends.",
    "[rods.bar]\ntemperature   = \"T\"\nlength        = \"L\"\narea          = \"A\"\nconductivity  = \"lambda\"\ndensity       = "
    "\"rho\"\nheat_capacity = \"c_p\"\nfirst         = { temperature = \"T_0\" }\nlast          = { coefficient = \"alpha\", ambient = "
    "\"T_inf\" }", "", {.in_all_modes = true, .naming = Naming::parts, .has_cells = true, .borders = {"first", "last"}}};

inline const KeyChoices<Rod::Scheme>& rod_schemes() {
    using S = Rod::Scheme;
    static const KeyChoices<S> choices{
        {"points",
         S::points,
         {},
         {},
         ": at points from end to end, half a cell at free ends, the finite differences of (4.96); the default"},
        {"cells", S::cells, {}, {}, ": means of cells, finite volumes"},
    };
    return choices;
}

inline const KeyChoices<Rod::Shape>& rod_shapes() {
    using S = Rod::Shape;
    static const KeyChoices<S> choices{
        {"bar", S::bar, {"length", "area"}, {"perimeter", "side_coefficient", "side_emissivity", "ambient"}, " (default)"},
        {"cylinder", S::cylinder, {"inner", "outer", "height"}, {}, " (4.5), with heat along the radius"},
        {"sphere", S::sphere, {"inner", "outer"}, {}, " likewise"},
    };
    return choices;
}

template <class Visitor, ElementOf<Rod> E>
void describe(Visitor& v, E& rod) {
    v("temperature", rod.temperature, {.required = true, .refers = {"state"}, .all_members = true,
        .doc = "family of states: the temperatures from the first end to the last"});
    v.choice("scheme", rod.scheme, {}, rod_schemes());
    v.choice("shape", rod.shape, {}, rod_shapes());
    v("length", rod.length, {.dimension = Dimension::length(), .depends = on_parameters, .sign = above_zero("m"),
        .doc = "of a bar: length"});
    v("area", rod.area, {.dimension = dimension::surface(), .depends = on_parameters, .variables = {Dimension::length()},
        .doc = "of a bar: cross section; \"x -> ...\" if it varies"});
    v("inner", rod.inner, {.dimension = Dimension::length(), .depends = on_parameters, .sign = not_below_zero("m"), .words = "inner radius",
        .doc = "of a cylinder or sphere: inner radius; 0 for a solid one"});
    v("outer", rod.outer, {.dimension = Dimension::length(), .depends = on_parameters, .words = "outer radius",
        .doc = "of a cylinder or sphere: outer radius"});
    v("height", rod.height,
      {.dimension = Dimension::length(), .depends = on_parameters, .sign = above_zero("m"), .doc = "of a cylinder: height along its axis"});
    v("grid", rod.grid, {.dimension = Dimension::none(), .depends = on_parameters, .variables = {Dimension::none()},
        .doc = "\"s -> ...\", increasing from 0 to 1: the cells are equal over s. \"s -> s^2\" makes them finer at the first end"});
    v("conductivity", rod.conductivity, {.required = true, .dimension = dimension::heat_conductivity(), .depends = on_parameters,
        .variables = {Dimension::temperature()},
        .sign = above_zero("W/(m*K)"), .doc = "thermal conductivity; \"T -> ...\" if it depends on the temperature"});
    v("density", rod.density,
      {.required = true,
       .dimension = dimension::density(),
       .depends = on_parameters,
       .sign = above_zero("kg/m^3"),
       .doc = "density"});
    v("heat_capacity", rod.heat_capacity, {.required = true, .dimension = dimension::specific_heat(), .depends = on_parameters,
        .variables = {Dimension::temperature()},
        .doc = "specific heat capacity; \"T -> ...\" if it depends on the temperature"});
    v("source", rod.source, {.dimension = Dimension::power() / Dimension::volume(), .depends = on_plain_states_and_inputs,
        .variables = {Dimension::length()},
        .doc = "heat source by volume (4.4); \"x -> ...\" if it varies along the rod"});
    v("perimeter", rod.perimeter, {.dimension = Dimension::length(), .depends = on_parameters,
        .doc = "of a bar: perimeter, for the heat flow through its side"});
    v("side_coefficient", rod.side_coefficient, {.dimension = dimension::heat_transfer(), .depends = on_plain_states_and_inputs,
        .doc = "convection through the side: heat transfer coefficient"});
    v("side_emissivity", rod.side_emissivity, {.dimension = Dimension::none(), .depends = on_parameters,
        .doc = "radiation of the side: emissivity"});
    v("ambient", rod.ambient, {.dimension = Dimension::temperature(), .depends = on_plain_states_and_inputs,
        .doc = "ambient temperature around the side"});
    v("loops", rod.loops, {
        .doc = "true: loops compute the cells, so that the code does not grow with their number; if left out, true above 40 "
               "cells"});
    v.table("first", rod.first, {.words = "end", .noun = "end",
        .doc = "condition at the first end (4.9): { temperature }, or some of flux (into the rod), coefficient and emissivity "
               "with ambient; insulated if left out"});
    v.table("last", rod.last, {.words = "end", .noun = "end", .doc = "the same at the last end"});
    v.item({.has_family = false});
}

/// Of a block.
struct Side : Boundary {
    std::optional<Reference> node;  ///< in perfect contact with it
};

template <class Visitor, ElementOf<Side> E>
void describe(Visitor& v, E& side) {
    v("node", side.node, {.refers = {"node"}, .doc = "a node in perfect contact with the side; then no other key"});
    if constexpr (std::is_const_v<E>) describe(v, static_cast<const Boundary&>(side));
    else describe(v, static_cast<Boundary&>(side));
}

/// A stretch of a block along x or y, cut into equal cells.
struct BlockPiece {
    ExpressionPtr length;  ///< m
    ExpressionPtr cells;
};

/// A rectangle in which heat flows in two directions, pieced together of columns and rows, each meeting of which has its material. Its
/// temperatures are a family of states, row by row from the bottom, each from the left.
struct Block : Item {
    /// One expression for all (a single entry), or one for each piece: [column][row].
    using Table = Listed<std::vector<ExpressionPtr>>;
    Reference temperature;
    std::vector<BlockPiece> columns, rows;
    ExpressionPtr depth;
    Table conductivity, density, heat_capacity;
    std::optional<Property> source;  ///< W/m^3, an expression or a law "(x, y) -> ..."
    std::optional<Side> left, right, bottom, top;
    std::optional<bool> loops;               ///< as of a rod

    static const ExpressionPtr& at(const Table& table, std::size_t column, std::size_t row) {
        return table.size() == 1 && table[0].size() == 1 ? table[0][0] : table[column][row];
    }
};

template <>
inline constexpr KindSpec kind_of<Block>{"block",
    "Rectangles of one or several materials with heat flow in two directions (4.4), divided into cells: finite "
    "volumes, where the halves of two neighbouring cells are in series. heat[NAME.left], right, bottom and top are "
    "the heat flows into the block through its sides.",
    "[blocks.wall]\ntemperature   = \"T\"\ncolumns       = [[\"L\", 8]]\nrows          = [[\"H_1\", 4], [\"H_2\", 4]]\n"
    "depth         = \"B\"\nconductivity  = [[\"lambda_1\", \"lambda_2\"]]\ndensity       = \"rho\"\nheat_capacity = \"c_p\"\n"
    "left          = { node = \"plate\" }\nright         = { coefficient = \"alpha\", ambient = \"T_inf\" }",
    "", {.in_all_modes = true, .naming = Naming::parts, .has_cells = true, .borders = {"left", "right", "bottom", "top"}}};

template <class Visitor, ElementOf<Block> E>
void describe(Visitor& v, E& block) {
    v("temperature", block.temperature, {.required = true, .refers = {"state"}, .all_members = true,
        .doc = "family of states: the temperatures of the cells, along the bottom row from left to right, then the next row"});
    v("columns", block.columns, {.required = true, .dimension = Dimension::length(), .depends = constant_only,
        .sign = above_zero("m"), .words = "length of a column",
        .doc = "columns from left to right, along x: [[\"L_a\", \"M\"], [\"L_b\", 3]] is a length L_a with M cells, then L_b "
               "with 3 cells"});
    v("rows", block.rows, {.required = true, .dimension = Dimension::length(), .depends = constant_only,
        .sign = above_zero("m"), .words = "height of a row",
        .doc = "rows from bottom to top, along y, in the same form"});
    v("depth", block.depth,
      {.required = true, .dimension = Dimension::length(), .depends = constant_only, .sign = above_zero("m"),
        .doc = "depth across x and y"});
    v("conductivity", block.conductivity,
      {.required = true,
       .dimension = dimension::heat_conductivity(),
       .depends = constant_only,
       .sign = above_zero("W/(m*K)"),
       .doc = "thermal conductivity: one for all, or a list for each column with an entry for each row: [[\"a\", \"a\"], "
               "[\"b\", \"c\"]]"});
    v("density", block.density, {.required = true, .dimension = dimension::density(), .depends = constant_only,
        .sign = above_zero("kg/m^3"), .doc = "density, in the same form"});
    v("heat_capacity", block.heat_capacity, {.required = true, .dimension = dimension::specific_heat(), .depends = constant_only,
        .doc = "specific heat capacity, in the same form"});
    v("source", block.source, {.type = ValueType::field, .dimension = Dimension::power() / Dimension::volume(),
        .depends = on_plain_states_and_inputs, .variables = {Dimension::length(), Dimension::length()},
        .doc = "heat source by volume (4.4); \"(x, y) -> ...\" if it varies, measured from the bottom left corner"});
    v.table("left", block.left, {.words = "side", .noun = "side",
        .doc = "condition at the left side (4.9): { temperature }, { node } in perfect contact, or some of flux (into the "
               "block), coefficient and emissivity with ambient; insulated if left out"});
    v.table("right", block.right, {.words = "side", .noun = "side", .doc = "the same at the right side"});
    v.table("bottom", block.bottom, {.words = "side", .noun = "side", .doc = "the same at the bottom"});
    v.table("top", block.top, {.words = "side", .noun = "side", .doc = "the same at the top"});
    v("loops", block.loops, {
        .doc = "true: loops compute the cells, so that the code does not grow with their number; if left out, true above 40 "
               "cells. Loops compute no sides that are nodes or radiate, and no surroundings that depend on states or the motion; "
               "such blocks are written out"});
    v.item({});
}

}  // namespace dalembert
