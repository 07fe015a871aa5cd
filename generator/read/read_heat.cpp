// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/read_heat.hpp"

#include "elements/describe_heat.hpp"
#include "read/described.hpp"
#include "read/law_keys.hpp"

namespace dalembert {

namespace {

const std::vector<LawKeys<Link::Law>>& link_laws() {
    using L = Link::Law;
    static const std::vector<LawKeys<L>> laws{
        {"conduction", L::conduction, {"conductivity", "area", "length"}, {}},
        {"convection", L::convection, {"coefficient", "area"}, {}},
        {"contact", L::convection, {"coefficient", "area"}, {}},
        {"radiation", L::radiation, {"emissivity", "area"}, {}},
    };
    return laws;
}

void needs(const Entry& e, const char* what, const char* key, const char* because) {
    if (!e.has(key)) e.error(Id::missing_key, e.span(), fmt::format("{} '{}' needs the key '{}'{}", what, e.name(), key, because));
}

void useless(const Entry& e, const char* what, const char* key, const char* because) {
    if (e.has(key)) e.error(Id::unknown_key, e.span_of(key), fmt::format("{} '{}' has no use for '{}'{}", what, e.name(), key, because));
}

/// Of an end of a rod, or a side of a block: "the last end of rod 'bar'".
void check_boundary(const Entry& e, const std::optional<Boundary>& end, const std::string& place) {
    if (!end) return;
    const bool exchanges = end->coefficient || end->emissivity;
    if ((end->temperature || end->node) && (end->flux || exchanges || (end->temperature && end->node)))
        e.error(Id::doubly_determined, end->span,
                fmt::format("{} has a {}, so that nothing else can be said of it", place, end->temperature ? "temperature" : "node"));
    if (exchanges != (end->ambient != nullptr))
        e.error(Id::missing_key, end->span, fmt::format("{} needs an ambient together with a coefficient or an emissivity", place));
}

/// A side of a block, which may also touch a node.
std::optional<Boundary> side(const Entry& e, const char* key) {
    if (!e.has(key)) return std::nullopt;
    std::optional<Boundary> end(std::in_place);
    end->span = e.span_of(key);
    const std::string place = fmt::format("the {} side of block '{}'", key, e.name());
    ExpressionPtr node;
    PartKeys keys;
    describe(keys, *end);
    keys("node", node, {});
    keys.read(e, key, place);
    if (node && node->kind == Expression::Kind::name && node->children.size() <= 1)
        end->node = Reference{node->name, node->children.empty() ? nullptr : node->children[0], node->span};
    else if (node)
        e.error(Id::wrong_type, node->span, fmt::format("'{}' is not the name of a node", node->written()));
    check_boundary(e, end, place);
    return end;
}

/// Cells take all members, so an index has no place.
void whole_family(const Entry& e, const char* what, const Reference& temperature) {
    if (temperature.index) e.error(Id::not_indexed, temperature.span, fmt::format("{} '{}' takes a whole family of states; name it without an index", what, e.name()));
}

void read_shape(const Entry& e, Rod& rod) {
    const std::string shape = e.text("shape");
    rod.shape = shape == "cylinder" ? Rod::Shape::cylinder : shape == "sphere" ? Rod::Shape::sphere : Rod::Shape::bar;
    if (!shape.empty() && shape != "bar" && shape != "cylinder" && shape != "sphere")
        e.error(Id::wrong_type, e.span_of("shape"), fmt::format("'{}' is not a shape of a rod; the shapes are 'bar', 'cylinder' and 'sphere'", shape));
    const bool is_bar = rod.shape == Rod::Shape::bar;
    const std::string because = fmt::format(", because it is a {}", is_bar ? "bar" : shape);
    for (const char* key : {"length", "area"}) is_bar ? needs(e, "rod", key, because.c_str()) : useless(e, "rod", key, because.c_str());
    for (const char* key : {"inner", "outer"}) is_bar ? useless(e, "rod", key, because.c_str()) : needs(e, "rod", key, because.c_str());
    rod.shape == Rod::Shape::cylinder ? needs(e, "rod", "height", because.c_str()) : useless(e, "rod", "height", because.c_str());
    if (!is_bar)
        for (const char* key : {"perimeter", "side_coefficient", "side_emissivity", "ambient"}) useless(e, "rod", key, ", because only a bar has a side");
}

}  // namespace

void read(const Entry& e, HeatNode& node) {
    read_described(e, node);
    if (e.has("boiling")) {
        needs(e, "node", "capacity", ", because it boils");
        if (e.has("for")) e.error(Id::not_allowed_here, e.span_of("boiling"), fmt::format("node '{}' is a family, whose members cannot have modes of their own", e.name()));
    }
    if (e.has("capacity")) needs(e, "node", "temperature", ": the state that its capacity belongs to");
    if (node.is_held() && e.has("heat"))
        e.error(Id::doubly_determined, e.span_of("heat"), fmt::format("node '{}' is held at a temperature, so that heat into it changes nothing; give it a capacity, or leave its temperature out", e.name()));
}

void read(const Entry& e, Link& link) {
    read_described(e, link);
    const std::vector<const char*> keys{"heat", "conductance", "resistance", "conductivity", "area", "length", "coefficient", "emissivity"};
    if (e.has("law")) {
        if (const auto* law = find_law(e, "link", link_laws(), keys)) link.law = law->law;
        return;
    }
    std::vector<const char*> given;
    for (const char* key : keys)
        if (e.has(key)) given.push_back(key);
    const bool is_simple = given.size() == 1 && (e.has("heat") || e.has("conductance") || e.has("resistance"));
    if (!is_simple)
        e.error(Id::missing_key, e.span(), fmt::format("link '{}' needs either a law, or one of heat, conductance and resistance", e.name()));
    link.law = e.has("heat") ? Link::Law::given : Link::Law::linear;
}

void read(const Entry& e, Rod& rod) {
    read_described(e, rod);
    const std::string scheme = e.text("scheme");
    rod.scheme = scheme == "cells" ? Rod::Scheme::cells : Rod::Scheme::points;
    if (!scheme.empty() && scheme != "cells" && scheme != "points")
        e.error(Id::wrong_type, e.span_of("scheme"), fmt::format("'{}' is not a scheme of a rod; the schemes are 'points' and 'cells'", scheme));
    read_shape(e, rod);
    for (const auto& [end, key] : {std::pair(&rod.first, "first"), std::pair(&rod.last, "last")})
        check_boundary(e, *end, fmt::format("the {} end of rod '{}'", key, e.name()));
    if (e.has("side_coefficient") || e.has("side_emissivity"))
        for (const char* key : {"perimeter", "ambient"}) needs(e, "rod", key, ", because heat leaves through its side");
    else
        for (const char* key : {"perimeter", "ambient"}) useless(e, "rod", key, ": it says neither side_coefficient nor side_emissivity");
    whole_family(e, "rod", rod.temperature);
}

void read(const Entry& e, Block& block) {
    if (auto temperature = e.part("temperature")) block.temperature = *temperature;
    for (const auto& [length, cells] : e.points("columns")) block.columns.push_back({length, cells});
    for (const auto& [length, cells] : e.points("rows")) block.rows.push_back({length, cells});
    block.depth = e.expression("depth");
    block.conductivity = e.table("conductivity");
    block.conductivity_span = e.span_of("conductivity");
    block.density = e.table("density");
    block.density_span = e.span_of("density");
    block.heat_capacity = e.table("heat_capacity");
    block.heat_capacity_span = e.span_of("heat_capacity");
    block.source = e.property("source");
    if (block.source && block.source->variables.size() == 1)
        e.error(Id::wrong_type, block.source->span, fmt::format("the source of block '{}' may be a law of two variables, as in \"(x, y) -> ...\", not of one", e.name()));
    block.left = side(e, "left");
    block.right = side(e, "right");
    block.bottom = side(e, "bottom");
    block.top = side(e, "top");
    whole_family(e, "block", block.temperature);
}

void read(const Entry& e, Enclosure& enclosure) {
    enclosure.surfaces = e.parts("surfaces");
    enclosure.emissivities = e.expressions("emissivities");
    enclosure.emissivities_span = e.span_of("emissivities");
    enclosure.areas = e.expressions("areas");
    enclosure.areas_span = e.span_of("areas");
    enclosure.view_factors = e.matrix("view_factors");
    enclosure.view_factors_span = e.span_of("view_factors");
    enclosure.polygon = e.points("polygon");
    enclosure.polygon_span = e.span_of("polygon");
    enclosure.height = e.expression("height");
    if (e.has("polygon") == e.has("view_factors"))
        e.error(Id::missing_key, e.has("polygon") ? e.span_of("view_factors") : e.span(),
                fmt::format("enclosure '{}' needs either the polygon of its cross section or its view_factors{}", e.name(), e.has("polygon") ? ", and not both" : ""));
    const bool is_prism = e.has("polygon");
    needs(e, "enclosure", is_prism ? "height" : "areas", is_prism ? ", because it has a polygon" : ", because its view factors are given");
    useless(e, "enclosure", is_prism ? "areas" : "height", is_prism ? ": they follow from the polygon and the height" : ", because its view factors are given");
}

}  // namespace dalembert
