// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives by the chain rule, all directions in one pass. GiNaC's own diff knows one symbol at a time, and throws and catches
// an exception for each function that it meets.
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <stdexcept>

namespace dalembert {

/// A function of the table has no derivative there; `what()` is its name.
struct NoDerivative : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// How fast each symbol changes; 0 for one that does not.
using Direction = std::function<GiNaC::ex(const GiNaC::ex& symbol)>;

/// Throws NoDerivative.
GiNaC::ex directional_derivative(const GiNaC::ex& e, const Direction& direction);

/// Partial derivative by a symbol.
GiNaC::ex partial(const GiNaC::ex& e, const GiNaC::ex& symbol);

/// The same, with sums that are kept whole having derivatives that are, too: of what is emitted and not differentiated again.
GiNaC::ex directional_derivative_of_kept(const GiNaC::ex& e, const Direction& direction);
GiNaC::ex partial_of_kept(const GiNaC::ex& e, const GiNaC::ex& symbol);

}  // namespace dalembert
