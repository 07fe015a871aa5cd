// SPDX-License-Identifier: GPL-3.0-or-later
// What runs set for whole families: lists, and one value for all members.
#pragma once

#include "elements/model.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Each entry of a list becomes that of one member. A value for all members names the first of them: the scene knows how many there are.
/// Reports wrong-arguments for a list that is given to a single quantity.
void expand_run_lists(Model& model, Diagnostics& diagnostics);

}  // namespace dalembert
