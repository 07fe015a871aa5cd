// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/polynomial.hpp"

#include <algorithm>

namespace dalembert {

Monomial operator*(const Monomial& a, const Monomial& b) {
    Monomial result;
    result.reserve(a.size() + b.size());
    auto i = a.begin();
    auto j = b.begin();
    while (i != a.end() || j != b.end()) {
        if (j == b.end() || (i != a.end() && i->letter < j->letter)) {
            result.push_back(*i++);
        } else if (i == a.end() || j->letter < i->letter) {
            result.push_back(*j++);
        } else {
            if (const std::int32_t sum = i->exponent + j->exponent; sum != 0) result.push_back({i->letter, sum});
            ++i;
            ++j;
        }
    }
    return result;
}

Monomial raised(const Monomial& m, int exponent) {
    if (exponent == 0) return {};
    Monomial result = m;
    for (LetterPower& power : result) power.exponent *= exponent;
    return result;
}

int exponent_of(const Monomial& m, std::uint32_t letter) {
    const auto found = std::lower_bound(m.begin(), m.end(), letter, [](const LetterPower& p, std::uint32_t l) { return p.letter < l; });
    return found != m.end() && found->letter == letter ? found->exponent : 0;
}

Monomial without(const Monomial& m, std::uint32_t letter) {
    Monomial result;
    for (const LetterPower& power : m)
        if (power.letter != letter) result.push_back(power);
    return result;
}

Polynomial Polynomial::letter(std::uint32_t letter, int exponent) {
    Polynomial result;
    if (exponent == 0) result.add({}, 1);
    else result.add({{letter, exponent}}, 1);
    return result;
}

void Polynomial::add(Monomial monomial, const Rational& coefficient) {
    if (dalembert::is_zero(coefficient)) return;
    const auto [term, is_new] = terms_.try_emplace(std::move(monomial), coefficient);
    if (is_new) return;
    term->second = term->second + coefficient;
    if (dalembert::is_zero(term->second)) terms_.erase(term);
}

Polynomial& Polynomial::operator+=(const Polynomial& other) {
    for (const auto& [monomial, coefficient] : other.terms_) add(monomial, coefficient);
    return *this;
}

Polynomial& Polynomial::operator*=(const Rational& factor) {
    if (dalembert::is_zero(factor)) {
        terms_.clear();
        return *this;
    }
    for (auto& [monomial, coefficient] : terms_) coefficient = coefficient * factor;
    return *this;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) {
    Polynomial result = a;
    for (const auto& [monomial, coefficient] : b.terms_) result.add(monomial, -coefficient);
    return result;
}

bool operator<(const Polynomial& a, const Polynomial& b) {
    return std::lexicographical_compare(
        a.terms_.begin(), a.terms_.end(), b.terms_.begin(), b.terms_.end(),
        [](const auto& x, const auto& y) { return x.first != y.first ? x.first < y.first : x.second < y.second; });
}

bool operator==(const Polynomial& a, const Polynomial& b) {
    return std::equal(a.terms_.begin(), a.terms_.end(), b.terms_.begin(), b.terms_.end(),
                      [](const auto& x, const auto& y) { return x.first == y.first && x.second == y.second; });
}

Polynomial Polynomial::product(const Polynomial& a, const Polynomial& b, std::size_t limit) {
    Polynomial result;
    for (const auto& [ma, ca] : a.terms_) {
        for (const auto& [mb, cb] : b.terms_) result.add(ma * mb, ca * cb);
        if (result.size() > limit) throw TooManyTerms();
    }
    return result;
}

Polynomial operator*(const Polynomial& p, const Monomial& m) {
    Polynomial result;
    for (const auto& [monomial, coefficient] : p.terms()) result.add(monomial * m, coefficient);
    return result;
}

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

}  // namespace dalembert
