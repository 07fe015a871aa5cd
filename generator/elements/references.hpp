// SPDX-License-Identifier: GPL-3.0-or-later
// A visitor of descriptions that finds the names by which an element refers to others. The checks that these exist, and that a scene has
// them, follow from it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "elements/item.hpp"

namespace dalembert {

/// The name of an element at a key of another one.
struct Referred {
    Reference to;
    const char* key;
    std::vector<const char*> kinds;  ///< that may stand there: "volume", "reservoir"
    bool all_members;                ///< of a family, which has no index then
};

using ReferenceVisitor = std::function<void(const Referred&)>;

/// The references of one item of any kind, in the order of its keys.
template <class Described>
void visit_references(const Described& item, const ReferenceVisitor& visitor);

}  // namespace dalembert
