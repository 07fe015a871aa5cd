// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/lowered_chain.hpp"

#include <algorithm>

#include "graph/lower.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

bool is_all_zero(const std::vector<Polynomial>& polynomials) {
    return std::all_of(polynomials.begin(), polynomials.end(), [](const Polynomial& p) { return p.is_zero(); });
}

}  // namespace

LoweredChain lower_chain(const System& system, Atoms& atoms, const std::vector<By>& jacobians) {
    const ChainSlopes<ex> chain = chain_slopes(system, jacobians);
    const auto all = [&](const std::vector<ex>& expressions) {
        std::vector<Polynomial> result;
        for (const ex& e : expressions) result.push_back(e.is_zero() ? Polynomial() : lower(e, atoms));
        return result;
    };
    // What is zero may be seen to be only now.
    const auto slopes = [&](const std::vector<ChainSlope<ex>>& of) {
        std::vector<ChainSlope<Polynomial>> result;
        for (const ChainSlope<ex>& slope : of) {
            ChainSlope<Polynomial> lowered{slope.of, all(slope.letters), all(slope.parts)};
            if (!is_all_zero(lowered.letters) || !is_all_zero(lowered.parts)) result.push_back(std::move(lowered));
        }
        return result;
    };
    LoweredChain result;
    for (const LinkSlopes<ex>& link : chain.links) {
        result.links.push_back({all(link.letters), all(link.parts), slopes(link.by_base), slopes(link.by_own), {}});
        for (std::size_t by = 0; by < link.by.size(); ++by) result.links.back().by[by] = slopes(link.by[by]);
    }
    result.ground = all(chain.ground);
    result.rest = all(chain.rest);
    for (std::size_t by = 0; by < chain.by.size(); ++by)
        for (const auto& [of, ground, rest] : chain.by[by]) {
            LoweredChain::Column column{of, all(ground), all(rest)};
            if (!is_all_zero(column.ground) || !is_all_zero(column.rest)) result.by[by].push_back(std::move(column));
        }
    return result;
}

}  // namespace dalembert
