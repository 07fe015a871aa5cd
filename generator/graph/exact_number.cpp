// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/exact_number.hpp"

#include <cln/float.h>

#include <algorithm>
#include <cmath>

#include "graph/raise.hpp"
#include "symbolic/network_functions.hpp"
#include "symbolic/values.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

std::optional<cln::cl_R> number_of(const ex& e) {
    const ex value = e.evalf();
    if (!GiNaC::is_exactly_a<numeric>(value) || !GiNaC::ex_to<numeric>(value).is_real()) return std::nullopt;
    return cln::realpart(GiNaC::ex_to<numeric>(value).to_cl_N());
}

GiNaC::exvector numbers_of(const std::vector<cln::cl_R>& values) {
    GiNaC::exvector numbers;
    for (const cln::cl_R& x : values) numbers.emplace_back(numeric(x));
    return numbers;
}

bool all_there(const std::vector<const MaybeExact*>& parts) {
    return std::all_of(parts.begin(), parts.end(), [](const MaybeExact* part) { return part->has_value(); });
}

/// A slope is a double, and 40 digits are enough for it: GiNaC computes with so many as long as this lives.
class SlopeDigits {
public:
    explicit SlopeDigits(int digits) : digits_(digits) { GiNaC::Digits = few(digits) + guard_digits; }
    ~SlopeDigits() { GiNaC::Digits = digits_ + guard_digits; }
    SlopeDigits(const SlopeDigits&) = delete;
    SlopeDigits& operator=(const SlopeDigits&) = delete;
    static int few(int digits) { return std::min(digits, 40); }

private:
    int digits_;
};

std::vector<cln::cl_R> with_digits(std::vector<cln::cl_R> values, int digits) {
    const cln::float_format_t format = cln::float_format(static_cast<unsigned long>(digits + guard_digits));
    for (cln::cl_R& x : values) x = cln::cl_float(x, format);
    return values;
}

double approximate(const cln::cl_R& x) { return cln::double_approx(x); }

}  // namespace

void ExactNumber::add_slopes(const ExactNumber& other, double factor) {
    if (other.slopes.empty() || factor == 0) return;
    if (slopes.empty()) slopes.assign(other.slopes.size(), 0);
    if (std::isfinite(factor)) {  // most are zero, and no branch is quicker than one that is guessed
        for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] += factor * other.slopes[i];
        return;
    }
    for (std::size_t i = 0; i < slopes.size(); ++i)
        if (other.slopes[i] != 0) slopes[i] += factor * other.slopes[i];
}

void ExactNumber::operator*=(const ExactNumber& factor) {
    const double own = slopes.empty() ? 0 : approximate(factor.value), others = factor.slopes.empty() ? 0 : approximate(value);
    if (slopes.empty() || factor.slopes.empty() || own == 0 || others == 0 || !std::isfinite(own) || !std::isfinite(others)) {
        ExactNumber product;
        product.add_slopes(*this, own);
        product.add_slopes(factor, others);
        slopes = std::move(product.slopes);
    } else {
        for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = own * slopes[i] + others * factor.slopes[i];
    }
    value = value * factor.value;
}

ExactArithmetic::ExactArithmetic(int digits)
    : digits_(digits), format_(cln::float_format(static_cast<unsigned long>(digits + guard_digits))) {}

MaybeExact ExactArithmetic::input(const Rational& value, std::size_t number, std::size_t count) const {
    ExactNumber result{cln::cl_float(value, format_), std::vector<double>(count, 0)};
    result.slopes[number] = 1;
    return result;
}

MaybeExact ExactArithmetic::sum(const std::vector<const MaybeExact*>& terms, const std::vector<bool>& negative) {
    if (!all_there(terms)) return std::nullopt;
    ExactNumber result;
    for (std::size_t i = 0; i < terms.size(); ++i) {
        const ExactNumber& term = **terms[i];
        const bool subtract = !negative.empty() && negative[i];
        result.value = subtract ? result.value - term.value : result.value + term.value;
        result.add_slopes(term, subtract ? -1 : 1);
    }
    return result;
}

MaybeExact ExactArithmetic::product(const std::vector<const MaybeExact*>& factors) {
    if (!all_there(factors)) return std::nullopt;
    ExactNumber result = **factors.front();
    for (std::size_t i = 1; i < factors.size(); ++i) result *= **factors[i];
    return result;
}

MaybeExact ExactArithmetic::reciprocal(const MaybeExact& x) {
    if (!x || cln::zerop(x->value)) return std::nullopt;
    ExactNumber result{1 / x->value, {}};
    result.add_slopes(*x, -approximate(cln::square(result.value)));
    return result;
}

std::optional<cln::cl_R> ExactArithmetic::value(Op op, const Values& a) const {
    const ScalarFunction& row = scalar_function(op);
    if (row.exact != nullptr) return row.exact(a, cln::expt(cln::cl_RA(10), -digits_ / 2));
    return number_of(applied(row, numbers_of(a)));
}

MaybeExact ExactArithmetic::by_differences(const At& at, const std::vector<const MaybeExact*>& arguments, bool is_smooth) const {
    Values values;
    for (const MaybeExact* argument : arguments) values.push_back((*argument)->value);
    const auto guarded = [&]() -> std::optional<cln::cl_R> {
        try {
            return at(values);
        } catch (const std::exception&) {  // a pole
            return std::nullopt;
        }
    };
    const auto here = guarded();
    if (!here) return std::nullopt;
    ExactNumber result{*here, {}};
    if (std::all_of(arguments.begin(), arguments.end(), [](const MaybeExact* argument) { return (*argument)->slopes.empty(); }))
        return result;
    const SlopeDigits meanwhile(digits_);
    const int digits = SlopeDigits::few(digits_);
    values = with_digits(std::move(values), digits);
    const auto middle = guarded();
    for (std::size_t i = 0; middle && i < values.size(); ++i) {
        if ((*arguments[i])->slopes.empty()) continue;
        const cln::cl_R x = values[i];
        const cln::cl_R step = cln::zerop(x) ? cln::cl_R(cln::expt(cln::cl_RA(10), -2 * digits / 3))
                                             : cln::cl_R(cln::abs(x) * cln::expt(cln::cl_RA(10), -digits / 3));
        std::optional<double> slope;
        for (const int side : {1, -1}) {
            values[i] = x + side * step;
            const auto there = guarded();
            if (!there) continue;
            const double one = approximate((*there - *middle) / (side * step));
            if (!slope || std::fabs(one) > std::fabs(*slope)) slope = one;
            if (is_smooth) break;
        }
        values[i] = x;
        result.add_slopes(**arguments[i], slope.value_or(0));
    }
    return result;
}

/// The smaller or the larger of two; both, where they are equal.
ExactNumber ExactArithmetic::extreme(bool is_smaller, const ExactNumber& x, const ExactNumber& y) {
    const int order = cln::compare(x.value, y.value);
    ExactNumber result = (order < 0) == is_smaller || order == 0 ? x : y;
    if (order == 0) result.add_slopes(y, 1);
    return result;
}

/// By the slopes in double that the table of functions has; nothing where it has none, or there is no value.
MaybeExact ExactArithmetic::by_exact_slopes(Op op, const std::vector<const MaybeExact*>& arguments) const {
    const ScalarFunction& row = scalar_function(op);
    if (row.exact_slopes == nullptr) return std::nullopt;
    Values values;
    for (const MaybeExact* argument : arguments) values.push_back((*argument)->value);
    const auto here = value(op, values);
    if (!here) return std::nullopt;
    ExactNumber result{*here, {}};
    if (std::all_of(arguments.begin(), arguments.end(), [](const MaybeExact* argument) { return (*argument)->slopes.empty(); }))
        return result;
    const std::vector<double> slopes = row.exact_slopes(values, *here);
    if (slopes.empty()) return std::nullopt;
    for (std::size_t i = 0; i < slopes.size(); ++i) result.add_slopes(**arguments[i], slopes[i]);
    return result;
}

/// By the slopes that the table of functions knows; nothing where it knows none, or they have no value.
MaybeExact ExactArithmetic::by_known_slopes(Op op, const std::vector<const MaybeExact*>& arguments) const {
    const ScalarFunction& row = scalar_function(op);
    if (row.slope == nullptr && row.slopes == nullptr) return std::nullopt;
    Values values;
    for (const MaybeExact* argument : arguments) {
        values.push_back((*argument)->value);
        if (cln::zerop(values.back())) return std::nullopt;  // there are kinks
    }
    const auto here = value(op, values);
    if (!here) return std::nullopt;
    ExactNumber result{*here, {}};
    const SlopeDigits meanwhile(digits_);
    values.push_back(*here);
    const auto parts = numbers_of(with_digits(std::move(values), SlopeDigits::few(digits_)));
    const ex& f = parts.back();
    std::vector<ex> slopes;
    if (row.slope != nullptr) slopes = {row.slope(f, parts[0])};
    else {
        const auto [by_first, by_second] = row.slopes(f, parts[0], parts[1]);
        slopes = {by_first, by_second};
    }
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        if ((*arguments[i])->slopes.empty()) continue;
        const auto slope = number_of(slopes[i]);
        if (!slope) return std::nullopt;
        result.add_slopes(**arguments[i], approximate(*slope));
    }
    return result;
}

MaybeExact ExactArithmetic::function(Op op, const std::vector<const MaybeExact*>& arguments) const {
    if (!all_there(arguments)) return std::nullopt;
    GiNaC::Digits = digits_ + guard_digits;
    try {
        if (op == Op::if_else) return **arguments[cln::minusp((*arguments[0])->value) ? 2 : 1];
        if (op == Op::min || op == Op::max) return extreme(op == Op::min, **arguments[0], **arguments[1]);
        if (const MaybeExact result = by_exact_slopes(op, arguments)) return result;
        if (const MaybeExact result = by_known_slopes(op, arguments)) return result;
        return by_differences([&](const Values& values) { return value(op, values); }, arguments);
    } catch (const std::exception&) {  // a pole
        return std::nullopt;
    }
}

MaybeExact ExactArithmetic::element(Op array, const std::vector<const MaybeExact*>& arguments, std::size_t k) const {
    if (!all_there(arguments)) return std::nullopt;
    GiNaC::Digits = digits_ + guard_digits;
    const auto at = [&](const Values& values) {
        const GiNaC::exvector list = numbers_of(values);
        const ex whole = GiNaC::exprseq(list.begin(), list.end());
        if (array == Op::balanced_temperature) return number_of(balanced_temperature(static_cast<unsigned long>(k), whole));
        if (array == Op::junction_root) return number_of(junction_root(static_cast<unsigned long>(k), whole));
        const unsigned long n = network_order(whole);
        return number_of(network_inverse(k / n, k % n, whole));
    };
    return by_differences(at, arguments, array != Op::junction_root);  // whose flows have kinks where they turn
}

}  // namespace dalembert
