// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/passivity.hpp"

#include <algorithm>
#include <optional>

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

std::optional<int> sign_of_terms(const ex& e);

std::optional<int> sign_of_power(const ex& base, const ex& exponent) {
    const std::optional<int> inner = sign_of_terms(base);
    if (!inner || !GiNaC::is_exactly_a<numeric>(exponent)) return std::nullopt;
    if (*inner >= 0) return *inner;
    const numeric& n = ex_to<numeric>(exponent);
    if (!n.is_integer()) return std::nullopt;
    return n.is_even() ? 1 : -1;
}

/// -1, 0 or 1 where the signs of the terms tell; parameters have theirs from their ranges.
std::optional<int> sign_of_terms(const ex& e) {
    if (e.is_zero()) return 0;
    if (e.info(GiNaC::info_flags::positive)) return 1;
    if (GiNaC::is_exactly_a<numeric>(e)) return ex_to<numeric>(e).is_negative() ? -1 : 1;
    if (is_ex_the_function(e, whole) || is_ex_the_function(e, unlocated)) return sign_of_terms(e.op(0));
    if (GiNaC::is_a<GiNaC::power>(e)) return sign_of_power(e.op(0), e.op(1));
    if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e)) return std::nullopt;
    const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
    int result = is_sum ? 0 : 1;
    for (std::size_t i = 0; i < e.nops(); ++i) {
        const std::optional<int> part = sign_of_terms(e.op(i));
        if (!part) return std::nullopt;
        if (!is_sum) result *= *part;
        else if (result == 0) result = *part;
        else if (*part != 0 && *part != result) return std::nullopt;
    }
    return result;
}

bool has_sign(const ex& e, int sign) {
    const std::optional<int> found = sign_of_terms(e.expand());
    return found && (*found == 0 || *found == sign);
}

const ex& letter(const NodeState& node) { return node.kind == NodeState::Kind::sought ? node.letter : node.warmth.temperature; }

/// What holds for every cell in a loop: conduction is symmetric, the surroundings draw towards themselves.
bool is_passive(const CellField& f) {
    GiNaC::exmap rising;
    if (const auto* letters = std::get_if<RodLetters>(&f.place)) {
        const Rod& rod = static_cast<const Rod&>(*f.body);
        if (rod.grid || rod.shape != Rod::Shape::bar || !rod.area->variables.empty())
            return false;  // the signs of widths and areas are not told by their terms
        // Numbers on a uniform grid stand in differences alone, from the smaller to the larger: any that rise give their signs.
        rising = {{letters->place.left, 1}, {letters->place.here, 2}, {letters->place.right, 3}, {letters->beyond, 4}};
    }
    const auto at = [&](const ex& e) { return e.subs(rising, GiNaC::subs_options::no_pattern); };
    const auto knows = [&](const ex& e) { return e.has(f.here) || e.has(f.next); };
    const auto draws = [&](const ex& heat) {
        const ex slope = partial(heat, f.here);
        return !knows(slope) && has_sign(at(slope), -1);
    };
    return std::all_of(f.faces.begin(), f.faces.end(),
                       [&](const FaceLaw& face) {
                           const ex by_here = partial(face.heat, f.here), by_next = partial(face.heat, f.next);
                           return !knows(by_here) && !knows(by_next) && has_sign(at(by_here), 1) && (by_here + by_next).expand().is_zero();
                       }) &&
           std::all_of(f.sides.begin(), f.sides.end(), [&](const SideLaw& side) { return draws(side.heat); }) &&
           std::all_of(f.laws.begin(), f.laws.end(), [&](const CellLaw& law) {
               const auto capacity = sign_of_terms(at(law.capacity));
               return !knows(law.capacity) && capacity == 1 && draws(law.source);
           });
}

}  // namespace

bool is_passive(const System& system, Prover& prover) {
    const Symbols& symbols = system.symbols;
    std::vector<const NodeState*> nodes;
    for (const NodeState& node : system.heat.nodes)
        if (node.state) nodes.push_back(&node);
    if (nodes.empty() || nodes.size() != symbols.states() || symbols.degrees() > 0) return false;
    // Nodes that store nothing count too: what is left when they are eliminated has the same signs.
    for (const NodeState& node : system.heat.nodes)
        if (node.kind == NodeState::Kind::sought) nodes.push_back(&node);
    const auto has_state = [&](const ex& e) {
        return std::any_of(nodes.begin(), nodes.end(), [&](const NodeState* node) { return e.has(letter(*node)); });
    };
    const auto slope = [&](std::size_t i, std::size_t j) { return partial(nodes[i]->balance, letter(*nodes[j])); };
    for (const NodeState* node : nodes)
        for (const NodeState* other : nodes)
            if (other->kind == NodeState::Kind::sought && node->balance.has(other->fourth_letter)) return false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i]->state && (sign_of_terms(nodes[i]->capacity) != 1 || has_state(nodes[i]->capacity))) return false;
        ex sum = 0;
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            const ex here = slope(i, j);
            if (has_state(here)) return false;
            sum += here;
            if (i != j && !has_sign(here, 1)) return false;
            if (j < i && !(here.is_zero() && slope(j, i).is_zero()) && !prover.proven_equal(here, slope(j, i))) return false;
        }
        if (!has_sign(sum, -1)) return false;
    }
    for (const CellField& field : system.heat.fields)
        if (!is_passive(field)) return false;
    return true;
}

}  // namespace dalembert
