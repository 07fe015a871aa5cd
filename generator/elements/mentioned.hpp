// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <set>
#include <string>

#include "elements/model.hpp"

namespace dalembert {

inline const Definition* find_definition(const Model& model, const std::string& name) {
    const auto found =
        std::find_if(model.definitions.begin(), model.definitions.end(), [&](const Definition& d) { return d.name == name; });
    return found == model.definitions.end() ? nullptr : &*found;
}

/// Calls is_it with the parts of an expression, and of the definitions that it mentions, each of these once, until that returns true.
/// Definitions may need themselves: nothing needs to be checked yet.
template <class IsIt>
bool mentions(const Expression& e, const Model& model, const IsIt& is_it) {
    std::set<std::string> followed;
    const auto look = [&](const auto& again, const Expression& one) -> bool {
        bool found = false;
        for_each(one, [&](const Expression& part) {
            if (found || (found = is_it(part)) || part.kind != Expression::Kind::name || !followed.insert(part.name).second) return;
            const Definition* definition = find_definition(model, part.name);
            if (definition != nullptr && definition->value) found = again(again, *definition->value);
        });
        return found;
    };
    return look(look, e);
}

}  // namespace dalembert
