// SPDX-License-Identifier: GPL-3.0-or-later
// The table of verbs.
#pragma once

#include <span>

#include "command/verb_options.hpp"

namespace dalembert {

struct Verb {
    const char* name;
    const char* doc;
    ExitCode (*run)(const Options& options, Streams streams);  ///< throws Failure
    void (*take)(VerbOptions& o);                              ///< the options it has, in the order in which help lists them
};

/// In the order of `dalembert --help`.
std::span<const Verb> verbs();

}  // namespace dalembert
