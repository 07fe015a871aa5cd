// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "check/checks.hpp"
#include "check/written_values.hpp"
#include "elements/every_kind.hpp"
#include "elements/expand_switching.hpp"
#include "elements/kinds.hpp"
#include "elements/rename.hpp"
#include "elements/sites.hpp"
#include "read/joins.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

using NameSet = std::set<std::string, std::less<>>;

/// Names of a part without the name of the part.
template <class Items>
std::vector<std::string> names_within(const Items& items, const std::string& prefix) {
    std::vector<std::string> names;
    for (const auto& item : items)
        if (item.name.starts_with(prefix)) names.push_back(item.name.substr(prefix.size()));
    return names;
}

template <class T>
T* find(std::vector<T>& items, const std::string& name) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const T& item) { return item.name == name; });
    return found == items.end() ? nullptr : &*found;
}

/// Sets what [use] sets in one part, whose names are those of the model already.
class Setter {
public:
    /// `units` are those of all parameters of the model.
    Setter(const Use& use, Part& part, const std::map<std::string, Unit>& units, Renaming& everywhere, Diagnostics& diagnostics)
        : use_(use), part_(part), prefix_(use.name + "_"), units_(units), everywhere_(everywhere), diagnostics_(diagnostics) {}

    void run() {
        for (const RunEntry& entry : use_.parameters) parameter(entry);
        for (const RunEntry& entry : use_.sizes) size(entry);
        for (const RunEntry& entry : use_.start) start(entry);
        for (const RunEntry& entry : use_.media)
            if (const auto name = other(entry, "medium"); name && named(entry, part_.model.media, "medium")) {
                everywhere_.elements[full(entry)] = {*name, nullptr, entry.value->span};
                remove(part_.model.media, full(entry));
            }
        for (const RunEntry& entry : use_.effects)
            if (const auto name = other(entry, "effect"); name && named(entry, part_.model.effects, "effect")) {
                everywhere_.effects[full(entry)] = *name;
                remove(part_.model.effects, full(entry));
            }
    }

private:
    using Kind = Expression::Kind;

    std::string full(const RunEntry& entry) const { return prefix_ + entry.variable->name; }

    template <class T>
    static void remove(std::vector<T>& items, const std::string& name) {
        std::erase_if(items, [&](const T& item) { return item.name == name; });
    }

    template <class T>
    T* named(const RunEntry& entry, std::vector<T>& items, const char* word) {
        T* found = entry.variable->is_name() ? find(items, full(entry)) : nullptr;
        if (found == nullptr)
            diagnostics_.error(Id::unknown_name, entry.span,
                               fmt::format("part '{}' has no {} '{}'{}", use_.name, word, entry.variable->written(),
                                           did_you_mean(entry.variable->written(), names_within(items, prefix_))),
                               {{use_.file_span, "its file is named here"}});
        return found;
    }

    std::optional<std::string> other(const RunEntry& entry, const char* word) {
        if (entry.value->is_name()) return entry.value->name;
        diagnostics_.error(Id::wrong_type, entry.value->span,
                           fmt::format("'{}' is not the name of {}", entry.value->written(), with_article(word)));
        return std::nullopt;
    }

    static ExpressionPtr in_unit(const ExpressionPtr& value, const Unit& unit) {
        return is_plain_number(*value) ? to_si(value, unit) : value;
    }

    void parameter(const RunEntry& entry) {
        Parameter* parameter = named(entry, part_.model.parameters, "parameter");
        if (parameter == nullptr) return;
        if (!has_names(*entry.value)) {
            parameter->values = {in_unit(entry.value, parameter->unit)};
            return;
        }
        const bool is_name = entry.value->is_name() && !parameter->family;
        if (const auto other = is_name ? units_.find(entry.value->name) : units_.end();
            other != units_.end() && other->second.dimension == parameter->unit.dimension) {
            everywhere_.values[full(entry)] = entry.value;
        } else {
            Definition definition;
            static_cast<Item&>(definition) = *parameter;
            definition.span = entry.span;
            definition.value = entry.value;
            definition.unit = parameter->unit;
            part_.model.definitions.push_back(std::move(definition));
        }
        remove(part_.model.parameters, full(entry));
    }

    void size(const RunEntry& entry) {
        if (named(entry, part_.model.sizes, "size") == nullptr) return;
        everywhere_.values[full(entry)] = entry.value;
        remove(part_.model.sizes, full(entry));
    }

    void start(const RunEntry& entry) {
        const Expression& variable = *entry.variable;
        const bool is_rate = variable.kind == Kind::call && variable.name == "dot" && variable.children.size() == 1;
        const Expression& whose = is_rate ? *variable.children[0] : variable;
        const std::string& name = whose.name;
        if (whose.kind == Kind::name && !whose.children.empty()) {
            diagnostics_.error(Id::not_allowed_here, entry.span,
                               fmt::format("'{}' is one member of a family; a start is set for all of them, as in start = {{ {} = 0 }}",
                                           whose.written(), is_rate ? fmt::format("\"dot({})\"", name) : name));
            return;
        }
        if (Coordinate* coordinate = find(part_.model.coordinates, prefix_ + name)) {
            Unit unit = coordinate->unit;
            if (is_rate) unit.offset = 0;
            (is_rate ? coordinate->start_rate : coordinate->start) = in_unit(entry.value, unit);
            if (!is_rate) coordinate->guess.clear();
            return;
        }
        if (State* state = is_rate ? nullptr : find(part_.model.states, prefix_ + name)) {
            state->start = in_unit(entry.value, state->unit);
            return;
        }
        std::vector<std::string> known = names_within(part_.model.coordinates, prefix_);
        for (const std::string& more : names_within(part_.model.states, prefix_)) known.push_back(more);
        diagnostics_.error(Id::unknown_name, entry.span,
                           fmt::format("part '{}' has no coordinate or state '{}'{}", use_.name, name, did_you_mean(name, known)),
                           {{use_.file_span, "its file is named here"}});
    }

    const Use& use_;
    Part& part_;
    std::string prefix_;
    const std::map<std::string, Unit>& units_;
    Renaming& everywhere_;
    Diagnostics& diagnostics_;
};

/// All pins of a part that has its ground as a port, so that it can stand elsewhere. Of others the ground is that of the model.
std::optional<NameSet> pins_of_own_ground(Model& part) {
    const auto is_at_ground = [](const Port& port) { return port.kind == Port::Kind::pin && port.at && port.at->name == ground_pin; };
    if (std::none_of(part.ports.begin(), part.ports.end(), is_at_ground)) {
        std::erase_if(part.pins, [](const Pin& pin) { return pin.name == ground_pin; });
        return std::nullopt;
    }
    NameSet pins;
    for (const Pin& pin : part.pins) pins.insert(pin.name);
    return pins;
}

/// What counts only where the part stands alone.
void leave_out_what_stands_alone(Model& part) {
    part.gravity.reset();
    part.view.reset();
    part.scenes.clear();
    part.printed.clear();
    part.runs.clear();
    part.measurements.clear();
    for (Use& use : part.uses) use.joins.clear();
}

/// What takes the place of a thing of a part must be there, and not be replaced itself.
template <class Items>
void check_targets(const std::vector<RunEntry>& entries, const Items& items, const char* word, Diagnostics& diagnostics) {
    for (const RunEntry& entry : entries) {
        const std::vector<std::string> known = names_within(items, "");
        if (std::find(known.begin(), known.end(), entry.value->name) == known.end())
            diagnostics.error(Id::unknown_name, entry.value->span,
                              fmt::format("this model has no {} '{}'{}", word, entry.value->written(),
                                          did_you_mean(entry.value->name, known)));
    }
}

/// Parts first, in their order.
void merge(Model& model, std::vector<Part>& parts) {
    for (auto part = parts.rbegin(); part != parts.rend(); ++part)
        for_each_common_kind(part->model, model, []<class Items>(Items& of_part, Items& items) {
            if constexpr (requires { items.begin(); })
                items.insert(items.begin(), std::make_move_iterator(of_part.begin()), std::make_move_iterator(of_part.end()));
        });
}

void add_names_in_expressions(const Model& model, NameSet& names) {
    visit(model, [&](const Site& site) {
        for_each(*site.expression, [&](const Expression& e) {
            if (e.kind == Expression::Kind::name || e.kind == Expression::Kind::call) names.insert(e.name);
        });
    });
}

/// What formulas of the model itself may name.
NameSet names_in_formulas(const Model& model) {
    NameSet names;
    for_each_kind(model, [&]<class Items>(const char*, const Items& items) {
        using Element = typename Items::value_type;
        if constexpr (std::derived_from<Element, Item>)
            if (kind_of<Element>.facts.naming == Naming::formulas)
                for (const Element& item : items) names.insert(item.name);
    });
    return names;
}

/// What stands for a name may be made of names for which something stands.
void resolve(Renaming& renaming) {
    const auto has_more = [&](const Expression& value) {
        bool found = false;
        for_each(value, [&](const Expression& e) {
            found = found || (e.kind == Expression::Kind::name && e.children.empty() && renaming.values.contains(e.name));
        });
        return found;
    };
    for (auto& [name, value] : renaming.values)
        for (std::size_t rounds = 0; has_more(*value); ++rounds) {
            if (rounds > renaming.values.size())
                fail(Id::cyclic_definition, value->span, fmt::format("what stands for '{}' needs '{}' itself", name, name));
            value = renamed(value, renaming);
        }
    for (auto& [name, other] : renaming.elements)
        if (other.index) other.index = renamed(other.index, renaming);
}

/// What only things needed that are there no more: parameters of a medium that another one replaces, say.
void leave_out_unneeded(Model& model, const NameSet& needed) {
    for (bool is_whole = false; !is_whole;) {
        NameSet now;
        add_names_in_expressions(model, now);
        is_whole = true;
        const auto leave_out = [&]<class T>(std::vector<T>& items) {
            is_whole = std::erase_if(items,
                                     [&](const T& item) {
                                         return item.span.source != model.source && needed.contains(item.name) && !now.contains(item.name);
                                     }) == 0 &&
                       is_whole;
        };
        leave_out(model.parameters);
        leave_out(model.definitions);
        leave_out(model.inputs);
        leave_out(model.curves);
    }
}

}  // namespace

void join_parts(Model& model, std::vector<Part> parts, Diagnostics& diagnostics) {
    const NameSet taken = names_in_formulas(model);
    Renaming everywhere;
    std::vector<PartPort> ports;
    NameSet needed;
    for (Part& part : parts) {
        const Use& use = *find(model.uses, part.name);
        if (part.model.gravity && !model.gravity)
            diagnostics.error(
                Id::missing_key, use.span,
                fmt::format("part '{}' has gravity where it stands alone, but this model has no [gravity]; say what acts here, "
                            "with [0, 0, 0] for none",
                            part.name),
                {{part.model.gravity->span, "that of the part stands here"}});
        rename(part.model, {part.name + "_", part.formulas, {}, {}, {}, taken, pins_of_own_ground(part.model)});
        add_names_in_expressions(part.model, needed);
        leave_out_what_stands_alone(part.model);
        for (Port& port : part.model.ports) ports.push_back({part.name, std::move(port)});
        part.model.ports.clear();
    }
    std::map<std::string, Unit> units;
    for (const Parameter& parameter : model.parameters) units[parameter.name] = parameter.unit;
    for (const Part& part : parts)
        for (const Parameter& parameter : part.model.parameters) units[parameter.name] = parameter.unit;
    for (Part& part : parts) Setter(*find(model.uses, part.name), part, units, everywhere, diagnostics).run();
    const std::vector<Use> uses = model.uses;
    diagnostics.stop_on_errors();
    merge(model, parts);
    name_pins(model);
    for (const Use& use : uses) {
        check_targets(use.media, model.media, "medium", diagnostics);
        check_targets(use.effects, model.effects, "effect", diagnostics);
    }
    diagnostics.stop_on_errors();
    join_ports(model, uses, std::move(ports), everywhere, diagnostics);
    diagnostics.stop_on_errors();
    resolve(everywhere);
    rename(model, everywhere);
    leave_out_unneeded(model, needed);
}

}  // namespace dalembert
