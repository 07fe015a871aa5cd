// SPDX-License-Identifier: GPL-3.0-or-later
// Joins of ports: what becomes one, what is left out, and where a constraint takes the place of a coordinate that cannot go.
#pragma once

#include <string>
#include <vector>

#include "elements/model.hpp"
#include "elements/parts.hpp"
#include "elements/rename.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// A port with all its names as those of the model.
struct PartPort {
    std::string part;
    Port port;
    Span joined = {};  ///< where, if it is
};

/// Joins the ports that `uses` name. What stands instead of another is added to `everywhere`, and what goes is taken out of the model.
void join_ports(Model& model, const std::vector<Use>& uses, std::vector<PartPort> ports, Renaming& everywhere, Diagnostics& diagnostics);

}  // namespace dalembert
