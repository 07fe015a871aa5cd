// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/steps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// A product of at most two letters.
bool is_short(const ex& e) {
    const auto is_leaf = [](const ex& part) { return GiNaC::is_a<GiNaC::symbol>(part) || GiNaC::is_a<GiNaC::numeric>(part); };
    if (is_leaf(e)) return true;
    return GiNaC::is_a<GiNaC::mul>(e) && e.nops() <= 2 && std::all_of(e.begin(), e.end(), is_leaf);
}

}  // namespace

ex Steps::operator()(const char* what, const std::vector<std::size_t>& indices, const ex& value, Slope slope) {
    Step step{{}, {}, {}, value};
    step.slope = std::move(slope);
    return add(what, indices, std::move(step));
}

ex Steps::staying(const char* what, const std::vector<std::size_t>& indices, const ex& value, const ex& instead) {
    Step step{{}, {}, {}, value};
    step.stays = true;
    step.instead = instead;
    return add(what, indices, std::move(step));
}

ex Steps::add(const char* what, const std::vector<std::size_t>& indices, Step step) {
    if (is_short(step.value)) return step.value;
    if (!with_letters_) return whole(step.value);
    step.name = enclosure_;
    step.identifier = fmt::format("{}_{}", enclosure_, what);
    for (const std::size_t i : indices) {
        step.name += fmt::format(", {}", i + 1);
        step.identifier += fmt::format("_{}", i + 1);
    }
    step.name = fmt::format("{}[{}]", what, step.name);
    return symbols_.add_step(std::move(step));
}

bool is_of_parameters(const ex& e, const Symbols& symbols) {
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        if (!GiNaC::is_a<GiNaC::symbol>(*part)) continue;
        const Variable* variable = symbols.find(*part);
        if (variable == nullptr || (variable->kind != SymbolKind::parameter && variable->kind != SymbolKind::definition)) return false;
    }
    return true;
}

}  // namespace dalembert
