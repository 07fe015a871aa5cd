// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/lowered_chain.hpp"

#include <algorithm>
#include <set>

#include "graph/lower.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class ChainLowerer {
public:
    ChainLowerer(const System& system, Atoms& atoms, const std::vector<By>& jacobians)
        : system_(system), atoms_(atoms), jacobians_(jacobians) {}

    LoweredChain run() {
        LoweredChain result;
        for (const ChainLink& link : system_.chain->links) result.links.push_back(lowered(link));
        const std::vector<ex> ground(system_.chain->ground.begin(), system_.chain->ground.end());
        result.ground = all(ground);
        result.rest = all(system_.chain->rest);
        for (const By by : jacobians_) {
            const auto variables = column_variables(system_.symbols, by);
            for (std::size_t c = 0; c < variables.size(); ++c) {
                const auto slope = [&](const std::vector<ex>& of) {
                    return derivatives(of, [&](const ex& e) { return by_column(system_, e, *variables[c]); });
                };
                LoweredChain::Column column{c, slope(ground), slope(system_.chain->rest)};
                if (matters(column.ground) || matters(column.rest)) result.by[static_cast<std::size_t>(by)].push_back(std::move(column));
            }
        }
        return result;
    }

private:
    LoweredLink lowered(const ChainLink& link) {
        std::vector<ex> letters;
        for (const auto& [letter, value] : link.letters) letters.push_back(value);
        const std::vector<ex> parts = link.parts();
        LoweredLink result{all(letters), all(parts), {}, {}, {}};
        const std::set<ex, GiNaC::ex_is_less> symbols = symbols_in(letters, parts);
        const auto add = [&](std::vector<LoweredLink::Slope>& to, std::size_t of, const auto& derivative) {
            LoweredLink::Slope slope{of, derivatives(letters, derivative), derivatives(parts, derivative)};
            if (matters(slope.letters) || matters(slope.parts)) to.push_back(std::move(slope));
        };
        const auto by_letters = [&](std::vector<LoweredLink::Slope>& to, const ChainLink& of) {
            for (std::size_t k = 0; k < of.letters.size(); ++k)
                if (symbols.contains(of.letters[k].first)) add(to, k, [&](const ex& e) { return partial_of_kept(e, of.letters[k].first); });
        };
        if (link.base) by_letters(result.by_base, system_.chain->links[*link.base]);
        by_letters(result.by_own, link);
        const bool has_definitions =
            std::any_of(symbols.begin(), symbols.end(), [&](const ex& s) { return kind_of(s) == SymbolKind::definition; });
        for (const By by : jacobians_) {
            const auto variables = column_variables(system_.symbols, by);
            for (std::size_t c = 0; c < variables.size(); ++c) {
                if (!symbols.contains(variables[c]->symbol) && !(by == By::parameter && has_definitions)) continue;
                add(result.by[static_cast<std::size_t>(by)], c, [&](const ex& e) { return by_column(system_, e, *variables[c]); });
            }
        }
        return result;
    }

    std::optional<SymbolKind> kind_of(const ex& symbol) const {
        const Variable* variable = system_.symbols.find(symbol);
        return variable == nullptr ? std::nullopt : std::optional(variable->kind);
    }

    static std::set<ex, GiNaC::ex_is_less> symbols_in(const std::vector<ex>& a, const std::vector<ex>& b) {
        std::set<ex, GiNaC::ex_is_less> result;
        const auto note = [&](const ex& e) {
            for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part)
                if (GiNaC::is_a<GiNaC::symbol>(*part)) result.insert(*part);
        };
        std::for_each(a.begin(), a.end(), note);
        std::for_each(b.begin(), b.end(), note);
        return result;
    }

    template <class Derivative>
    std::vector<Polynomial> derivatives(const std::vector<ex>& of, const Derivative& derivative) {
        std::vector<Polynomial> result;
        for (const ex& e : of) result.push_back(e.is_zero() ? Polynomial() : lower(derivative(e), atoms_));
        return result;
    }

    std::vector<Polynomial> all(const std::vector<ex>& expressions) {
        std::vector<Polynomial> result;
        for (const ex& e : expressions) result.push_back(lower(e, atoms_));
        return result;
    }

    static bool matters(const std::vector<Polynomial>& polynomials) {
        return std::any_of(polynomials.begin(), polynomials.end(), [](const Polynomial& p) { return !p.is_zero(); });
    }

    const System& system_;
    Atoms& atoms_;
    const std::vector<By>& jacobians_;
};

}  // namespace

LoweredChain lower_chain(const System& system, Atoms& atoms, const std::vector<By>& jacobians) {
    return ChainLowerer(system, atoms, jacobians).run();
}

}  // namespace dalembert
