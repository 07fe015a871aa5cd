// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/quotient.hpp"

#include <cmath>
#include <map>
#include <string>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

/// Whether an expression is negative where its letters, in the order of their names, have certain values.
bool is_negative_somewhere_fixed(const ex& polynomial) {
    std::map<std::string, ex> letters;
    for (auto part = polynomial.preorder_begin(); part != polynomial.preorder_end(); ++part)
        if (GiNaC::is_a<GiNaC::symbol>(*part)) letters[ex_to<GiNaC::symbol>(*part).get_name()] = *part;
    GiNaC::exmap at;
    int value = 3;
    for (const auto& [name, letter] : letters) at[letter] = numeric(value += 4 + value % 5, 7);
    const ex number = polynomial.subs(at, GiNaC::subs_options::no_pattern).evalf();
    return GiNaC::is_exactly_a<numeric>(number) && ex_to<numeric>(number).is_negative();
}

/// Functions and constants as letters of their own.
struct AsLetters : GiNaC::map_function {
    ex operator()(const ex& e) override {
        const bool is_letter = GiNaC::is_a<GiNaC::function>(e) || GiNaC::is_a<GiNaC::constant>(e) ||
                               (GiNaC::is_a<GiNaC::power>(e) && !e.op(1).info(GiNaC::info_flags::integer));
        if (!is_letter) return GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e) || GiNaC::is_a<GiNaC::power>(e) ? e.map(*this) : e;
        for (const auto& [letter, value] : values)
            if (value.is_equal(e)) return letter;
        const GiNaC::possymbol letter("function." + std::to_string(values.size()));
        values[letter] = e;
        return letter;
    }
    GiNaC::exmap values;
};

}  // namespace

double terms_when_expanded(const ex& e) {
    if (GiNaC::is_a<GiNaC::add>(e)) {
        double terms = 0;
        for (const ex& term : e) terms += terms_when_expanded(term);
        return terms;
    }
    double terms = 1;
    if (GiNaC::is_a<GiNaC::mul>(e))
        for (const ex& factor : e) terms *= terms_when_expanded(factor);
    else if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint))
        terms = std::pow(terms_when_expanded(e.op(0)), GiNaC::ex_to<numeric>(e.op(1)).to_double());
    return terms;
}

ex quotient(const ex& above, const ex& below) {
    if (above.is_zero()) return 0;
    if (!GiNaC::is_a<GiNaC::add>(below)) return (above / below).expand();
    constexpr std::size_t most_terms = 60;
    if (above.nops() > most_terms || below.nops() > most_terms) return above / below;
    AsLetters letters;
    ex a = letters(above), b = letters(below);
    if (!a.info(GiNaC::info_flags::rational_polynomial) || !b.info(GiNaC::info_flags::rational_polynomial)) return above / below;
    GiNaC::gcd(a, b, &a, &b, false);
    b = b.expand();
    numeric unit = b.integer_content();
    if (is_negative_somewhere_fixed(b.subs(letters.values, GiNaC::subs_options::no_pattern)))
        unit = -unit;  // functions may be met in any order
    const auto written = [&](const ex& e) { return (e / unit).expand().subs(letters.values, GiNaC::subs_options::no_pattern); };
    const ex denominator = written(b);
    return GiNaC::is_a<GiNaC::add>(denominator) ? written(a) / denominator : (written(a) / denominator).expand();
}

}  // namespace dalembert
