// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/port_places.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"
#include "language/expression_text.hpp"

namespace dalembert {

namespace {

bool is_nothing(const ExpressionPtr& e) { return !e || (e->kind == Expression::Kind::number && zerop(e->value)); }

bool is_origin(const std::optional<VectorExpression>& place) {
    return !place || std::all_of(place->begin(), place->end(), [](const ExpressionPtr& e) { return is_nothing(e); });
}

Rank rank_of(const Reservoir&) { return Rank::given; }
Rank rank_of(const Junction&) { return Rank::follows; }
Rank rank_of(const HeatNode& node) {
    return node.is_held() ? Rank::given : node.capacity ? Rank::stores : Rank::follows;
}
/// The ground: a body without mass that does not move away from the origin. Any other place would be lost.
Rank rank_of(const Body& body) {
    const bool weighs = !is_nothing(body.mass) || !is_nothing(body.inertia) || !body.tensor.empty() || body.solid;
    const bool is_at_origin = is_origin(body.position) && is_origin(body.origin) && is_origin(body.centre);
    const bool turns = !is_nothing(body.rotation) || body.angular_velocity || !body.turns.empty() || body.attitude;
    return weighs || !is_at_origin || turns || body.on ? Rank::stores : Rank::given;
}

}  // namespace

std::string written(const Reference& to) { return to.index ? fmt::format("{}[{}]", to.name, in_model_language(*to.index)) : to.name; }

Place place_of(const Model& model, const Reference& to, Port::Kind kind) {
    const std::vector<const char*> kinds = elements_at(kind, true);
    Place place{to};
    for_each_kind(model, [&]<class Items>(const char*, const Items& items) {
        using Element = typename Items::value_type;
        if constexpr (std::derived_from<Element, Item>) {
            if (std::find(kinds.begin(), kinds.end(), std::string_view(kind_of<Element>.word)) == kinds.end()) return;
            for (const Element& element : items) {
                if (element.name != to.name) continue;
                place.word = kind_of<Element>.word;
                place.is_of_part = element.span.source != model.source;
                if constexpr (requires { element.medium; }) place.medium = element.medium.name;
                if constexpr (requires { rank_of(element); }) place.rank = rank_of(element);
                place.is_family = element.family.has_value();
            }
        }
    });
    return place;
}

bool Place::is(const Place& other) const { return written(to) == written(other.to); }

std::string named(const Place& place) { return fmt::format("{} '{}'", place.word, written(place.to)); }

std::string said(const Place& place) {
    const bool is_body = std::string_view(place.word) == kind_of<Body>.word;
    const char* const natures[]{"whose state is given", "whose state follows from the balance", "whose state is stored"};
    const char* const nature = place.is_family && place.rank != Rank::stores ? "one of a family, which cannot go alone"
                               : is_body && place.rank == Rank::stores       ? "which has a mass or a place of its own"
                               : is_body                                     ? "which is the ground"
                                                                             : natures[static_cast<std::size_t>(place.rank)];
    return fmt::format("{}, {}", named(place), nature);
}

}  // namespace dalembert
