// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/map_pieces.hpp"

#include <algorithm>

#include "symbolic/bounds.hpp"

namespace dalembert {

namespace {

using Line = CurveCourse::Numbers;
using Powers = MapPieces::Powers;
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

constexpr int most_powers = 5;
constexpr int factorial[most_powers]{1, 1, 2, 6, 24};

/// A polynomial, derived and taken at d.
cln::cl_R derived(const Powers& c, int order, const cln::cl_R& d) {
    cln::cl_R sum = 0;
    for (int q = most_powers - 1; q >= order; --q) sum = sum * d + falling(q, order) * c[static_cast<std::size_t>(q)];
    return sum;
}

/// In the powers of u from 0 to 1, where d goes from low to high.
Powers stretched(const Powers& c, const Rational& low, const Rational& high) {
    Powers result;
    Rational scale = 1;
    for (int order = 0; order < most_powers; ++order) {
        result[static_cast<std::size_t>(order)] = cln::the<cln::cl_RA>(derived(c, order, low)) * scale / factorial[order];
        scale = scale * (high - low);
    }
    return result;
}

/// The same polynomial of u, of this degree, as a mean of numbers with weights that are not negative (Bernstein).
Powers as_mean(const Powers& c, std::size_t degree) {
    Powers result;
    for (std::size_t i = 0; i <= degree; ++i)
        for (std::size_t q = 0; q <= i; ++q)  // i over q, as a part of degree over q
            result[i] = result[i] + c[q] * falling(static_cast<int>(i), static_cast<int>(q)) /
                                        falling(static_cast<int>(degree), static_cast<int>(q));
    return result;
}

MapPieces::Cell turned_cell(const MapPieces::Cell& cell) {
    MapPieces::Cell result;
    for (std::size_t i = 0; i < cell.size(); ++i)
        for (std::size_t k = 0; k < cell.size(); ++k) result[k][i] = cell[i][k];
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
    for (std::size_t i = 0; i < along.size(); ++i) result[i][0] = cln::the<cln::cl_RA>(derived(along[i], order, place));
    return axis == 0 ? turned_cell(result) : result;
}

bool is_constant_along(const MapPieces::Cell& cell, std::size_t axis) {
    const MapPieces::Cell along = axis == 0 ? turned_cell(cell) : cell;
    return std::all_of(along.begin(), along.end(), [](const Powers& c) { return std::all_of(c.begin() + 1, c.end(), is_zero); });
}

/// Of the values in a cell of these degrees. One without an end goes straight on there.
Bounds bounds_of_cell(MapPieces::Cell cell, const std::array<std::size_t, 2>& degrees, CellBounds at) {
    for (const std::size_t axis : {0U, 1U}) {
        Bounds& own = at[axis];
        if (is_constant_along(cell, axis)) own = {Rational(0), Rational(0)};
        if (own.low && own.high) continue;
        if (!own.low && !own.high) return {};
        const bool is_upwards = own.low.has_value();
        CellBounds flat = at;
        flat[axis] = {Rational(0), Rational(0)};
        const Bounds first = bounds_of_cell(collapsed(cell, axis, 0, is_upwards ? *own.low : *own.high), degrees, flat);
        const Bounds slope = bounds_of_cell(collapsed(cell, axis, 1, 0), degrees, flat);
        const auto& falls_by = is_upwards ? slope.low : slope.high;
        const auto& rises_by = is_upwards ? slope.high : slope.low;
        const int way = is_upwards ? 1 : -1;
        return {falls_by && way * *falls_by >= 0 ? first.low : std::nullopt, rises_by && way * *rises_by <= 0 ? first.high : std::nullopt};
    }
    for (const std::size_t axis : {1U, 0U}) {  // turned twice
        for (Powers& c : cell) c = as_mean(stretched(c, *at[axis].low, *at[axis].high), degrees[axis]);
        cell = turned_cell(cell);
    }
    Bounds result{cell[0][0], cell[0][0]};
    for (std::size_t i = 0; i <= degrees[0]; ++i)
        for (std::size_t k = 0; k <= degrees[1]; ++k) result = around(result, {cell[i][k], cell[i][k]});
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
    for (int p = most_powers - 1; p >= orders[0]; --p)
        sum = sum * dx + falling(p, orders[0]) * derived(cell(i, k)[static_cast<std::size_t>(p)], orders[1], dy);
    return sum;
}

std::optional<int> MapPieces::order_of_jump(std::size_t axis, std::size_t knot, std::array<int, 2> orders) const {
    const Axis &own = axes[axis], &other = axes[1 - axis];
    // The coefficients of the other variable's powers, in the piece below or above the knot.
    const auto is_same = [&](std::size_t piece, int order) {
        const auto at_knot = [&](std::size_t side) {
            const Cell along = axis == 0 ? turned_cell(cell(knot + side, piece)) : cell(piece, knot + side);
            std::vector<cln::cl_R> values;
            for (int q = orders[1 - axis]; q < most_powers; ++q)
                values.push_back(derived(along[static_cast<std::size_t>(q)], order, own.knots[knot] - own.origins[knot + side]));
            return values;
        };
        const auto below = at_knot(0), above = at_knot(1);
        return std::equal(below.begin(), below.end(), above.begin(), [](const cln::cl_R& a, const cln::cl_R& b) { return a == b; });
    };
    for (int order = orders[axis]; order <= static_cast<int>(degree(axis)); ++order)
        for (std::size_t piece = 0; piece < other.origins.size(); ++piece)
            if (!is_same(piece, order)) return order;
    return std::nullopt;
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
            const Bounds own =
                bounds_of_cell(cell(i, k), {degree(0), degree(1)}, {from(*part_x, axes[0].origins[i]), from(*part_y, axes[1].origins[k])});
            result = result ? around(*result, own) : own;
        }
    return result.value_or(Bounds{});
}

MapPieces map_of(const Curve& curve) {
    const Curve::Grid& grid = *curve.grid;
    MapPieces result{curve.name, curve.doc, {curve.variable, grid.variable}, {}, {}, curve.shape == Curve::Shape::linear,
                     curve.outside == Curve::Outside::error, {}};
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
            for (std::size_t p = 0; p < 4; ++p) {
                const CurveCourse::Coefficients c = along_y.piece(k, level[p], slope[p]);
                std::copy(c.begin(), c.end(), cell[p].begin());
            }
        }
    }
    return result;
}

MapPieces integrated(const MapPieces& map, std::size_t axis) {
    MapPieces result = map;
    result.is_integral[axis] = true;
    const MapPieces::Axis &own = map.axes[axis], &other = map.axes[1 - axis];
    const auto cell_at = [&](std::size_t piece, std::size_t beside) -> MapPieces::Cell& {
        return result.cells[axis == 0 ? piece * other.origins.size() + beside : beside * own.origins.size() + piece];
    };
    const auto turned_of_y = [&](const MapPieces::Cell& cell) { return axis == 0 ? cell : turned_cell(cell); };
    for (std::size_t beside = 0; beside < other.origins.size(); ++beside) {
        // Rows are polynomials of the other variable.
        const auto value = [&](std::size_t piece, const Rational& at) {
            const MapPieces::Cell cell = turned_of_y(cell_at(piece, beside));
            Powers sum;
            for (std::size_t p = cell.size(); p-- > 0;)
                for (std::size_t q = 0; q < sum.size(); ++q) sum[q] = sum[q] * (at - own.origins[piece]) + cell[p][q];
            return sum;
        };
        const auto join = [&](std::size_t piece, const Rational& at, const Powers& wanted) {
            const MapPieces::Cell of = turned_of_y(cell_at(piece, beside));
            MapPieces::Cell cell;
            for (std::size_t p = 1; p < cell.size(); ++p)
                for (std::size_t q = 0; q < cell.size(); ++q) cell[p][q] = of[p - 1][q] / static_cast<int>(p);
            cell_at(piece, beside) = turned_of_y(cell);
            const Powers from_origin = value(piece, at);
            for (std::size_t q = 0; q < cell.size(); ++q) cell[0][q] = wanted[q] - from_origin[q];
            cell_at(piece, beside) = turned_of_y(cell);
        };
        const std::size_t zero = own.piece(0);
        join(zero, 0, {});
        for (std::size_t i = zero; i < own.knots.size(); ++i) join(i + 1, own.knots[i], value(i, own.knots[i]));
        for (std::size_t i = zero; i-- > 0;) join(i, own.knots[i], value(i + 1, own.knots[i]));
    }
    return result;
}

}  // namespace dalembert
