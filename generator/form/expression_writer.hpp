// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions as text.
#pragma once

#include "symbolic/symbols.hpp"

namespace dalembert {

/// As people write it, in an order that does not depend on the run.
class ExpressionWriter {
public:
    explicit ExpressionWriter(const Symbols& symbols) : symbols_(symbols) {}
    std::string operator()(const GiNaC::ex& e) const;

private:
    std::string as_factor(const GiNaC::ex& e) const;
    /// Numbers last.
    std::string sum(const GiNaC::ex& e) const;
    std::string product(const GiNaC::ex& e) const;

    const Symbols& symbols_;
};

}  // namespace dalembert
