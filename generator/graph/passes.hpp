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
    Pass{"rewriting", &Passes::rewriting, "forms that lose digits have others"},
    Pass{"chain", &Passes::chain, "motion from body to body, where that is shorter"},
    Pass{"constants", &Passes::constants, "what depends on parameters alone is computed once"},
    Pass{"factoring", &Passes::factoring, "common factors and sums are computed once"},
    Pass{"angles", &Passes::angles, "sine and cosine of one angle in one call"},
    Pass{"reciprocals", &Passes::reciprocals, "what is divided by one pivot several times is multiplied by its reciprocal"},
    Pass{"loops", &Passes::loops, "M of more than seven rows is solved with by loops, unless it is sparse"},
};

}  // namespace dalembert
