// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/parts.hpp"

#include <stdexcept>

namespace dalembert {

using GiNaC::ex;

WithLetters::WithLetters(GiNaC::exmap letters) : letters_(std::move(letters)) {
    for (const auto& [letter, value] : letters_)
        if (!GiNaC::is_a<GiNaC::symbol>(letter)) throw std::logic_error("a value is given to what is no letter");
}

ex WithLetters::operator()(const ex& e) {
    if (GiNaC::is_a<GiNaC::symbol>(e)) {
        const auto letter = letters_.find(e);
        return letter == letters_.end() ? e : letter->second;
    }
    if (e.nops() == 0) return e;
    if (!GiNaC::is_a<GiNaC::function>(e)) return e.map(*this);
    if (const auto known = known_.find(e); known != known_.end()) return known->second;
    return known_.emplace(e, e.map(*this)).first->second;
}

}  // namespace dalembert
