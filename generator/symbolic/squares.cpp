// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/squares.hpp"

#include <algorithm>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

constexpr std::size_t most_terms_of_squares = 20'000;

struct SquaresOfSines : GiNaC::map_function {
    ex operator()(const ex& e) override {
        if (!GiNaC::is_a<GiNaC::power>(e) || !e.op(1).info(GiNaC::info_flags::posint) ||
            !GiNaC::is_the_function<GiNaC::sin_SERIAL>(e.op(0)))
            return e.nops() == 0 || GiNaC::is_a<GiNaC::function>(e) ? e : e.map(*this);
        const int exponent = ex_to<numeric>(e.op(1)).to_int();
        return GiNaC::pow(1 - GiNaC::pow(GiNaC::cos(e.op(0).op(0)), 2), exponent / 2) * GiNaC::pow(e.op(0), exponent % 2);
    }
};

}  // namespace

ex in_cosines(const ex& e) {
    SquaresOfSines replaced;
    return replaced(e.expand()).expand();
}

Squares::Letter Squares::letter(const ex& e) {
    const auto [found, is_new] = numbers_.emplace(e, static_cast<Letter>(letters_.size()));
    if (!is_new) return found->second;
    const Letter number = found->second;
    const auto is = [&](const char* name) { return GiNaC::is_a<GiNaC::function>(e) && ex_to<GiNaC::function>(e).get_name() == name; };
    const auto name_of = [](const ex& symbol) {
        return GiNaC::is_a<GiNaC::symbol>(symbol) ? ex_to<GiNaC::symbol>(symbol).get_name() : std::string();
    };
    bool positive = is("exp") || is("cosh") || e.info(GiNaC::info_flags::positive) || positive_.names.contains(name_of(e));
    for (const char* wave : {"sin", "cos"})
        positive = positive || (is(wave) && positive_.waves.contains(wave + ("(" + name_of(e.op(0)) + ")")));
    positive = positive || (is("sinh") && (e.op(0).info(GiNaC::info_flags::positive) || positive_.names.contains(name_of(e.op(0)))));
    letters_.push_back(e);
    positive_letters_.push_back(positive);
    if (is("sin") || is("cosh")) {
        Polynomial square(1);
        square.add({{letter(is("sin") ? ex(GiNaC::cos(e.op(0))) : ex(GiNaC::sinh(e.op(0)))), 2}}, is("sin") ? -1 : 1);
        squares_[number] = square;
    }
    return number;
}

Polynomial Squares::convert(const ex& e) {
    if (GiNaC::is_exactly_a<numeric>(e) && ex_to<numeric>(e).is_rational())
        return Polynomial(cln::the<cln::cl_RA>(ex_to<numeric>(e).to_cl_N()));
    if (GiNaC::is_a<GiNaC::add>(e)) {
        Polynomial sum;
        for (const ex& term : e) sum += convert(term);
        return sum;
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        Polynomial product(1);
        for (const ex& factor : e) product = multiply(product, convert(factor));
        return product;
    }
    if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::integer)) {
        const int exponent = ex_to<numeric>(e.op(1)).to_int();
        const Polynomial base = convert(e.op(0));
        if (exponent > 0) {
            Polynomial product = base;
            for (int i = 1; i < exponent; ++i) product = multiply(product, base);
            return product;
        }
        if (base.is_monomial()) {
            Polynomial result(cln::expt(leading(base), cln::cl_I(exponent)));
            return result * raised(base.terms().begin()->first, exponent);
        }
    }
    return Polynomial::letter(letter(e));
}

Polynomial Squares::multiply(const Polynomial& a, const Polynomial& b) {
    Polynomial rest = Polynomial::product(a, b, most_terms_of_squares), result;
    while (!rest.is_zero()) {
        Polynomial next;
        for (const auto& [monomial, coefficient] : rest.terms()) {
            const auto high = std::find_if(monomial.begin(), monomial.end(),
                                           [&](const LetterPower& p) { return p.exponent >= 2 && squares_.contains(p.letter); });
            if (high == monomial.end()) {
                result.add(monomial, coefficient);
                continue;
            }
            const Monomial lower = monomial * Monomial{{high->letter, -2}};
            for (const auto& [m, c] : squares_.at(high->letter).terms()) next.add(lower * m, coefficient * c);
        }
        rest = std::move(next);
    }
    return result;
}

Squares::Factors Squares::factors(Polynomial p) {
    Factors result{common_factor(p), {}};
    p = p * raised(result.powers, -1);
    for (const auto& [wave, square] : squares_)
        while (const auto quotient = exact_quotient(p, square)) {
            p = *quotient;
            result.powers = result.powers * Monomial{{wave, 2}};
        }
    result.rest = std::move(p);
    return result;
}

bool Squares::is_positive(const Polynomial& p) const {
    return !p.is_zero() && std::all_of(p.terms().begin(), p.terms().end(), [&](const auto& term) {
        return !is_negative(term.second) &&
               std::all_of(term.first.begin(), term.first.end(), [&](const LetterPower& power) { return is_positive(power.letter); });
    });
}

ex Squares::back(const Monomial& powers) const {
    ex product = 1;
    for (const LetterPower& p : powers) product *= GiNaC::pow(letters_[p.letter], p.exponent);
    return product;
}

ex Squares::back(const Polynomial& p) const {
    GiNaC::exvector terms;
    for (const auto& [monomial, coefficient] : p.terms()) terms.push_back(numeric(coefficient) * back(monomial));
    return GiNaC::add(terms);
}

ex Squares::shortened(const ex& e) {
    try {
        const Polynomial p = convert(e);
        if (p.is_zero()) return 0;
        const Factors f = factors(p);
        return back(f.powers) * back(f.rest);
    } catch (const TooManyTerms&) {
        return e;
    }
}

ex Squares::root(const ex& square) {
    Factors f;
    try {
        const Polynomial p = convert(square);
        if (p.is_zero()) return 0;
        f = factors(p);
    } catch (const TooManyTerms&) {
        return GiNaC::sqrt(square);
    }
    Monomial outside, inside;
    for (const LetterPower& p : f.powers) {
        if (!is_positive(p.letter)) {
            inside.push_back(p);
            continue;
        }
        const int odd = p.exponent % 2 == 0 ? 0 : 1;
        if (p.exponent != odd) outside.push_back({p.letter, (p.exponent - odd) / 2});
        if (odd != 0) inside.push_back({p.letter, odd});
    }
    ex result = back(outside);
    const Rational factor = highest_coefficient(f.rest);
    if (!is_negative(factor)) {
        Polynomial scaled_rest = f.rest;
        scaled_rest *= Rational(1) / factor;
        auto rest = exact_root(scaled_rest);
        if (rest && is_negative(leading(*rest))) *rest *= Rational(-1);
        if (rest && is_positive(*rest)) return result * back(*rest) * GiNaC::sqrt(numeric(factor) * back(inside));
    }
    return result * GiNaC::sqrt(back(inside) * back(f.rest));
}

}  // namespace dalembert
