// SPDX-License-Identifier: GPL-3.0-or-later
// What several verbs do.
#pragma once

#include "run/options.hpp"

namespace dalembert {

/// The model of the command line; warnings are printed.
std::shared_ptr<const LoadedModel> loaded(const Options& options, Streams streams);

/// The machine of the command line, derived and proven.
Machine derived(const Options& options, Streams streams);
/// Those of the derivation.
void show_warnings(const Machine& machine, Streams streams);
/// Of start values of the model that hardly anybody means.
void show_doubts(const Machine& machine, Streams streams);

/// What the command line asks of code: the passes that it does not leave out, and whose sine and cosine.
void ask_of_code(Machine& machine, const Options& options);

/// The machine in the mode of the command line. Throws Failure (unknown-name).
const Machine& in_chosen_mode(const Machine& machine, const Options& options);

/// Throws Failure (too-large) where cells of rods are computed in loops, so that they have no equations of their own.
void refuse_fields(const System& system, const char* verb);
/// Throws Failure (nothing-left) where nothing can move: statics alone.
/// Tells that what is written is the machine without its controllers.
void tell_of_samplers(const System& system, Streams streams);
/// Throws Failure (not-allowed-here) where a controller samples.
void refuse_samplers(const System& system, const std::string& verb);

void refuse_rest(const System& system, const char* verb);

}  // namespace dalembert
