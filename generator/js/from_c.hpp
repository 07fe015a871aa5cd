// SPDX-License-Identifier: GPL-3.0-or-later
// C of runtime/ -> JavaScript that does the same, so that what is written once runs in both.
//
// A pointer to numbers is an array there, and its target the first entry; a variable whose address is taken is an array of one. Structures
// are objects, and pointers to them the objects themselves. sizeof counts numbers instead of bytes.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "js/c_syntax.hpp"

namespace dalembert {

struct FromC {
    /// The JavaScript name of a function, table or number of C.
    std::function<std::string(const std::string&)> name = [](const std::string& one) { return one; };
    std::set<std::string> left_out = {};  ///< functions that stand elsewhere
    std::string left_out_argument = {};   ///< of functions and calls
    bool has_comments = false;
};

std::string javascript_from(const CUnit& unit, const FromC& options);

/// A name that is no word of JavaScript.
std::string javascript_name(const std::string& name);

}  // namespace dalembert
