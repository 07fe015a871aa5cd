// SPDX-License-Identifier: GPL-3.0-or-later
// Traits of a system, words by which a page can be filtered. The program finds them in the scene, the check and the run; no model states them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "form/system.hpp"
#include "report/printed_report.hpp"

namespace dalembert {

/// The results in which traits are found.
struct TraitFacts {
    const System& system;
    const VerdictCounts& printed;
    const Run* run;              ///< null: the model has none
    std::size_t stiff_steps;     ///< of the implicit integrator, by the method `automatic`
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
