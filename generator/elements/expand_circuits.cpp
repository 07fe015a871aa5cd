// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "elements/circuits.hpp"
#include "elements/element.hpp"
#include "elements/every_kind.hpp"
#include "elements/expand_switching.hpp"
#include "elements/names.hpp"

namespace dalembert {

namespace {

/// Its current ends at zero, and its voltage begins at that of the diode.
void expand_diode(Model& model, const Branch& diode) {
    Element made(model, diode);
    made.modes({"blocks", "conducts"});
    const ExpressionPtr voltage = made.own("voltage");
    made.event("begins", "blocks", diode.forward_voltage ? minus(diode.forward_voltage, voltage) : negative(voltage), {"conducts"});
    made.event("ends", "conducts", made.own("current"), {"blocks"});
}

/// Whether an expression may jump, or rest at a value: what inputs, modes and patterns of the time are made of.
bool may_jump(const Expression& e, const Model& model, std::set<std::string>& followed) {
    static const std::set<std::string, std::less<>> jumping{"mod", "step", "pulse", "sign", "if"};
    bool result = false;
    for_each(e, [&](const Expression& part) {
        if (part.kind == Expression::Kind::call && jumping.contains(part.name)) result = true;
        if (part.kind != Expression::Kind::name || !followed.insert(part.name).second) return;
        const auto is_it = [&](const auto& item) { return item.name == part.name; };
        result = result || std::any_of(model.inputs.begin(), model.inputs.end(), is_it) ||
                 std::any_of(model.modes.begin(), model.modes.end(),
                             [&](const ModeGroup& group) { return std::any_of(group.modes.begin(), group.modes.end(), is_it); });
        const auto definition = std::find_if(model.definitions.begin(), model.definitions.end(), is_it);
        if (definition != model.definitions.end() && definition->value)
            result = result || may_jump(*definition->value, model, followed);
    });
    return result;
}

/// A single comparison of smooth quantities becomes the difference of its two sides: a guard with a derivative. Others stay as they are.
ExpressionPtr guard_of(const Model& model, const ExpressionPtr& closed) {
    std::set<std::string> followed;
    const bool is_one = closed->children[1]->kind == Expression::Kind::number && closed->children[2]->kind == Expression::Kind::number;
    if (!is_one || may_jump(*closed->children[0], model, followed)) return closed;
    return closed->children[1]->value == 1 ? closed->children[0] : negative(closed->children[0]);
}

void expand_switch(Model& model, const Branch& branch) {
    if (!branch.closed) return;  // reported where it was read
    const ExpressionPtr guard = guard_of(model, branch.closed);
    Element made(model, branch);
    made.modes({"open", "closed"});
    made.event("closes", "open", guard, {"closed"}).rises = true;
    made.event("opens", "closed", guard, {"open"});
}

}  // namespace

void expand_circuits(Model& model) {
    for (const Branch& branch : model.branches)
        if (branch.has_modes()) (branch.law == Branch::Law::diode ? expand_diode : expand_switch)(model, branch);
    name_pins(model);
}

void name_pins(Model& model) {
    const Names names(model);
    std::vector<Pin> found;
    const auto is_known = [&](const std::string& name) {
        const auto& others = names.elements(name);
        // What has another meaning is reported where references are checked.
        return std::any_of(others.begin(), others.end(), [](const OfKind& one) { return one.kind->facts.naming == Naming::parts; }) ||
               std::any_of(found.begin(), found.end(), [&](const Pin& pin) { return pin.name == name; });
    };
    for (const Branch& branch : model.branches)
        for (const Reference* end : {&branch.from, &branch.to, branch.second_from ? &*branch.second_from : nullptr,
                                     branch.second_to ? &*branch.second_to : nullptr}) {
            if (end == nullptr || end->name.empty() || end->index || is_known(end->name)) continue;
            Pin& pin = found.emplace_back();
            pin.name = end->name;
            pin.span = end->span;
        }
    model.pins.insert(model.pins.end(), found.begin(), found.end());
}

void open_pins_at_ports(Model& model) {
    for (const Port& port : model.ports)
        for (Pin& pin : model.pins)
            if (port.kind == Port::Kind::pin && port.at && port.at->name == pin.name) pin.open_port = port.span;
}

}  // namespace dalembert
