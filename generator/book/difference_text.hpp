// SPDX-License-Identifier: GPL-3.0-or-later
// By what the sides of a printed equation differ, as people read it.
#pragma once

#include "graph/notation.hpp"
#include "form/system.hpp"

namespace dalembert {

/// As a formula; of what is made of signs, as cases are, piece by piece: "2*u where u > 0; 0 elsewhere".
std::string difference_text(const System& system, const GiNaC::ex& difference, bool has_cases);

}  // namespace dalembert
