// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/normal_form.hpp"

#include "prove/angle_basis.hpp"
#include "text/budgets.hpp"

#include <algorithm>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

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
            const bool result = vanishes(convert(e));
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
    // By the symbol itself: a letter that a proof makes may be called what something in the model is.
    if (const auto known = symbols_.find(symbol); known != symbols_.end()) return known->second;
    const std::string name = ex_to<GiNaC::symbol>(symbol).get_name();
    const Letter letter = new_letter(symbol.info(GiNaC::info_flags::positive) || assumed_positive_.contains(name));
    symbols_[symbol] = letter;
    for (const auto& [scalar, x, y, z] : unit_quaternions_)
        if (scalar.is_equal(symbol)) relate(letter, 2, convert(1 - GiNaC::pow(x, 2) - GiNaC::pow(y, 2) - GiNaC::pow(z, 2)));
    return letter;
}

/// The name of the symbol that a monomial is, if it is one.
std::string NormalForm::symbol_named(const Monomial& monomial) const {
    if (monomial.size() != 1 || monomial[0].exponent != 1) return {};
    for (const auto& [symbol, letter] : symbols_)
        if (letter == monomial[0].letter) return ex_to<GiNaC::symbol>(symbol).get_name();
    return {};
}

Polynomial NormalForm::convert(const ex& e) {
    if (GiNaC::is_exactly_a<numeric>(e)) return Polynomial(rational(ex_to<numeric>(e)));
    if (e.info(GiNaC::info_flags::symbol)) return Polynomial::letter(symbol(e));
    if (GiNaC::is_exactly_a<GiNaC::add>(e)) {
        Polynomial sum;
        for (const ex& term : e) sum += convert(term);
        if (sum.size() > budget::polynomial_terms) throw TooManyTerms();
        return sum;
    }
    if (GiNaC::is_exactly_a<GiNaC::mul>(e)) return product_of(e);
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

/// Of factors with one term each only the product is reduced.
Polynomial NormalForm::product_of(const ex& factors) {
    Monomial monomial;
    Rational coefficient = 1;
    std::vector<Polynomial> sums;
    for (const ex& factor : factors) {
        if (GiNaC::is_exactly_a<numeric>(factor)) {
            coefficient = coefficient * rational(ex_to<numeric>(factor));
        } else if (factor.info(GiNaC::info_flags::symbol)) {
            monomial = monomial * Monomial{{symbol(factor), 1}};
        } else if (Polynomial one = convert(factor); one.is_monomial()) {
            monomial = monomial * one.terms().begin()->first;
            coefficient = coefficient * one.terms().begin()->second;
        } else {
            sums.push_back(std::move(one));
        }
    }
    Polynomial product;
    add_reduced(product, std::move(monomial), coefficient);
    for (const Polynomial& sum : sums) product = multiply(product, sum);
    return product;
}

void NormalForm::note_argument(const ex& e) {
    bool may_hide = false;
    for (auto part = e.preorder_begin(); part != e.preorder_end() && !may_hide; ++part) {
        const bool is_root = GiNaC::is_a<GiNaC::power>(*part) && !part->op(1).info(GiNaC::info_flags::integer);
        may_hide = is_root || GiNaC::is_a<GiNaC::function>(*part);
    }
    if (may_hide) must_not_vanish_.insert(e);
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

void NormalForm::add_reduced(Polynomial& to, Monomial monomial, const Rational& coefficient) {
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
    to.add(std::move(monomial), coefficient);
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

/// None where the letter is no reciprocal.
const Polynomial* NormalForm::denominator_of(Letter reciprocal) const {
    const auto found = std::lower_bound(inverse_order_.begin(), inverse_order_.end(), reciprocal,
                                        [](const auto& known, Letter letter) { return known.first < letter; });
    return found != inverse_order_.end() && found->first == reciprocal ? &found->second : nullptr;
}

/// Multiplies by the denominator of the reciprocal `letter` until it is gone; the denominator is not zero where the expression is defined.
Polynomial NormalForm::without_inverse(const Polynomial& p, Letter letter, const Polynomial& denominator) {
    int highest = 0;
    for (const auto& [monomial, coefficient] : p.terms()) highest = std::max(highest, exponent_of(monomial, letter));
    std::vector<Polynomial> by_exponent(static_cast<std::size_t>(highest) + 1);
    for (const auto& [monomial, coefficient] : p.terms())
        by_exponent[static_cast<std::size_t>(highest - exponent_of(monomial, letter))].add(without(monomial, letter), coefficient);
    Polynomial result;
    Polynomial denominators(1);
    for (const Polynomial& part : by_exponent) {
        result += multiply(part, denominators);
        denominators = multiply(denominators, denominator);
    }
    return result;
}

/// Which letters change when the reciprocals among `letters` are multiplied away: those in denominators, and those in the values of
/// relations of such letters.
std::set<NormalForm::Letter> NormalForm::touched_by_inverses(const std::set<Letter>& letters) const {
    std::set<Letter> touched;
    std::vector<Letter> open;
    const auto touch = [&](const Polynomial& p) {
        for (const auto& [monomial, coefficient] : p.terms())
            for (const LetterPower& power : monomial)
                if (touched.insert(power.letter).second) open.push_back(power.letter);
    };
    const auto touch_denominator = [&](Letter letter) {
        if (const Polynomial* denominator = denominator_of(letter)) {
            touched.insert(letter);
            touch(*denominator);
        }
    };
    for (const Letter letter : letters) touch_denominator(letter);
    while (!open.empty()) {
        const Letter letter = open.back();
        open.pop_back();
        touch_denominator(letter);
        if (has_relation_[letter]) touch(relations_.at(letter).value);
    }
    return touched;
}

/// Whether a polynomial with reciprocals is zero. Terms that differ in letters which no denominator touches never meet: each group of
/// them is zero alone. Reducing the square of a root may bring a reciprocal back that was gone already, so the depth is bounded.
bool NormalForm::vanishes(const Polynomial& p, int depth) {
    constexpr int deepest = 500;
    if (depth > deepest) throw NoNormalForm("reciprocals that do not cancel");
    std::set<Letter> letters;
    for (const auto& [monomial, coefficient] : p.terms())
        for (const LetterPower& power : monomial) letters.insert(power.letter);
    const std::set<Letter> touched = touched_by_inverses(letters);
    if (touched.empty()) return p.is_zero();

    std::map<Monomial, Polynomial> groups;
    for (const auto& [monomial, coefficient] : p.terms()) {
        Monomial apart, rest;
        for (const LetterPower& power : monomial) (touched.contains(power.letter) ? rest : apart).push_back(power);
        groups[apart].add(std::move(rest), coefficient);
    }
    if (groups.size() > 1)
        return std::all_of(groups.begin(), groups.end(), [&](const auto& group) { return vanishes(group.second, depth + 1); });
    // The latest first: its denominator may hold earlier ones.
    const auto inverse = std::find_if(inverse_order_.rbegin(), inverse_order_.rend(),
                                      [&](const auto& known) { return letters.contains(known.first); });
    return vanishes(without_inverse(groups.begin()->second, inverse->first, inverse->second), depth + 1);
}

}  // namespace dalembert
