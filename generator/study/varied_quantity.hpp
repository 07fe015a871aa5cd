// SPDX-License-Identifier: GPL-3.0-or-later
// "m_W=normal(1, 5 %), d_R=0.1:1:10": what a study varies, read from the command line.
#pragma once

#include <string>

#include "form/system.hpp"
#include "study/design.hpp"

namespace dalembert {

struct VariedQuantity {
    const Variable* variable;
    Variation variation;
    Span place;
    std::string name() const { return variable->recorded_name(); }
    /// Of SI; empty without one.
    std::string unit() const;
};

/// In the order of the command line. `values` are those that the other runs have. Throws Failure (bad-option, unknown-name, syntax,
/// unit-mismatch, value-out-of-range).
std::vector<VariedQuantity> read_varied(const std::vector<std::string>& texts, const System& system, const Values& values);

}  // namespace dalembert
