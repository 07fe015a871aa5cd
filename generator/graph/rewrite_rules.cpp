// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/rewrite_rules.hpp"

#include <algorithm>

#include "graph/lower.hpp"
#include "graph/rewrite_terms.hpp"

namespace dalembert {

namespace {

/// k*T*f - k*T -> k*T*replacement, for all terms in which f is a factor once: `replace` says with what, from the exponent of f.
template <class Replace>
Forms without_one(const Polynomial& p, Letter f, const Replace& replace) {
    std::optional<Polynomial> result;
    for (const auto& [monomial, coefficient] : p.terms()) {
        const int exponent = exponent_of(monomial, f);
        if (exponent == 0) continue;
        const Monomial rest = without(monomial, f);
        const Polynomial& now = result ? *result : p;
        const auto partner = now.terms().find(rest);
        if (partner == now.terms().end() || partner->second != -coefficient) continue;
        const std::optional<Polynomial> replacement = replace(exponent);
        if (!replacement) continue;
        if (!result) result = p;
        result->add(monomial, -coefficient);
        result->add(rest, coefficient);
        *result += times(rest, coefficient, *replacement);
    }
    return result ? Forms{*result} : Forms{};
}

Forms cosines(const Polynomial& p, Atoms& atoms) {
    Forms forms;
    for (const Letter cosine : letters_of(p, atoms, Op::cos)) {
        const std::vector<Polynomial> argument = atoms[cosine].arguments;
        const auto more = without_one(p, cosine, [&](int exponent) {
            return exponent == 1 ? std::optional(-Polynomial::letter(atoms.letter(Op::one_minus_cos, argument))) : std::nullopt;
        });
        forms.insert(forms.end(), more.begin(), more.end());
    }
    return forms;
}

Forms exponentials(const Polynomial& p, Atoms& atoms) {
    Forms forms;
    for (const Letter exponential : letters_of(p, atoms, Op::exp)) {
        const Polynomial argument = atoms[exponential].arguments[0];
        const auto more = without_one(p, exponential, [&](int exponent) {
            Polynomial whole = argument;
            whole *= Rational(exponent);
            return std::optional(Polynomial::letter(atoms.letter(Op::expm1, {whole})));
        });
        forms.insert(forms.end(), more.begin(), more.end());
    }
    return forms;
}

/// c*m*exp(a)^i - c*m*exp(b)^j = c*m*exp(b)^j*expm1(i*a - j*b), for all terms with this quotient.
Forms exponential_differences(const Polynomial& p, Atoms& atoms) {
    if (letters_of(p, atoms, Op::exp).size() < 2) return {};
    std::map<Monomial, Polynomial> by_quotient;
    for (const auto& [monomial, coefficient] : p.terms())
        for (const auto& [other, other_coefficient] : p.terms()) {
            if (other_coefficient != -coefficient) continue;
            const Monomial quotient = monomial * raised(other, -1);
            if (quotient.size() < 2 || quotient[0].exponent < 0 ||
                std::any_of(quotient.begin(), quotient.end(), [&](const LetterPower& each) { return atoms[each.letter].op != Op::exp; }))
                continue;
            Polynomial& form = by_quotient.try_emplace(quotient, p).first->second;
            if (!form.terms().contains(monomial) || !form.terms().contains(other)) continue;
            Polynomial exponent;
            for (const LetterPower& each : quotient) exponent += times({}, each.exponent, atoms[each.letter].arguments[0]);
            form.add(monomial, -coefficient);
            form.add(other, coefficient);
            form += times(other, coefficient, Polynomial::letter(atoms.letter(Op::expm1, {exponent})));
        }
    Forms forms;
    for (auto& [quotient, form] : by_quotient) forms.push_back(std::move(form));
    return forms;
}

/// c*m*log(a/b) - c*m*log(d/b) = c*m*log(a/d), and c*m*log(a/b) - c*m*log(a/d) = c*m*log(d/b), for all such terms.
Forms ratios(const Polynomial& p, Atoms& atoms) {
    Forms forms;
    const std::vector<Letter> letters = letters_of(p, atoms, Op::log_ratio);
    for (const Letter first : letters)
        for (const Letter second : letters) {
            const std::vector<Polynomial> of = atoms[first].arguments, by = atoms[second].arguments;
            if (second <= first || !(of[0] == by[0] || of[1] == by[1])) continue;
            const std::vector<Polynomial> between = of[1] == by[1] ? std::vector{of[0], by[0]} : std::vector{by[1], of[1]};
            std::optional<Polynomial> form;
            for (const auto& [monomial, coefficient] : p.terms()) {
                if (exponent_of(monomial, first) != 1) continue;
                const Monomial rest = without(monomial, first), other = rest * Monomial{{second, 1}};
                const auto partner = p.terms().find(other);
                if (partner == p.terms().end() || partner->second != -coefficient) continue;
                if (!form) form = p;
                form->add(monomial, -coefficient);
                form->add(other, coefficient);
                *form += times(rest, coefficient, Polynomial::letter(atoms.letter(Op::log_ratio, between)));
            }
            if (form) forms.push_back(std::move(*form));
        }
    return forms;
}

Forms logarithms(const Polynomial& p, Atoms& atoms) {
    Forms forms;
    for (const Letter logarithm : letters_of(p, atoms, Op::log)) {
        const std::optional<Polynomial> inside = less_one(atoms[logarithm].arguments[0], true, atoms);
        if (!inside) continue;
        const Letter better = atoms.letter(Op::log1p, {*inside});
        Polynomial result;
        for (const auto& [monomial, coefficient] : p.terms()) {
            const int exponent = exponent_of(monomial, logarithm);
            result.add(without(monomial, logarithm) * (exponent == 0 ? Monomial{} : Monomial{{better, exponent}}), coefficient);
        }
        forms.push_back(std::move(result));
    }
    return forms;
}

/// Pairs of terms c*m*a, -c'*m*b with one of the letters in the first, whose quotient is -y: c*m*(a - y).
template <class Visit>
void each_difference(const Polynomial& p, Letter letter, int exponent, const Visit& visit) {
    for (const auto& [monomial, coefficient] : p.terms()) {
        if (exponent_of(monomial, letter) != exponent) continue;
        const Monomial rest = without(monomial, letter);
        for (const auto& [other, other_coefficient] : p.terms()) {
            if (other == monomial || is_negative(other_coefficient) == is_negative(coefficient)) continue;
            visit(monomial, coefficient, other, other_coefficient, rest,
                  single(other * raised(rest, -1), -other_coefficient / coefficient));
        }
    }
}

/// S^2 - y^2 and S^4 - y^4 of a sum S, where S - y is shorter than S.
Forms powers(const Polynomial& p, Atoms& atoms) {
    Forms forms;
    for (const Letter sum : letters_of(p, atoms, Op::sum)) {
        const Polynomial inside = atoms[sum].arguments[0];
        for (const int n : {2, 4})
            each_difference(p, sum, n,
                            [&](const Monomial& m, const Rational& c, const Monomial& other, const Rational& c_other, const Monomial& rest,
                                const Polynomial& power) {
                                const auto& [y_n, c_n] = *power.terms().begin();
                                if (c_n != 1) return;
                                Monomial y = y_n;
                                for (LetterPower& each : y) {
                                    if (each.exponent % n != 0) return;
                                    each.exponent /= n;
                                }
                                const Polynomial root = single(y, 1), difference = inside - root;
                                if (difference.size() >= inside.size()) return;
                                Polynomial result = p;
                                result.add(m, -c);
                                result.add(other, -c_other);
                                Polynomial total = inside;
                                total += root;
                                Polynomial product =
                                    Polynomial::product(kept_whole(difference, 1, atoms), kept_whole(total, 1, atoms), SIZE_MAX);
                                if (n == 4) {
                                    Polynomial squares = Polynomial::letter(sum, 2);
                                    squares += single(raised(y, 2), 1);
                                    product = Polynomial::product(product, kept_whole(squares, 1, atoms), SIZE_MAX);
                                }
                                result += times(rest, c, product);
                                forms.push_back(std::move(result));
                            });
    }
    return forms;
}

/// sqrt(A) - y, where A - y^2 is shorter than A.
Forms roots(const Polynomial& p, Atoms& atoms) {
    Forms forms;
    for (const Letter root : letters_of(p, atoms, Op::sqrt)) {
        const Polynomial inside = atoms[root].arguments[0];
        each_difference(
            p, root, 1,
            [&](const Monomial& m, const Rational& c, const Monomial& other, const Rational& c_other, const Monomial& rest,
                const Polynomial& y) {
                // The square of y, in which roots are no roots.
                Polynomial square(1);
                const auto& [y_monomial, y_coefficient] = *y.terms().begin();
                square *= y_coefficient * y_coefficient;
                for (const LetterPower& each : y_monomial) {
                    const bool is_root = atoms[each.letter].op == Op::sqrt && each.exponent == 1;
                    square = Polynomial::product(
                        square, is_root ? atoms[each.letter].arguments[0] : Polynomial::letter(each.letter, 2 * each.exponent), SIZE_MAX);
                }
                const Polynomial difference = inside - square;
                if (difference.is_zero() || difference.size() >= inside.size() + (square.size() > 1 ? square.size() - 1 : 0)) return;
                Polynomial result = p, total = Polynomial::letter(root);
                result.add(m, -c);
                result.add(other, -c_other);
                total += y;
                result += times(rest, c, Polynomial::product(kept_whole(difference, 1, atoms), kept_whole(total, -1, atoms), SIZE_MAX));
                forms.push_back(std::move(result));
            });
    }
    return forms;
}

/// a^e - b^e of positive a and b
Forms real_powers(const Polynomial& p, Atoms& atoms) {
    Forms forms;
    for (const Letter power : letters_of(p, atoms, Op::power)) {
        const std::vector<Polynomial> of = atoms[power].arguments;
        each_difference(p, power, 1,
                        [&](const Monomial& m, const Rational& c, const Monomial& other, const Rational& c_other, const Monomial& rest,
                            const Polynomial& y) {
                            const auto& [y_monomial, y_coefficient] = *y.terms().begin();
                            if (y_coefficient != 1 || y_monomial.size() != 1 || y_monomial[0].exponent != 1 ||
                                atoms[y_monomial[0].letter].op != Op::power)
                                return;
                            const std::vector<Polynomial> by = atoms[y_monomial[0].letter].arguments;
                            if (!(by[1] == of[1])) return;
                            const Polynomial growth =
                                Polynomial::product(of[1], Polynomial::letter(atoms.letter(Op::log_ratio, {of[0], by[0]})), SIZE_MAX);
                            Polynomial result = p;
                            result.add(m, -c);
                            result.add(other, -c_other);
                            result += times(rest * y_monomial, c, Polynomial::letter(atoms.letter(Op::expm1, {growth})));
                            forms.push_back(std::move(result));
                        });
    }
    return forms;
}

/// The part of a term that terms of its product with S take away from n: 1 where it is equal and opposite to one of them, nothing where it
/// is too small for that.
Rational cancelling_part(const Polynomial& over, const Polynomial& multiplied) {
    Rational largest = 0;
    for (const auto& [monomial, coefficient] : multiplied.terms()) {
        const auto there = over.terms().find(monomial);
        if (there == over.terms().end()) continue;
        const Rational part = -there->second / coefficient;
        if (part <= 1) largest = cln::max(largest, part);
    }
    return largest;
}

/// a*S^(e + 1) + n*S^e, e < 0, where terms of a*S, or of a part of it, cancel with those of n: a weighted mean and what it is the mean of,
/// and derivatives of such.
std::optional<Polynomial> cancelled(const Polynomial& p, Letter sum, int exponent, const Atoms& atoms) {
    Polynomial over, rest;
    for (const auto& [monomial, coefficient] : p.terms())
        if (exponent_of(monomial, sum) == exponent) over.add(without(monomial, sum), coefficient);
        else rest.add(monomial, coefficient);
    Polynomial numerator = over;
    const Polynomial others = rest;
    for (const auto& [monomial, coefficient] : others.terms()) {
        if (exponent_of(monomial, sum) != exponent + 1) continue;
        const Polynomial multiplied = times(without(monomial, sum), coefficient, atoms[sum].arguments[0]);
        const Rational part = cancelling_part(over, multiplied);
        if (is_zero(part)) continue;
        numerator += times({}, part, multiplied);
        rest.add(monomial, -part * coefficient);
    }
    if (rest == others) return std::nullopt;
    rest += numerator * Monomial{{sum, exponent}};
    return rest;
}

/// With one sum, and with all of them one after the other: 4 - 2*a/(a + b) - 2*c/(c + d) is small where both quotients are near one only.
Forms quotients(const Polynomial& p, Atoms& atoms) {
    Forms forms;
    Polynomial all = p;
    for (const Letter sum : letters_of(p, atoms, Op::sum)) {
        int lowest = 0;
        for (const auto& [monomial, coefficient] : p.terms()) lowest = std::min(lowest, exponent_of(monomial, sum));
        for (int exponent = lowest; exponent < 0; ++exponent) {
            if (std::optional<Polynomial> one = cancelled(p, sum, exponent, atoms)) forms.push_back(std::move(*one));
            if (std::optional<Polynomial> next = cancelled(all, sum, exponent, atoms)) all = std::move(*next);
        }
    }
    if (forms.size() > 1) forms.push_back(std::move(all));
    return forms;
}

}  // namespace

const std::vector<RewriteRule>& rewrite_rules() {
    static const std::vector<RewriteRule> rules{
        {"1 - cos(x)", "1 - cos(x) = 2*sin(x/2)^2", cosines},
        {"exp(x) - 1", "exp(x) - 1 = expm1(x)", exponentials},
        {"differences of exponentials", "exp(a) - exp(b) = exp(b)*expm1(a - b)", exponential_differences},
        {"differences of log(a/b)", "log(a/b) - log(d/b) = log(a/d), log(a/b) - log(a/d) = log(d/b)", ratios},
        {"log(1 + x)", "log(1 + x) = log1p(x)", logarithms},
        {"differences of powers of sums", "s^2 - y^2 = (s - y)*(s + y), s^4 - y^4 = (s - y)*(s + y)*(s^2 + y^2)", powers},
        {"differences of roots", "sqrt(a) - y = (a - y^2)/(sqrt(a) + y)", roots},
        {"differences of real powers", "a^e - b^e = b^e*expm1(e*log(a/b))", real_powers},
        {"a quotient that cancels", "a - n/s = (a*s - n)/s, also with several quotients at once", quotients},
        {"quotients that overflow", "sinh(x)/sinh(y) = exp(x - y)*expm1(-2*x)/expm1(-2*y), 1/(exp(x) - 1) = exp(-x)/(1 - exp(-x))",
         overflowing_quotients},
        {"removable 0/0", "sin(x)/x, (1 - cos(x))/x^2, (exp(x) - 1)/x and log(1 + x)/x have values at 0", removable},
        {"slopes of removable 0/0",
         "(x*cos(x) - sin(x))/x^2, (x*sin(x) - 2*(1 - cos(x)))/x^3, (x*exp(x) - exp(x) + 1)/x^2 and (x/(1 + x) - log(1 + x))/x^2 have "
         "values at 0",
         removable_slopes},
    };
    return rules;
}

namespace {

bool is_divided_by(const Polynomial& p, Letter letter) {
    return std::any_of(p.terms().begin(), p.terms().end(), [&](const auto& term) { return exponent_of(term.first, letter) < 0; });
}

}  // namespace

const std::vector<OtherForm>& other_forms(const Polynomial& p, Atoms& atoms, FormMemory& known) {
    if (const auto found = known.find(p); found != known.end()) return found->second;
    std::vector<OtherForm> result;
    for (const RewriteRule& rule : rewrite_rules())
        for (Polynomial& form : rule.forms(p, atoms))
            result.push_back({rule.name, folded(std::move(form), atoms), rule.forms == removable || rule.forms == removable_slopes});
    std::set<Letter> letters;
    for (const auto& [monomial, coefficient] : p.terms())
        for (const LetterPower& power : monomial)
            if (!atoms[power.letter].arguments.empty() && !is_array(atoms[power.letter].op)) letters.insert(power.letter);
    for (const Letter letter : letters) {
        const Op op = atoms[letter].op;
        const std::vector<Polynomial> arguments = atoms[letter].arguments;
        for (std::size_t i = 0; i < arguments.size(); ++i)
            for (const OtherForm& inner : other_forms(arguments[i], atoms, known)) {
                if (op == Op::sum && inner.form.is_zero() && is_divided_by(p, letter)) continue;
                Polynomial form;
                for (const auto& [monomial, coefficient] : p.terms()) {
                    const int exponent = exponent_of(monomial, letter);
                    if (exponent == 0) {
                        form.add(monomial, coefficient);
                        continue;
                    }
                    std::vector<Polynomial> replaced = arguments;
                    replaced[i] = inner.form;
                    const Polynomial power = op == Op::sum ? kept_whole(replaced[0], exponent, atoms)
                                                           : Polynomial::letter(atoms.letter(op, std::move(replaced)), exponent);
                    form += times(without(monomial, letter), coefficient, power);
                }
                result.push_back({inner.rule, std::move(form), inner.fills_gaps});
            }
    }
    return known[p] = std::move(result);
}

}  // namespace dalembert
