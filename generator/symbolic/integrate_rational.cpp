// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/functions.hpp"
#include "symbolic/integrate_parts.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;
using GiNaC::symbol;

int known_sign(const ex& constant) {
    const ex e = constant.expand();
    if (e.info(GiNaC::info_flags::positive)) return 1;
    if (ex(-e).expand().info(GiNaC::info_flags::positive)) return -1;
    const ex value = e.evalf();  // of roots and pi
    if (!is_real_number(value) || GiNaC::abs(ex_to<numeric>(value)) < numeric(1, 1'000'000'000)) return 0;  // may be a zero with roundings
    return ex_to<numeric>(value).is_negative() ? -1 : 1;
}

namespace {

/// a*x^2 + b*x + c
struct Quadratic {
    ex a, b, c;

    Quadratic(const ex& p, const symbol& x) : a(p.coeff(x, 2)), b(p.coeff(x, 1)), c(p.coeff(x, 0)) {}
    ex slope(const symbol& x) const { return 2 * a * x + b; }
    ex discriminant() const { return (4 * a * c - b * b).expand(); }
};

/// The integral of 1/p^k.
std::optional<ex> integrate_inverse(const ex& p, int k, const symbol& x) {
    const Quadratic q(p, x);
    const ex d = q.discriminant();
    if (k > 1) {
        const auto lower = integrate_inverse(p, k - 1, x);
        if (!lower || d.is_zero()) return std::nullopt;
        return q.slope(x) / ((k - 1) * d * GiNaC::pow(p, k - 1)) + 2 * (2 * k - 3) * q.a / ((k - 1) * d) * *lower;
    }
    const int sign = known_sign(d);
    if (sign == 0) return std::nullopt;
    const ex root = GiNaC::sqrt(sign * d);
    if (sign > 0) return 2 / root * GiNaC::atan(q.slope(x) / root);
    return GiNaC::log(magnitude((q.slope(x) - root) / (q.slope(x) + root))) / root;
}

/// The integral of top/p^k, p of first or second degree and top of a lower one.
std::optional<ex> integrate_fraction(const ex& top, const ex& p, int k, const symbol& x) {
    const auto power = [&](const ex& slope) {
        return k == 1 ? ex(GiNaC::log(magnitude(p)) / slope) : ex(GiNaC::pow(p, 1 - k) / ((1 - k) * slope));
    };
    if (p.degree(x) == 1) return top * power(p.coeff(x, 1));
    const Quadratic q(p, x);
    const ex with_slope = top.coeff(x, 1) / (2 * q.a), rest = (top.coeff(x, 0) - with_slope * q.b).normal();
    const ex first = with_slope.is_zero() ? ex(0) : ex(with_slope * power(1));
    if (rest.is_zero()) return first;
    const auto second = integrate_inverse(p, k, x);
    return second ? std::optional<ex>(first + rest * *second) : std::nullopt;
}

struct Factor {
    ex base;
    int power;
};

/// The factors of a polynomial that contain x; the others go into `constant`. Nothing where one is of too high a degree.
std::optional<std::vector<Factor>> factors_of(const ex& polynomial, const symbol& x, ex& constant) {
    std::vector<Factor> factors;
    const ex factored = GiNaC::factor(polynomial);
    const auto take = [&](const ex& e) {
        const bool is_power = GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint);
        if (!e.has(x)) constant *= e;
        else factors.push_back({(is_power ? e.op(0) : e).expand(), is_power ? ex_to<numeric>(e.op(1)).to_int() : 1});
    };
    if (GiNaC::is_a<GiNaC::mul>(factored)) std::for_each(factored.begin(), factored.end(), take);
    else take(factored);
    for (const Factor& f : factors)
        if (!f.base.is_polynomial(x) || f.base.degree(x) > 2 || f.power > 8) return std::nullopt;
    return factors;
}

}  // namespace

std::optional<ex> integrate_rational(const ex& function, const symbol& x) {
    const ex quotient = function.numer_denom();
    const ex above = quotient.op(0).expand(), below = quotient.op(1).expand();
    if (!above.is_polynomial(x) || !below.is_polynomial(x) || below.degree(x) == 0 || below.degree(x) > 8 || above.degree(x) > 20)
        return std::nullopt;
    ex constant = 1;
    const auto factors = factors_of(below, x, constant);
    if (!factors) return std::nullopt;
    ex result = 0;
    const ex whole = GiNaC::quo(above, below, x).expand();
    for (int i = 0; i <= whole.degree(x); ++i) result += whole.coeff(x, i) * GiNaC::pow(x, i + 1) / (i + 1);
    // rest/below as a sum of fractions with tops that are not known yet, compared power by power.
    struct Term {
        ex top, base;
        int power;
    };
    std::vector<Term> terms;
    GiNaC::lst unknowns;
    ex difference = GiNaC::rem(above, below, x) / constant;
    for (const Factor& f : *factors)
        for (int k = 1; k <= f.power; ++k) {
            ex top = 0, others = 1;
            for (int i = 0; i < f.base.degree(x); ++i) {
                const symbol unknown;
                unknowns.append(unknown);
                top += unknown * GiNaC::pow(x, i);
            }
            for (const Factor& other : *factors) others *= GiNaC::pow(other.base, &other == &f ? other.power - k : other.power);
            difference -= top * others;
            terms.push_back({top, f.base, k});
        }
    difference = difference.expand();
    GiNaC::lst equations;
    for (int i = 0; i < below.degree(x); ++i) equations.append(difference.coeff(x, i) == 0);
    const ex solved = GiNaC::lsolve(equations, unknowns);
    if (solved.nops() != unknowns.nops()) return std::nullopt;
    for (const Term& term : terms) {
        const ex top = term.top.subs(solved).expand();
        if (top.is_zero()) continue;
        const auto part = integrate_fraction(top, term.base, term.power, x);
        if (!part) return std::nullopt;
        result += *part;
    }
    return result;
}

std::optional<ex> integrate_root_of_quadratic(const ex& function, const symbol& x) {
    ex polynomial = 1, inside = 0;
    int exponent = 0;  // of the root
    const auto take = [&](const ex& e) {
        const bool is_root =
            GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::rational) && (2 * e.op(1)).info(GiNaC::info_flags::odd);
        if (is_root && inside.is_zero() && e.op(0).is_polynomial(x) && e.op(0).expand().degree(x) == 2) {
            inside = e.op(0).expand();
            exponent = ex_to<numeric>(2 * e.op(1)).to_int();
        } else {
            polynomial *= e;
        }
    };
    if (GiNaC::is_a<GiNaC::mul>(function)) std::for_each(function.begin(), function.end(), take);
    else take(function);
    if (inside.is_zero() || exponent < -3 || exponent > 9 || !polynomial.is_polynomial(x)) return std::nullopt;
    const Quadratic q(inside, x);
    const ex root = GiNaC::sqrt(inside), d = q.discriminant();
    if (exponent == -3) {
        const ex p = polynomial.expand();
        if (p.degree(x) > 1 || known_sign(d) == 0) return std::nullopt;
        return 2 * (p.coeff(x, 0) * q.slope(x) - p.coeff(x, 1) * (q.b * x + 2 * q.c)) / (d * root);
    }
    // All over one root: x^n/root falls by one or two powers each time.
    const ex p = (polynomial * GiNaC::pow(inside, (exponent + 1) / 2)).expand();
    const int sign = known_sign(q.a);
    if (sign == 0 || (sign < 0 && known_sign(d) >= 0) || p.degree(x) > 20) return std::nullopt;
    std::vector<ex> of_power{sign < 0 ? ex(-GiNaC::asin(q.slope(x) / GiNaC::sqrt(-d)) / GiNaC::sqrt(-q.a))
                                      : ex(GiNaC::log(magnitude(2 * GiNaC::sqrt(q.a) * root + q.slope(x))) / GiNaC::sqrt(q.a))};
    ex result = p.coeff(x, 0) * of_power[0];
    for (int n = 1; n <= p.degree(x); ++n) {
        ex next = GiNaC::pow(x, n - 1) * root / (n * q.a) - (2 * n - 1) * q.b / (2 * n * q.a) * of_power[static_cast<std::size_t>(n - 1)];
        if (n > 1) next -= (n - 1) * q.c / (n * q.a) * of_power[static_cast<std::size_t>(n - 2)];
        of_power.push_back(next);
        result += p.coeff(x, n) * next;
    }
    return result;
}

}  // namespace dalembert
