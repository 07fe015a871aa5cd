// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/angle_basis.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

namespace dalembert {

using GiNaC::ex;

namespace {

using Arguments = std::set<ex, GiNaC::ex_is_less>;

std::string name_of(const ex& symbol) { return GiNaC::ex_to<GiNaC::symbol>(symbol).get_name(); }

using SymbolsByName = std::map<std::string, ex>;

struct HashOf {
    std::size_t operator()(const ex& e) const { return e.gethash(); }
};
struct AreEqual {
    bool operator()(const ex& a, const ex& b) const { return a.is_equal(b); }
};
using Seen = std::unordered_set<ex, HashOf, AreEqual>;

void note_angles(const ex& e, Arguments& found, Seen& seen, SymbolsByName& symbols) {
    if (e.info(GiNaC::info_flags::numeric) || !seen.insert(e).second) return;
    if (e.info(GiNaC::info_flags::symbol)) {
        symbols.emplace(name_of(e), e);
        return;
    }
    if (GiNaC::is_the_function<GiNaC::sin_SERIAL>(e) || GiNaC::is_the_function<GiNaC::cos_SERIAL>(e)) found.insert(e.op(0));
    for (std::size_t i = 0; i < e.nops(); ++i) note_angles(e.op(i), found, seen, symbols);
}

std::size_t terms_of(const ex& e) { return GiNaC::is_a<GiNaC::add>(e) ? e.nops() : 1; }

std::size_t longest(const Arguments& arguments) {
    std::size_t result = 0;
    for (const ex& e : arguments) result = std::max(result, terms_of(e));
    return result;
}

/// What addition theorems make of them.
double size_of(const Arguments& arguments) {
    double size = 0;
    for (const ex& e : arguments) size += static_cast<double>(1ull << std::min<std::size_t>(terms_of(e), 60));
    return size;
}

/// A symbol that stands alone in the sum, once or minus once, and may be any number: the last by name, and none of the new ones.
std::optional<ex> replaceable(const ex& sum, const GiNaC::exmap& made) {
    std::optional<ex> last;
    for (const ex& term : sum) {
        const ex symbol = GiNaC::is_a<GiNaC::symbol>(term) ? term : -term;
        if (!GiNaC::is_a<GiNaC::symbol>(symbol) || symbol.info(GiNaC::info_flags::positive) || made.contains(symbol)) continue;
        const auto key = [](const ex& s) { return std::pair(name_of(s).size(), name_of(s)); };
        if (!last || key(*last) < key(symbol)) last = symbol;
    }
    return last;
}

/// The same change for rates, which are linear in the rates of the sums, too. Any change would be right: what a name means does not matter.
void change_rates(const GiNaC::exmap& change, const GiNaC::exmap& back, const SymbolsByName& symbols, ShortAngles& result) {
    for (const char* rate : {"dot", "ddot"}) {
        SymbolsByName made;
        const auto rate_of = [&](const ex& symbol) {
            const std::string name = std::string(rate) + "(" + name_of(symbol) + ")";
            const auto known = symbols.find(name);
            return known != symbols.end() ? known->second : made.emplace(name, GiNaC::realsymbol(name)).first->second;
        };
        const auto rates_in = [&](const ex& sum) {
            GiNaC::exmap rates;
            for (auto part = sum.preorder_begin(); part != sum.preorder_end(); ++part)
                if (GiNaC::is_a<GiNaC::symbol>(*part)) rates[*part] = rate_of(*part);
            return sum.subs(rates, GiNaC::subs_options::no_pattern);
        };
        GiNaC::exmap changed;
        for (const auto& [old, value] : change)
            if (symbols.contains(std::string(rate) + "(" + name_of(old) + ")")) changed[rate_of(old)] = rates_in(value);
        if (changed.empty()) continue;
        result.expression = result.expression.subs(changed, GiNaC::subs_options::no_pattern);
        for (const auto& [angle, sum] : back) result.meaning[rate_of(angle)] = rates_in(sum);
    }
}

}  // namespace

ShortAngles with_short_angles(const ex& given) {
    constexpr std::size_t short_enough = 2;
    Seen seen;
    Arguments arguments;
    SymbolsByName symbols;
    note_angles(given, arguments, seen, symbols);
    if (longest(arguments) <= short_enough) return {given, {}};
    const double before = size_of(arguments);
    GiNaC::exmap change, back;
    for (int round = 0; round < 200; ++round) {
        // The shortest sum first: what comes after it is made of it.
        const ex* sum = nullptr;
        for (const ex& e : arguments)
            if (terms_of(e) >= 2 && replaceable(e, back) && (sum == nullptr || terms_of(e) < terms_of(*sum))) sum = &e;
        if (sum == nullptr) break;
        const ex old = *replaceable(*sum, back), angle = GiNaC::realsymbol("angle " + std::to_string(round));
        back[angle] = sum->subs(back, GiNaC::subs_options::no_pattern);
        const ex value = sum->diff(GiNaC::ex_to<GiNaC::symbol>(old)) * (angle - (*sum - sum->diff(GiNaC::ex_to<GiNaC::symbol>(old)) * old));
        const GiNaC::exmap step{{old, value.expand()}};
        for (auto& [symbol, by] : change) by = by.subs(step, GiNaC::subs_options::no_pattern).expand();
        change.insert(*step.begin());
        Arguments next;
        for (const ex& e : arguments) next.insert(e.subs(step, GiNaC::subs_options::no_pattern).expand());
        arguments = std::move(next);
        if (longest(arguments) <= short_enough) break;
    }
    if (size_of(arguments) >= before) return {given, {}};
    ShortAngles result{given.subs(change, GiNaC::subs_options::no_pattern), back};
    change_rates(change, back, symbols, result);
    return result;
}

}  // namespace dalembert
