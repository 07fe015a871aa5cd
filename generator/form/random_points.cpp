// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/random_points.hpp"

#include <cln/float.h>

#include <array>

#include "symbolic/map_functions.hpp"
#include "symbolic/parts.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

/// A rational next to a constant, which may contain roots and pi.
std::optional<Rational> near(const ex& constant) {
    const auto value = value_at(constant, {}, 30);
    return value ? std::optional<Rational>(cln::rational(*value)) : std::nullopt;
}

}  // namespace

std::uint64_t next_word(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
}

std::optional<cln::cl_R> value_at(const ex& e, const Symbols& symbols, const Point& point, int digits) {
    return ValuesAtPoint(symbols, point, digits)(e);
}

ValuesAtPoint::ValuesAtPoint(const Symbols& symbols, const Point& point, int digits) : symbols_(symbols), digits_(digits) {
    const cln::float_format_t precision = cln::float_format(static_cast<unsigned long>(digits + guard_digits));
    for (const auto& [letter, value] : point) constants_[letter] = numeric(cln::cl_float(value, precision));
}

std::optional<cln::cl_R> ValuesAtPoint::operator()(const ex& e) {
    // Steps one after the other: written out they may be too large. Without a value they stay letters.
    for (const std::size_t step : symbols_.steps_in(e)) {
        const ex& letter = symbols_.get(SymbolKind::definition, step);
        if (constants_.contains(letter)) continue;
        const auto value = value_at(symbols_.without_model_definitions(symbols_.definition_values()[step]), constants_, digits_);
        if (!value) continue;
        constants_[letter] = numeric(*value);
        at_.reset();
    }
    if (!at_) at_.emplace(constants_, digits_);
    return at_->value(symbols_.without_model_definitions(e));
}

RandomPoints::RandomPoints(const System& system) {
    const Values defaults(system.scene, system.translate);
    const GiNaC::exmap at_start = defaults.substitution();
    for (const SymbolKind kind :
         {SymbolKind::parameter, SymbolKind::time, SymbolKind::input, SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state,
          SymbolKind::acceleration, SymbolKind::state_rate, SymbolKind::multiplier, SymbolKind::multiplier_rate, SymbolKind::residual}) {
        for (const Variable& variable : system.symbols.all(kind)) {
            // Without a declared range: around the default of a parameter, around zero for what moves or has none. Coordinates and letters
            // go beyond pi, so that asin(sin(phi)) is not taken for phi.
            const bool may_be_angle = kind == SymbolKind::coordinate || kind == SymbolKind::state || kind == SymbolKind::parameter;
            Rational high = may_be_angle ? Rational(4) : Rational(3) / 2;
            Rational low = kind == SymbolKind::time || variable.is_root ? Rational(0) : -high;
            const bool may_be_large = may_be_angle || kind == SymbolKind::input || kind == SymbolKind::velocity;
            bool is_free = may_be_large && !variable.is_root && (variable.declared == nullptr || !variable.declared->range);
            if (kind == SymbolKind::parameter) {
                const auto value = near(at_start.at(variable.symbol));
                if (value && !is_zero(*value)) {
                    is_free = false;
                    low = *value / 2;
                    high = *value * 3 / 2;
                }
            }
            if (variable.declared != nullptr && variable.declared->range) {
                const auto bound = [&](const ExpressionPtr& e) { 
                    if (!e) return std::optional<Rational>();
                    const ex value = system.translate(*e, {});
                    return near(variable.is_root ? GiNaC::sqrt(value) : value);
                };
                const auto declared_low = bound(variable.declared->range->low);
                const auto declared_high = bound(variable.declared->range->high);
                const Rational width = cln::abs(high - low);
                if (declared_low && declared_high) {
                    low = *declared_low;
                    high = *declared_high;
                } else if (declared_low && cln::min(low, high) < *declared_low) {
                    low = *declared_low;
                    high = low + width;
                } else if (declared_high && cln::max(low, high) > *declared_high) {
                    high = *declared_high;
                    low = high - width;
                }
            }
            is_free = is_free ||
                      (variable.declared != nullptr && variable.declared->range && variable.declared->range->is_guess && !variable.is_root);
            const bool has_range = kind == SymbolKind::parameter || (variable.declared != nullptr && variable.declared->range);
            intervals_.push_back({variable.symbol, low, high, is_free, has_range && kind != SymbolKind::velocity});
        }
    }
    for (const Symbols::AttitudeSymbols& attitude : system.symbols.attitudes()) {
        std::array<std::size_t, 4> places{};
        for (std::size_t i = 0; i < places.size(); ++i) {
            const ex& part = system.symbols.get(SymbolKind::state, attitude.parts[i]);
            while (!intervals_[places[i]].letter.is_equal(part)) ++places[i];
        }
        quaternions_.push_back(places);
    }
    look_at_curves(system, at_start);
    // What cells in loops are made of: temperatures, and numbers on the grid in their order.
    for (const CellField& field : system.heat.fields) {
        for (const ex& temperature : {field.here, field.next}) intervals_.push_back({temperature, Rational(250), Rational(600)});
        int number = 1;
        for (const ex& letter : field.letters()) {
            intervals_.push_back({letter, Rational(number), Rational(2 * number + 1) / 2});
            ++number;
        }
    }
    for (const CellSum& sum : system.cell_sums) intervals_.push_back({sum.letter, Rational(250), Rational(600)});
    for (const SymbolKind kind : {SymbolKind::costate, SymbolKind::adjoint})
        for (const Variable& variable : system.symbols.all(kind)) factors_.push_back(variable.symbol);
}

void RandomPoints::look_at_curves(const System& system, const GiNaC::exmap& at_start) {
    std::vector<ex> all = system.residual;
    all.insert(all.end(), system.state_rates.begin(), system.state_rates.end());
    for (const OutputEquation& output : system.outputs) all.push_back(output.value);
    for (const ex& equation : all)
        each_part_once(equation, [&](const ex& part) {
            for (const PointsOfCall& points : points_of_call(part)) look_at_points(points, at_start);
        });
}

void RandomPoints::look_at_points(const PointsOfCall& points, const GiNaC::exmap& at_start) {
    for (Interval& one : intervals_) {
        if (one.has_range || !points.argument.has(one.letter)) continue;
        GiNaC::exmap others = at_start;
        others.erase(one.letter);
        const ex argument = points.argument.subs(others, GiNaC::subs_options::no_pattern).expand();
        if (!argument.is_polynomial(one.letter) || argument.degree(one.letter) != 1) continue;
        const auto slope = near(argument.coeff(one.letter, 1)), rest = near(argument.coeff(one.letter, 0));
        if (!slope || !rest || is_zero(*slope)) continue;
        const Rational first = (points.first - *rest) / *slope, last = (points.last - *rest) / *slope;
        const Rational beyond = cln::abs(last - first) / 10;
        one = {one.letter, cln::min(first, last) - beyond, cln::max(first, last) + beyond, false, true};
    }
}

Rational RandomPoints::fraction(std::uint64_t& state) {
    // Strictly inside: at the ends of a range an expression may have no value.
    return Rational(cln::cl_I(static_cast<unsigned long>(next_word(state) >> 40U)) + 1) / ((1UL << 24U) + 1);
}

/// A quaternion times itself, by its norm: all parts stay rational, and the norm of the quotient is one.
void RandomPoints::make_unit_quaternions(Point& point) const {
    for (const auto& [a, b, c, d] : quaternions_) {
        const Rational w = point[a].second, x = point[b].second, y = point[c].second, z = point[d].second;
        const Rational vector = x * x + y * y + z * z, norm = w * w + vector;
        point[a].second = (w * w - vector) / norm;
        for (const std::size_t part : {b, c, d}) point[part].second = 2 * w * point[part].second / norm;
    }
}

/// From numbers of their own: what else is drawn does not depend on how many there are.
void RandomPoints::add_factors(Point& point) {
    for (const ex& factor : factors_) point.emplace_back(factor, 2 * fraction(state_of_factors_) - 1);
}

Point RandomPoints::next() {
    Point point;
    for (const Interval& interval : intervals_)
        point.emplace_back(interval.letter, interval.low + (interval.high - interval.low) * fraction(state_));
    make_unit_quaternions(point);
    add_factors(point);
    return point;
}

Point RandomPoints::next_wide() {
    static const std::array<Rational, 3> sizes{Rational(1) / 50, Rational(30), Rational(1000)};
    Point point;
    for (const Interval& interval : intervals_) {
        if (!interval.is_free) {
            point.emplace_back(interval.letter, interval.low + (interval.high - interval.low) * fraction(state_));
            continue;
        }
        const std::uint64_t word = next_word(state_);
        const Rational size = sizes[(word >> 40U) % sizes.size()] * fraction(state_);
        point.emplace_back(interval.letter, cln::minusp(interval.low) && (word >> 63U) != 0 ? Rational(-size) : size);
    }
    make_unit_quaternions(point);
    add_factors(point);
    return point;
}

constexpr std::array digits_of_signs{60, 120, 180};

Sign sign_at(const ValueAt& value) {
    const auto coarse = value(digits_of_signs[0]);
    const auto fine = value(digits_of_signs[1]);
    const auto finest = value(digits_of_signs[2]);
    if (!coarse || !fine || !finest) return Sign::none;
    if (cln::zerop(*finest)) return Sign::zero;
    // A value that shrinks when more digits are used is nothing but rounding.
    const cln::cl_R largest = cln::max(cln::abs(*coarse), cln::abs(*fine));
    const cln::cl_RA shrinkage = cln::expt(cln::cl_RA(10), -30);
    const bool shrinks = cln::zerop(largest) || cln::abs(*finest) <= shrinkage * largest;
    return shrinks ? Sign::zero : Sign::not_zero;
}

Sign ZeroAtPoints::sign(const ex& e) {
    if (e.is_zero()) return Sign::zero;
    const auto [known, is_new] = known_.emplace(e, Sign::none);
    if (!is_new) return known->second;
    constexpr int tries = 3;
    if (points_.empty()) {
        RandomPoints random(system_);
        for (int i = 0; i < tries; ++i) {
            const Point point = random.next();
            std::map<int, ValuesAtPoint>& by_digits = points_.emplace_back();
            for (const int digits : digits_of_signs) by_digits.emplace(digits, ValuesAtPoint(system_.symbols, point, digits));
        }
    }
    for (auto& by_digits : points_) {
        const Sign here = sign_at([&](int digits) { return by_digits.at(digits)(e); });
        if (here != Sign::none) known->second = here;
        if (here == Sign::not_zero) break;
    }
    return known->second;
}

}  // namespace dalembert
