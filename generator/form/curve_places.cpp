// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/curve_places.hpp"

#include <set>
#include <tuple>

#include "symbolic/curve_functions.hpp"
#include "symbolic/map_functions.hpp"
#include "symbolic/parts.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

class Search {
public:
    Search(const ex& e, const BoundsOfLetters& letters, const GiNaC::exmap& start, const std::function<bool(const Rational&)>& is_wrong)
        : e_(e), bounds_(letters), start_(start), is_wrong_(is_wrong) {}

    std::optional<CurvePlace> run() {
        for (const auto look : {&Search::at_extremes, &Search::beyond_points, &Search::between_bounds}) {
            for (auto part = e_.preorder_begin(); part != e_.preorder_end(); ++part)
                if (const auto call = curve_call(*part); call && call->order == 0)
                    for (const ex& letter : letters_in(part->op(0))) (this->*look)(*call->curve, part->op(0), letter);
            if (worst_) break;
        }
        for (auto part = e_.preorder_begin(); part != e_.preorder_end(); ++part)
            if (const auto call = map_call(*part); call && call->is_value()) at_grid(*call->map, *part);
        return worst_;
    }

private:
    /// An argument that is linear in a letter.
    struct Line {
        Rational slope, rest;
        Bounds bounds;
    };

    /// What has no value there stays as it is.
    ex at_start(const ex& e, const ex& letter, const ex& value) const {
        GiNaC::exmap values = start_;
        values[letter] = value;
        try {
            return e.subs(values, GiNaC::subs_options::no_pattern);
        } catch (const GiNaC::pole_error&) {
            return e;
        }
    }

    std::optional<Line> line_of(const ex& argument, const ex& letter) const {
        const ex linear = at_start(argument, letter, letter).expand();
        if (!linear.is_polynomial(letter) || linear.degree(letter) != 1) return std::nullopt;
        const auto slope = rational_near(linear.coeff(letter, 1)), rest = rational_near(linear.coeff(letter, 0));
        if (!slope || !rest || cln::zerop(*slope)) return std::nullopt;
        return Line{*slope, *rest, bounds_of(linear, bounds_)};
    }

    void at_extremes(const CurvePieces& curve, const ex& argument, const ex& letter) {
        const auto line = line_of(argument, letter);
        if (!line) return;
        for (const Rational& place : curve.extreme_places(line->bounds))
            look_at(curve, argument, letter, (place - line->rest) / line->slope);
    }

    /// Where a straight line beyond the points is zero, and farther on.
    void beyond_points(const CurvePieces& curve, const ex& argument, const ex& letter) {
        const auto line = line_of(argument, letter);
        if (!line) return;
        const auto beyond = [&](const Rational& from, const Rational& slope, const Rational& outwards) {
            if (cln::zerop(slope)) return;
            const auto look = [&](const Rational& place) { look_at(curve, argument, letter, (place - line->rest) / line->slope); };
            const Rational way = -cln::rational(curve.at(0, from)) / slope;
            if (!(way * outwards > 0)) return look(from + outwards);
            look(from + way);
            look(from + 2 * way);
        };
        const Rational &first = curve.knots.front(), &last = curve.knots.back();
        if (!line->bounds.low) beyond(first, curve.pieces.front().coefficients[1], first - last);
        if (!line->bounds.high) beyond(last, curve.pieces.back().coefficients[1], last - first);
    }

    void between_bounds(const CurvePieces& curve, const ex& argument, const ex& letter) {
        constexpr int steps = 64;
        const auto known = bounds_.find(letter);
        if (known == bounds_.end() || !known->second.low || !known->second.high) return;
        const Rational &low = *known->second.low, &high = *known->second.high;
        for (int i = 0; i <= steps; ++i) look_at(curve, argument, letter, low + (high - low) * i / steps);
    }

    void look_at(const CurvePieces& curve, const ex& argument, const ex& letter, const Rational& number) {
        if (const auto known = bounds_.find(letter); known != bounds_.end() && !known->second.holds(number)) return;
        const auto at = [&](const ex& e) { return rational_near(at_start(e, letter, numeric(number))); };
        const auto place = at(argument);
        if (!place || (curve.ends_runs && !curve.points().holds(*place))) return;
        if (const auto value = at(e_)) compare({curve.name, {*place}, !curve.points().holds(*place), *value});
    }

    void compare(const CurvePlace& one) {
        const auto order = [](const CurvePlace& p) { return std::tie(p.value, p.places, p.curve); };
        if (is_wrong_(one.value) && (!worst_ || order(one) < order(*worst_))) worst_ = one;
    }

    /// Where an argument of a map has such places: values of a letter in it.
    struct Setting {
        std::optional<ex> letter;  ///< nothing where nothing in the argument moves
        Rational value, place;
    };

    std::vector<Setting> settings(const MapPieces& map, std::size_t axis, const ex& argument) const {
        constexpr int steps = 4;
        const std::vector<Rational>& knots = map.axes[axis].knots;
        std::vector<Rational> places = knots;
        for (std::size_t i = 1; i < knots.size(); ++i)
            for (int step = 1; step < steps; ++step) places.push_back(knots[i - 1] + (knots[i] - knots[i - 1]) * step / steps);
        const Rational width = knots.back() - knots.front();
        if (!map.ends_runs)
            for (const int times : {1, 10}) places.insert(places.end(), {knots.front() - times * width, knots.back() + times * width});
        std::vector<Setting> result;
        for (const ex& letter : letters_in(argument))
            if (const auto line = line_of(argument, letter)) {
                const auto add = [&](const Rational& place) {
                    if (line->bounds.holds(place)) result.push_back({letter, (place - line->rest) / line->slope, place});
                };
                for (const Rational& place : places) add(place);
                if (line->bounds.low) add(*line->bounds.low);
                if (line->bounds.high) add(*line->bounds.high);
            }
        if (const auto fixed = rational_near(argument); fixed && result.empty()) result.push_back({std::nullopt, 0, *fixed});
        return result;
    }

    void at_grid(const MapPieces& map, const ex& call) {
        const auto first = settings(map, 0, call.op(0)), second = settings(map, 1, call.op(1));
        const bool is_one_letter = first.size() * second.size() > 0 && first[0].letter && second[0].letter &&
                                   first[0].letter->is_equal(*second[0].letter);
        for (const Setting& x : first)
            for (const Setting& y : second) {
                if (x.letter && y.letter && x.letter->is_equal(*y.letter)) continue;
                look_at(map, call, {x, y});
            }
        if (!is_one_letter) return;
        for (const auto& one : {first, second})
            for (const Setting& x : one) look_at(map, call, {x});
    }

    void look_at(const MapPieces& map, const ex& call, const std::vector<Setting>& at) {
        GiNaC::exmap values = start_;
        for (const Setting& one : at) {
            if (!one.letter) continue;
            if (const auto known = bounds_.find(*one.letter); known != bounds_.end() && !known->second.holds(one.value)) return;
            values[*one.letter] = numeric(one.value);
        }
        const auto value_of = [&](const ex& e) -> std::optional<Rational> {
            try {
                return rational_near(e.subs(values, GiNaC::subs_options::no_pattern));
            } catch (const GiNaC::pole_error&) {
                return std::nullopt;
            }
        };
        const auto x = value_of(call.op(0)), y = value_of(call.op(1)), value = value_of(e_);
        if (!x || !y || !value) return;
        const bool is_beyond = !map.axes[0].points().holds(*x) || !map.axes[1].points().holds(*y);
        if (!(map.ends_runs && is_beyond)) compare({map.name, {*x, *y}, is_beyond, *value});
    }

    const ex& e_;
    const BoundsOfLetters& bounds_;
    const GiNaC::exmap& start_;
    const std::function<bool(const Rational&)>& is_wrong_;
    std::optional<CurvePlace> worst_;
};

}  // namespace

bool has_moving_curve(const ex& e) {
    return any_part(e, [](const ex& part) {
        const std::vector<PointsOfCall> calls = points_of_call(part);
        return std::any_of(calls.begin(), calls.end(), [](const PointsOfCall& points) { return !letters_in(points.argument).empty(); });
    });
}

std::optional<CurvePlace> worst_place(const ex& e, const BoundsOfLetters& letters, const GiNaC::exmap& start,
                                      const std::function<bool(const Rational&)>& is_wrong) {
    return Search(e, letters, start, is_wrong).run();
}

}  // namespace dalembert
