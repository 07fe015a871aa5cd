// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/map_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>

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

/// Of one variable there are the integral and derivatives 0 to 3. With 48 bits for the map the number is whole as a double too.
constexpr unsigned long orders_of_variable = 5;
constexpr unsigned long steps_of_axis[]{orders_of_variable, 1};

/// What a number is made of.
struct Parts {
    unsigned long map;
    std::array<int, 2> orders;  ///< -1 for an integral
};

Parts parts_of(const cln::cl_R& number) {
    const unsigned long all = cln::cl_I_to_ulong(cln::round1(number));
    const auto order = [&](std::size_t axis) { return static_cast<int>(all / steps_of_axis[axis] % orders_of_variable) - 1; };
    return {all / (orders_of_variable * orders_of_variable), {order(0), order(1)}};
}

/// Over x, over y. They are made when they are wanted, and kept as the maps are.
const MapPieces& integral_of(unsigned long map, std::array<bool, 2> over) {
    static std::mutex mutex;
    static std::map<std::pair<unsigned long, std::array<bool, 2>>, MapPieces> all;
    const std::scoped_lock lock(mutex);
    const auto known = all.find({map, over});
    if (known != all.end()) return known->second;
    MapPieces result = all_maps()[map];
    for (const std::size_t axis : {0U, 1U})
        if (over[axis]) result = integrated(result, axis);
    return all.emplace(std::pair(map, over), std::move(result)).first->second;
}

/// With all digits asked for, though the number of the map may be a decimal by now.
ex map_evalf(const ex& x, const ex& y, const ex& number) {
    const ex first = x.evalf(), second = y.evalf();
    if (!is_real_number(first) || !is_real_number(second) || !is_real_number(number)) return map_value(first, second, number).hold();
    const MapCall call = map_call_of(real_of(number));
    return numeric(call.map->at(call.orders, real_of(first), real_of(second))).evalf();
}

ex map_eval(const ex& x, const ex& y, const ex& number) {
    if (!is_real_number(number)) return map_value(x, y, number).hold();
    const Parts parts = parts_of(real_of(number));
    if ((parts.orders[0] < 0 && x.is_zero()) || (parts.orders[1] < 0 && y.is_zero())) return 0;  // from zero to zero
    if (!is_real_number(x) || !is_real_number(y)) return map_value(x, y, number).hold();
    const MapCall call = map_call_of(real_of(number));
    return numeric(call.map->at(call.orders, real_of(x), real_of(y)));
}

}  // namespace

REGISTER_FUNCTION(map_value, eval_func(map_eval).evalf_func(map_evalf))

numeric number_of(const MapPieces& map) {
    const auto of_map = static_cast<unsigned long>(all_maps().number_of(text_of(map), map));
    return numeric(cln::cl_I(of_map * orders_of_variable * orders_of_variable + steps_of_axis[0] + steps_of_axis[1]));
}

MapCall map_call_of(const cln::cl_R& number) {
    const Parts parts = parts_of(number);
    const std::array<bool, 2> over{parts.orders[0] < 0, parts.orders[1] < 0};
    if (!over[0] && !over[1]) return {&all_maps()[parts.map], parts.orders};
    return {&integral_of(parts.map, over), {std::max(parts.orders[0], 0), std::max(parts.orders[1], 0)}};
}

std::optional<MapCall> map_call(const ex& function) {
    if (!is_ex_the_function(function, map_value)) return std::nullopt;
    return map_call_of(real_of(function.op(2)));
}

std::optional<cln::cl_I> number_of_slope(const cln::cl_R& number, std::size_t axis) {
    const Parts parts = parts_of(number);
    if (parts.orders[axis] == static_cast<int>(all_maps()[parts.map].degree(axis))) return std::nullopt;
    return cln::round1(number) + steps_of_axis[axis];
}

std::optional<cln::cl_I> number_of_integral(const cln::cl_R& number, std::size_t axis) {
    if (parts_of(number).orders[axis] < 0) return std::nullopt;
    return cln::round1(number) - steps_of_axis[axis];
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
        if (call.map->is_integral[axis]) name = fmt::format("integral_of_{}_over_{}", name, call.map->variables[axis]);
    for (const std::size_t axis : {0U, 1U})
        for (int i = 0; i < call.orders[axis]; ++i) name += "_" + call.map->variables[axis];
    return name;
}

}  // namespace dalembert
