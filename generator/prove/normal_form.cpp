// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/normal_form.hpp"

#include <numeric>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

constexpr std::size_t most_terms = 40'000;
constexpr double most_products = 4e6;
constexpr int largest_power = 64;
constexpr int largest_multiple = 24;
constexpr int most_restarts = 8;

const Monomial one;

Rational rational(const numeric& value) {
    if (!value.is_rational()) throw NoNormalForm("a number that is not rational");
    return cln::the<cln::cl_RA>(value.to_cl_N());
}

Polynomial constant(const Rational& value) { return Polynomial(value); }

Polynomial minus(Polynomial p) {
    p *= Rational(-1);
    return p;
}

/// The coefficient of the first term, by which a polynomial is divided to make it comparable up to a factor.
Rational leading(const Polynomial& p) { return p.terms().begin()->second; }

/// What all terms have in common, negative exponents included.
Monomial common_factor(const Polynomial& p) {
    std::map<std::uint32_t, int> least;
    bool first = true;
    for (const auto& [monomial, coefficient] : p.terms()) {
        if (first) {
            for (const LetterPower& power : monomial) least[power.letter] = power.exponent;
            first = false;
            continue;
        }
        for (auto& [letter, exponent] : least) exponent = std::min(exponent, exponent_of(monomial, letter));
        for (const LetterPower& power : monomial)
            if (power.exponent < 0 && !least.contains(power.letter)) least[power.letter] = power.exponent;
    }
    Monomial result;
    for (const auto& [letter, exponent] : least)
        if (exponent != 0) result.push_back({letter, exponent});
    return result;
}

Polynomial times(const Polynomial& p, const Monomial& m) {
    Polynomial result;
    for (const auto& [monomial, coefficient] : p.terms()) result.add(monomial * m, coefficient);
    return result;
}

}  // namespace

bool NormalForm::is_zero(const ex& e) {
    for (int attempt = 0; attempt < most_restarts; ++attempt) {
        forget();
        try {
            return without_inverses(convert(e)).is_zero();
        } catch (const Restart&) {
        } catch (const TooManyTerms&) {
            throw NoNormalForm("too many terms");
        }
    }
    throw NoNormalForm("angles with too many denominators");
}

void NormalForm::forget() {
    relations_.clear();
    angles_.clear();
    exponentials_.clear();
    roots_.clear();
    signs_.clear();
    inverses_.clear();
    inverse_order_.clear();
    atoms_.clear();
    known_functions_.clear();
    has_relation_.assign(positive_.size(), false);
}

NormalForm::Letter NormalForm::new_letter(bool positive) {
    positive_.push_back(positive);
    has_relation_.push_back(false);
    return static_cast<Letter>(positive_.size() - 1);
}

void NormalForm::relate(Letter letter, int degree, Polynomial value) {
    relations_[letter] = {degree, std::move(value)};
    has_relation_[letter] = true;
}

NormalForm::Letter NormalForm::symbol(const ex& symbol) {
    const std::string name = ex_to<GiNaC::symbol>(symbol).get_name();
    if (const auto known = symbols_.find(name); known != symbols_.end()) return known->second;
    return symbols_[name] = new_letter(symbol.info(GiNaC::info_flags::positive));
}

Polynomial NormalForm::convert(const ex& e) {
    if (GiNaC::is_exactly_a<numeric>(e)) return constant(rational(ex_to<numeric>(e)));
    if (GiNaC::is_a<GiNaC::symbol>(e)) return Polynomial::letter(symbol(e));
    if (GiNaC::is_a<GiNaC::add>(e)) {
        Polynomial sum;
        for (const ex& term : e) sum += convert(term);
        if (sum.size() > most_terms) throw TooManyTerms();
        return sum;
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        Polynomial product(1);
        for (const ex& factor : e) product = multiply(product, convert(factor));
        return product;
    }
    if (const auto known = known_functions_.find(e); known != known_functions_.end()) return known->second;
    Polynomial result;
    if (GiNaC::is_a<GiNaC::power>(e)) result = power(e.op(0), e.op(1));
    else if (GiNaC::is_a<GiNaC::function>(e)) result = function(e);
    else result = atom("constant", e);
    known_functions_.emplace(e, result);
    return result;
}

Polynomial NormalForm::function(const ex& e) {
    const std::string name = ex_to<GiNaC::function>(e).get_name();
    if (name == "sin") return sine_and_cosine(convert(e.op(0))).first;
    if (name == "cos") return sine_and_cosine(convert(e.op(0))).second;
    if (name == "tan") {
        const auto [s, c] = sine_and_cosine(convert(e.op(0)));
        return multiply(s, inverse(c));
    }
    if (name == "exp") return exponential(convert(e.op(0)));
    if (name == "sinh" || name == "cosh" || name == "tanh") {
        const Polynomial grows = exponential(convert(e.op(0)));
        const Polynomial falls = inverse(grows);
        Polynomial sum = grows;
        sum += falls;
        Polynomial difference = grows - falls;
        if (name == "tanh") return multiply(difference, inverse(sum));
        Polynomial& result = name == "sinh" ? difference : sum;
        result *= Rational(1) / 2;
        return result;
    }
    if (name == "sign_of") return sign_of(convert(e.op(0)));
    if (name == "magnitude") {
        const Polynomial x = convert(e.op(0));
        return multiply(x, sign_of(x));
    }
    if (name == "unit_step") {
        Polynomial result = sign_of(convert(e.op(0)));
        result.add(one, 1);
        result *= Rational(1) / 2;
        return result;
    }
    if (name == "minimum" || name == "maximum") {
        const Polynomial a = convert(e.op(0));
        const Polynomial b = convert(e.op(1));
        const Polynomial difference = a - b;
        Polynomial distance = multiply(difference, sign_of(difference));
        Polynomial result = a;
        result += b;
        if (name == "minimum") distance *= Rational(-1);
        result += distance;
        result *= Rational(1) / 2;
        return result;
    }
    return atom(name, e);
}

Polynomial NormalForm::atom(const std::string& name, const ex& e) {
    std::vector<Polynomial> arguments;
    std::string key = name;
    if (GiNaC::is_a<GiNaC::constant>(e)) {
        if (!e.is_equal(GiNaC::Pi)) throw NoNormalForm("an unknown constant");
        key = "pi";
    } else {
        for (const ex& argument : e) arguments.push_back(convert(argument));
    }
    const auto [found, is_new] = atoms_.emplace(std::pair(key, arguments), 0);
    if (is_new) found->second = new_letter(key == "pi");
    return Polynomial::letter(found->second);
}

/// The whole multiple of atom/denominator that factor*atom is.
int NormalForm::multiple(const Rational& factor, const Monomial& atom, std::map<Monomial, int>& denominators) {
    int& denominator = denominators.emplace(atom, 1).first->second;
    const auto needed = to_int(cln::denominator(factor));
    if (!needed || *needed > 1000) throw NoNormalForm("an angle with a large denominator");
    if (denominator % *needed != 0) {
        denominator = std::lcm(denominator, *needed);
        throw Restart();
    }
    const auto result = to_int(factor * denominator);
    if (!result || std::abs(*result) > largest_multiple) throw NoNormalForm("a large multiple of an angle");
    return *result;
}

std::pair<Polynomial, Polynomial> NormalForm::sine_and_cosine(const Polynomial& argument) {
    Polynomial s;
    Polynomial c(1);
    const auto turn = [&](const Polynomial& sine, const Polynomial& cosine) {
        Polynomial new_s = multiply(s, cosine);
        new_s += multiply(c, sine);
        c = multiply(c, cosine) - multiply(s, sine);
        s = std::move(new_s);
    };
    for (const auto& [monomial, factor] : argument.terms()) {
        const int n = multiple(factor, monomial, angle_denominators_);
        auto found = angles_.find(monomial);
        if (found == angles_.end()) {
            const Angle angle{new_letter(), new_letter()};
            Polynomial one_minus_c2(1);
            one_minus_c2.add({{angle.second, 2}}, -1);
            relate(angle.first, 2, one_minus_c2);
            found = angles_.emplace(monomial, angle).first;
        }
        const Polynomial cosine = Polynomial::letter(found->second.second);
        const Polynomial sine = n > 0 ? Polynomial::letter(found->second.first) : minus(Polynomial::letter(found->second.first));
        for (int i = 0; i < std::abs(n); ++i) turn(sine, cosine);
    }
    return {s, c};
}

Polynomial NormalForm::exponential(const Polynomial& argument) {
    Monomial product;
    for (const auto& [monomial, factor] : argument.terms()) {
        const int n = multiple(factor, monomial, exponential_denominators_);
        auto found = exponentials_.find(monomial);
        if (found == exponentials_.end()) found = exponentials_.emplace(monomial, Angle{new_letter(true), 0}).first;
        product = product * Monomial{{found->second.first, n}};
    }
    Polynomial result;
    result.add(product, 1);
    return result;
}

/// S with S^2 = 1, the same letter for x and, with the other sign, for -x. At x = 0 nothing is claimed.
Polynomial NormalForm::sign_of(const Polynomial& argument) {
    if (argument.is_zero()) return {};
    Polynomial positive = argument;
    const Rational factor = leading(argument);
    positive *= Rational(1) / factor;
    const auto [found, is_new] = signs_.emplace(positive, 0);
    if (is_new) {
        found->second = new_letter();
        relate(found->second, 2, Polynomial(1));
    }
    Polynomial result = Polynomial::letter(found->second);
    if (is_negative(factor)) result *= Rational(-1);
    return result;
}

Polynomial NormalForm::power(const ex& base, const ex& exponent) {
    if (GiNaC::is_exactly_a<numeric>(exponent)) {
        const Rational e = rational(ex_to<numeric>(exponent));
        const auto numerator = to_int(cln::numerator(e));
        const auto denominator = to_int(cln::denominator(e));
        if (!numerator || !denominator || *denominator > largest_power) throw NoNormalForm("a large exponent");
        const Polynomial b = convert(base);
        return integer_power(*denominator == 1 ? b : root(b, *denominator), *numerator);
    }
    // b^(r + ...) with rational r: the rational part is taken out, so that b^(k+1) = b*b^k.
    const Polynomial e = convert(exponent);
    Rational whole = 0;
    if (const auto number = e.terms().find(one); number != e.terms().end()) whole = cln::floor1(number->second);
    const auto n = to_int(whole);
    if (!n) throw NoNormalForm("a large exponent");
    const Polynomial rest = e - constant(whole);
    const std::vector<Polynomial> key{convert(base), rest};
    const auto [found, is_new] = atoms_.emplace(std::pair(std::string("power"), key), 0);
    if (is_new) found->second = new_letter(true);
    return multiply(Polynomial::letter(found->second), integer_power(key[0], *n));
}

/// b^(1/q), q > 1, for b where that is real. Positive factors are taken out.
Polynomial NormalForm::root(const Polynomial& base, int degree) {
    if (base.is_zero()) return {};
    Rational factor = leading(base);
    if (is_negative(factor)) factor = -factor;
    Polynomial outside = root_of_number(factor, degree);
    Polynomial inside = base;
    inside *= Rational(1) / factor;
    for (const LetterPower& p : common_factor(inside)) {
        if (!positive_[p.letter]) continue;
        inside = times(inside, {{p.letter, -p.exponent}});
        if (p.exponent % degree == 0) {
            outside = multiply(outside, integer_power(Polynomial::letter(p.letter), p.exponent / degree));
            continue;
        }
        const auto [found, is_new] = roots_.emplace(std::pair(Polynomial::letter(p.letter), degree), 0);
        if (is_new) {
            found->second = new_letter(true);
            relate(found->second, degree, Polynomial::letter(p.letter));
        }
        outside = multiply(outside, integer_power(Polynomial::letter(found->second), p.exponent));
    }
    if (inside == Polynomial(1)) return outside;
    const auto [found, is_new] = roots_.emplace(std::pair(inside, degree), 0);
    if (is_new) {
        found->second = new_letter(true);
        relate(found->second, degree, inside);
    }
    return multiply(outside, Polynomial::letter(found->second));
}

/// The root of a positive number as a number times roots of primes (and of one cofactor without small primes).
Polynomial NormalForm::root_of_number(const Rational& value, int degree) {
    Polynomial result(1);
    const auto take = [&](const cln::cl_I& prime, int exponent) {
        const int whole = exponent >= 0 ? exponent / degree : -((-exponent + degree - 1) / degree);
        result *= cln::expt(Rational(prime), cln::cl_I(whole));
        const int rest = exponent - whole * degree;
        if (rest == 0) return;
        const auto [found, is_new] = roots_.emplace(std::pair(constant(prime), degree), 0);
        if (is_new) {
            found->second = new_letter(true);
            relate(found->second, degree, constant(prime));
        }
        result = multiply(result, Polynomial::letter(found->second, rest));
    };
    const auto factorise = [&](cln::cl_I n, int sign) {
        for (int prime = 2; prime < 1000 && n > 1; ++prime) {
            int exponent = 0;
            while (cln::zerop(cln::mod(n, cln::cl_I(prime)))) {
                n = cln::exquo(n, cln::cl_I(prime));
                ++exponent;
            }
            if (exponent > 0) take(prime, sign * exponent);
        }
        if (n > 1) take(n, sign);
    };
    factorise(cln::numerator(value), 1);
    factorise(cln::denominator(value), -1);
    return result;
}

void NormalForm::add_reduced(Polynomial& to, const Monomial& monomial, const Rational& coefficient) {
    for (const LetterPower& p : monomial) {
        if (!has_relation_[p.letter]) continue;
        const Relation& relation = relations_.at(p.letter);
        if (p.exponent < relation.degree) continue;
        Monomial rest = without(monomial, p.letter);
        if (const int left = p.exponent % relation.degree; left != 0) rest = rest * Monomial{{p.letter, left}};
        const Polynomial value = integer_power(relation.value, p.exponent / relation.degree);
        for (const auto& [m, c] : value.terms()) add_reduced(to, rest * m, coefficient * c);
        return;
    }
    to.add(monomial, coefficient);
}

Polynomial NormalForm::multiply(const Polynomial& a, const Polynomial& b) {
    if (static_cast<double>(a.size()) * static_cast<double>(b.size()) > most_products) throw TooManyTerms();
    Polynomial result;
    for (const auto& [ma, ca] : a.terms()) {
        for (const auto& [mb, cb] : b.terms()) add_reduced(result, ma * mb, ca * cb);
        if (result.size() > most_terms) throw TooManyTerms();
    }
    return result;
}

Polynomial NormalForm::integer_power(const Polynomial& base, int exponent) {
    if (exponent < 0) return integer_power(inverse(base), -exponent);
    if (exponent > largest_power && !base.is_monomial()) throw NoNormalForm("a large power");
    if (exponent > 1 && base.is_monomial() && base.terms().begin()->first.empty()) return constant(cln::expt(leading(base), cln::cl_I(exponent)));
    Polynomial result(1);
    Polynomial square = base;
    for (int left = exponent; left > 0; left /= 2) {
        if (left % 2 == 1) result = multiply(result, square);
        if (left > 1) square = multiply(square, square);
    }
    return result;
}

Polynomial NormalForm::inverse(const Polynomial& p) {
    if (p.is_zero()) throw NoNormalForm("a division by zero");
    const Monomial common = common_factor(p);
    // Letters with a relation are inverted through it; the others get negative exponents.
    Polynomial result(Rational(1) / leading(p));
    Polynomial rest = p;
    rest *= Rational(1) / leading(p);
    for (const LetterPower& power : common) {
        rest = times(rest, {{power.letter, -power.exponent}});
        if (!has_relation_[power.letter]) {
            result = times(result, {{power.letter, -power.exponent}});
            continue;
        }
        const Relation& relation = relations_.at(power.letter);
        Polynomial one_over = inverse(relation.value);
        one_over = multiply(one_over, Polynomial::letter(power.letter, relation.degree - 1));
        result = multiply(result, integer_power(one_over, power.exponent));
    }
    if (rest == Polynomial(1)) return result;
    const auto [found, is_new] = inverses_.emplace(rest, 0);
    if (is_new) {
        found->second = new_letter();
        inverse_order_.emplace_back(found->second, rest);
    }
    return multiply(result, Polynomial::letter(found->second));
}

/// Multiplies by the denominators until no reciprocal is left; a denominator is not zero where the expression is defined.
Polynomial NormalForm::without_inverses(Polynomial p) {
    for (auto inverse = inverse_order_.rbegin(); inverse != inverse_order_.rend(); ++inverse) {
        const auto& [letter, denominator] = *inverse;
        int highest = 0;
        for (const auto& [monomial, coefficient] : p.terms()) highest = std::max(highest, exponent_of(monomial, letter));
        if (highest == 0) continue;
        std::vector<Polynomial> by_exponent(static_cast<std::size_t>(highest) + 1);
        for (const auto& [monomial, coefficient] : p.terms())
            by_exponent[static_cast<std::size_t>(highest - exponent_of(monomial, letter))].add(without(monomial, letter), coefficient);
        Polynomial result;
        Polynomial denominators(1);
        for (const Polynomial& part : by_exponent) {
            result += multiply(part, denominators);
            denominators = multiply(denominators, denominator);
        }
        p = std::move(result);
    }
    return p;
}

}  // namespace dalembert
