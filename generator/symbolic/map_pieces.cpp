// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/map_pieces.hpp"

#include <algorithm>

#include "symbolic/bounds.hpp"

namespace dalembert {

namespace {

using Line = CurveCourse::Numbers;
using Lines = std::vector<Line>;

Lines turned(const Lines& lines) {
    Lines result(lines.front().size());
    for (const Line& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) result[i].push_back(line[i]);
    return result;
}

/// Along each of the lines.
Lines slopes_along(const CurveCourse& course, const Lines& lines) {
    Lines result;
    for (const Line& line : lines) result.push_back(course.slopes(line));
    return result;
}

Lines mean(const Lines& a, const Lines& b) {
    Lines result = a;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < a[i].size(); ++k) result[i][k] = (a[i][k] + b[i][k]) / 2;
    return result;
}

/// q!/(q - order)!
int falling(int q, int order) {
    int result = 1;
    for (int i = 0; i < order; ++i) result *= q - i;
    return result;
}

/// A polynomial, derived and taken at d.
cln::cl_R derived(const CurveCourse::Coefficients& c, int order, const cln::cl_R& d) {
    cln::cl_R sum = 0;
    for (int q = 3; q >= order; --q) sum = sum * d + falling(q, order) * c[static_cast<std::size_t>(q)];
    return sum;
}

/// In the powers of u from 0 to 1, where d goes from low to high.
CurveCourse::Coefficients stretched(const CurveCourse::Coefficients& c, const Rational& low, const Rational& high) {
    CurveCourse::Coefficients result;
    Rational scale = 1;
    for (int order = 0; order < 4; ++order) {
        static constexpr int factorial[]{1, 1, 2, 6};
        result[static_cast<std::size_t>(order)] = cln::the<cln::cl_RA>(derived(c, order, low)) * scale / factorial[order];
        scale = scale * (high - low);
    }
    return result;
}

/// The same polynomial of u as a mean of numbers with weights that are not negative (Bernstein).
CurveCourse::Coefficients as_mean(const CurveCourse::Coefficients& c) {
    return {c[0], c[0] + c[1] / 3, c[0] + 2 * c[1] / 3 + c[2] / 3, c[0] + c[1] + c[2] + c[3]};
}

MapPieces::Cell turned_cell(const MapPieces::Cell& cell) {
    MapPieces::Cell result;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 4; ++k) result[k][i] = cell[i][k];
    return result;
}

/// What piece i of an axis has of these bounds; nothing where it has nothing of them.
std::optional<Bounds> part_of(const MapPieces::Axis& axis, std::size_t i, const Bounds& bounds) {
    const auto end = [&](std::size_t knot) { return std::optional(axis.knots[knot]); };
    const Bounds part = common(bounds, {i > 0 ? end(i - 1) : std::nullopt, i < axis.knots.size() ? end(i) : std::nullopt});
    return part.low && part.high && *part.low > *part.high ? std::nullopt : std::optional(part);
}

/// Where a cell begins and ends, counted from its origins.
using CellBounds = std::array<Bounds, 2>;

/// The cell with one variable put in: its value at that place, or, of order 1, its slope there. The result does not change with it.
MapPieces::Cell collapsed(const MapPieces::Cell& cell, std::size_t axis, int order, const Rational& place) {
    MapPieces::Cell result;
    const MapPieces::Cell along = axis == 0 ? turned_cell(cell) : cell;
    for (std::size_t i = 0; i < 4; ++i) result[i] = {cln::the<cln::cl_RA>(derived(along[i], order, place)), 0, 0, 0};
    return axis == 0 ? turned_cell(result) : result;
}

bool is_constant_along(const MapPieces::Cell& cell, std::size_t axis) {
    const MapPieces::Cell along = axis == 0 ? turned_cell(cell) : cell;
    return std::all_of(along.begin(), along.end(), [](const auto& c) { return is_zero(c[1]) && is_zero(c[2]) && is_zero(c[3]); });
}

/// Of the values in a cell. One without an end goes straight on there.
Bounds bounds_of_cell(MapPieces::Cell cell, CellBounds at) {
    for (const std::size_t axis : {0U, 1U}) {
        Bounds& own = at[axis];
        if (is_constant_along(cell, axis)) own = {Rational(0), Rational(0)};
        if (own.low && own.high) continue;
        if (!own.low && !own.high) return {};
        const bool is_upwards = own.low.has_value();
        CellBounds flat = at;
        flat[axis] = {Rational(0), Rational(0)};
        const Bounds first = bounds_of_cell(collapsed(cell, axis, 0, is_upwards ? *own.low : *own.high), flat);
        const Bounds slope = bounds_of_cell(collapsed(cell, axis, 1, 0), flat);
        const auto& falls_by = is_upwards ? slope.low : slope.high;
        const auto& rises_by = is_upwards ? slope.high : slope.low;
        const int way = is_upwards ? 1 : -1;
        return {falls_by && way * *falls_by >= 0 ? first.low : std::nullopt, rises_by && way * *rises_by <= 0 ? first.high : std::nullopt};
    }
    for (const std::size_t axis : {1U, 0U}) {  // turned twice
        for (CurveCourse::Coefficients& c : cell) c = as_mean(stretched(c, *at[axis].low, *at[axis].high));
        cell = turned_cell(cell);
    }
    Bounds result{cell[0][0], cell[0][0]};
    for (const CurveCourse::Coefficients& row : cell)
        for (const Rational& value : row) result = around(result, {value, value});
    return result;
}

}  // namespace

std::size_t MapPieces::Axis::piece(const cln::cl_R& x) const {
    const auto above = std::partition_point(knots.begin(), knots.end(), [&](const Rational& knot) { return cln::compare(knot, x) <= 0; });
    return static_cast<std::size_t>(above - knots.begin());
}

cln::cl_R MapPieces::at(std::array<int, 2> orders, const cln::cl_R& x, const cln::cl_R& y) const {
    const std::size_t i = axes[0].piece(x), k = axes[1].piece(y);
    const cln::cl_R dx = x - axes[0].origins[i], dy = y - axes[1].origins[k];
    cln::cl_R sum = 0;
    for (int p = 3; p >= orders[0]; --p)
        sum = sum * dx + falling(p, orders[0]) * derived(cell(i, k)[static_cast<std::size_t>(p)], orders[1], dy);
    return sum;
}

int MapPieces::order_of_jump(std::size_t axis, std::size_t knot, std::array<int, 2> orders) const {
    const Axis &own = axes[axis], &other = axes[1 - axis];
    // The coefficients of the other variable's powers, in the piece below or above the knot.
    const auto is_same = [&](std::size_t piece, int order) {
        const auto at_knot = [&](std::size_t side) {
            const Cell along = axis == 0 ? turned_cell(cell(knot + side, piece)) : cell(piece, knot + side);
            std::vector<cln::cl_R> values;
            for (int q = orders[1 - axis]; q < 4; ++q)
                values.push_back(derived(along[static_cast<std::size_t>(q)], order, own.knots[knot] - own.origins[knot + side]));
            return values;
        };
        const auto below = at_knot(0), above = at_knot(1);
        return std::equal(below.begin(), below.end(), above.begin(), [](const cln::cl_R& a, const cln::cl_R& b) { return a == b; });
    };
    int order = orders[axis];
    const auto is_joined = [&] {
        for (std::size_t piece = 0; piece < other.origins.size(); ++piece)
            if (!is_same(piece, order)) return false;
        return true;
    };
    while (order < 4 && is_joined()) ++order;
    return order;
}

Bounds MapPieces::bounds(Bounds x, Bounds y) const {
    if (ends_runs) {
        x = common(x, axes[0].points());
        y = common(y, axes[1].points());
    }
    std::optional<Bounds> result;
    for (std::size_t i = 0; i < axes[0].origins.size(); ++i)
        for (std::size_t k = 0; k < axes[1].origins.size(); ++k) {
            const auto part_x = part_of(axes[0], i, x), part_y = part_of(axes[1], k, y);
            if (!part_x || !part_y) continue;
            const auto from = [](const Bounds& part, const Rational& origin) {
                const auto end = [&](const std::optional<Rational>& at) {
                    return at ? std::optional<Rational>(*at - origin) : std::nullopt;
                };
                return Bounds{end(part.low), end(part.high)};
            };
            const Bounds own = bounds_of_cell(cell(i, k), {from(*part_x, axes[0].origins[i]), from(*part_y, axes[1].origins[k])});
            result = result ? around(*result, own) : own;
        }
    return result.value_or(Bounds{});
}

MapPieces map_of(const Curve& curve) {
    const Curve::Grid& grid = *curve.grid;
    MapPieces result{curve.name, curve.doc, {curve.variable, grid.variable}, {}, {}, curve.shape == Curve::Shape::linear,
                     curve.outside == Curve::Outside::error};
    result.axes[0].knots = grid.x;
    result.axes[1].knots = grid.y;
    const CurveCourse along_x(grid.x, curve.shape, curve.outside), along_y(grid.y, curve.shape, curve.outside);
    // [k][i]: along x for each place of y. Straight lines have no slopes of their own.
    const Lines values = turned(grid.values);
    const Lines by_x = slopes_along(along_x, values);
    Lines by_y(values.size()), by_both(values.size());
    if (!result.is_linear) {
        by_y = turned(slopes_along(along_y, grid.values));
        by_both = mean(slopes_along(along_x, by_y), turned(slopes_along(along_y, turned(by_x))));
    }
    for (std::size_t k = 0; k <= grid.y.size(); ++k) result.axes[1].origins.push_back(along_y.origin(k));
    for (std::size_t i = 0; i <= grid.x.size(); ++i) {
        result.axes[0].origins.push_back(along_x.origin(i));
        // Of each power of x: the values and slopes along y.
        std::array<Line, 4> level, slope;
        for (std::size_t k = 0; k < grid.y.size(); ++k) {
            const auto c = along_x.piece(i, values[k], by_x[k]);
            for (std::size_t p = 0; p < 4; ++p) level[p].push_back(c[p]);
            if (result.is_linear) continue;
            const auto s = along_x.piece(i, by_y[k], by_both[k]);
            for (std::size_t p = 0; p < 4; ++p) slope[p].push_back(s[p]);
        }
        for (std::size_t k = 0; k <= grid.y.size(); ++k) {
            MapPieces::Cell& cell = result.cells.emplace_back();
            for (std::size_t p = 0; p < 4; ++p) cell[p] = along_y.piece(k, level[p], slope[p]);
        }
    }
    return result;
}

}  // namespace dalembert
