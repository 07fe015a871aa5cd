// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/heat_validity.hpp"

#include <fmt/format.h>

#include <set>

#include "form/start_values.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

class HeatValues {
public:
    explicit HeatValues(const System& system) : system_(system), value_(system) {}

    void run() const {
        for (const auto& member : system_.scene.rods) check(*member.item);
        for (const auto& member : system_.scene.blocks) check(*member.item);
        check_radiation();
        for (const NodeState& node : system_.heat.nodes) {
            if (node.kind == NodeState::Kind::storing) above_zero(node.capacity, place_of_capacity(node), fmt::format("the heat capacity of '{}'", node.name), "J/K");
            if (node.kind != NodeState::Kind::sought) above_zero(node.warmth.temperature, node.place, fmt::format("the temperature of '{}'", node.name), "K");
        }
        for (const auto& member : system_.scene.links) {
            const Link& item = *member.item;
            const Indices indices = Translator::indices_of(member);
            const auto check = [&](const ExpressionPtr& e, const char* what, const char* unit) {
                if (e) above_zero(system_.translate(e, indices), e->span, fmt::format("the {} of link '{}'", what, member.name()), unit, item.law == Link::Law::linear);
            };
            check(item.conductance, "conductance", "W/K");
            check(item.resistance, "resistance", "K/W");
            check(item.area, "area", "m^2");
            check(item.length, "length", "m");
            check(item.coefficient, "coefficient", "W/(m^2*K)");
            check(item.emissivity, "emissivity", "1");
            if (item.conductivity && item.conductivity->variables.empty()) check(item.conductivity->body, "conductivity", "W/(m*K)");
        }
    }

private:
    /// What radiates is above absolute zero, also where its temperature follows from the others.
    void check_radiation() const {
        std::set<const NodeState*> checked;
        const auto check = [&](const NodeState& node) {
            if (checked.insert(&node).second) above_zero(node.warmth.temperature, node.place, fmt::format("the temperature of '{}', which radiates,", node.name), "K");
        };
        for (const NodeState& node : system_.heat.nodes)
            if (node.radiates) check(node);
        for (const LinkState& link : system_.heat.links)
            for (const LinkEnd& end : {link.from, link.to})
                if (link.radiates && end.node != nullptr) check(*end.node);
    }

    /// What moves with inputs or the time has no value before a run.
    bool moves(const ex& e) const { return value_.depends_on_input(e) || e.has(system_.symbols.time()); }

    void above_zero(const ex& e, const Span& place, const std::string& what, const char* unit, bool strictly = true) const {
        if (moves(e)) return;
        strictly ? value_.positive(e, place, what, unit) : value_.at_least_zero(e, place, what, unit);
    }

    Span place_of_capacity(const NodeState& node) const {
        for (const auto& member : system_.scene.nodes)
            if (member.item == node.item) return member.item->capacity->span;
        return node.place;
    }

    void check(const Rod& rod) const {
        const auto positive = [&](const ExpressionPtr& e, const char* what, const char* unit) {
            if (e) above_zero(system_.translate(e, {}), e->span, fmt::format("the {} of rod '{}'", what, rod.name), unit);
        };
        positive(rod.length, "length", "m");
        positive(rod.height, "height", "m");
        positive(rod.density, "density", "kg/m^3");
        if (rod.conductivity->variables.empty()) positive(rod.conductivity->body, "conductivity", "W/(m*K)");
        if (rod.inner) above_zero(system_.translate(rod.inner, {}), rod.inner->span, fmt::format("the inner radius of rod '{}'", rod.name), "m", false);
        if (rod.inner) above_zero(system_.translate(rod.outer, {}) - system_.translate(rod.inner, {}), rod.outer->span, fmt::format("the difference between outer and inner radius of rod '{}'", rod.name), "m");
        if (!rod.grid) return;
        // At its ends and in steps between them; what folds back in between shows in the capacities of cells.
        constexpr int steps = 64;
        const auto at = [&](int i) { return value_(system_.translate(*rod.grid->body, {}, {{rod.grid->variable, numeric(i, steps)}})); };
        const auto first = at(0);
        const auto last = at(steps);
        bool rises = first && last && first->is_zero() && *last == 1;
        for (int i = 0; rises && i < steps; ++i) rises = at(i) && at(i + 1) && *at(i) < *at(i + 1);
        if (!rises) throw Failure(Diagnostic{Id::value_out_of_range, rod.grid->span, fmt::format("the grid of rod '{}' must rise from 0 at s = 0 to 1 at s = 1, but '{}' does not", rod.name, rod.grid->body->written())});
    }

    void check(const Block& block) const {
        const auto positive = [&](const ExpressionPtr& e, const char* what, const char* unit) { above_zero(system_.translate(e, {}), e->span, fmt::format("{} of block '{}'", what, block.name), unit); };
        for (const BlockPiece& piece : block.columns) positive(piece.length, "the length of a column", "m");
        for (const BlockPiece& piece : block.rows) positive(piece.length, "the height of a row", "m");
        positive(block.depth, "the depth", "m");
        for (const auto& column : block.conductivity)
            for (const ExpressionPtr& value : column) positive(value, "a conductivity", "W/(m*K)");
        for (const auto& column : block.density)
            for (const ExpressionPtr& value : column) positive(value, "a density", "kg/m^3");
    }

    const System& system_;
    StartValues value_;
};

}  // namespace

void check_heat_values(const System& system) { HeatValues(system).run(); }

}  // namespace dalembert
