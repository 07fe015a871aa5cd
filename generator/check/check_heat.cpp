// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "check/checks.hpp"
#include "elements/conduction.hpp"
#include "elements/heat.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

class HeatCheck {
public:
    HeatCheck(const Model& model, const Names& names, Claims& claims, Diagnostics& diagnostics)
        : model_(model), names_(names), claims_(claims), diagnostics_(diagnostics) {}

    void run() {
        for (const HeatNode& node : model_.nodes) {
            const std::string what = fmt::format("node '{}'", node.name);
            if (node.capacity && node.temperature)
                (void)without_root(claims_.claim(*node.temperature, "temperature", what), node.temperature->span, what);
            if (node.boiling && node.boiling->mass) {
                const State* mass = claims_.claim(*node.boiling->mass, "mass", what);
                if (mass != nullptr && (mass->root || mass->family))
                    diagnostics_.error(
                        Id::not_allowed_here, node.boiling->mass->span,
                        fmt::format("the mass of {} must be a plain state, neither a family nor integrated as its root", what));
            }
        }
        for (const Link& link : model_.links) check(link);
        for (const Enclosure& enclosure : model_.enclosures) check(enclosure);
        for (const Rod& rod : model_.rods) temperatures(rod.temperature, fmt::format("rod '{}'", rod.name));
        for (const Block& block : model_.blocks) check(block);
    }

private:
    void temperatures(const Reference& named, const std::string& what) {
        const Named* found = names_.find(named.name);
        if (found == nullptr || found->kind != Named::Kind::state) return;  // which was said already
        const State* states = without_root(claims_.claim(named.name, named.span, "temperature", what), named.span, what);
        if (states != nullptr && !states->family)
            diagnostics_.error(Id::index_missing, named.span,
                               fmt::format("the temperature of {} must be a family of states, one for each cell, but '{}' is a single one",
                                           what, states->name),
                               {{states->span, fmt::format("'{}' is declared here", states->name)}});
    }

    const State* without_root(const State* state, const Span& span, const std::string& what) {
        if (state != nullptr && state->root)
            diagnostics_.error(Id::not_allowed_here, span, fmt::format("the temperature of {} cannot be integrated as its root", what),
                               {{state->span, fmt::format("'{}' is declared here", state->name)}});
        return state;
    }

    void check(const Block& block) {
        temperatures(block.temperature, fmt::format("block '{}'", block.name));
        const auto count = [](std::size_t n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); };
        const auto fits = [&](const Block::Table& table, const Span& span, const char* what) {
            if (table.size() == 1 && table[0].size() == 1) return;
            if (table.size() != block.columns.size())
                diagnostics_.error(Id::wrong_arguments, span,
                                   fmt::format("block '{}' has {}, but its {} has {} of them", block.name,
                                               count(block.columns.size(), "column"), what, table.size()));
            for (std::size_t i = 0; i < table.size(); ++i)
                if (table[i].size() != block.rows.size())
                    diagnostics_.error(Id::wrong_arguments, span,
                                       fmt::format("block '{}' has {}, but in column {} its {} has {} of them", block.name,
                                                   count(block.rows.size(), "row"), i + 1, what, table[i].size()));
        };
        fits(block.conductivity, block.conductivity.span, "conductivity");
        fits(block.density, block.density.span, "density");
        fits(block.heat_capacity, block.heat_capacity.span, "heat capacity");
    }

    void check(const Link& link) {
        if (link.from.name == link.to.name && !link.from.index)
            diagnostics_.error(Id::not_allowed_here, link.to.span,
                               fmt::format("link '{}' goes from '{}' to '{}' itself", link.name, link.from.name, link.to.name));
    }

    void check(const Enclosure& enclosure) {
        const std::size_t n = enclosure.surfaces.size();
        const auto has_length = [&](std::size_t length, const Span& span, const char* what) {
            if (length != n)
                diagnostics_.error(
                    Id::wrong_arguments, span,
                    fmt::format("enclosure '{}' has {} surface{}, but {} {}", enclosure.name, n, n == 1 ? "" : "s", length, what));
        };
        constexpr std::size_t most = 32;
        if (n < 2 || n > most)
            diagnostics_.error(
                Id::wrong_arguments, enclosure.span,
                fmt::format("enclosure '{}' has {} surface{}; there must be 2 to {}", enclosure.name, n, n == 1 ? "" : "s", most));
        has_length(enclosure.emissivities.size(), enclosure.emissivities.span, "emissivities");
        if (enclosure.is_prism()) {
            has_length(enclosure.polygon.size(), enclosure.polygon.span, "corners, each of which begins a surface");
            if (enclosure.polygon.size() < 3)
                diagnostics_.error(Id::wrong_arguments, enclosure.polygon.span,
                                   fmt::format("the polygon of enclosure '{}' has {} corners, but needs at least 3", enclosure.name,
                                               enclosure.polygon.size()));
        } else {
            has_length(enclosure.areas.size(), enclosure.areas.span, "areas");
            has_length(enclosure.view_factors.size(), enclosure.view_factors.span, "rows of view factors");
            for (std::size_t i = 0; i < enclosure.view_factors.size(); ++i)
                if (enclosure.view_factors[i].size() != n)
                    diagnostics_.error(Id::wrong_arguments, enclosure.view_factors.span,
                                       fmt::format("enclosure '{}' has {} surfaces, but row {} of its view factors has {} entries",
                                                   enclosure.name, n, i + 1, enclosure.view_factors[i].size()));
        }
    }

    const Model& model_;
    const Names& names_;
    Claims& claims_;
    Diagnostics& diagnostics_;
};

}  // namespace

void check_heat(const Model& model, const Names& names, Claims& claims, Diagnostics& diagnostics) {
    HeatCheck(model, names, claims, diagnostics).run();
}

}  // namespace dalembert
