// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of runtime/c, which a C header brings itself.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace dalembert {

/// A function of the runtime, for arrays of a size; 0: it has none.
struct CHelper {
    std::string function;
    std::size_t size = 0;
    friend auto operator<=>(const CHelper&, const CHelper&) = default;
};

/// A section of runtime/c, for a size. Names begin with NAME.
struct CHelperSection {
    std::string name, text;
};

/// The sections of the functions and of all that they need, each behind those that it calls.
std::vector<CHelperSection> c_helper_sections(const std::set<CHelper>& helpers);

/// Their texts. `name` stands before their names.
std::string c_helper_source(const std::set<CHelper>& helpers, const std::string& name);

}  // namespace dalembert
