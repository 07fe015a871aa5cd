// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/sum_by_sum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "symbolic/functions.hpp"
#include "symbolic/parts.hpp"
#include "symbolic/squares.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// What must not vanish, or may not be real, is not to be made of letters: nothing would be known of its values.
bool needs_values(const ex& e) {
    if (GiNaC::is_a<GiNaC::power>(e)) return !e.op(1).info(GiNaC::info_flags::posint);
    return GiNaC::is_a<GiNaC::function>(e) && !GiNaC::is_the_function<GiNaC::sin_SERIAL>(e) &&
           !GiNaC::is_the_function<GiNaC::cos_SERIAL>(e) && !is_ex_the_function(e, whole);
}

double terms_multiplied_out(const ex& e) {
    if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
        const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
        double result = is_sum ? 0 : 1;
        for (const ex& part : e) result = is_sum ? result + terms_multiplied_out(part) : result * terms_multiplied_out(part);
        return result;
    }
    if (!GiNaC::is_a<GiNaC::power>(e) || !e.op(1).info(GiNaC::info_flags::posint)) return 1;
    return std::pow(terms_multiplied_out(e.op(0)), GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_double());
}

/// The factors of a term with their exponents.
GiNaC::exmap powers_in(const ex& term) {
    GiNaC::exmap result;
    const auto add = [&](const ex& factor) {
        if (GiNaC::is_exactly_a<GiNaC::numeric>(factor)) return;
        const bool is_power = GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::posint);
        result.emplace(is_power ? factor.op(0) : factor, is_power ? factor.op(1) : ex(1));
    };
    if (!GiNaC::is_a<GiNaC::mul>(term)) add(term);
    else std::for_each(term.begin(), term.end(), add);
    return result;
}

/// A sum as a product: the factor that all its terms share, and the rest, multiplied out. Code contains the rest as a sum of its own.
std::pair<ex, ex> without_common_factors(const ex& sum) {
    constexpr double most_terms = 400;
    if (terms_multiplied_out(sum) > most_terms) return {1, sum};
    const ex e = in_cosines(sum);
    if (!GiNaC::is_a<GiNaC::add>(e)) return {e, 1};
    GiNaC::exmap common = powers_in(e.op(0));
    for (const ex& term : e) {
        const GiNaC::exmap own = powers_in(term);
        GiNaC::exmap both;
        for (const auto& [base, exponent] : common)
            if (const auto found = own.find(base); found != own.end())
                both.emplace(base, (exponent - found->second).info(GiNaC::info_flags::positive) ? found->second : exponent);
        common = std::move(both);
    }
    ex factor = e.integer_content();
    for (const auto& [base, exponent] : common) factor *= GiNaC::pow(base, exponent);
    GiNaC::exvector rest;
    for (const ex& term : e) rest.push_back(term / factor);
    return {factor, GiNaC::add(rest)};
}

}  // namespace

/// With sums as letters, what they are made of first.
class SumBySum::Writer : public GiNaC::map_function {
public:
    Writer(SumBySum& letters, bool is_derived) : letters_(letters), is_derived_(is_derived) {}
    ex operator()(const ex& e) override {
        if (e.nops() == 0 || needs_values(e)) return e;
        Known& known = is_derived_ ? letters_.derived_ : letters_.other_;
        if (const auto found = known.find(e); found != known.end()) return found->second;
        const bool is_sum = is_ex_the_function(e, whole);
        const ex result = is_sum ? letters_.letter_for((*this)(e.op(0)), is_derived_) : e.map(*this);
        known.emplace(e, result);
        return result;
    }

private:
    SumBySum& letters_;
    bool is_derived_;
};

bool SumBySum::has_sums(const ex& e) {
    return any_part(e, [](const ex& part) { return is_ex_the_function(part, whole); });
}

ex SumBySum::letter_for(const ex& sum, bool is_derived) {
    if (!GiNaC::is_a<GiNaC::add>(sum)) return sum;
    const auto [factor, rest] = without_common_factors(sum);
    if (!GiNaC::is_a<GiNaC::add>(rest)) return factor;
    const std::uint64_t print = print_(rest), opposite = Fingerprints::prime - print;
    const bool is_negative = opposite < print;
    const auto known = by_print_.find(std::min(print, opposite));
    if (known != by_print_.end()) {
        const LetterMeanings::Letter& letter = letters_[known->second];
        const bool is_opposite = print_(letter.symbol) != print;
        if (are_same(rest, is_opposite ? ex(-letter.meaning) : letter.meaning))
            return is_opposite ? ex(-factor * letter.symbol) : factor * letter.symbol;
    }
    if (!is_derived || known != by_print_.end()) return sum;
    const ex symbol = GiNaC::realsymbol(fmt::format("sum {}", letters_.size()));
    print_.set(symbol, print);
    by_print_.emplace(is_negative ? opposite : print, letters_.size());
    letters_.add(symbol, rest);
    return factor * symbol;
}

bool SumBySum::are_same(ex a, ex b) {
    if (a.is_equal(b)) return true;
    if (print_(a) != print_(b)) return false;
    if (prover_.have_same_form(a, b)) return true;
    letters_.write_out(a, b, [] { return false; });
    if (prover_.proven_equal(a, b)) return true;
    return is_zero_down_to_leaves(a - b);
}

/// That the columns of a rotation are at right angles is known of each turn alone: the outermost letters go first, and what is left of them
/// cancels before the next ones go.
bool SumBySum::is_zero_down_to_leaves(ex difference) {
    constexpr std::size_t most_terms = 3000;
    difference = in_cosines(difference);
    while (true) {
        if (difference.is_zero()) return true;
        if (difference.nops() > most_terms) return false;
        const std::set<std::size_t> inside = letters_.in(difference);
        if (inside.empty()) return prover_.proven_equal(difference, 0);
        difference = in_cosines(letters_.without(difference, *inside.rbegin()));
    }
}

bool SumBySum::proven_equal(const ex& other, const ex& derived) {
    if (other.is_equal(derived)) return true;
    const ex meant = Writer(*this, true)(derived);
    return are_same(Writer(*this, false)(other), meant);
}

}  // namespace dalembert
