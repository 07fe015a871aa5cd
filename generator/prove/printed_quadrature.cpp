// SPDX-License-Identifier: GPL-3.0-or-later
// Sides with integrals that have no primitive: compared at random points, with what a quadrature says of the integrals there.
#include <fmt/format.h>

#include "form/quadrature.hpp"
#include "prove/printed_pair.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr const char* no_value = "the program finds no primitive of an integral, and quadrature gives no value of it";

/// How exact integrals are taken to be: larger than the error of the quadrature.
Rational accuracy_of_integrals() { return cln::expt(cln::cl_RA(10), -8); }

bool depends_on(const DefiniteIntegral& integral, const ex& letter) {
    return integral.function.has(letter) || integral.from.has(letter) || integral.to.has(letter);
}

}  // namespace

bool PairCheck::has_open_integral(const ex& e) const {
    const auto& open = system_.translate.open_integrals();
    return std::any_of(open.begin(), open.end(), [&](const DefiniteIntegral& integral) { return e.has(integral.value); });
}

std::optional<Point> PairCheck::with_integrals(const Point& point) {
    const auto& open = system_.translate.open_integrals();
    fixed_integrals_.resize(open.size());
    Point result = point;
    for (std::size_t i = 0; i < open.size(); ++i) {
        DefiniteIntegral integral = open[i];
        for (ex* part : {&integral.function, &integral.from, &integral.to}) *part = prepared(*part);
        if (contains_acceleration(integral.function)) return std::nullopt;
        const bool is_fixed =
            std::none_of(point.begin(), point.end(), [&](const auto& known) { return depends_on(integral, known.first); });
        std::optional<double> value = fixed_integrals_[i];
        if (!value) value = value_by_quadrature(system_, integral, point);
        if (!value) return std::nullopt;
        if (is_fixed) fixed_integrals_[i] = value;
        result.emplace_back(integral.value, cln::rational(cln::cl_DF(*value)));
    }
    return result;
}

PrintedResult PairCheck::run_by_quadrature(const ex& left, const ex& right) {
    constexpr int needed = 8, most = 24, hopeless = 3, digits = 40;
    PrintedResult result;
    result.comparison = {Verdict::not_checkable, no_value};
    if (contains_acceleration(left - right)) return result;
    RandomPoints points(system_);
    int valid = 0;
    for (int i = 0; i < most && valid < needed && !(i == hopeless && valid == 0); ++i) {
        Point point = points.next();
        for (auto& [letter, value] : point) value = rounded(value, 3);
        const auto at = with_integrals(point);
        if (!at) continue;
        Point off = *at;
        for (std::size_t k = point.size(); k < off.size(); ++k) off[k].second = off[k].second * (1 + accuracy_of_integrals());
        const auto a = value_at(left, system_.symbols, *at, digits), b = value_at(right, system_.symbols, *at, digits);
        const auto changed = value_at(left - right, system_.symbols, off, digits);
        if (!a || !b || !changed) continue;
        const cln::cl_R tolerance = 4 * cln::abs(*changed - (*a - *b)) + (cln::abs(*a) + cln::abs(*b)) * accuracy_of_integrals() / 100,
                        distance = cln::abs(*a - *b);
        ++valid;
        if (distance <= tolerance) continue;
        if (distance <= 10 * tolerance) {
            result.comparison.reason =
                "the program finds no primitive of an integral, and quadrature has too few digits to compare the sides";
            return result;
        }
        result.comparison = {Verdict::wrong, "an integral without a primitive is computed by quadrature"};
        CounterExample& example = result.counterexample.emplace();
        for (const auto& [letter, value] : point) {
            const Variable* variable = system_.symbols.find(letter);
            const auto& open = system_.translate.open_integrals();
            const bool is_needed = left.has(letter) || right.has(letter) ||
                                   std::any_of(open.begin(), open.end(), [&letter = letter](const DefiniteIntegral& integral) {
                                       return depends_on(integral, letter);
                                   });
            if (variable != nullptr && is_needed) example.values.emplace_back(variable->name, decimal(value, 6));
        }
        example.left = decimal(cln::rational(*a), 6);
        example.right = decimal(cln::rational(*b), 6);
        return result;
    }
    if (valid < needed) return result;
    // Whatever the integrals are: equal with letters for them.
    if (prover_.proven_equal(left, right)) result.comparison = {Verdict::proven};
    else
        result.comparison = {
            Verdict::numerically_equal,
            fmt::format("an integral without a primitive is computed by quadrature, to 8 digits at {} random points", valid)};
    return result;
}

PrintedResult PairCheck::number_by_quadrature(const ex& value, const PrintedNumber& number) {
    constexpr int most_digits = 7;
    PrintedResult result;
    result.comparison = {Verdict::not_checkable, no_value};
    const auto integrals = with_integrals({});
    if (!integrals) return result;
    ex known = value;
    for (const auto& [letter, found] : *integrals) known = known.subs(letter == GiNaC::numeric(found), GiNaC::subs_options::no_pattern);
    result.comparison = compare_with_number(known, number);
    if (result.comparison.verdict == Verdict::wrong)
        result.counterexample = CounterExample{{}, number_text(known, number.unit.value_or(Unit{})), decimal(number.value, 12)};
    if (result.comparison.verdict != Verdict::proven) return result;
    if (number.digits > most_digits)
        result.comparison = {
            Verdict::not_checkable,
            fmt::format("an integral without a primitive is computed by quadrature, to fewer than {} digits", number.digits)};
    else result.comparison = {Verdict::numerically_equal, "an integral without a primitive is computed by quadrature"};
    return result;
}

}  // namespace dalembert
