// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the runtimes that generated files bring along: what stands between "// begin NAME: needs" and "// end NAME".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

struct MarkedSection {
    std::string name;
    std::vector<std::string> needs;  ///< sections that have to stand before
    std::string text;
};

/// In their order. Throws std::logic_error where one does not end.
std::vector<MarkedSection> marked_sections(std::string_view text);

}  // namespace dalembert
