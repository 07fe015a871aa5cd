// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/read_statics.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/nearest.hpp"

namespace dalembert {

namespace {

struct ShapeKeys {
    const char* name;
    Solid::Shape shape;
    std::vector<std::string> needs, may_have;
};

const std::vector<ShapeKeys>& shapes() {
    using S = Solid::Shape;
    static const std::vector<ShapeKeys> table{
        {"box", S::box, {"size"}, {}},
        {"cylinder", S::cylinder, {"radius", "height"}, {"inner_radius"}},
        {"cone", S::cone, {"radius", "height"}, {"top_radius"}},
        {"sphere", S::sphere, {"radius"}, {"inner_radius"}},
        {"hemisphere", S::hemisphere, {"radius"}, {}},
        {"point", S::point, {"mass"}, {}},
    };
    return table;
}

constexpr const char* dimensions[]{"size", "radius", "inner_radius", "height", "top_radius"};

/// What a solid that is put together does not have itself.
void read_composed(const Entry& e) {
    for (const char* key : {"size", "radius", "inner_radius", "height", "top_radius", "density", "mass"})
        if (e.has(key)) e.error(Id::not_allowed_here, e.span_of(key), fmt::format("solid '{}' is put together of others, which have their own {}; it has none itself", e.name(), key));
}

void read_solid_shape(const Entry& e, Solid& solid) {
    std::vector<std::string> known;
    for (const ShapeKeys& one : shapes()) known.emplace_back(one.name);
    const std::string wanted = e.text("shape");
    const auto found = std::find_if(shapes().begin(), shapes().end(), [&](const ShapeKeys& one) { return one.name == wanted; });
    if (found == shapes().end()) return e.error(Id::wrong_type, e.span_of("shape"), fmt::format("'{}' is not a shape{}; the shapes are {}", wanted, did_you_mean(wanted, known), quoted_list(known)));
    solid.shape = found->shape;
    for (const std::string& key : found->needs)
        if (!e.has(key)) e.error(Id::missing_key, e.span(), fmt::format("solid '{}' is a {} and needs its {}", e.name(), wanted, key));
    for (const char* key : dimensions) {
        const auto lists = [&](const std::vector<std::string>& keys) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
        if (e.has(key) && !lists(found->needs) && !lists(found->may_have)) e.error(Id::not_allowed_here, e.span_of(key), fmt::format("solid '{}' is a {}, which has no {}", e.name(), wanted, key));
    }
    if (solid.shape == Solid::Shape::point) {
        if (e.has("density")) e.error(Id::not_allowed_here, e.span_of("density"), fmt::format("solid '{}' is a point, which has a mass, but no density", e.name()));
        return;
    }
    if (e.has("density") == e.has("mass"))
        e.error(Id::missing_key, e.has("mass") ? e.span_of("mass") : e.span(), fmt::format("solid '{}' needs either a density or a mass, and not both", e.name()));
    const bool is_flat = solid.size && (*solid.size)[2]->kind == Expression::Kind::number && is_zero((*solid.size)[2]->value);
    if (is_flat) e.error(Id::wrong_type, e.span_of("size"), fmt::format("the size of box '{}' is three lengths, none of them zero", e.name()));
}

void read(const Entry& e, LoadPart& part, const std::string& load) {
    part.at = e.vector("at");
    part.force = e.vector("force");
    part.moment = e.vector("moment");
    if (e.has("force") == e.has("moment")) e.error(Id::missing_key, e.span(), fmt::format("'{}' of load '{}' needs either a force or a moment, and not both", e.name(), load));
    if (e.has("moment") && e.has("at")) e.error(Id::not_allowed_here, e.span_of("at"), fmt::format("'{}' of load '{}' is a moment, which is the same wherever it acts; leave out 'at'", e.name(), load));
}

}  // namespace

void read(const Entry& e, Solid& solid) {
    solid.size = e.vector("size");
    solid.radius = e.expression("radius");
    solid.inner_radius = e.expression("inner_radius");
    solid.top_radius = e.expression("top_radius");
    solid.height = e.expression("height");
    solid.density = e.expression("density");
    solid.mass = e.expression("mass");
    solid.at = e.vector("at");
    solid.turns = e.turns("turns");
    solid.of = e.parts("of");
    solid.without = e.parts("without");
    if (e.has("shape") == e.has("of")) return e.error(Id::missing_key, e.span(), fmt::format("solid '{}' needs either a shape or a list of the solids that it is made of, and not both", e.name()));
    if (e.has("without") && !e.has("of")) e.error(Id::not_allowed_here, e.span_of("without"), fmt::format("solid '{}' has a shape, and nothing is taken away from it; put it into another one with 'of' and 'without'", e.name()));
    if (e.has("shape")) read_solid_shape(e, solid);
    else read_composed(e);
    if (e.has("of") && solid.of.empty()) e.error(Id::missing_key, e.span_of("of"), fmt::format("solid '{}' is made of nothing", e.name()));
}

void read(const Entry& e, Load& load) {
    load.about = e.vector("about");
    e.each_named("forces", load_part_section(), [&](const Entry& part) {
        load.parts.emplace_back();
        part.fill(load.parts.back());
        read(part, load.parts.back(), e.name());
    });
    e.each_named("unknowns", unknown_section(), [&](const Entry& unknown) {
        load.unknowns.emplace_back();
        unknown.fill(load.unknowns.back());
        load.unknowns.back().unit = unknown.unit("unit").value_or(Unit{});
        load.unknowns.back().when = load.when;
    });
    if (e.has("forces") && load.parts.empty()) e.error(Id::missing_key, e.span_of("forces"), fmt::format("load '{}' has no force", e.name()));
}

void read(const Entry& e, Sticking& sticking) {
    sticking.normal = e.expression("normal");
    sticking.tangential = e.one_or_two("tangential");
    sticking.tensions = e.expressions("tensions");
    sticking.angle = e.expression("angle");
    sticking.coefficient = e.expression("coefficient");
    const bool is_rope = e.has("tensions") || e.has("angle");
    const bool is_surface = e.has("normal") || e.has("tangential");
    if (is_rope == is_surface || e.has("tensions") != e.has("angle") || e.has("normal") != e.has("tangential"))
        return e.error(Id::missing_key, e.span(), fmt::format("sticking '{}' needs either normal and tangential force of a surface, or the tensions of a rope and its angle", e.name()));
    if (is_rope && sticking.tensions.size() != 2) e.error(Id::wrong_type, e.span_of("tensions"), fmt::format("the rope of sticking '{}' has two ends, so that there are 2 tensions, not {}", e.name(), sticking.tensions.size()));
}

}  // namespace dalembert
