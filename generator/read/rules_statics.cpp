// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/statics.hpp"
#include "read/rules.hpp"

namespace dalembert {

namespace {

/// What a solid that is put together does not have itself.
void check_composed(const Entry& e) {
    for (const char* key : {"size", "radius", "inner_radius", "height", "top_radius", "density", "mass"})
        if (e.has(key))
            e.error(Id::not_allowed_here, e.span_of(key),
                    fmt::format("solid '{}' consists of other solids, which have their own {}; leave it out here", e.name(), key));
}

void check_shape(const Entry& e, const Solid& solid) {
    if (solid.shape == Solid::Shape::point) return;
    if (e.has("density") == e.has("mass"))
        e.error(Id::missing_key, e.has("mass") ? e.span_of("mass") : e.span(),
                fmt::format("solid '{}' needs either a density or a mass, and not both", e.name()));
    const bool is_flat = solid.size && (*solid.size)[2]->kind == Expression::Kind::number && is_zero((*solid.size)[2]->value);
    if (is_flat)
        e.error(Id::wrong_type, e.span_of("size"), fmt::format("the size of box '{}' is three lengths, none of them zero", e.name()));
}

}  // namespace

void check_rules(const Entry& e, Solid& solid) {
    if (e.has("shape") == e.has("of")) return;
    if (e.has("without") && !e.has("of"))
        e.error(Id::not_allowed_here, e.span_of("without"),
                fmt::format("solid '{}' has a shape and takes no 'without'; make another solid with 'of' and 'without'", e.name()));
    if (e.has("shape")) check_shape(e, solid);
    else check_composed(e);
    if (e.has("of") && solid.of.empty())
        e.error(Id::missing_key, e.span_of("of"), fmt::format("solid '{}' is empty; 'of' needs at least one solid", e.name()));
}

void check_rules(const Entry& e, Load& load) {
    for (Unknown& unknown : load.unknowns) unknown.when = load.when;
    if (e.has("forces") && load.parts.empty())
        e.error(Id::missing_key, e.span_of("forces"), fmt::format("load '{}' has no force", e.name()));
}

void check_rules(const Entry& e, Sticking& sticking) {
    const bool is_rope = e.has("tensions") || e.has("angle");
    const bool is_surface = e.has("normal") || e.has("tangential");
    if (is_rope == is_surface || e.has("tensions") != e.has("angle") || e.has("normal") != e.has("tangential"))
        return e.error(
            Id::missing_key, e.span(),
            fmt::format("sticking '{}' needs either normal and tangential force of a surface, or the tensions of a rope and its angle",
                        e.name()));
    if (is_rope && sticking.tensions.size() != 2)
        e.error(Id::wrong_type, e.span_of("tensions"),
                fmt::format("the rope of sticking '{}' has two ends, so it has 2 tensions, not {}", e.name(), sticking.tensions.size()));
}

}  // namespace dalembert
