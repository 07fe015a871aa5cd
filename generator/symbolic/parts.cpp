// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/parts.hpp"

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

ex WithLetters::operator()(const ex& e) {
    if (GiNaC::is_a<GiNaC::symbol>(e)) {
        const auto letter = letters_.find(e);
        return letter == letters_.end() ? e : letter->second;
    }
    if (e.nops() == 0) return e;
    if (!is_ex_the_function(e, whole)) return e.map(*this);
    if (const auto known = sums_.find(e); known != sums_.end()) return known->second;
    return sums_.emplace(e, e.map(*this)).first->second;
}

}  // namespace dalembert
