// SPDX-License-Identifier: GPL-3.0-or-later
// Values of expressions at the default parameters and the start, for checks of what they must be.
#pragma once

#include "form/system.hpp"

namespace dalembert {

class StartValues {
public:
    explicit StartValues(const System& system);

    /// Nothing where it has none.
    std::optional<GiNaC::numeric> operator()(const GiNaC::ex& e) const;
    bool depends_on_input(const GiNaC::ex& e) const;
    /// Throws Failure (value-out-of-range): "WHAT is VALUE UNIT at the start, but must be above zero".
    void positive(const GiNaC::ex& e, const Span& place, const std::string& what, const char* unit) const;
    /// The same of what may be zero; what has no value passes.
    void at_least_zero(const GiNaC::ex& e, const Span& place, const std::string& what, const char* unit) const;

private:
    const System& system_;
    GiNaC::exmap start_;
};

}  // namespace dalembert
