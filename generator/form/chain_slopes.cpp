// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/chain_slopes.hpp"

#include <algorithm>

#include "symbolic/derivative.hpp"
#include "symbolic/parts.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

LettersInside letters_in_lists(const std::vector<ex>& a, const std::vector<ex>& b) {
    LettersInside result;
    const auto note = [&](const ex& e) { result.merge(letters_in(e)); };
    std::for_each(a.begin(), a.end(), note);
    std::for_each(b.begin(), b.end(), note);
    return result;
}

template <class Derivative>
std::vector<ex> derivatives(const std::vector<ex>& of, const Derivative& derivative) {
    std::vector<ex> result;
    for (const ex& e : of) result.push_back(e.is_zero() ? ex(0) : derivative(e));
    return result;
}

bool matters(const std::vector<ex>& values) {
    return std::any_of(values.begin(), values.end(), [](const ex& e) { return !e.is_zero(); });
}

class SlopesOfLink {
public:
    SlopesOfLink(const System& system, const ChainLink& link) : system_(system), link_(link) {
        for (const auto& [letter, value] : link.letters) result_.letters.push_back(value);
        result_.parts = link.parts();
        found_ = letters_in_lists(result_.letters, result_.parts);
    }

    LinkSlopes<ex> run(const std::vector<By>& jacobians) {
        if (link_.base) by_letters(result_.by_base, system_.chain->links[*link_.base]);
        by_letters(result_.by_own, link_);
        for (const By by : jacobians) by_columns(by);
        return std::move(result_);
    }

private:
    template <class Derivative>
    void add(std::vector<ChainSlope<ex>>& to, std::size_t of, const Derivative& derivative) const {
        ChainSlope<ex> slope{of, derivatives(result_.letters, derivative), derivatives(result_.parts, derivative)};
        if (matters(slope.letters) || matters(slope.parts)) to.push_back(std::move(slope));
    }

    void by_letters(std::vector<ChainSlope<ex>>& to, const ChainLink& of) const {
        for (std::size_t k = 0; k < of.letters.size(); ++k)
            if (found_.contains(of.letters[k].first)) add(to, k, [&](const ex& e) { return partial_of_kept(e, of.letters[k].first); });
    }

    void by_columns(By by) {
        const bool has_definitions = std::any_of(found_.begin(), found_.end(), [&](const ex& symbol) {
            const Variable* variable = system_.symbols.find(symbol);
            return variable != nullptr && variable->kind == SymbolKind::definition;
        });
        const auto variables = column_variables(system_.symbols, by);
        for (std::size_t c = 0; c < variables.size(); ++c) {
            if (!found_.contains(variables[c]->symbol) && !(by == By::parameter && has_definitions)) continue;
            add(result_.by[static_cast<std::size_t>(by)], c, [&](const ex& e) { return by_column(system_, e, *variables[c]); });
        }
    }

    const System& system_;
    const ChainLink& link_;
    LinkSlopes<ex> result_;
    LettersInside found_;
};

}  // namespace

ChainSlopes<ex> chain_slopes(const System& system, const std::vector<By>& jacobians) {
    const Chain& chain = *system.chain;
    ChainSlopes<ex> result{{}, {chain.ground.begin(), chain.ground.end()}, chain.rest, {}};
    for (const ChainLink& link : chain.links) result.links.push_back(SlopesOfLink(system, link).run(jacobians));
    for (const By by : jacobians) {
        const auto variables = column_variables(system.symbols, by);
        for (std::size_t c = 0; c < variables.size(); ++c) {
            const auto slope = [&](const std::vector<ex>& of) {
                return derivatives(of, [&](const ex& e) { return by_column(system, e, *variables[c]); });
            };
            ChainSlopes<ex>::Column column{c, slope(result.ground), slope(result.rest)};
            if (matters(column.ground) || matters(column.rest)) result.by[static_cast<std::size_t>(by)].push_back(std::move(column));
        }
    }
    return result;
}

}  // namespace dalembert
