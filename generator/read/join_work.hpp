// SPDX-License-Identifier: GPL-3.0-or-later
// The work on the joins of one model: joins.cpp says what is joined to what, joins_of_motion.cpp, joins_of_places.cpp and
// joins_of_pins.cpp do it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"
#include "language/expression_text.hpp"
#include "read/joins.hpp"
#include "read/port_places.hpp"

namespace dalembert {

class Joins {
public:
    Joins(Model& model, std::vector<PartPort> ports, Renaming& everywhere, Diagnostics& diagnostics)
        : model_(model), ports_(std::move(ports)), everywhere_(everywhere), diagnostics_(diagnostics) {}

    void run(const std::vector<Use>& uses);

private:
    template <class Items>
    static auto find(Items& items, const std::string& name) {
        const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
        return found == items.end() ? nullptr : &*found;
    }

    template <class Do>
    void attempt(const Do& what) {
        try {
            what();
        } catch (const Failure& failure) {
            for (const Diagnostic& d : failure.diagnostics()) diagnostics_.error(d.id, d.span, d.message, d.notes);
        }
    }

    /// "left.rod"
    static std::string shown(const PartPort& port) { return port.part + "." + port.port.name.substr(port.part.size() + 1); }
    /// As this file writes it; of a port of a part, with names of this model.
    std::string shown(const Expression& value) const {
        return value.span.source == model_.source ? value.written() : in_model_language(value);
    }
    static std::vector<Note> declared(const PartPort& port) {
        return {{port.port.span, fmt::format("'{}' is declared here", shown(port))}};
    }
    static std::vector<Note> both_declared(const PartPort& one, const PartPort& other) {
        return {declared(one).front(), declared(other).front()};
    }

    void join(const Use& use, const RunEntry& entry);
    static void take(PartPort& port, const Span& where);
    void check_open(const Use& use, const PartPort& port);
    void join_signal(PartPort& port, PartPort* other, const RunEntry& entry);
    /// A name that had a value of its own gets that of an expression.
    void define(const Quantity& quantity, const ExpressionPtr& value, const Span& place);
    void remove(const std::vector<const char*>& kinds, const std::string& name);
    /// For the list of joined ports that "derive" prints.
    void tell(const PartPort& port, const std::string& what) {
        if (use_ != nullptr) use_->joins.push_back(fmt::format("{}: {}", shown(port), what));
    }

    // --- shafts and flanges ---
    struct Motion {
        ExpressionPtr place;
        Coordinate* coordinate = nullptr;  ///< that it is
        bool can_go = false;               ///< it is one of a part
    };
    Motion motion(ExpressionPtr place) const;
    Motion motion(const PartPort& port) const;
    void join_motion(PartPort& port, PartPort* other, const RunEntry& entry);
    void become_one(const PartPort& port, const Motion& going, const Motion& staying, const RunEntry& entry);
    void follow(const PartPort& port, const Motion& going, const Motion& staying, const RunEntry& entry);
    void constrain(const PartPort& port, const Motion& mine, const Motion& theirs, const RunEntry& entry);
    void refuse_lost_start(const PartPort& port, const Motion& going, const Motion& staying, const RunEntry& entry);
    void stand_for(const std::string& name, const ExpressionPtr& by);

    // --- fluids, heat and bodies ---
    void join_places(PartPort& port, PartPort* other, const RunEntry& entry);
    Reference resolved(Reference to, Port::Kind kind) const;
    /// The element of this model or of the other port that a value names. Throws Failure (wrong-type) where it is no name.
    Reference joined_to(const PartPort& port, const PartPort* other, const Expression& value) const;
    /// Of two elements of a kind one goes.
    void give_way(const Reference& going, const Reference& staying, Port::Kind kind);
    void replace(const PartPort& port, const Place& going, const Place& staying, Port::Kind kind);
    void hand_over_heat(const PartPort& port, const Place& going, const Place& staying);
    void refuse_lost_potential(const PartPort& port, const Place& going, const Place& staying) const;

    // --- pins ---
    void name_pins_by_ports();
    void join_pins(PartPort& port, PartPort* other, const RunEntry& entry);
    void refuse_no_pin(const PartPort& port, const Reference& to, const Expression& value) const;
    void refuse_open_ground(const Use& use, const PartPort& port) const;
    void refuse_short_circuits();

    Model& model_;
    std::vector<PartPort> ports_;
    Renaming& everywhere_;
    Diagnostics& diagnostics_;
    Use* use_ = nullptr;  ///< whose ports are being joined
    std::vector<std::pair<std::vector<const char*>, std::string>> gone_;
    std::multimap<std::string, Span> set_starts_;  ///< of coordinates, where [use] sets them
};

}  // namespace dalembert
