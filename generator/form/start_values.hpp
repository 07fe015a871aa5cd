// SPDX-License-Identifier: GPL-3.0-or-later
// Values of expressions at the default parameters and the start, for checks of what they must be.
#pragma once

#include "form/system.hpp"

namespace dalembert {

class StartValues {
public:
    /// The values of the model file.
    explicit StartValues(const System& system);
    StartValues(const System& system, const Values& values);

    /// Nothing where it has none.
    std::optional<GiNaC::numeric> operator()(const GiNaC::ex& e) const;
    bool depends_on_input(const GiNaC::ex& e) const;
    /// Throws Failure (value-out-of-range): "WHAT is VALUE UNIT at the start, but must be above zero". What has no value breaks no rule but
    /// this one.
    void check(const SignRule& rule, const GiNaC::ex& e, const Span& place, const std::string& what) const;
    void positive(const GiNaC::ex& e, const Span& place, const std::string& what, const char* unit) const;

private:
    const System& system_;
    const char* when_ = "at the start";
    GiNaC::exmap start_;
};

}  // namespace dalembert
