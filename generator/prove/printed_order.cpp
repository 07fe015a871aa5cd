// SPDX-License-Identifier: GPL-3.0-or-later
// Of a linear equation that is wrong: whether it is what the motion is to first order about zero.
#include <fmt/format.h>

#include "prove/printed_pair.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_coordinates = 5;

}  // namespace

std::vector<ex> PairCheck::small_quantities() const {
    std::vector<ex> small = unknowns_;
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity})
        for (std::size_t i = 0; i < system_.symbols.count(kind); ++i) small.push_back(system_.symbols.get(kind, i));
    return small;
}

ex PairCheck::at_rest(const ex& e) const {
    GiNaC::exmap zero;
    for (const ex& one : small_quantities()) zero[one] = 0;
    return e.subs(zero, GiNaC::subs_options::no_pattern);
}

ex PairCheck::linear_terms(const ex& e) const {
    ex sum = 0;
    for (const ex& one : small_quantities()) sum += at_rest(partial(e, one)) * one;
    return sum;
}

/// det [M, force; a', -b] as in holds_on_motion, with M at rest and the force to first order. Only about an equilibrium: elsewhere
/// accelerations are not small.
bool PairCheck::holds_with_linear_motion(const ex& rest) {
    const auto written_out = [&](const ex& e) { return system_.symbols.without_definitions(e); };
    const auto last = static_cast<unsigned>(n_);
    GiNaC::matrix bordered(last + 1, last + 1), masses(last, last);
    ex b = rest;
    for (unsigned j = 0; j < last; ++j) {
        const ex of_force = written_out(force(j)), a = partial(rest, acceleration(j));
        if (!prover_.proven_equal(at_rest(of_force), 0)) return false;
        for (unsigned l = 0; l < last; ++l) masses(j, l) = bordered(j, l) = at_rest(written_out(mass(j, l)));
        bordered(j, last) = linear_terms(of_force);
        bordered(last, j) = a;
        b -= a * acceleration(j);
    }
    bordered(last, last) = -b.expand();
    return !prover_.proven_equal(masses.determinant(GiNaC::determinant_algo::laplace), 0) &&
           prover_.proven_equal(bordered.determinant(GiNaC::determinant_algo::laplace), 0);
}

std::string PairCheck::order_hint(const ex& left_side, const ex& right_side) {
    const std::vector<Variable>& coordinates = system_.symbols.all(SymbolKind::coordinate);
    const bool is_free = at_.empty() && n_ == unknowns_.size() && n_ == coordinates.size() && system_.motion.multipliers.empty();
    if (!is_free || n_ == 0 || n_ > most_coordinates) return {};
    bool holds = false;
    try {
        const ex left = system_.symbols.without_definitions(left_side), right = system_.symbols.without_definitions(right_side);
        const auto is_linear = [&](const ex& e) {
            const ex terms = linear_terms(e);
            return !terms.is_zero() && (e - at_rest(e) - terms).expand().is_zero();
        };
        const ex rest = left - right;
        if (contains_acceleration(rest)) holds = is_linear(rest) && holds_with_linear_motion(rest);
        else holds = (is_linear(left) || is_linear(right)) && prover_.proven_equal(at_rest(rest) + linear_terms(rest), 0);
    } catch (const std::exception&) {  // no value at zero
    }
    if (!holds) return {};
    std::string about;
    for (const Variable& coordinate : coordinates) about += fmt::format("{}{} = 0", about.empty() ? "" : ", ", coordinate.name);
    return "holds to first order about " + about;
}

}  // namespace dalembert
