// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/map_functions.hpp"

#include "symbolic/curve_functions.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/numbered.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

Numbered<MapPieces>& all_maps() {
    static Numbered<MapPieces> all;
    return all;
}

std::string text_of(const MapPieces& map) {
    std::string text = map.name + (map.ends_runs ? "|" : "") + "\n" + map.doc + "\n";
    for (const std::size_t axis : {0U, 1U}) {
        text += map.variables[axis] + "\n";
        for (const Rational& knot : map.axes[axis].knots) text += to_string(knot) + "\n";
    }
    for (const MapPieces::Cell& cell : map.cells)
        for (const auto& row : cell)
            for (const Rational& c : row) text += to_string(c) + " ";
    return text;
}

/// Of one variable there are derivatives 0 to 3.
constexpr unsigned long derivatives = 4;

/// With all digits asked for, though the number of the map may be a decimal by now.
ex map_evalf(const ex& x, const ex& y, const ex& number) {
    const ex first = x.evalf(), second = y.evalf();
    if (!is_real_number(first) || !is_real_number(second) || !is_real_number(number)) return map_value(first, second, number).hold();
    const MapCall call = map_call_of(real_of(number));
    return numeric(call.map->at(call.orders, real_of(first), real_of(second))).evalf();
}

ex map_eval(const ex& x, const ex& y, const ex& number) {
    if (!is_real_number(x) || !is_real_number(y) || !is_real_number(number)) return map_value(x, y, number).hold();
    const MapCall call = map_call_of(real_of(number));
    return numeric(call.map->at(call.orders, real_of(x), real_of(y)));
}

}  // namespace

REGISTER_FUNCTION(map_value, eval_func(map_eval).evalf_func(map_evalf))

numeric number_of(const MapPieces& map) {
    return numeric(cln::cl_I(static_cast<unsigned long>(all_maps().number_of(text_of(map), map) * derivatives * derivatives)));
}

MapCall map_call_of(const cln::cl_R& number) {
    const unsigned long all = cln::cl_I_to_ulong(cln::round1(number));
    const auto by_x = static_cast<int>(all / derivatives % derivatives), by_y = static_cast<int>(all % derivatives);
    return {&all_maps()[all / (derivatives * derivatives)], {by_x, by_y}};
}

std::optional<MapCall> map_call(const ex& function) {
    if (!is_ex_the_function(function, map_value)) return std::nullopt;
    return map_call_of(real_of(function.op(2)));
}

std::optional<cln::cl_I> number_of_slope(const cln::cl_R& number, std::size_t axis) {
    const MapCall call = map_call_of(number);
    if (static_cast<std::size_t>(call.orders[axis]) == call.map->degree()) return std::nullopt;
    return cln::round1(number) + (axis == 0 ? derivatives : 1);
}

std::vector<PointsOfCall> points_of_call(const ex& function) {
    if (const auto call = curve_call(function)) {
        const CurvePieces& curve = *call->curve;
        return {{curve.name, "", function.op(0), 0, curve.knots.front(), curve.knots.back(), curve.ends_runs}};
    }
    std::vector<PointsOfCall> result;
    if (const auto call = map_call(function))
        for (const std::size_t axis : {0U, 1U}) {
            const std::vector<Rational>& knots = call->map->axes[axis].knots;
            result.push_back({call->map->name, call->map->variables[axis], function.op(axis), axis, knots.front(), knots.back(),
                              call->map->ends_runs});
        }
    return result;
}

std::vector<PointsOfCall> points_that_end_runs(const ex& function) {
    std::vector<PointsOfCall> all = points_of_call(function);
    if (!all.empty() && !all.front().ends_runs) all.clear();
    return all;
}

std::string name_of_map_function(const MapCall& call) {
    std::string name = call.map->name;
    for (const std::size_t axis : {0U, 1U})
        for (int i = 0; i < call.orders[axis]; ++i) name += "_" + call.map->variables[axis];
    return name;
}

}  // namespace dalembert
