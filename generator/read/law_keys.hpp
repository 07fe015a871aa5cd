// SPDX-License-Identifier: GPL-3.0-or-later
// Entries whose keys depend on the law that they follow.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "read/entry.hpp"
#include "text/nearest.hpp"

namespace dalembert {

/// One law of a table with the keys that it needs and may have.
template <class Law>
struct LawKeys {
    const char* name;
    Law law;
    std::vector<const char*> required;
    std::vector<const char*> optional;

    bool takes(std::string_view key) const {
        const auto has = [&](const std::vector<const char*>& keys) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
        return has(required) || has(optional);
    }
};

template <class Law>
std::vector<std::string> names_of(const std::vector<LawKeys<Law>>& laws) {
    std::vector<std::string> names;
    for (const auto& law : laws) names.emplace_back(law.name);
    return names;
}

/// The row of a law; checks that the keys are those that it takes.
template <class Law>
const LawKeys<Law>* find_law(const Entry& e, const char* what, const std::vector<LawKeys<Law>>& laws, const std::vector<const char*>& keys) {
    const std::string name = e.text("law");
    const auto found = std::find_if(laws.begin(), laws.end(), [&](const auto& law) { return name == law.name; });
    if (found == laws.end()) {
        if (e.has("law"))
            e.error(Id::wrong_type, e.span_of("law"), fmt::format("'{}' is not a law of a {}; the laws are {}", name, what, quoted_list(names_of(laws))));
        return nullptr;
    }
    for (const char* key : found->required)
        if (!e.has(key)) e.error(Id::missing_key, e.span(), fmt::format("{} '{}' follows the law '{}' and needs the key '{}'", what, e.name(), name, key));
    for (const char* key : keys)
        if (e.has(key) && !found->takes(key))
            e.error(Id::unknown_key, e.span_of(key), fmt::format("{} '{}' follows the law '{}', which has no use for '{}'", what, e.name(), name, key));
    return &*found;
}

}  // namespace dalembert
