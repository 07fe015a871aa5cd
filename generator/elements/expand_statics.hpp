// SPDX-License-Identifier: GPL-3.0-or-later
// What solids and loads stand for elsewhere in the model.
#pragma once

#include "elements/model.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Bodies that name a solid get its mass, inertia and centre as expressions of its quantities.
void expand_solids(Model& model, Diagnostics& diagnostics);

/// An unknown of a load becomes a definition of its name.
void expand_loads(Model& model);

}  // namespace dalembert
