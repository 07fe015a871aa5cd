// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/read_heat.hpp"

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

/// A law of more than one variable makes no sense here.
std::optional<Property> dependent(const Entry& e, const char* key) {
    auto property = e.property(key);
    if (property && property->variables.size() > 1)
        e.error(Id::wrong_type, property->span, fmt::format("the {} of '{}' may be a law of one variable, as in \"T -> ...\", not of two", key, e.name()));
    return property;
}

void needs(const Entry& e, const char* what, const char* key, const char* because) {
    if (!e.has(key)) e.error(Id::missing_key, e.span(), fmt::format("{} '{}' needs the key '{}'{}", what, e.name(), key, because));
}

void useless(const Entry& e, const char* what, const char* key, const char* because) {
    if (e.has(key)) e.error(Id::unknown_key, e.span_of(key), fmt::format("{} '{}' has no use for '{}'{}", what, e.name(), key, because));
}

/// An end of a rod, or a side of a block: "the last end of rod 'bar'".
std::optional<Boundary> boundary(const Entry& e, const char* key, const char* what, bool takes_node) {
    if (!e.has(key)) return std::nullopt;
    Boundary end;
    end.span = e.span_of(key);
    const std::string place = fmt::format("the {} {} '{}'", key, what, e.name());
    for (const RunEntry& entry : e.by_name(key)) {
        const std::string& name = entry.variable->name;
        if (takes_node && name == "node") {
            const Expression& node = *entry.value;
            if (node.kind == Expression::Kind::name && node.children.size() <= 1) end.node = Reference{node.name, node.children.empty() ? nullptr : node.children[0], node.span};
            else e.error(Id::wrong_type, node.span, fmt::format("'{}' is not the name of a node", node.written()));
            continue;
        }
        ExpressionPtr* part = name == "temperature"   ? &end.temperature
                              : name == "flux"        ? &end.flux
                              : name == "coefficient" ? &end.coefficient
                              : name == "emissivity"  ? &end.emissivity
                              : name == "ambient"     ? &end.ambient
                                                      : nullptr;
        if (part == nullptr)
            e.error(Id::unknown_key, entry.span, fmt::format("{} has a temperature, {}flux, coefficient, emissivity and ambient, but no '{}'", place, takes_node ? "node, " : "", entry.variable->written()));
        else
            *part = entry.value;
    }
    const bool exchanges = end.coefficient || end.emissivity;
    if ((end.temperature || end.node) && (end.flux || exchanges || (end.temperature && end.node)))
        e.error(Id::doubly_determined, end.span, fmt::format("{} has a {}, so that nothing else can be said of it", place, end.temperature ? "temperature" : "node"));
    if (exchanges != (end.ambient != nullptr))
        e.error(Id::missing_key, end.span, fmt::format("{} needs an ambient together with a coefficient or an emissivity", place));
    return end;
}

Boiling boiling(const Entry& e) {
    Boiling boiling;
    for (const RunEntry& entry : e.by_name("boiling")) {
        const std::string& name = entry.variable->name;
        ExpressionPtr* part = name == "temperature" ? &boiling.temperature : name == "enthalpy" ? &boiling.enthalpy : name == "mass" ? &boiling.mass : nullptr;
        if (part == nullptr) e.error(Id::unknown_key, entry.span, fmt::format("the boiling of node '{}' has a temperature, an enthalpy and a mass, but no '{}'", e.name(), entry.variable->written()));
        else *part = entry.value;
    }
    for (const auto& [part, name] : {std::pair(&boiling.temperature, "temperature"), std::pair(&boiling.enthalpy, "enthalpy"), std::pair(&boiling.mass, "mass")})
        if (!*part) e.error(Id::missing_key, e.span_of("boiling"), fmt::format("the boiling of node '{}' needs the {}", e.name(), name));
    return boiling;
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
    node.temperature = e.expression("temperature");
    node.capacity = dependent(e, "capacity");
    node.heat = e.expression("heat");
    if (e.has("boiling")) {
        needs(e, "node", "capacity", ", because it boils");
        if (e.has("for")) e.error(Id::not_allowed_here, e.span_of("boiling"), fmt::format("node '{}' is a family, whose members cannot have modes of their own", e.name()));
        node.boiling = boiling(e);
    }
    if (e.has("capacity")) needs(e, "node", "temperature", ": the state that its capacity belongs to");
    if (node.is_held() && e.has("heat"))
        e.error(Id::doubly_determined, e.span_of("heat"), fmt::format("node '{}' is held at a temperature, so that heat into it changes nothing; give it a capacity, or leave its temperature out", e.name()));
}

void read(const Entry& e, Link& link) {
    if (auto from = e.part("from")) link.from = *from;
    if (auto to = e.part("to")) link.to = *to;
    link.heat = e.expression("heat");
    link.conductance = e.expression("conductance");
    link.resistance = e.expression("resistance");
    link.conductivity = dependent(e, "conductivity");
    link.area = e.expression("area");
    link.length = e.expression("length");
    link.coefficient = e.expression("coefficient");
    link.emissivity = e.expression("emissivity");
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
    if (auto temperature = e.part("temperature")) rod.temperature = *temperature;
    const std::string scheme = e.text("scheme");
    rod.scheme = scheme == "cells" ? Rod::Scheme::cells : Rod::Scheme::points;
    if (!scheme.empty() && scheme != "cells" && scheme != "points")
        e.error(Id::wrong_type, e.span_of("scheme"), fmt::format("'{}' is not a scheme of a rod; the schemes are 'points' and 'cells'", scheme));
    read_shape(e, rod);
    rod.length = e.expression("length");
    rod.area = dependent(e, "area");
    rod.inner = e.expression("inner");
    rod.outer = e.expression("outer");
    rod.height = e.expression("height");
    rod.grid = e.law("grid");
    rod.conductivity = dependent(e, "conductivity");
    rod.density = e.expression("density");
    rod.heat_capacity = dependent(e, "heat_capacity");
    rod.source = dependent(e, "source");
    rod.perimeter = e.expression("perimeter");
    rod.side_coefficient = e.expression("side_coefficient");
    rod.side_emissivity = e.expression("side_emissivity");
    rod.ambient = e.expression("ambient");
    if (e.has("loops")) rod.loops = e.boolean("loops");
    rod.first = boundary(e, "first", "end of rod", false);
    rod.last = boundary(e, "last", "end of rod", false);
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
    block.left = boundary(e, "left", "side of block", true);
    block.right = boundary(e, "right", "side of block", true);
    block.bottom = boundary(e, "bottom", "side of block", true);
    block.top = boundary(e, "top", "side of block", true);
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
