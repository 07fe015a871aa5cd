// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/normal_form.hpp"

#include "prove/angle_basis.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/scalar_functions.hpp"
#include "text/budgets.hpp"

#include <algorithm>
#include <numeric>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

constexpr int largest_multiple = 24;
constexpr int most_restarts = 200;

}  // namespace

Rational NormalForm::rational(const numeric& value) {
    if (!value.is_rational()) throw NoNormalForm("a number that is not rational");
    return cln::the<cln::cl_RA>(value.to_cl_N());
}

bool NormalForm::is_zero(const ex& given) {
    // Assumptions name angles.
    const ShortAngles angles = assumed_positive_.empty() ? with_short_angles(given) : ShortAngles{given, {}};
    const ex& e = angles.expression;
    work_ = 0;
    logarithm_factors_.clear();
    for (int attempt = 0; attempt < most_restarts; ++attempt) {
        forget();
        try {
            if (!functions_are_letters_) roots_first(e);
            if (joins_roots_) simple_roots_first(e);
            const bool result = without_inverses(convert(e)).is_zero();
            // Positive is what a logarithm is taken of, here and not before a restart alone.
            if (!std::includes(logarithms_of_.begin(), logarithms_of_.end(), divided_by_.begin(), divided_by_.end()))
                throw NoNormalForm("logarithms that went");
            std::set<ex, GiNaC::ex_is_less> claimed;
            for (const ex& claim : must_not_vanish_) claimed.insert(claim.subs(angles.meaning, GiNaC::subs_options::no_pattern));
            must_not_vanish_ = std::move(claimed);
            return result;
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
    logarithms_.clear();
    logarithms_of_.clear();
    divided_by_.clear();
    known_functions_.clear();
    symbols_.clear();
    positive_.clear();
    has_relation_.clear();
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
    return symbols_[name] = new_letter(symbol.info(GiNaC::info_flags::positive) || assumed_positive_.contains(name));
}

/// The name of the symbol that a monomial is, if it is one.
std::string NormalForm::symbol_named(const Monomial& monomial) const {
    if (monomial.size() != 1 || monomial[0].exponent != 1) return {};
    for (const auto& [name, letter] : symbols_)
        if (letter == monomial[0].letter) return name;
    return {};
}

Polynomial NormalForm::convert(const ex& e) {
    if (GiNaC::is_exactly_a<numeric>(e)) return Polynomial(rational(ex_to<numeric>(e)));
    if (GiNaC::is_a<GiNaC::symbol>(e)) return Polynomial::letter(symbol(e));
    if (GiNaC::is_a<GiNaC::add>(e)) {
        Polynomial sum;
        for (const ex& term : e) sum += convert(term);
        if (sum.size() > budget::polynomial_terms) throw TooManyTerms();
        return sum;
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        Polynomial product(1);
        for (const ex& factor : e) product = multiply(product, convert(factor));
        return product;
    }
    if (const auto known = known_functions_.find(e); known != known_functions_.end()) return known->second;
    Polynomial result;
    if (GiNaC::is_a<GiNaC::power>(e)) {
        if (!e.op(1).info(GiNaC::info_flags::nonnegint)) note_argument(e.op(0));
        result = power(e.op(0), e.op(1));
    }
    else if (GiNaC::is_a<GiNaC::function>(e)) result = function(e);
    else result = atom("constant", e);
    known_functions_.emplace(e, result);
    return result;
}

void NormalForm::note_argument(const ex& e) {
    bool may_hide = false;
    for (auto part = e.preorder_begin(); part != e.preorder_end() && !may_hide; ++part) {
        const bool is_root = GiNaC::is_a<GiNaC::power>(*part) && !part->op(1).info(GiNaC::info_flags::integer);
        may_hide = is_root || GiNaC::is_a<GiNaC::function>(*part);
    }
    if (may_hide) must_not_vanish_.insert(e);
}

Polynomial NormalForm::function(const ex& e) {
    const std::string name = ex_to<GiNaC::function>(e).get_name();
    static const std::set<std::string> with_sign{"sign_of",      "magnitude",    "unit_step", "if_else",     "signed_root",
                                                 "inverse_root", "forward_root", "norm",      "inverse_norm"};
    if (with_sign.contains(name)) note_argument(e.op(0));
    if (name == "minimum" || name == "maximum") note_argument(e.op(0) - e.op(1));
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
    if (name == "whole" || name == "unlocated") return convert(e.op(0));
    if (name == "sum_of_three") return convert(e.op(0) + e.op(1) + e.op(2));
    if (const ScalarFunction* known = scalar_function_of(e); known != nullptr && known->meaning != nullptr) {
        if (known->fills_gap) note_argument(e.op(0));
        return convert(in_elementary_functions(e));
    }
    if (name == "log") return logarithm(convert(e.op(0)));
    if (name == "asin" || name == "atan" || name == "acos") {  // odd ones, but for the quarter turn that acos is from asin
        const Polynomial x = convert(e.op(0));
        const std::string odd = name == "atan" ? "atan" : "asin";
        const bool is_turned = !x.is_zero() && is_negative(leading(x));
        Polynomial result = atom_of(odd, {is_turned ? -x : x});
        if (is_turned != (name == "acos")) result *= Rational(-1);
        if (name != "acos") return result;
        Polynomial quarter = convert(GiNaC::Pi);
        quarter *= Rational(1) / 2;
        return result += quarter;
    }
    if (name == "signed_root" || name == "inverse_root" || name == "forward_root") {
        const Polynomial x = convert(e.op(0));
        const Polynomial sign = sign_of(x);
        const Polynomial magnitude_root = root(multiply(x, sign), 2);
        if (name == "inverse_root") return inverse(magnitude_root);
        Polynomial factor = sign;
        if (name == "forward_root") {
            factor += Polynomial(1);
            factor *= Rational(1) / 2;
        }
        return multiply(factor, magnitude_root);
    }
    if (name == "outflow_factor") {
        const Polynomial d = convert(e.op(0));
        const Polynomial k = convert(e.op(1));
        if (d.is_constant() && k.is_constant() && !d.is_zero() && !k.is_zero()) return outflow_factor(leading(d), leading(k));
        return atom(name, e);
    }
    if (const auto heat = heat_function(name, e)) return *heat;
    if (name == "norm") return root(convert(e.op(0)), 2);
    if (name == "inverse_norm") return inverse(root(convert(e.op(0)), 2));
    const auto where_positive = [&] {
        Polynomial result = sign_of(convert(e.op(0)));
        result.add({}, 1);
        result *= Rational(1) / 2;
        return result;
    };
    if (name == "unit_step") return where_positive();
    if (name == "if_else") {
        const Polynomial otherwise = convert(e.op(2));
        Polynomial result = multiply(where_positive(), convert(e.op(1)) - otherwise);
        result += otherwise;
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
    return atom_of(key, arguments);
}

Polynomial NormalForm::atom_of(const std::string& name, const std::vector<Polynomial>& arguments) {
    const auto [found, is_new] = atoms_.emplace(std::pair(name, arguments), 0);
    if (is_new) found->second = new_letter(name == "pi");
    return Polynomial::letter(found->second);
}

/// Sine and cosine of a part of pi, where GiNaC knows one of them, or of the double angle.
std::optional<std::pair<Polynomial, Polynomial>> NormalForm::of_part_of_pi(const Rational& part) {
    const auto known = [](const ex& e) {
        return std::none_of(e.preorder_begin(), e.preorder_end(), [](const ex& inner) { return GiNaC::is_a<GiNaC::function>(inner); });
    };
    const auto square_root = [&](const Polynomial& square, bool is_positive) {
        Polynomial result = root(square, 2);
        return is_positive ? result : -result;
    };
    const ex angle = numeric(part) * GiNaC::Pi, sine = GiNaC::sin(angle), cosine = GiNaC::cos(angle);
    const Rational turns = part / 2, fraction = turns - cln::floor1(turns);  // of a whole turn
    const bool is_above = fraction < Rational(1) / 2, is_right = fraction < Rational(1) / 4 || fraction > Rational(3) / 4;
    if (known(sine) && known(cosine)) return std::pair(convert(sine), convert(cosine));
    if (known(cosine)) {
        const Polynomial c = convert(cosine);
        return std::pair(square_root(Polynomial(1) - multiply(c, c), is_above), c);
    }
    if (known(sine)) {
        const Polynomial s = convert(sine);
        return std::pair(s, square_root(Polynomial(1) - multiply(s, s), is_right));
    }
    if (cln::denominator(part) > 200 || cln::oddp(cln::denominator(part))) return std::nullopt;
    const auto doubled = of_part_of_pi(part * 2);
    if (!doubled) return std::nullopt;
    Polynomial sine_square = Polynomial(1) - doubled->second, cosine_square = Polynomial(1);
    cosine_square += doubled->second;
    sine_square *= Rational(1) / 2;
    cosine_square *= Rational(1) / 2;
    return std::pair(square_root(sine_square, is_above), square_root(cosine_square, is_right));
}

/// Sine and cosine of an arc function.
std::optional<std::pair<Polynomial, Polynomial>> NormalForm::of_arc(const Monomial& monomial) {
    if (monomial.size() != 1 || monomial[0].exponent != 1 || angle_denominators_.at(monomial) != 1) return std::nullopt;
    for (const auto& [key, letter] : std::map(atoms_)) {
        if (letter != monomial[0].letter || (key.first != "atan" && key.first != "asin")) continue;
        const Polynomial& x = key.second[0];
        Polynomial square = multiply(x, x);
        if (key.first == "asin") return std::pair(x, root(Polynomial(1) - square, 2));
        square += Polynomial(1);
        const Polynomial cosine = inverse(root(square, 2));
        return std::pair(multiply(x, cosine), cosine);
    }
    return std::nullopt;
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
    const auto pi = atoms_.find(std::pair(std::string("pi"), std::vector<Polynomial>()));
    for (const auto& [monomial, factor] : argument.terms()) {
        if (pi != atoms_.end() && monomial == Monomial{{pi->second, 1}})
            if (const auto known = of_part_of_pi(factor)) {
                turn(known->first, known->second);
                continue;
            }
        const int n = multiple(factor, monomial, angle_denominators_);
        if (const auto arc = of_arc(monomial)) {
            for (int i = 0; i < std::abs(n); ++i) turn(n > 0 ? arc->first : -arc->first, arc->second);
            continue;
        }
        auto found = angles_.find(monomial);
        if (found == angles_.end()) {
            // Of part of an angle the sine is positive where that of the whole is; a cosine likewise.
            const std::string name = symbol_named(monomial);
            const bool sine_is_positive = assumed_positive_.contains("sin(" + name + ")"),
                       cosine_is_positive = assumed_positive_.contains("cos(" + name + ")");
            const Letter sine_letter = new_letter(sine_is_positive);
            const Angle angle{sine_letter, new_letter(cosine_is_positive)};
            Polynomial one_minus_c2(1);
            one_minus_c2.add({{angle.second, 2}}, -1);
            relate(angle.first, 2, one_minus_c2);
            found = angles_.emplace(monomial, angle).first;
        }
        const Polynomial cosine = Polynomial::letter(found->second.second);
        const Polynomial sine = n > 0 ? Polynomial::letter(found->second.first) : -Polynomial::letter(found->second.first);
        for (int i = 0; i < std::abs(n); ++i) turn(sine, cosine);
    }
    return {s, c};
}

Polynomial NormalForm::exponential(const Polynomial& given) {
    const Polynomial argument = in_partial_fractions(given);
    Monomial product;
    Polynomial powers(1);
    for (const auto& [monomial, factor] : argument.terms()) {
        // exp(n/d*log(x)) = x^(n/d)
        if (monomial.size() == 1 && monomial[0].exponent == 1 && logarithms_.contains(monomial[0].letter)) {
            const auto n = to_int(cln::numerator(factor));
            const auto d = to_int(cln::denominator(factor));
            if (!n || !d) throw NoNormalForm("a large exponent");
            const Polynomial& base = logarithms_.at(monomial[0].letter);
            powers = multiply(powers, integer_power(*d == 1 ? base : root(base, *d), *n));
            continue;
        }
        const int n = multiple(factor, monomial, exponential_denominators_);
        auto found = exponentials_.find(monomial);
        if (found == exponentials_.end()) found = exponentials_.emplace(monomial, Angle{new_letter(true), 0}).first;
        product = product * Monomial{{found->second.first, n}};
    }
    Polynomial result;
    result.add(product, 1);
    return multiply(result, powers);
}

/// x/(x + c) as 1 - c/(x + c), so that exponents that are equal look so. Where the denominator has a letter once and alone.
Polynomial NormalForm::in_partial_fractions(Polynomial p) const {
    constexpr int most_steps = 100;
    for (int step = 0; step < most_steps; ++step) {
        bool any = false;
        for (const auto& inverse : inverse_order_) {
            const Letter reciprocal = inverse.first;
            const Polynomial& denominator = inverse.second;
            const Monomial& first = denominator.terms().begin()->first.empty() ? std::next(denominator.terms().begin())->first
                                                                               : denominator.terms().begin()->first;
            if (first.size() != 1 || first[0].exponent != 1) continue;
            const Letter letter = first[0].letter;
            const bool is_alone = std::none_of(denominator.terms().begin(), denominator.terms().end(), [&](const auto& term) {
                return term.first != first && exponent_of(term.first, letter) != 0;
            });
            if (!is_alone) continue;
            const auto found = std::find_if(p.terms().begin(), p.terms().end(), [&](const auto& term) {
                return exponent_of(term.first, letter) > 0 && exponent_of(term.first, reciprocal) > 0;
            });
            if (found == p.terms().end()) continue;
            any = true;
            const auto [monomial, coefficient] = *found;
            const Rational scale = coefficient / denominator.terms().at(first);
            const Monomial rest = monomial * Monomial{{letter, -1}};
            p.add(monomial, -coefficient);
            p.add(rest * Monomial{{reciprocal, -1}}, scale);
            for (const auto& [other, factor] : denominator.terms())
                if (other != first) p.add(rest * other, -scale * factor);
        }
        if (!any) break;
    }
    return p;
}

/// S with S^2 = 1, the same letter for x and, with the other sign, for -x. At x = 0 nothing is claimed.
Polynomial NormalForm::sign_of(const Polynomial& whole) {
    if (without_inverses(whole).is_zero()) return {};
    Polynomial argument = whole;
    if (joins_roots_) {
        clear_by_squares(argument, false);
        take_radicands(argument);
    }
    const bool negative = is_negative(leading(argument));
    const auto has_that_sign = [&](const auto& term) {
        const auto& [monomial, coefficient] = term;
        return is_negative(coefficient) == negative &&
               std::all_of(monomial.begin(), monomial.end(), [&](const LetterPower& p) { return positive_[p.letter]; });
    };
    if (std::all_of(argument.terms().begin(), argument.terms().end(), has_that_sign)) return Polynomial(negative ? -1 : 1);
    Polynomial positive = argument * raised(positive_factor(argument), -1);
    const Rational factor = leading(positive);
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
    work_ += 1 + static_cast<double>(bit_length(coefficient)) / 64;
    to.add(monomial, coefficient);
}

Polynomial NormalForm::multiply(const Polynomial& a, const Polynomial& b) {
    if (static_cast<double>(a.size()) * static_cast<double>(b.size()) > budget::polynomial_products) throw TooManyTerms();
    Polynomial result;
    for (const auto& [ma, ca] : a.terms()) {
        for (const auto& [mb, cb] : b.terms()) add_reduced(result, ma * mb, ca * cb);
        if (work_ > budget::proof_work) throw TooManyTerms();
        if (result.size() > budget::polynomial_terms) throw TooManyTerms();
    }
    return result;
}

/// Multiplies by the denominators until no reciprocal is left; a denominator is not zero where the expression is defined. Reducing the
/// square of a root may bring a reciprocal back that was gone already, so one round is not always enough.
Polynomial NormalForm::without_inverses(Polynomial p) {
    const auto highest_power = [&](Letter letter) {
        int highest = 0;
        for (const auto& [monomial, coefficient] : p.terms()) highest = std::max(highest, exponent_of(monomial, letter));
        return highest;
    };
    constexpr int most_rounds = 20;
    for (int round = 0; round < most_rounds; ++round) {
        bool any = false;
        for (auto inverse = inverse_order_.rbegin(); inverse != inverse_order_.rend(); ++inverse) {
            const auto& [letter, denominator] = *inverse;
            const int highest = highest_power(letter);
            if (highest == 0) continue;
            any = true;
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
        if (!any) return p;
    }
    throw NoNormalForm("reciprocals that do not go away");
}

}  // namespace dalembert
