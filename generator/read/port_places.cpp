// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/port_places.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"

namespace dalembert {

namespace {

bool weighs_nothing(const ExpressionPtr& e) { return !e || (e->kind == Expression::Kind::number && zerop(e->value)); }

Rank rank_of(const Reservoir&) { return Rank::given; }
Rank rank_of(const Junction&) { return Rank::follows; }
Rank rank_of(const HeatNode& node) { return node.is_held() ? Rank::given : node.capacity ? Rank::stores : Rank::follows; }
Rank rank_of(const Body& body) {
    const bool is_place = weighs_nothing(body.mass) && weighs_nothing(body.inertia) && body.tensor.empty() && !body.solid;
    return is_place ? Rank::given : Rank::stores;
}

}  // namespace

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
            }
        }
    });
    return place;
}

std::string said(const Place& place) {
    const char* const nature[]{"is given", "follows from the balance", "is stored"};
    return fmt::format("{} '{}', whose state {}", place.word, place.to.name, nature[static_cast<std::size_t>(place.rank)]);
}

}  // namespace dalembert
