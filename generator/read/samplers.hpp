// SPDX-License-Identifier: GPL-3.0-or-later
// Controllers that a machine uses: their files, with the parameters that the machine sets.
#pragma once

#include "elements/model.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Gives a controller, as its file says, the name and the parameters that it has in a machine. What is made of parameters of the
/// machine is known in its runs.
void set_controller(Model& controller, Sampler& sampler, const std::string& machine, Diagnostics& diagnostics);

/// Each measurement becomes an output of the model, "speed_w", and each parameter that is made of those of the model a definition,
/// "speed_K". What samplers measure and set is checked here.
void expand_samplers(Model& model, Diagnostics& diagnostics);

}  // namespace dalembert
