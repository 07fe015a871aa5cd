// SPDX-License-Identifier: GPL-3.0-or-later
// What is proven is what is emitted: the code of every function, raised back to GiNaC, against the derivation.
#pragma once

#include "graph/code.hpp"
#include "prove/audit.hpp"

namespace dalembert {

/// One entry a function, with the worst verdict of its values; and one for the solve where it is written out.
std::vector<AuditEntry> verify(const Code& code);

}  // namespace dalembert
