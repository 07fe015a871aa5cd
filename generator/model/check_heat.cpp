// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "model/checks.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

class HeatCheck {
public:
    HeatCheck(const Model& model, const Names& names, Claims& claims, Diagnostics& diagnostics) : model_(model), names_(names), claims_(claims), diagnostics_(diagnostics) {}

    void run() {
        for (const HeatNode& node : model_.nodes)
            if (node.capacity && node.temperature) temperature(node.temperature->name, node.temperature->span, fmt::format("node '{}'", node.name));
        for (const Link& link : model_.links) check(link);
        for (const Rod& rod : model_.rods) {
            const State* states = temperature(rod.temperature.name, rod.temperature.span, fmt::format("rod '{}'", rod.name));
            if (states != nullptr && !states->family)
                diagnostics_.error(Id::index_missing, rod.temperature.span, fmt::format("the temperature of rod '{}' must be a family of states, one for each cell, but '{}' is a single one", rod.name, states->name),
                                   {{states->span, fmt::format("'{}' is declared here", states->name)}});
        }
    }

private:
    const State* temperature(const std::string& name, const Span& span, const std::string& what) {
        const State* state = claims_.claim(name, span, "temperature", what);
        if (state != nullptr && state->root)
            diagnostics_.error(Id::not_allowed_here, span, fmt::format("the temperature of {} cannot be integrated as its root", what), {{state->span, fmt::format("'{}' is declared here", name)}});
        return state;
    }

    void check(const Link& link) {
        end(link.from, "from", link);
        end(link.to, "to", link);
        if (link.from.name == link.to.name && !link.from.index)
            diagnostics_.error(Id::not_allowed_here, link.to.span, fmt::format("link '{}' goes from '{}' to '{}' itself", link.name, link.from.name, link.to.name));
    }

    void end(const Reference& reference, const char* preposition, const Link& link) {
        using K = Part::Kind;
        const Part* part = names_.find_part(reference.name);
        const std::vector<K> kinds = parts_in(Subscript::warm);
        if (part == nullptr || std::find(kinds.begin(), kinds.end(), part->kind) == kinds.end()) {
            diagnostics_.error(Id::unknown_name, reference.span,
                               fmt::format("link '{}' goes {} '{}', which is no node, rod, volume or reservoir{}", link.name, preposition, reference.name, did_you_mean(reference.name, names_.parts(kinds))));
            return;
        }
        const bool takes_index = part->kind == K::rod || part->item->family.has_value();
        if (takes_index != (reference.index != nullptr))
            diagnostics_.error(takes_index ? Id::index_missing : Id::not_indexed, reference.span, fmt::format("'{}' is {}", reference.name, part->kind == K::rod ? "a rod; name the cell" : takes_index ? "a family" : "not a family"),
                               {{part->item->span, "it is defined here"}});
    }

    const Model& model_;
    const Names& names_;
    Claims& claims_;
    Diagnostics& diagnostics_;
};

}  // namespace

void check_heat(const Model& model, const Names& names, Claims& claims, Diagnostics& diagnostics) { HeatCheck(model, names, claims, diagnostics).run(); }

}  // namespace dalembert
