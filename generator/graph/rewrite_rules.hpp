// SPDX-License-Identifier: GPL-3.0-or-later
// Other forms of a sum that may keep digits which the sum loses. Each is equal to it, wherever both have values; which is better is for
// others to find out.
#pragma once

#include <map>

#include "graph/atoms.hpp"

namespace dalembert {

struct OtherForm {
    const char* rule;  ///< "1 - cos(x)", ...
    Polynomial form;
    bool fills_gaps = false;  ///< it has values where the other one is 0/0
};

/// The rules, with the identity of each as text: what is written on the left becomes what is on the right.
struct RewriteRule {
    const char* name;
    const char* identity;
    std::vector<Polynomial> (*forms)(const Polynomial&, Atoms&);
};
const std::vector<RewriteRule>& rewrite_rules();

/// All forms that differ from p at one place: in its own terms, or in the argument of a function or sum in them.
using FormMemory = std::map<Polynomial, std::vector<OtherForm>>;
const std::vector<OtherForm>& other_forms(const Polynomial& p, Atoms& atoms, FormMemory& known);

}  // namespace dalembert
