// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/joins.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/checks.hpp"
#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"
#include "read/port_places.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

const char* word_of(Port::Kind kind) {
    for (const auto& choice : port_kinds())
        if (choice.value == kind) return choice.word;
    return "";
}

template <class T>
const T* find(const std::vector<T>& items, const std::string& name) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const T& item) { return item.name == name; });
    return found == items.end() ? nullptr : &*found;
}

class Joins {
public:
    Joins(Model& model, std::vector<PartPort> ports, Renaming& everywhere, Diagnostics& diagnostics)
        : model_(model), ports_(std::move(ports)), everywhere_(everywhere), diagnostics_(diagnostics) {}

    void run(const std::vector<Use>& uses) {
        for (const Use& use : uses)
            for (const RunEntry& entry : use.ports) {
                use_ = find_use(use.name);
                attempt([&] { join(use, entry); });
            }
        for (const Use& use : uses)
            for (const PartPort& port : ports_)
                if (port.part == use.name && !port.joined) attempt([&] { check_open(use, port); });
        for (const auto& [kinds, name] : gone_) remove(kinds, name);
        for (const PartPort& port : ports_)  // what it gives may stand in expressions
            if (port.port.kind == Port::Kind::signal && port.port.value && port.port.value->name != port.port.name)
                everywhere_.values.emplace(port.port.name, port.port.value);
    }

private:
    template <class Do>
    void attempt(const Do& what) {
        try {
            what();
        } catch (const Failure& failure) {
            for (const Diagnostic& d : failure.diagnostics()) diagnostics_.error(d.id, d.span, d.message, d.notes);
        }
    }

    Use* find_use(const std::string& name) const { return const_cast<Use*>(find(model_.uses, name)); }
    static std::string shown(const PartPort& port) { return port.part + "." + port.port.name.substr(port.part.size() + 1); }
    static std::vector<Note> declared(const PartPort& port) {
        return {{port.port.span, fmt::format("'{}' is declared here", shown(port))}};
    }

    PartPort* find_port(const std::string& name) {
        const auto found = std::find_if(ports_.begin(), ports_.end(), [&](const PartPort& port) { return port.port.name == name; });
        return found == ports_.end() ? nullptr : &*found;
    }

    void join(const Use& use, const RunEntry& entry) {
        const std::string written = entry.variable->name;
        PartPort* port = entry.variable->kind == Kind::name ? find_port(use.name + "_" + written) : nullptr;
        if (port == nullptr || port->part != use.name) {
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
        PartPort* other = entry.value->kind == Kind::name && entry.value->children.empty() ? find_port(entry.value->name) : nullptr;
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
            default:
                join_places(*port, other, entry);
                break;
        }
        leave_out(*port);
        if (other != nullptr) leave_out(*other);
    }

    static std::vector<Note> both_declared(const PartPort& one, const PartPort& other) {
        std::vector<Note> notes = declared(one);
        notes.push_back(declared(other).front());
        return notes;
    }

    static void take(PartPort& port, const Span& where) {
        if (port.joined)
            fail(Id::doubly_defined, where,
                 fmt::format("port '{}' is joined twice; where more than two meet, join each of them to an element of this file",
                             shown(port)),
                 {{port.joined, "it is joined here already"}});
        port.joined = where;
    }

    /// What a port has for standing alone goes.
    void leave_out(const PartPort& port) {
        for (const auto& [name, span] : port.port.alone) gone_.push_back({{}, name});
    }

    void check_open(const Use& use, const PartPort& port) {
        if (port.port.kind != Port::Kind::fluid || place_of(model_, *port.port.at, port.port.kind).rank != Rank::given) return;
        fail(Id::missing_key, use.span,
             fmt::format("fluid port '{0}' is open, and nothing is behind it; join it in [use.{1}]: ports = {{ {2} = ... }}, to a volume, "
                         "reservoir or junction",
                         shown(port), use.name, port.port.name.substr(use.name.size() + 1)),
             declared(port));
    }

    // --- shafts and flanges ---

    struct Motion {
        ExpressionPtr place;
        const Coordinate* coordinate = nullptr;  ///< that it is
        bool can_go = false;                     ///< it is one of a part
    };

    Motion motion(ExpressionPtr place) const {
        Motion made{std::move(place)};
        if (made.place->kind == Kind::name && made.place->children.empty()) made.coordinate = find(model_.coordinates, made.place->name);
        made.can_go = made.coordinate != nullptr && is_of_part(*made.coordinate);
        return made;
    }
    Motion motion(const PartPort& port) const {
        return motion(port.port.coordinate ? make_name(port.port.coordinate->name, port.port.coordinate->span) : port.port.value);
    }
    bool is_of_part(const Item& item) const { return item.span.source != model_.source; }

    void join_motion(PartPort& port, PartPort* other, const RunEntry& entry) {
        const Motion mine = motion(port), theirs = other != nullptr ? motion(*other) : motion(entry.value);
        if (mine.coordinate != nullptr && theirs.coordinate != nullptr) {
            if (mine.coordinate == theirs.coordinate) return;
            if (mine.coordinate->unit.dimension != theirs.coordinate->unit.dimension)
                fail(Id::unit_mismatch, entry.value->span,
                     fmt::format("'{}' counts in {}, but '{}' in {}", shown(port), mine.coordinate->unit.written, entry.value->written(),
                                 theirs.coordinate->unit.written),
                     {{mine.coordinate->span, "that of the part is declared here"},
                      {theirs.coordinate->span, "the other one is declared here"}});
            if (mine.can_go && theirs.can_go) agree(*mine.coordinate, *theirs.coordinate, entry);
            if (mine.can_go) return become_one(port, mine, theirs);
            if (theirs.can_go) return become_one(port, theirs, mine);
        }
        if (mine.can_go && can_follow(mine)) return follow(port, mine, theirs, entry);
        if (theirs.can_go && other != nullptr && can_follow(theirs)) return follow(*other, theirs, mine, entry);
        constrain(port, mine, theirs, entry);
    }

    void become_one(const PartPort& port, const Motion& going, const Motion& staying) {
        const std::string name = going.coordinate->name, by = staying.coordinate->name;
        stand_for(name, make_name(by, staying.place->span));
        std::erase_if(model_.coordinates, [&](const Coordinate& item) { return item.name == name; });
        tell(port, fmt::format("coordinate '{}' is '{}'", name, by));
    }

    /// Only expressions name it.
    bool can_follow(const Motion& motion) const { return !is_named_as_coordinate(model_, motion.coordinate->name); }

    void follow(const PartPort& port, const Motion& going, const Motion& staying, const RunEntry& entry) {
        tell(port, fmt::format("coordinate '{}' is '{}'", going.coordinate->name, staying.place->written()));
        define(*going.coordinate, staying.place, entry.span);
        std::erase_if(model_.coordinates, [&, name = going.coordinate->name](const Coordinate& item) { return item.name == name; });
    }

    void define(const Quantity& quantity, const ExpressionPtr& value, const Span& place) {
        Definition definition;
        static_cast<Item&>(definition) = quantity;
        definition.span = place;
        definition.value = value;
        definition.unit = quantity.unit;
        model_.definitions.insert(model_.definitions.begin(), std::move(definition));
    }

    /// Of two parts neither start may count more than the other.
    static void agree(const Coordinate& one, const Coordinate& other, const RunEntry& entry) {
        const auto differ = [&](const ExpressionPtr& a, const ExpressionPtr& b, const char* what) {
            if (!a || !b || a->written() == b->written()) return;
            fail(Id::doubly_defined, entry.span,
                 fmt::format("'{}' and '{}' become one coordinate, but have different {}; join both to a coordinate of this file, or give "
                             "one of them the value of the other with 'start'",
                             one.name, other.name, what),
                 {{a->span, fmt::format("that of '{}' stands here", one.name)},
                  {b->span, fmt::format("that of '{}' stands here", other.name)}});
        };
        differ(one.start, other.start, "starts");
        differ(one.start_rate, other.start_rate, "velocities at the start");
    }

    void constrain(const PartPort& port, const Motion& mine, const Motion& theirs, const RunEntry& entry) {
        Constraint constraint;
        constraint.name = port.port.name;
        constraint.span = entry.span;
        constraint.doc = fmt::format("joins '{}'", shown(port));
        constraint.position = make_binary(Kind::subtract, mine.place, theirs.place);
        model_.constraints.push_back(std::move(constraint));
        tell(port, fmt::format("constraint '{0}' holds it there, because no coordinate can go; constraint_force[{0}] is its force",
                               port.port.name));
    }

    // --- signals ---

    void join_signal(PartPort& port, PartPort* other, const RunEntry& entry) {
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
        tell(*sink, fmt::format("input '{}' is '{}'", name, value->written()));
        define(*input, value, entry.span);
        std::erase_if(model_.inputs, [&](const Input& item) { return item.name == name; });
    }

    // --- fluids, heat and bodies ---

    void join_places(PartPort& port, PartPort* other, const RunEntry& entry) {
        const Expression& value = *entry.value;
        const Port::Kind kind = port.port.kind;
        if (value.kind != Kind::name || value.children.size() > 1)
            fail(Id::wrong_type, value.span,
                 fmt::format("'{}' is not the name of {}, to which '{}' could be joined", value.written(),
                             with_article(words_of(elements_at(kind, true))), shown(port)));
        const Place mine = place_of(model_, resolved(*port.port.at, kind), kind);
        const Place theirs =
            place_of(model_,
                     resolved(other != nullptr ? *other->port.at
                                               : Reference{value.name, value.children.empty() ? nullptr : value.children[0], value.span},
                              kind),
                     kind);
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
        if (mine.to.name == theirs.to.name) return;
        if (mine.can_go() && (!theirs.can_go() || mine.rank <= theirs.rank)) return replace(port, mine, theirs, kind);
        if (is_part && theirs.can_go()) return replace(*other, theirs, mine, kind);
        fail(Id::doubly_determined, value.span,
             fmt::format("port '{}' is {}, and '{}' is {}; nothing can take the place of the other: put {} between them", shown(port),
                         said(mine), value.written(), said(theirs),
                         kind == Port::Kind::fluid     ? "an orifice or a pipe"
                         : kind == Port::Kind::thermal ? "a link"
                                                       : "a constraint"),
             declared(port));
    }

    Reference resolved(Reference to, Port::Kind kind) const {
        const auto found = everywhere_.elements.find(Renaming::key_of(to.name, kind == Port::Kind::point));
        return found == everywhere_.elements.end() ? to : found->second;
    }

    void replace(const PartPort& port, const Place& going, const Place& staying, Port::Kind kind) {
        const bool is_body = kind == Port::Kind::point;
        for (auto& [name, other] : everywhere_.elements)
            if (other.name == going.to.name && name.starts_with("body ") == is_body) other = staying.to;
        everywhere_.elements[Renaming::key_of(going.to.name, is_body)] = staying.to;
        gone_.push_back({elements_at(kind), going.to.name});
        tell(port, fmt::format("{} '{}' is {} '{}'", going.word, going.to.name, staying.word, staying.to.name));
    }

    // --- what follows ---

    /// Also of what stands for a name that goes now.
    void stand_for(const std::string& name, const ExpressionPtr& by) {
        Renaming now;
        now.values[name] = by;
        for (auto& [other, value] : everywhere_.values) value = renamed(value, now);
        everywhere_.values[name] = by;
        for (PartPort& port : ports_)
            if (port.port.coordinate && port.port.coordinate->name == name) port.port.coordinate->name = by->name;
    }

    void tell(const PartPort& port, const std::string& what) {
        if (use_ != nullptr) use_->joins.push_back(fmt::format("{}: {}", shown(port), what));
    }

    void remove(const std::vector<const char*>& kinds, const std::string& name) {
        for_each_kind(model_, [&]<class Items>(const char*, Items& items) {
            if constexpr (requires { items.begin()->name; })
                if (kinds.empty() ||
                    std::find(kinds.begin(), kinds.end(), std::string_view(kind_of<typename Items::value_type>.word)) != kinds.end())
                    std::erase_if(items, [&](const auto& item) { return item.name == name; });
        });
    }

    Model& model_;
    std::vector<PartPort> ports_;
    Renaming& everywhere_;
    Diagnostics& diagnostics_;
    Use* use_ = nullptr;
    std::vector<std::pair<std::vector<const char*>, std::string>> gone_;
};

}  // namespace

void join_ports(Model& model, const std::vector<Use>& uses, std::vector<PartPort> ports, Renaming& everywhere, Diagnostics& diagnostics) {
    Joins(model, std::move(ports), everywhere, diagnostics).run(uses);
}

}  // namespace dalembert
