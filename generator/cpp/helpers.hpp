// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that a header brings itself, from the same source as the runtime's.
#pragma once

#include <set>
#include <string>

namespace dalembert {

/// The source of the helpers named, with those that they need, in an order that compiles.
std::string helper_source(std::set<std::string> names);

}  // namespace dalembert
