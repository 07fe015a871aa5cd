// SPDX-License-Identifier: GPL-3.0-or-later
// What makes code of equations short, fast or exact. Each can be left out, to see what it gains.
#pragma once

#include <array>

namespace dalembert {

struct Passes {
    bool rewriting = true;
    bool chain = true;
    bool constants = true;
    bool factoring = true;
    bool nesting = true;
    bool angles = true;
    bool reciprocals = true;
    bool loops = true;
};

struct Pass {
    const char* name;
    bool Passes::*is_on;
    const char* doc;
};

inline constexpr std::array all_passes{
    Pass{"rewriting", &Passes::rewriting, "forms that lose digits are replaced"},
    Pass{"chain", &Passes::chain, "motion from body to body, if that is shorter"},
    Pass{"constants", &Passes::constants, "expressions of parameters alone are computed once"},
    Pass{"factoring", &Passes::factoring, "common factors and sums are computed once"},
    Pass{"nesting", &Passes::nesting, "sums are nested (Horner's scheme): what terms share is multiplied once"},
    Pass{"angles", &Passes::angles, "sine and cosine of one angle in one call"},
    Pass{"reciprocals", &Passes::reciprocals, "repeated divisions by one pivot become multiplications by its reciprocal"},
    Pass{"loops", &Passes::loops, "loops solve a mass matrix of more than seven rows, unless it is sparse"},
};

}  // namespace dalembert
