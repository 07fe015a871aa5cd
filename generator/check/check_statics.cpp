// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "check/checks.hpp"
#include "text/nearest.hpp"

namespace dalembert {

void check_statics(const Model& model, Diagnostics& diagnostics) {
    const Names names(model);
    for (const Solid& solid : model.solids)
        for (const auto* parts : {&solid.of, &solid.without})
            for (const Reference& part : *parts) {
                if (names.find_solid(part.name) == nullptr)
                    diagnostics.error(Id::unknown_name, part.span,
                                      fmt::format("there is no solid '{}' that '{}' could be made of{}", part.name, solid.name,
                                                  did_you_mean(part.name, names.solids())));
                else if (part.index)
                    diagnostics.error(Id::not_indexed, part.span, fmt::format("solid '{}' has no index", part.name));
            }
    for (const Body& body : model.bodies)
        if (body.solid && body.solid->index)
            diagnostics.error(Id::not_indexed, body.solid->span, fmt::format("solid '{}' has no index", body.solid->name));
}

}  // namespace dalembert
