// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/curve_places.hpp"

#include <set>
#include <tuple>

#include "symbolic/curve_functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

using LettersInside = std::set<ex, GiNaC::ex_is_less>;

LettersInside letters_in(const ex& e) {
    LettersInside letters;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (GiNaC::is_a<GiNaC::symbol>(*part)) letters.insert(*part);
    return letters;
}

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
        const auto value = at(e_);
        if (!value || !is_wrong_(*value)) return;
        const auto order = [](const CurvePlace& p) { return std::tie(p.value, p.place, p.curve->name); };
        const CurvePlace one{&curve, *place, *value};
        if (!worst_ || order(one) < order(*worst_)) worst_ = one;
    }

    const ex& e_;
    const BoundsOfLetters& bounds_;
    const GiNaC::exmap& start_;
    const std::function<bool(const Rational&)>& is_wrong_;
    std::optional<CurvePlace> worst_;
};

}  // namespace

bool has_moving_curve(const ex& e) {
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
        if (const auto call = curve_call(*part); call && call->order == 0 && !letters_in(part->op(0)).empty()) return true;
    return false;
}

std::optional<CurvePlace> worst_place(const ex& e, const BoundsOfLetters& letters, const GiNaC::exmap& start,
                                      const std::function<bool(const Rational&)>& is_wrong) {
    return Search(e, letters, start, is_wrong).run();
}

}  // namespace dalembert
