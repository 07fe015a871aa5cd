// SPDX-License-Identifier: GPL-3.0-or-later
// What was rewritten in the code of a machine to keep digits.
#pragma once

#include "pipeline.hpp"

namespace dalembert {

struct RewrittenPlaces {
    std::string mode;  ///< of a machine that switches; else empty
    Rewriting rewriting;
};

/// Of all modes. After generate.
std::vector<RewrittenPlaces> rewritten_places(const Machine& machine);
/// A line each; nothing where nothing was rewritten.
std::string rewritten_text(const std::vector<RewrittenPlaces>& all);

}  // namespace dalembert
