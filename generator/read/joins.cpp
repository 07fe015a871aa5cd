// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/joins.hpp"

#include "check/checks.hpp"
#include "read/join_work.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

const char* word_of(Port::Kind kind) {
    for (const auto& choice : port_kinds())
        if (choice.value == kind) return choice.word;
    return "";
}

}  // namespace

void Joins::run(const std::vector<Use>& uses) {
    for (const Use& use : uses)
        for (const RunEntry& entry : use.start) {
            const Expression& variable = entry.variable->kind == Kind::call ? *entry.variable->children[0] : *entry.variable;
            set_starts_.emplace(use.name + "_" + variable.name, entry.span);
        }
    name_pins_by_ports();
    for (const Use& use : uses)
        for (const RunEntry& entry : use.ports) {
            use_ = find(model_.uses, use.name);
            attempt([&] { join(use, entry); });
        }
    for (const Use& use : uses)
        for (const PartPort& port : ports_)
            if (port.part == use.name && !port.joined) attempt([&] { check_open(use, port); });
    for (const auto& [kinds, name] : gone_) remove(kinds, name);
    refuse_short_circuits();
    for (const PartPort& port : ports_)  // what it gives may stand in expressions
        if (port.port.kind == Port::Kind::signal && port.port.value && port.port.value->name != port.port.name)
            everywhere_.values.emplace(port.port.name, port.port.value);
}

void Joins::join(const Use& use, const RunEntry& entry) {
    const std::string written = entry.variable->name, full = use.name + "_" + written;
    const auto own = std::find_if(ports_.begin(), ports_.end(),
                                  [&](const PartPort& each) { return each.part == use.name && each.port.name == full; });
    PartPort* const port = entry.variable->kind == Kind::name && own != ports_.end() ? &*own : nullptr;
    if (port == nullptr) {
        std::vector<std::string> known;
        for (const PartPort& other : ports_)
            if (other.part == use.name) known.push_back(other.port.name.substr(use.name.size() + 1));
        fail(Id::unknown_name, entry.span,
             fmt::format("part '{}' has no port '{}'{}", use.name, entry.variable->written(),
                         known.empty()                          ? "; its file has no [ports]"
                         : did_you_mean(written, known).empty() ? "; its ports are " + quoted_list(known)
                                                                : did_you_mean(written, known)),
             {{use.file_span, "its file is named here"}});
    }
    const bool is_name = entry.value->is_name();
    const auto found = std::find_if(ports_.begin(), ports_.end(),
                                    [&](const PartPort& each) { return is_name && each.port.name == entry.value->name; });
    PartPort* const other = found != ports_.end() ? &*found : nullptr;
    take(*port, entry.span);
    if (other != nullptr) {
        take(*other, entry.value->span);
        if (port->port.kind != other->port.kind)
            fail(Id::wrong_type, entry.value->span,
                 fmt::format("'{}' is a {} and '{}' a {}; ports of one kind can be joined", shown(*port), word_of(port->port.kind),
                             shown(*other), word_of(other->port.kind)),
                 both_declared(*port, *other));
    }
    switch (port->port.kind) {
        case Port::Kind::shaft:
        case Port::Kind::flange:
            join_motion(*port, other, entry);
            break;
        case Port::Kind::signal:
            join_signal(*port, other, entry);
            break;
        case Port::Kind::pin:
            join_pins(*port, other, entry);
            break;
        default:
            join_places(*port, other, entry);
            break;
    }
    for (const PartPort* joined : {port, other})
        if (joined != nullptr)
            for (const auto& [name, span] : joined->port.alone) gone_.push_back({{}, name});
}

void Joins::take(PartPort& port, const Span& where) {
    if (port.joined)
        fail(Id::doubly_defined, where,
             fmt::format("port '{}' is joined twice; where more than two meet, join each of them to an element of this file",
                         shown(port)),
             {{port.joined, "it is joined here already"}});
    port.joined = where;
}

void Joins::check_open(const Use& use, const PartPort& port) {
    if (port.port.kind == Port::Kind::pin) return refuse_open_ground(use, port);
    if (port.port.kind != Port::Kind::fluid || place_of(model_, *port.port.at, port.port.kind).rank != Rank::given) return;
    if (everywhere_.elements.contains(port.port.at->name)) return;  // another port at the same place is joined
    fail(Id::missing_key, use.span,
         fmt::format("fluid port '{0}' is open, and nothing is behind it; join it in [use.{1}]: ports = {{ {2} = ... }}, to a volume, "
                     "reservoir or junction",
                     shown(port), use.name, port.port.name.substr(use.name.size() + 1)),
         declared(port));
}

void Joins::join_signal(PartPort& port, PartPort* other, const RunEntry& entry) {
    PartPort* sink = port.port.input ? &port : other != nullptr && other->port.input ? other : nullptr;
    PartPort* source = sink == &port ? other : &port;
    if (sink == nullptr)
        fail(Id::wrong_type, entry.span,
             other == nullptr ? fmt::format("port '{}' gives a value and takes none; use it at the place that needs it", shown(port))
                              : fmt::format("'{}' and '{}' both give a value; one of the two must take it", shown(port), shown(*other)),
             other == nullptr ? declared(port) : both_declared(port, *other));
    if (source != nullptr && source->port.input)
        fail(Id::wrong_type, entry.span,
             fmt::format("'{}' and '{}' both take a value; join each of them to an expression or input of this file", shown(port),
                         shown(*other)),
             both_declared(port, *other));
    const std::string name = sink->port.input->name;
    const Input* input = find(model_.inputs, name);
    if (input == nullptr) fail(Id::unknown_name, entry.span, fmt::format("input '{}' has its value from another port already", name));
    const ExpressionPtr value = source == nullptr ? entry.value : source->port.value;
    tell(*sink, fmt::format("input '{}' is '{}'", name, shown(*value)));
    define(*input, value, entry.span);
    std::erase_if(model_.inputs, [&](const Input& item) { return item.name == name; });
}

void Joins::define(const Quantity& quantity, const ExpressionPtr& value, const Span& place) {
    Definition definition;
    static_cast<Item&>(definition) = quantity;
    definition.span = place;
    definition.value = value;
    definition.unit = quantity.unit;
    model_.definitions.insert(model_.definitions.begin(), std::move(definition));
}

void Joins::remove(const std::vector<const char*>& kinds, const std::string& name) {
    for_each_kind(model_, [&]<class Items>(const char*, Items& items) {
        if constexpr (requires { items.begin()->name; })
            if (kinds.empty() ||
                std::find(kinds.begin(), kinds.end(), std::string_view(kind_of<typename Items::value_type>.word)) != kinds.end())
                std::erase_if(items, [&](const auto& item) { return item.name == name; });
    });
}

void join_ports(Model& model, const std::vector<Use>& uses, std::vector<PartPort> ports, Renaming& everywhere, Diagnostics& diagnostics) {
    Joins(model, std::move(ports), everywhere, diagnostics).run(uses);
}

}  // namespace dalembert
