// SPDX-License-Identifier: GPL-3.0-or-later
// The checks that a model passes after it was read and before anything is chosen from it. Each reports all that it finds.
#pragma once

#include "model/names.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Validity and uniqueness of names; definitions that need themselves. The other checks rely on this one.
void check_names(const Model& model, Diagnostics& diagnostics);

/// Every word of every expression: defined, with the right index and arguments, and nothing that its place must not depend on.
void check_expressions(const Model& model, Diagnostics& diagnostics);

/// Bodies, coordinates, effects and scenes that items refer to by name.
/// Media, volumes, reservoirs and flows: who refers to whom, and whether laws fit media and states.
void check_fluids(const Model& model, Diagnostics& diagnostics);
/// Warns of volumes that can reach zero within the declared ranges of coordinates and states, at the default parameters.
void warn_of_vanishing(const Model& model, Diagnostics& diagnostics);
void check_references(const Model& model, Diagnostics& diagnostics);

/// Units of every expression, and that both sides of everything agree.
void check_units(const Model& model, Diagnostics& diagnostics);

}  // namespace dalembert
