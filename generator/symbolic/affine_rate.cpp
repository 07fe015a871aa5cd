// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/affine_rate.hpp"

#include <fmt/format.h>

#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

AffineRate affine_rate(const ex& rate, const Symbols& symbols, const Span& place, const std::string& what) {
    AffineRate result{{}, rate};
    GiNaC::exmap at_rest;
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        const ex& velocity = symbols.get(SymbolKind::velocity, j);
        result.jacobian.push_back(partial(rate, velocity));
        at_rest[velocity] = 0;
        for (std::size_t k = 0; k < symbols.degrees(); ++k)
            if (!partial(result.jacobian.back(), symbols.get(SymbolKind::velocity, k)).expand().is_zero())
                throw Failure(Diagnostic{Id::not_affine, place,
                                         fmt::format("{} is not linear in '{}'", what, symbols.all(SymbolKind::velocity)[k].name)});
    }
    result.drift = rate.subs(at_rest, GiNaC::subs_options::no_pattern);
    return result;
}

}  // namespace dalembert
