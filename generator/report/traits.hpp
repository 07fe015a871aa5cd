// SPDX-License-Identifier: GPL-3.0-or-later
// What a system shows, in words that a page can be filtered by: found in its derived scene, its check and its run, never told by anybody.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "form/system.hpp"
#include "report/printed_report.hpp"

namespace dalembert {

/// What traits are found in.
struct TraitFacts {
    const System& system;
    const VerdictCounts& printed;
    const Run* run;              ///< null: the model has none
    std::size_t stiff_steps;     ///< that the method `automatic` made as of what is stiff
};

struct Trait {
    const char* name;
    const char* doc;
    bool (*is_shown)(const TraitFacts& facts);
};

/// All there are, in the order in which they are shown.
std::span<const Trait> traits();

std::vector<const Trait*> traits_of(const TraitFacts& facts);

}  // namespace dalembert
