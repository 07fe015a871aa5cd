// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/edge_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace dalembert {

namespace {

constexpr double quarter_turn = 1.5707963267948966;

// In place of log2 and exp2, whose last bit is not the same in every library: exact at powers of two, straight between them.
double steps_of_two(double size) {
    int exponent = 0;
    const double mantissa = std::frexp(size, &exponent);
    return exponent - 1 + (2 * mantissa - 1);
}

double power_of_two(double steps) {
    const double whole = std::floor(steps);
    return std::ldexp(1 + (steps - whole), static_cast<int>(whole));
}

}  // namespace

Rational exact(double value) {
    int exponent = 0;
    const auto digits = static_cast<long>(std::ldexp(std::frexp(value, &exponent), std::numeric_limits<double>::digits));
    exponent -= std::numeric_limits<double>::digits;
    const cln::cl_I power = cln::ash(1, std::abs(exponent));
    return exponent < 0 ? cln::cl_RA(cln::cl_I(digits)) / power : cln::cl_RA(cln::cl_I(digits) * power);
}

const Arithmetic& float_arithmetic() {
    static constexpr Arithmetic arithmetic{"float", 24, -149, std::numeric_limits<float>::max(), 20};
    return arithmetic;
}

const Arithmetic& double_arithmetic() {
    static constexpr Arithmetic arithmetic{"double", 53, -1074, std::numeric_limits<double>::max(), 47};
    return arithmetic;
}

double Arithmetic::nearest(const Rational& value) const {
    return digits == std::numeric_limits<float>::digits ? static_cast<double>(cln::float_approx(value)) : cln::double_approx(value);
}

double Arithmetic::next(double value, double towards) const {
    if (digits == std::numeric_limits<float>::digits)
        return static_cast<double>(std::nextafter(static_cast<float>(value), static_cast<float>(towards)));
    return std::nextafter(value, towards);
}

double Arithmetic::ulp(double value) const {
    if (value == 0) return std::ldexp(1.0, least);
    return std::ldexp(1.0, std::max(std::ilogb(value) - digits + 1, least));
}

EdgePoints::EdgePoints(const System& system, std::vector<const Variable*> variables, const Arithmetic& arithmetic, std::uint64_t seed)
    : variables_(std::move(variables)), arithmetic_(arithmetic), state_(seed) {
    const RandomPoints random(system);
    const GiNaC::exmap defaults = Values(system.scene, system.translate).substitution();
    for (const Variable* variable : variables_) {
        const auto& intervals = random.intervals();
        const auto interval =
            std::find_if(intervals.begin(), intervals.end(), [&](const auto& i) { return i.letter.is_equal(variable->symbol); });
        Range range{arithmetic.nearest(interval->low), arithmetic.nearest(interval->high), 0};
        if (range.low > range.high) std::swap(range.low, range.high);
        if (exact(range.low) < cln::min(interval->low, interval->high)) range.low = arithmetic.next(range.low, arithmetic.largest);
        if (exact(range.high) > cln::max(interval->low, interval->high)) range.high = arithmetic.next(range.high, -arithmetic.largest);
        if (variable->kind == SymbolKind::parameter) {
            const auto usual = value_at(defaults.at(variable->symbol), {}, 40);
            range.usual = usual ? arithmetic.nearest(cln::rational(*usual)) : range.low;
        }
        ranges_.push_back(range);
    }
}

double EdgePoints::Range::scale() const { return std::max(std::fabs(low), std::fabs(high)); }

std::vector<double> EdgePoints::sizes() const {
    std::vector<double> result;
    for (const Range& range : ranges_) result.push_back(range.scale());
    return result;
}

double EdgePoints::fraction() { return (static_cast<double>(next_word(state_) >> 11U) + 0.5) * 0x1p-53; }

double EdgePoints::rounded(double value) const {
    return arithmetic_.digits == std::numeric_limits<float>::digits ? static_cast<double>(static_cast<float>(value)) : value;
}

double EdgePoints::within(const Range& range, double value) const {
    const double number = rounded(value);
    return range.holds(number) ? number : number < range.low ? range.low : range.high;
}

double EdgePoints::uniform(const Range& range) {
    const double at = fraction();
    return within(range, range.low * (1 - at) + range.high * at);
}

double EdgePoints::small(double scale) {
    const double size = scale * power_of_two(-fraction() * arithmetic_.halvings);
    return chance() ? size : -size;
}

double EdgePoints::tiny_to_huge(const Range& range) {
    // Of ranges that do not reach zero, the decades that they have.
    const double least = std::min(std::fabs(range.low), std::fabs(range.high));
    if (!range.may_be_zero())
        return within(range, std::copysign(least * power_of_two(fraction() * steps_of_two(range.scale() / least)), range.low));
    const double value = small(range.scale());
    return within(range, range.holds(value) ? value : -value);
}

/// Values of quantities with one unit are made those of others: the same, next to them, or near.
void EdgePoints::make_equal(std::vector<double>& values) {
    for (std::size_t i = 1; i < values.size(); ++i) {
        if (chance()) continue;
        std::vector<std::size_t> others;
        for (std::size_t j = 0; j < i; ++j)
            if (variables_[j]->unit == variables_[i]->unit && ranges_[i].holds(values[j])) others.push_back(j);
        if (others.empty()) continue;
        const double other = values[others[static_cast<std::size_t>(fraction() * static_cast<double>(others.size()))]];
        const double which = fraction() * 3;
        values[i] = within(ranges_[i], which < 1   ? other
                                       : which < 2 ? arithmetic_.next(other, chance() ? arithmetic_.largest : -arithmetic_.largest)
                                                   : other + small(std::fabs(other)));
    }
}

EdgePoint EdgePoints::next() {
    static constexpr std::array kinds{"random",         "tiny to huge",  "near zero",    "equal values",
                                      "ends of ranges", "signs of zero", "quarter turns"};
    const std::size_t kind = count_ % kinds.size();
    const bool keeps_parameters = (count_ / kinds.size()) % 2 == 1;
    ++count_;
    EdgePoint point{kinds[kind], {}};
    for (std::size_t i = 0; i < variables_.size(); ++i) {
        const Range& range = ranges_[i];
        double value = uniform(range);
        const bool special = kind == 1 || chance();
        if (special) {
            switch (kind) {
                case 1: value = tiny_to_huge(range); break;
                case 2: value = range.may_be_zero() ? tiny_to_huge(range) : value; break;
                case 4: value = chance() ? range.low : range.high; break;
                case 5: value = range.may_be_zero() ? (chance() ? 0.0 : -0.0) : value; break;
                case 6:
                    if (variables_[i]->unit == "rad" || variables_[i]->unit == "1" || variables_[i]->unit.empty())
                        value = within(range, quarter_turn * std::round(value / quarter_turn) + (chance() ? 0 : small(1)));
                    break;
                default: break;
            }
        }
        if (keeps_parameters && variables_[i]->kind == SymbolKind::parameter) value = range.usual;
        point.values.push_back(value);
    }
    if (kind == 3) make_equal(point.values);
    return point;
}

}  // namespace dalembert
