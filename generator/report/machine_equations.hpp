// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "form/system.hpp"

namespace dalembert {

/// Equations of a machine, or of one of its modes, as HTML with MathML.
std::string equations_as_html(const System& system);

}  // namespace dalembert
