// SPDX-License-Identifier: GPL-3.0-or-later
// Printed LaTeX as MathML, with nothing read into it: what stands on a page as a text prints it.
#pragma once

#include <string>

#include "printed/latex_macros.hpp"

namespace dalembert {

/// The inside of a <math> element; empty where a command is not known here.
std::string mathml_of_latex(const std::string& latex, const LatexMacros& macros);

}  // namespace dalembert
