// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/sum_by_sum.hpp"

#include <fmt/format.h>

#include <algorithm>

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
    const std::uint64_t print = print_(sum), opposite = Fingerprints::prime - print;
    const bool is_negative = opposite < print;
    const auto known = by_print_.find(std::min(print, opposite));
    if (known != by_print_.end()) {
        const Letter& letter = letters_[known->second];
        const bool is_opposite = print_(letter.symbol) != print;
        if (are_same(sum, is_opposite ? ex(-letter.meaning) : letter.meaning)) return is_opposite ? ex(-letter.symbol) : letter.symbol;
    }
    if (!is_derived || known != by_print_.end()) return sum;
    const ex symbol = GiNaC::realsymbol(fmt::format("sum {}", letters_.size()));
    print_.set(symbol, print);
    by_print_.emplace(is_negative ? opposite : print, letters_.size());
    places_.emplace(symbol, letters_.size());
    letters_.push_back({symbol, sum});
    return symbol;
}

std::set<std::size_t> SumBySum::letters_in(const ex& e) const {
    std::set<std::size_t> result;
    each_part_once(e, [&](const ex& part) {
        if (const auto known = places_.find(part); known != places_.end()) result.insert(known->second);
    });
    return result;
}

bool SumBySum::are_same(ex a, ex b) {
    if (a.is_equal(b)) return true;
    if (print_(a) != print_(b)) return false;
    if (prover_.have_same_form(a, b)) return true;
    std::set<std::size_t> in_a = letters_in(a), in_b = letters_in(b);
    const auto write_out = [&](ex& side, std::set<std::size_t>& in_side, std::size_t letter) {
        side = side.subs(letters_[letter].symbol == letters_[letter].meaning, GiNaC::subs_options::no_pattern);
        in_side = letters_in(side);
    };
    while (true) {
        std::vector<std::size_t> one_sided;
        std::set_symmetric_difference(in_a.begin(), in_a.end(), in_b.begin(), in_b.end(), std::back_inserter(one_sided));
        if (one_sided.empty()) break;
        if (in_a.contains(one_sided.back())) write_out(a, in_a, one_sided.back());
        else write_out(b, in_b, one_sided.back());
    }
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
        const std::set<std::size_t> inside = letters_in(difference);
        if (inside.empty()) return prover_.proven_equal(difference, 0);
        const Letter& last = letters_[*inside.rbegin()];
        difference = in_cosines(difference.subs(last.symbol == last.meaning, GiNaC::subs_options::no_pattern));
    }
}

bool SumBySum::proven_equal(const ex& other, const ex& derived) {
    const ex meant = Writer(*this, true)(derived);
    return are_same(Writer(*this, false)(other), meant);
}

}  // namespace dalembert
