// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that a header brings itself, from the same source as the runtime's.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace dalembert {

/// Whether a function stands in dalembert::detail rather than in std.
bool is_helper(std::string_view name);

/// The source of the helpers named, with those that they need, in an order that compiles.
std::string helper_source(std::set<std::string> names);

}  // namespace dalembert
