// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "elements/circuits.hpp"
#include "elements/every_kind.hpp"
#include "elements/expand_switching.hpp"
#include "elements/names.hpp"

namespace dalembert {

void expand_circuits(Model& model) {
    const Names names(model);
    std::vector<Pin> found;
    const auto is_known = [&](const std::string& name) {
        const auto& others = names.elements(name);
        // What has another meaning is reported where references are checked.
        return std::any_of(others.begin(), others.end(), [](const OfKind& one) { return one.kind->facts.naming == Naming::parts; }) ||
               std::any_of(found.begin(), found.end(), [&](const Pin& pin) { return pin.name == name; });
    };
    for (const Branch& branch : model.branches)
        for (const Reference* end : {&branch.from, &branch.to}) {
            if (end->name.empty() || end->index || is_known(end->name)) continue;
            Pin& pin = found.emplace_back();
            pin.name = end->name;
            pin.span = end->span;
        }
    model.pins.insert(model.pins.end(), found.begin(), found.end());
}

}  // namespace dalembert
