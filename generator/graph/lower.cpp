// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/lower.hpp"

#include <algorithm>

#include "symbolic/functions.hpp"
#include "symbolic/network_functions.hpp"
#include "text/budgets.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

/// A product of sums with more terms than this is kept as a product.
constexpr std::size_t most_terms = 400;

/// A larger multiple in an exponential stays there.
constexpr int largest_power = 100;

Polynomial negated(Polynomial p) {
    p *= Rational(-1);
    return p;
}

/// content * common monomial * rest, rest with whole coprime coefficients and a positive leading term.
std::tuple<Rational, Monomial, Polynomial> primitive(const Polynomial& p, const Atoms& atoms) {
    cln::cl_I numerators = 0;
    cln::cl_I denominators = 1;
    for (const auto& [monomial, coefficient] : p.terms()) {
        numerators = cln::gcd(numerators, cln::numerator(coefficient));
        denominators = cln::lcm(denominators, cln::denominator(coefficient));
    }
    Rational content = Rational(numerators) / denominators;
    Monomial common = p.terms().begin()->first;
    for (const auto& [monomial, coefficient] : p.terms()) {
        Monomial shared;
        for (const LetterPower& power : common)
            if (const int other = exponent_of(monomial, power.letter); other > 0 && power.exponent > 0)
                shared.push_back({power.letter, std::min(power.exponent, other)});
        common = std::move(shared);
    }
    if (atoms.leading_sign(p) < 0) content = -content;
    Polynomial rest;
    for (const auto& [monomial, coefficient] : p.terms()) rest.add(monomial * raised(common, -1), coefficient / content);
    return {content, common, rest};
}

class Lowering {
public:
    Lowering(Atoms& atoms, LoweredSums& known, FractionalPowers powers) : atoms_(atoms), known_(known), powers_(powers) {}

    Polynomial operator()(const ex& e) {
        if (GiNaC::is_exactly_a<numeric>(e)) {
            if (!ex_to<numeric>(e).is_rational()) throw std::logic_error("a number that is not rational reached the graph");
            return Polynomial(cln::the<cln::cl_RA>(ex_to<numeric>(e).to_cl_N()));
        }
        if (GiNaC::is_a<GiNaC::symbol>(e)) {
            const Variable* variable = atoms_.symbols().find(e);
            if (variable == nullptr) throw std::logic_error("a symbol that is no variable reached the graph");
            return Polynomial::letter(atoms_.symbol(*variable));
        }
        if (GiNaC::is_a<GiNaC::add>(e)) {
            Polynomial sum;
            for (const ex& term : e) sum += (*this)(term);
            return sum;
        }
        if (GiNaC::is_a<GiNaC::mul>(e)) {
            Polynomial product(1);
            for (const ex& factor : e) product = multiply(product, (*this)(factor));
            return product;
        }
        if (GiNaC::is_a<GiNaC::power>(e)) return power(e);
        if (GiNaC::is_a<GiNaC::function>(e)) return function(e);
        if (e.is_equal(GiNaC::Pi)) return Polynomial::letter(atoms_.letter(Op::pi, {}));
        throw std::logic_error("an expression that the graph does not know");
    }

private:
    bool has_angles(const Polynomial& p) const {
        for (const auto& [monomial, coefficient] : p.terms())
            for (const LetterPower& power : monomial)
                if (atoms_[power.letter].op == Op::sin || atoms_[power.letter].op == Op::cos) return true;
        return false;
    }

    Polynomial multiply(const Polynomial& a, const Polynomial& b) {
        if (a.size() > 1 && b.size() > 1 && a.size() * b.size() > most_terms)
            return multiply(kept_whole(a, 1, atoms_), kept_whole(b, 1, atoms_));
        work_ += static_cast<double>(a.size()) * static_cast<double>(b.size());
        if (work_ > budget::code_work) throw TooManyTerms();
        return Polynomial::product(a, b, SIZE_MAX);
    }

    Polynomial power(const ex& e) {
        const ex& exponent = e.op(1);
        if (!GiNaC::is_exactly_a<numeric>(exponent))
            return Polynomial::letter(atoms_.letter(Op::power, {(*this)(e.op(0)), (*this)(exponent)}));
        const Rational value = cln::the<cln::cl_RA>(ex_to<numeric>(exponent).to_cl_N());
        const Polynomial base = (*this)(e.op(0));
        if (const auto n = to_int(value)) {
            // Expanded, (x - a)^n loses its digits near a. Only squares with angles are: what becomes 1 in them is worth more.
            if (*n == 2 && has_angles(base)) return multiply(base, base);
            return kept_whole(base, *n, atoms_);
        }
        const auto numerator = to_int(cln::numerator(value));
        if (numerator && cln::denominator(value) == 2) return Polynomial::letter(atoms_.letter(Op::sqrt, {base}), *numerator);
        // A power and its derivatives differ by whole exponents: x^(-5/4) = x^(-1/4)/x, which needs no other call.
        const auto whole = to_int(cln::truncate1(value));
        if (!whole || powers_ == FractionalPowers::as_written)
            return Polynomial::letter(atoms_.letter(Op::power, {base, Polynomial(value)}));
        const Polynomial fraction = fractional_power(base, value - *whole);
        return *whole == 0 ? fraction : multiply(fraction, kept_whole(base, *whole, atoms_));
    }

    /// Of an exponent between -1 and 1. Roots of roots are many times as fast as pow.
    Polynomial fractional_power(const Polynomial& base, const Rational& exponent) {
        const cln::cl_I of = cln::denominator(exponent);
        if (of != 4 && of != 8) return Polynomial::letter(atoms_.letter(Op::power, {base, Polynomial(exponent)}));
        Polynomial root = base;
        for (cln::cl_I left = of; left > 1; left = cln::exquo(left, 2)) root = Polynomial::letter(atoms_.letter(Op::sqrt, {root}));
        const auto numerator = to_int(cln::numerator(exponent));
        return Polynomial::letter(root.terms().begin()->first.front().letter, *numerator);
    }

    Polynomial function(const ex& e) {
        const unsigned serial = ex_to<GiNaC::function>(e).get_serial();
        if (serial == whole_SERIAL::serial) {
            if (const auto known = known_.find(e); known != known_.end()) return known->second;
            return known_.emplace(e, kept_whole(folded((*this)(e.op(0)), atoms_), 1, atoms_)).first->second;
        }
        if (serial == unlocated_SERIAL::serial) return (*this)(e.op(0));
        if (is_network_function(e)) return network(e);
        if (serial == GiNaC::exp_SERIAL::serial) return exponential(folded((*this)(e.op(0)), atoms_));
        if (const ScalarFunction* known = scalar_function_of(e)) {
            using Symmetry = ScalarFunction::Symmetry;
            std::vector<Polynomial> arguments;
            for (const ex& argument : e) arguments.push_back(folded((*this)(argument), atoms_));
            const bool flip =
                (known->symmetry == Symmetry::odd || known->symmetry == Symmetry::even) && atoms_.leading_sign(arguments[0]) < 0;
            if (flip) arguments[0] = negated(arguments[0]);
            if (known->symmetry == Symmetry::symmetric && atoms_.key(arguments[1]) < atoms_.key(arguments[0]))
                std::swap(arguments[0], arguments[1]);
            const Polynomial result = Polynomial::letter(atoms_.letter(known->op, std::move(arguments)));
            return flip && known->symmetry == Symmetry::odd ? negated(result) : result;
        }
        throw std::logic_error("a function that the graph does not know: " + ex_to<GiNaC::function>(e).get_name());
    }

    /// One element of an array. The elements of an inverse are numbered through.
    Polynomial network(const ex& e) {
        const bool is_inverse = is_ex_the_function(e, network_inverse);
        const Op op = is_inverse                             ? Op::network_inverse
                      : is_ex_the_function(e, junction_root) ? Op::junction_root
                                                             : Op::balanced_temperature;
        if (op == Op::balanced_temperature && NetworkData(e.op(1)).is_linear()) return (*this)(in_inverse(e));
        const ex& list = e.op(is_inverse ? 2 : 1);
        ex which = e.op(0);
        if (is_inverse) which = which * network_order(list) + e.op(1);
        std::vector<Polynomial> arguments{(*this)(which)};
        for (const ex& entry : list) arguments.push_back(folded((*this)(entry), atoms_));
        return Polynomial::letter(atoms_.letter(op, std::move(arguments)));
    }

    /// exp(n*x) = exp(x)^n for whole n, negative ones too: GiNaC writes a product of exponentials now one way, now the other, and what
    /// is to cancel must look alike.
    Polynomial exponential(Polynomial argument) {
        if (argument.is_zero()) return Polynomial(1);
        const auto content = std::get<0>(primitive(argument, atoms_));
        const bool is_power = cln::denominator(content) == 1 && cln::abs(content) <= largest_power;  // beyond, exp(x)^n has lost its digits
        const auto n = is_power ? to_int(content) : std::optional<int>(is_negative(content) ? -1 : 1);
        const int exponent = n.value_or(1);
        argument *= Rational(1) / exponent;
        return Polynomial::letter(atoms_.letter(Op::exp, {std::move(argument)}), exponent);
    }

    Atoms& atoms_;
    LoweredSums& known_;
    FractionalPowers powers_;
    double work_ = 0;
};

}  // namespace

Polynomial folded(Polynomial p, const Atoms& atoms) {
    // The order of folding is by key and exponent, so that the result does not depend on how letters happen to be numbered.
    std::map<std::string, std::pair<Letter, Letter>> angles;
    for (const auto& [monomial, coefficient] : p.terms())
        for (const LetterPower& power : monomial) {
            const Atom& atom = atoms[power.letter];
            if (atom.op != Op::sin || power.exponent < 2 || angles.contains(atom.key)) continue;
            if (const auto cosine = atoms.find(Op::cos, atom.arguments)) angles[atom.key] = {power.letter, *cosine};
        }
    bool changed = !angles.empty();
    while (changed) {
        changed = false;
        for (const auto& [key, letters] : angles) {
            const auto [sine, cosine] = letters;
            std::vector<Monomial> squares;
            for (const auto& [monomial, coefficient] : p.terms())
                if (exponent_of(monomial, sine) >= 2) squares.push_back(monomial);
            std::stable_sort(squares.begin(), squares.end(),
                             [s = sine](const Monomial& a, const Monomial& b) { return exponent_of(a, s) > exponent_of(b, s); });
            for (const Monomial& square : squares) {
                const auto term = p.terms().find(square);
                if (term == p.terms().end()) continue;
                const Monomial rest = square * Monomial{{sine, -2}};
                const Monomial partner = rest * Monomial{{cosine, 2}};
                const auto other = p.terms().find(partner);
                if (other == p.terms().end() || is_negative(other->second) != is_negative(term->second)) continue;
                const Rational common = cln::abs(other->second) < cln::abs(term->second) ? other->second : term->second;
                p.add(rest, common);
                p.add(partner, -common);
                p.add(square, -common);
                changed = true;
            }
        }
    }
    return p;
}

Polynomial kept_whole(const Polynomial& p, int exponent, Atoms& atoms) {
    if (p.is_zero() && exponent <= 0) throw GiNaC::pole_error("division by zero", exponent);
    if (p.is_zero()) return p;
    if (p.is_monomial()) {
        const auto& [monomial, coefficient] = *p.terms().begin();
        Polynomial result;
        result.add(raised(monomial, exponent), cln::expt(coefficient, cln::cl_I(exponent)));
        return result;
    }
    const auto [content, common, rest] = primitive(p, atoms);
    Polynomial result;
    Monomial m = raised(common, exponent) * Monomial{{atoms.letter(Op::sum, {rest}), exponent}};
    result.add(m, cln::expt(content, cln::cl_I(exponent)));
    return result;
}

namespace {

/// k*T*max(a, b) + k*T*min(a, b) -> k*T*(a + b): a flow that carries one thing forth and another back, of which both are the same here.
Polynomial with_extrema_joined(Polynomial p, const Atoms& atoms) {
    std::map<std::vector<Polynomial>, std::array<std::optional<Letter>, 2>> pairs;
    for (const auto& [monomial, coefficient] : p.terms())
        for (const LetterPower& power : monomial)
            if (const Op op = atoms[power.letter].op; op == Op::max || op == Op::min)
                pairs[atoms[power.letter].arguments][op == Op::max ? 0 : 1] = power.letter;
    for (const auto& [arguments, letters] : pairs) {
        const auto [largest, smallest] = letters;
        if (!largest || !smallest) continue;
        const Polynomial given = p;
        for (const auto& [monomial, coefficient] : given.terms()) {
            if (exponent_of(monomial, *largest) != 1 || exponent_of(monomial, *smallest) != 0) continue;
            const Monomial rest = monomial * Monomial{{*largest, -1}}, partner = rest * Monomial{{*smallest, 1}};
            const auto other = given.terms().find(partner);
            if (other == given.terms().end() || other->second != coefficient) continue;
            p.add(monomial, -coefficient);
            p.add(partner, -coefficient);
            for (const Polynomial& argument : arguments) {
                Polynomial part = argument * rest;
                p += part *= coefficient;
            }
        }
    }
    return p;
}

}  // namespace

Polynomial lower(const ex& e, Atoms& atoms, LoweredSums& known, FractionalPowers powers) {
    return folded(with_extrema_joined(Lowering(atoms, known, powers)(e), atoms), atoms);
}

Polynomial lower(const ex& e, Atoms& atoms, FractionalPowers powers) {
    LoweredSums known;
    return lower(e, atoms, known, powers);
}

std::vector<Polynomial> lower_in_order(const std::vector<ex>& expressions, Atoms& atoms) {
    Atoms grown = atoms;
    for (const ex& e : expressions) lower(e, grown);
    atoms.add_in_order(grown);
    std::vector<Polynomial> polynomials;
    for (const ex& e : expressions) polynomials.push_back(lower(e, atoms));
    return polynomials;
}

}  // namespace dalembert
