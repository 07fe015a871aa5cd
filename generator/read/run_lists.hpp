// SPDX-License-Identifier: GPL-3.0-or-later
// What runs set for whole families: lists, and one value for all members.
#pragma once

#include "elements/model.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// The entries of a list become those of single members, and a value for all members names the first of them. How many members there are
/// is known with the sizes of a scene. Reports wrong-arguments for a list of what is no family, or of one member.
void expand_run_lists(Model& model, Diagnostics& diagnostics);

}  // namespace dalembert
