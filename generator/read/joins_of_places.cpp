// SPDX-License-Identifier: GPL-3.0-or-later
// Joins of fluids, heat and bodies: of two elements the weaker one goes.
#include "check/checks.hpp"
#include "elements/fluids.hpp"
#include "elements/heat.hpp"
#include "read/join_work.hpp"

namespace dalembert {

void Joins::join_places(PartPort& port, PartPort* other, const RunEntry& entry) {
    const Expression& value = *entry.value;
    const Port::Kind kind = port.port.kind;
    const Place mine = place_of(model_, resolved(*port.port.at, kind), kind);
    const Place theirs = place_of(model_, joined_to(port, other, value), kind);
    if (*theirs.word == '\0')
        fail(Id::unknown_name, value.span,
             fmt::format("there is no {} '{}', to which port '{}' could be joined", words_of(elements_at(kind, true)), value.written(),
                         shown(port)),
             declared(port));
    const auto medium = [&](const Place& place) {
        const auto found = everywhere_.elements.find(place.medium);
        return found == everywhere_.elements.end() ? place.medium : found->second.name;
    };
    if (kind == Port::Kind::fluid && medium(mine) != medium(theirs))
        fail(Id::wrong_medium, value.span,
             fmt::format(
                 "port '{}' carries medium '{}', but {} '{}' holds '{}'; say that they are the same, as in media = {{ oil = \"oil\" "
                 "}}, or join others",
                 shown(port), medium(mine), theirs.word, value.written(), medium(theirs)),
             declared(port));
    const bool is_part = other != nullptr;
    if (kind == Port::Kind::fluid && is_part && mine.is_of_part && theirs.is_of_part && mine.rank == Rank::given &&
        theirs.rank == Rank::given)
        fail(Id::missing_key, value.span,
             fmt::format(
                 "ports '{}' and '{}' both stand at a reservoir that is there for standing alone, so nothing is behind them; join "
                 "both to a volume, reservoir or junction of this file",
                 shown(port), shown(*other)),
             both_declared(port, *other));
    if (mine.is(theirs)) return;
    if (mine.can_go() && (!theirs.can_go() || mine.rank <= theirs.rank)) return replace(port, mine, theirs, kind);
    if (is_part && theirs.can_go()) return replace(*other, theirs, mine, kind);
    fail(Id::doubly_determined, value.span,
         fmt::format("port '{}' is {}, and '{}' is {}; neither can take the place of the other: {}", shown(port), said(mine),
                     value.written(), said(theirs),
                     kind == Port::Kind::fluid     ? "put an orifice or a pipe between them"
                     : kind == Port::Kind::thermal ? "put a link between them"
                                                   : "place one on the other with 'on', or hold them together by constraints"),
         declared(port));
}

Reference Joins::joined_to(const PartPort& port, const PartPort* other, const Expression& value) const {
    const Port::Kind kind = port.port.kind;
    if (value.kind != Expression::Kind::name || value.children.size() > 1)
        fail(Id::wrong_type, value.span,
             fmt::format("'{}' is not the name of {}, to which '{}' could be joined", value.written(),
                         with_article(words_of(elements_at(kind, true))), shown(port)));
    return resolved(other != nullptr ? *other->port.at
                                     : Reference{value.name, value.children.empty() ? nullptr : value.children[0], value.span},
                    kind);
}

Reference Joins::resolved(Reference to, Port::Kind kind) const {
    const auto found = everywhere_.elements.find(Renaming::key_of(to.name, kind == Port::Kind::point));
    return found == everywhere_.elements.end() ? to : found->second;
}

void Joins::replace(const PartPort& port, const Place& going, const Place& staying, Port::Kind kind) {
    if (kind == Port::Kind::thermal) hand_over_heat(port, going, staying);
    if (kind == Port::Kind::fluid) refuse_lost_potential(port, going, staying);
    give_way(going.to, staying.to, kind);
    tell(port, fmt::format("{} is {}", named(going), named(staying)));
}

void Joins::give_way(const Reference& going, const Reference& staying, Port::Kind kind) {
    const bool is_body = kind == Port::Kind::point;
    for (auto& [name, other] : everywhere_.elements)
        if (other.name == going.name && name.starts_with("body ") == is_body) other = staying;
    everywhere_.elements[Renaming::key_of(going.name, is_body)] = staying;
    gone_.push_back({elements_at(kind), going.name});
}

/// Heat from outside goes to where the node was.
void Joins::hand_over_heat(const PartPort& port, const Place& going, const Place& staying) {
    const HeatNode* node = find(model_.nodes, going.to.name);
    if (node == nullptr || !node->heat) return;
    const auto add = [&](ExpressionPtr& heat) { heat = heat ? make_binary(Expression::Kind::add, heat, node->heat) : node->heat; };
    HeatNode* to_node = find(model_.nodes, staying.to.name);
    Volume* to_volume = find(model_.volumes, staying.to.name);
    if (to_node != nullptr && !staying.is_family && !to_node->is_held()) return add(to_node->heat);
    if (to_volume != nullptr && !staying.is_family) return add(to_volume->heat);
    fail(Id::doubly_determined, node->heat->span,
         fmt::format("the heat of {} would be lost, because {} takes its place; let it enter another node of the part, with a link to "
                     "this one",
                     named(going), named(staying)),
         declared(port));
}

/// Flows from and to the place would miss its height.
void Joins::refuse_lost_potential(const PartPort& port, const Place& going, const Place& staying) const {
    const auto potential = [&](const Place& place) {
        ExpressionPtr found;
        const auto look = [&](const auto& items) {
            if (const auto* item = find(items, place.to.name)) found = item->potential;
        };
        look(model_.reservoirs);
        look(model_.junctions);
        look(model_.volumes);
        return found;
    };
    if (const ExpressionPtr lost = potential(going); lost && !potential(staying))
        fail(Id::missing_key, lost->span,
             fmt::format("the potential of {} would be lost, because {} takes its place and has none; give it one", named(going),
                         named(staying)),
             declared(port));
}

}  // namespace dalembert
