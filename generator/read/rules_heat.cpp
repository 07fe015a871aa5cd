// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/conduction.hpp"
#include "elements/heat.hpp"
#include "read/rules.hpp"

namespace dalembert {

namespace {

void needs(const Entry& e, const char* what, const char* key, const char* because) {
    if (!e.has(key)) e.error(Id::missing_key, e.span(), fmt::format("{} '{}' needs the key '{}'{}", what, e.name(), key, because));
}

void useless(const Entry& e, const char* what, const char* key, const char* because) {
    if (e.has(key)) e.error(Id::unknown_key, e.span_of(key), fmt::format("{} '{}' does not take '{}'{}", what, e.name(), key, because));
}

/// Of an end of a rod, or a side of a block: "the last end of rod 'bar'".
void check_boundary(const Entry& e, const Boundary& end, const Side* side, const std::string& place) {
    const bool exchanges = end.coefficient || end.emissivity;
    const bool touches = side != nullptr && side->node;
    if ((end.temperature || touches) && (end.flux || exchanges || (end.temperature && touches)))
        e.error(Id::doubly_determined, end.span,
                fmt::format("{} has a {} and takes no other key", place, end.temperature ? "temperature" : "node"));
    if (exchanges != (end.ambient != nullptr))
        e.error(Id::missing_key, end.span, fmt::format("{} needs an ambient together with a coefficient or an emissivity", place));
}

/// Cells take all members, so an index has no place.
void whole_family(const Entry& e, const char* what, const Reference& temperature) {
    if (temperature.index)
        e.error(Id::not_indexed, temperature.span,
                fmt::format("{} '{}' takes a whole family of states; name it without an index", what, e.name()));
}

}  // namespace

void check_rules(const Entry& e, HeatNode& node) {
    if (node.is_held() && e.has("heat"))
        e.error(Id::doubly_determined, e.span_of("heat"),
                fmt::format(
                    "node '{}' has a given temperature, so heat into it changes nothing; give it a capacity, or leave its temperature out",
                    e.name()));
}

void check_rules(const Entry& e, Link& link) {
    if (e.has("law")) return;
    if (e.has("heat") + e.has("conductance") + e.has("resistance") != 1)
        e.error(Id::missing_key, e.span(),
                fmt::format("link '{}' needs either a law, or one of heat, conductance and resistance", e.name()));
    link.law = e.has("heat") ? Link::Law::given : Link::Law::linear;
}

void check_rules(const Entry& e, Rod& rod) {
    for (const auto& [end, key] : {std::pair(&rod.first, "first"), std::pair(&rod.last, "last")})
        if (*end) check_boundary(e, **end, nullptr, fmt::format("the {} end of rod '{}'", key, e.name()));
    if (e.has("side_coefficient") || e.has("side_emissivity"))
        for (const char* key : {"perimeter", "ambient"}) needs(e, "rod", key, ", because heat leaves through its side");
    else
        for (const char* key : {"perimeter", "ambient"}) useless(e, "rod", key, ": it has neither side_coefficient nor side_emissivity");
    whole_family(e, "rod", rod.temperature);
}

void check_rules(const Entry& e, Block& block) {
    for (const auto& [side, key] : {std::pair(&block.left, "left"), std::pair(&block.right, "right"), std::pair(&block.bottom, "bottom"),
                                    std::pair(&block.top, "top")})
        if (*side) check_boundary(e, **side, &**side, fmt::format("the {} side of block '{}'", key, e.name()));
    whole_family(e, "block", block.temperature);
}

void check_rules(const Entry& e, Enclosure&) {
    const bool is_prism = e.has("polygon");
    needs(e, "enclosure", is_prism ? "height" : "areas", is_prism ? ", because it has a polygon" : ", because its view factors are given");
    useless(e, "enclosure", is_prism ? "areas" : "height",
            is_prism ? ": they follow from the polygon and the height" : ", because its view factors are given");
}

}  // namespace dalembert
