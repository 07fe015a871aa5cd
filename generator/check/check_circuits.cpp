// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "check/checks.hpp"
#include "elements/circuits.hpp"
#include "elements/model.hpp"

namespace dalembert {

void check_circuits(const Model& model, Claims& claims, Diagnostics& diagnostics) {
    const auto claim = [&](const ExpressionPtr& state, const char* key, const char* kind, const Branch& branch) {
        if (!state) return;
        const std::string what = fmt::format("{} '{}'", kind, branch.name);
        const State* found = claims.claim(*state, key, what);
        if (found != nullptr && found->root)
            diagnostics.error(Id::not_allowed_here, state->span,
                              fmt::format("the {} of {} cannot be integrated as its root: it may be negative", key, what),
                              {{found->span, fmt::format("'{}' is declared here", found->name)}});
    };
    for (const Branch& branch : model.branches) {
        if (branch.law == Branch::Law::capacitor) claim(branch.voltage, "voltage", "capacitor", branch);
        if (branch.law == Branch::Law::inductor) claim(branch.current, "current", "inductor", branch);
    }
}

}  // namespace dalembert
