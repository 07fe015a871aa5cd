// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of runtime/c in JavaScript, which a module brings itself. They are written once, in C.
#pragma once

#include "c/helpers.hpp"

namespace dalembert {

/// "$sign", "$ldlt_factor_3".
std::string js_name(const CHelper& helper);

/// The texts of the functions and of all that they need, each behind those that it calls.
std::string js_helper_source(const std::set<CHelper>& helpers);

/// Functions in C of a plant, whose names begin with NAME and which take it as `plant_`.
std::string js_from_functions(const std::string& text);

}  // namespace dalembert
