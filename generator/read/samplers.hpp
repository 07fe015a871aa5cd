// SPDX-License-Identifier: GPL-3.0-or-later
// Controllers that a machine uses: their files, with the parameters that the machine sets.
#pragma once

#include "elements/model.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Gives a controller, as its file says, the name and the parameters that it has in a machine.
void set_controller(Model& controller, const Sampler& sampler, const std::string& machine, Diagnostics& diagnostics);

/// Each measurement becomes an output of the model, "speed_w". What samplers measure and set is checked here.
void expand_samplers(Model& model, Diagnostics& diagnostics);

}  // namespace dalembert
