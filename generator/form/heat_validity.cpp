// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/heat_validity.hpp"

#include <fmt/format.h>

#include <set>

#include "elements/conduction.hpp"
#include "elements/heat.hpp"
#include "elements/model.hpp"
#include "form/signs.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

class HeatValues {
public:
    HeatValues(const System& system, const Values& values, ValueConditions* conditions)
        : system_(system), value_(system, values, conditions) {}

    void run() const {
        for (const auto& member : system_.scene.rods) check(*member.item);
        for (const auto& member : system_.scene.blocks) check_signs(*member.item, member.name(), {}, system_, value_);
        check_radiation();
        for (const NodeState& node : system_.heat.nodes) {
            if (node.kind == NodeState::Kind::storing)
                above_zero(node.capacity, place_of_capacity(node), fmt::format("the heat capacity of '{}'", node.name), "J/K");
            if (node.kind != NodeState::Kind::sought)
                above_zero(node.warmth.temperature, node.place, fmt::format("the temperature of '{}'", node.name), "K");
        }
        for (const auto& member : system_.scene.links)
            check_signs(*member.item, member.name(), Translator::indices_of(member), system_, value_, temperatures(member.name()));
    }

private:
    /// What radiates is above absolute zero, also where its temperature follows from the others.
    void check_radiation() const {
        std::set<const NodeState*> checked;
        const auto check = [&](const NodeState& node) {
            if (checked.insert(&node).second)
                above_zero(node.warmth.temperature, node.place, fmt::format("the temperature of '{}', which radiates,", node.name), "K");
        };
        for (const NodeState& node : system_.heat.nodes)
            if (node.radiates) check(node);
        for (const LinkState& link : system_.heat.links)
            for (const LinkEnd& end : {link.from, link.to})
                if (link.radiates && end.node != nullptr) check(*end.node);
    }

    /// What moves with inputs or the time has no value before a run.
    bool moves(const ex& e) const { return value_.depends_on_input(e) || e.has(system_.symbols.time()); }

    void above_zero(const ex& e, const Span& place, const std::string& what, const char* unit) const {
        if (!moves(e)) value_.positive(e, place, what, unit);
        else value_.check_curves(dalembert::above_zero(unit), e, place, what);
    }

    /// Between which the temperatures of a rod go: those of its cells and ends. A surface lies between its cell and its surroundings, if no
    /// flux heats it.
    Bounds temperatures(const Rod& rod) const {
        if (!has_curves_) return {};
        std::optional<Bounds> all;
        const auto add = [&](const Bounds& one) { all = all ? around(*all, one) : one; };
        for (const NodeState& node : system_.heat.nodes)
            if (node.item == &rod && node.kind != NodeState::Kind::sought) add(value_.bounds(node.warmth.temperature));
        for (const auto& end : {rod.first, rod.last})
            if (end && end->ambient) add(end->flux ? Bounds{} : value_.bounds(system_.translate(end->ambient, {})));
        return all.value_or(Bounds{});
    }

    /// Between which the temperatures of the ends of a link go; one that follows from others may be any.
    Bounds temperatures(const std::string& link) const {
        const auto at = [&](const LinkEnd& end) {
            if (end.node == nullptr) return value_.bounds(*(end.volume != nullptr ? end.volume->fluid : end.reservoir->fluid).temperature);
            return end.node->kind == NodeState::Kind::sought ? Bounds{} : value_.bounds(end.node->warmth.temperature);
        };
        for (const LinkState& one : system_.heat.links)
            if (has_curves_ && one.name == link) return around(at(one.from), at(one.to));
        return {};
    }

    Span place_of_capacity(const NodeState& node) const {
        for (const auto& member : system_.scene.nodes)
            if (member.item == node.item) return member.item->capacity->span;
        for (const auto& member : system_.scene.rods)
            if (member.item == node.item) return member.item->heat_capacity->body->span;
        return node.place;
    }

    void check(const Rod& rod) const {
        check_signs(rod, rod.name, {}, system_, value_, temperatures(rod));
        if (rod.inner)
            above_zero(system_.translate(rod.outer, {}) - system_.translate(rod.inner, {}), rod.outer->span,
                       fmt::format("the difference between outer and inner radius of rod '{}'", rod.name), "m");
        if (!rod.grid) return;
        // At its ends and in steps between them; what folds back in between shows in the capacities of cells.
        constexpr int steps = 64;
        const auto place = [&](int i) { return system_.translate(*rod.grid->body, {}, {{rod.grid->variable, numeric(i, steps)}}); };
        ValueCondition rising{ValueCondition::Rule::rising,
                              {},
                              fmt::format("the grid of rod '{}' must rise from 0 at s = 0 to 1 at s = 1, but '{}' does not", rod.name,
                                          rod.grid->body->written())};
        for (int i = 0; i <= steps; ++i) rising.values.push_back(place(i));
        value_.note(std::move(rising));
        const auto at = [&](int i) { return value_(place(i)); };
        const auto first = at(0);
        const auto last = at(steps);
        bool rises = first && last && first->is_zero() && *last == 1;
        for (int i = 0; rises && i < steps; ++i) rises = at(i) && at(i + 1) && *at(i) < *at(i + 1);
        if (!rises)
            throw Failure(Diagnostic{Id::value_out_of_range, rod.grid->span,
                                     fmt::format("the grid of rod '{}' must rise from 0 at s = 0 to 1 at s = 1, but '{}' does not",
                                                 rod.name, rod.grid->body->written())});
    }

    const System& system_;
    StartValues value_;
    const bool has_curves_ = !system_.scene.model->curves.empty();  ///< else no bounds are asked for
};

}  // namespace

void check_heat_values(const System& system, const Values& values, ValueConditions* conditions) {
    HeatValues(system, values, conditions).run();
}

}  // namespace dalembert
