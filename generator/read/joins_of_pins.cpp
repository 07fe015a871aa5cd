// SPDX-License-Identifier: GPL-3.0-or-later
// Joins of pins: two pins become one, with one potential, so that the circuits of both sides are one circuit.
#include "check/checks.hpp"
#include "elements/circuits.hpp"
#include "elements/names.hpp"
#include "read/join_work.hpp"

namespace dalembert {

/// "battery.minus" is the pin at which that port stands, unless something else in the part has this name.
void Joins::name_pins_by_ports() {
    for (const PartPort& port : ports_)
        if (port.port.kind == Port::Kind::pin)
            std::erase_if(model_.pins, [&](const Pin& pin) {  // because a branch of this model names the port
                return pin.name == port.port.name && pin.span.source == model_.source;
            });
    const Names names(model_);
    for (const PartPort& port : ports_) {
        const auto& others = names.elements(port.port.name);
        if (port.port.kind == Port::Kind::pin && std::none_of(others.begin(), others.end(), [](const OfKind& one) {
                return one.kind->facts.naming == Naming::parts;
            }))
            everywhere_.elements.emplace(port.port.name, *port.port.at);
    }
}

void Joins::join_pins(PartPort& port, PartPort* other, const RunEntry& entry) {
    const Span& place = entry.value->span;
    const Reference mine = resolved(*port.port.at, Port::Kind::pin), theirs = joined_to(port, other, *entry.value);
    refuse_no_pin(port, theirs, *entry.value);
    for (const Reference* joined : {&mine, &theirs})
        if (Pin* pin = find(model_.pins, joined->name); pin != nullptr && !pin->family) pin->open_port = {};
    if (written(mine) == written(theirs)) return;
    // The lower one goes.
    enum { of_part, of_model, member, ground };
    const auto standing = [&](const Reference& pin) {
        return pin.name == ground_pin                                           ? ground
               : pin.index                                                      ? member
               : find(model_.pins, pin.name)->span.source == model_.source ? of_model
                                                                                : of_part;
    };
    if (standing(mine) >= member && standing(theirs) >= member)
        fail(Id::doubly_determined, place,
             fmt::format("port '{}' is pin '{}', and pin '{}' cannot take its place, because a member of a family stays; put a resistor "
                         "between them",
                         shown(port), written(mine), written(theirs)),
             declared(port));
    const bool mine_goes = standing(mine) <= standing(theirs);
    const Reference &going = mine_goes ? mine : theirs, &staying = mine_goes ? theirs : mine;
    tell(port, fmt::format("pin '{}' is '{}'", written(going), written(staying)));
    give_way(going, staying, Port::Kind::pin);
}

void Joins::refuse_no_pin(const PartPort& port, const Reference& to, const Expression& value) const {
    if (to.name == ground_pin && !to.index) return;
    const Pin* pin = find(model_.pins, to.name);
    if (pin == nullptr)
        fail(Id::unknown_name, value.span,
             fmt::format("there is no pin '{}', to which port '{}' could be joined; where no branch names it, list it in [pins]",
                         value.written(), shown(port)),
             declared(port));
    if (pin->family.has_value() != (to.index != nullptr))
        fail(pin->family ? Id::index_missing : Id::not_indexed, value.span,
             fmt::format("pin '{}' is {}", to.name, pin->family ? "a family and needs an index" : "not a family and has no index"),
             {{pin->span, "it is defined here"}});
}

/// A part whose ground is a port has none of its own in a machine.
void Joins::refuse_open_ground(const Use& use, const PartPort& port) const {
    const std::string& at = port.port.at->name;
    if (at != use.name + "_" + ground_pin || everywhere_.elements.contains(at)) return;
    const std::string name = port.port.name.substr(use.name.size() + 1);
    fail(Id::missing_key, use.span,
         fmt::format("pin '{0}' is open, so that the circuit of part '{1}' has no ground; join it in [use.{1}]: ports = {{ {2} = \"{3}\" "
                     "}}, or to another pin",
                     shown(port), use.name, name, ground_pin),
         declared(port));
}

/// Both ends of a branch at one pin, because of joins.
void Joins::refuse_short_circuits() {
    const auto check = [&](const Branch& branch, const Reference& from, const Reference& to) {
        const std::string pin = written(resolved(from, Port::Kind::pin));
        if (written(from) == written(to) || pin != written(resolved(to, Port::Kind::pin))) return;
        std::vector<const PartPort*> joined;
        std::vector<Note> notes{{branch.span, fmt::format("'{}' is defined here", branch.name)}};
        for (const PartPort& port : ports_)
            if (port.joined && port.port.at && (port.port.at->name == from.name || port.port.at->name == to.name)) joined.push_back(&port);
        for (const PartPort* port : joined)
            if (port != joined.front()) notes.push_back({port->joined, fmt::format("'{}' is joined here", shown(*port))});
        diagnostics_.error(Id::not_allowed_here, joined.empty() ? branch.span : joined.front()->joined,
                           fmt::format("branch '{}' is short-circuited: joined like this, pin '{}' is at both its ends", branch.name, pin),
                           std::move(notes));
    };
    for (const Branch& branch : model_.branches) {
        check(branch, branch.from, branch.to);
        if (branch.second_from && branch.second_to) check(branch, *branch.second_from, *branch.second_to);
    }
}

}  // namespace dalembert
