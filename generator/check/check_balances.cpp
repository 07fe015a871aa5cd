// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "check/checks.hpp"
#include "elements/model.hpp"

namespace dalembert {

const State* Claims::claim(const std::string& name, const Span& span, const char* key, const std::string& what) {
    const Named* found = names_.find(name);
    if (found == nullptr || found->kind != Named::Kind::state) {
        diagnostics_.error(Id::wrong_type, span,
                           fmt::format("the {} of {} must be the name of a state, but '{}' is {}", key, what, name,
                                       found == nullptr ? "none" : describe(found->kind)));
        return nullptr;
    }
    claimed_.insert(name);
    const auto& state = static_cast<const State&>(*found->item);
    if (state.derivative)
        diagnostics_.error(
            Id::doubly_determined, span,
            fmt::format("state '{}' is the {} of {} and has a derivative of its own; only one can determine it", name, key, what),
            {{state.derivative->span, "its derivative stands here"}});
    return &state;
}

const State* Claims::claim(const Expression& named, const char* key, const std::string& what) {
    return claim(named.kind == Expression::Kind::name ? named.name : named.written(), named.span, key, what);
}

void Claims::check_all(const Model& model) const {
    if (model.sampling) return;  // see check_sampling
    for (const State& state : model.states)
        if (!state.derivative && !state.next && !claimed_.contains(state.name))
            diagnostics_.error(
                Id::undetermined, state.span,
                fmt::format("nothing determines state '{}': it has no derivative, and no volume, pipe, node, rod, block, capacitor or "
                            "inductor names it",
                            state.name));
}

void check_balances(const Model& model, Diagnostics& diagnostics) {
    const Names names(model);
    Claims claims(names, diagnostics);
    check_fluids(model, names, claims, diagnostics);
    check_heat(model, names, claims, diagnostics);
    check_circuits(model, claims, diagnostics);
    claims.check_all(model);
}

}  // namespace dalembert
