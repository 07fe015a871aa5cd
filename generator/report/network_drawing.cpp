// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/network_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/conduction.hpp"
#include "elements/fluids.hpp"
#include "elements/heat.hpp"
#include "elements/view.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;
using Part = NetworkDrawing::Part;

/// Beyond, nobody can read the picture.
constexpr std::size_t most_parts = 40;
/// Nodes of a family that are drawn one by one; more are the cells of one part.
constexpr std::size_t most_members = 5;
constexpr std::size_t narrow = 3, wide = 5;

class NetworkMaker {
public:
    /// `flows`: those of all modes.
    NetworkMaker(const System& system, const std::vector<Member<Flow>>& flows) : system_(system), flows_(flows) {}

    NetworkDrawing run() {
        add_fluids();
        add_heat();
        hide();
        if (drawing_.parts.size() > most_parts) {
            const std::string told = fmt::format("the network of fluids and heat, which has {} parts", drawing_.parts.size());
            drawing_ = {};
            drawing_.not_drawn.push_back(told);
            return std::move(drawing_);
        }
        std::vector<std::pair<std::size_t, std::size_t>> edges;
        for (const NetworkDrawing::Link& link : drawing_.links) edges.emplace_back(link.from, link.to);
        if (!drawing_.empty())
            for (const std::size_t columns : {narrow, wide})
                drawing_.layouts.push_back(layered_layout(drawing_.parts.size(), edges, columns));
        return std::move(drawing_);
    }

private:
    /// Nothing where the value needs accelerations or the forces of constraints, which are no functions of the state.
    NetworkDrawing::Place add(const ex& value) {
        const ex plain = system_.symbols.without_definitions(system_.with_rates(value));
        for (const SymbolKind kind : {SymbolKind::acceleration, SymbolKind::multiplier, SymbolKind::state_rate})
            for (const Variable& variable : system_.symbols.all(kind))
                if (plain.has(variable.symbol)) return std::nullopt;
        drawing_.values.push_back(plain);
        return drawing_.values.size() - 1;
    }

    std::size_t add(Part part) {
        drawing_.parts.push_back(std::move(part));
        return drawing_.parts.size() - 1;
    }

    void link(std::string name, std::string kind, std::size_t from, std::size_t to, bool is_heat, const ex& flow) {
        const NetworkDrawing::Place place = add(flow);
        if (!place) drawing_.not_drawn.push_back(fmt::format("how much flows through '{}', as that depends on accelerations", name));
        drawing_.links.push_back({std::move(name), std::move(kind), from, to, is_heat, place});
    }

    /// What the view hides, with the links that lead to it, and what then nothing leads to.
    void hide() {
        const Model& model = *system_.scene.model;
        std::vector<bool> had_links(drawing_.parts.size(), false), has_links(drawing_.parts.size(), false);
        for (const NetworkDrawing::Link& link : drawing_.links) had_links[link.from] = had_links[link.to] = true;
        std::erase_if(drawing_.links, [&](const NetworkDrawing::Link& link) {
            return is_hidden(model, link.name) || is_hidden(model, drawing_.parts[link.from].name) ||
                   is_hidden(model, drawing_.parts[link.to].name);
        });
        for (const NetworkDrawing::Link& link : drawing_.links) has_links[link.from] = has_links[link.to] = true;
        std::vector<std::size_t> place;
        std::vector<Part> parts;
        for (std::size_t i = 0; i < drawing_.parts.size(); ++i) {
            place.push_back(parts.size());
            const Part& part = drawing_.parts[i];
            const bool is_end = part.kind == "reservoir" || part.kind == "held" || part.kind == "outside";  // of links alone
            if (!is_hidden(model, part.name) && !(is_end && had_links[i] && !has_links[i])) parts.push_back(part);
        }
        drawing_.parts = std::move(parts);
        for (NetworkDrawing::Link& link : drawing_.links) {
            link.from = place[link.from];
            link.to = place[link.to];
        }
    }

    std::size_t outside() { return add({"", "outside", {}, {}, {}}); }

    void add_fluids() {
        const Containers& all = system_.fluids.containers;
        for (const ControlVolume& volume : all.volumes) {
            const char* kind = volume.primary == ControlVolume::Primary::filling ? "tank"
                               : is_of_parameters(volume.size, system_.symbols)  ? "vessel"
                                                                                 : "cylinder";
            Part part{volume.member.name(), kind, add(volume.surface_pressure), {}, add(volume.size)};
            if (volume.fluid.temperature) part.temperature = add(*volume.fluid.temperature);
            volumes_[&volume] = add(std::move(part));
        }
        for (const JunctionState& junction : all.junctions)
            junctions_[&junction] = add({junction.member.name(), "junction", add(junction.fluid.pressure), {}, {}});
        for (const Member<Flow>& member : flows_) {
            const FlowState* flow = system_.fluids.find_flow(member.item->name, member.index);
            const std::size_t from =
                flow != nullptr ? end_of(flow->from_volume, flow->from_junction, flow->from) : end_named(member.item->from, member);
            const std::size_t to =
                flow != nullptr ? end_of(flow->to_volume, flow->to_junction, flow->to) : end_named(member.item->to, member);
            link(member.name(), law_of(*member.item), from, to, false, flow != nullptr ? flow->mass_flow : ex(0));
        }
        for (const ControlVolume& volume : all.volumes)
            if (!volume.heat.is_zero()) link(volume.member.name() + ", heat", "heat", outside(), volumes_.at(&volume), true, volume.heat);
    }

    /// Of a flow that this mode does not have.
    std::size_t end_named(const Reference& end, const Member<Flow>& member) {
        const Containers& all = system_.fluids.containers;
        const int index = end.index ? index_value(*end.index, system_.scene, Translator::indices_of(member)) : 0;
        const ControlVolume* volume = all.find_volume(end.name, index);
        const JunctionState* junction = all.find_junction(end.name, index);
        const ReservoirState* reservoir = all.find_reservoir(end.name, index);
        return end_of(volume, junction, reservoir == nullptr ? nullptr : &reservoir->fluid);
    }

    /// As models call it; empty where the flow is given.
    static std::string law_of(const Flow& flow) {
        for (const auto& choice : flow_laws())
            if (choice.value == flow.law) return choice.word;
        return {};
    }

    std::size_t end_of(const ControlVolume* volume, const JunctionState* junction, const FluidState* fluid) {
        if (volume != nullptr) return volumes_.at(volume);
        if (junction != nullptr) return junctions_.at(junction);
        for (const ReservoirState& reservoir : system_.fluids.containers.reservoirs)
            if (&reservoir.fluid == fluid) return again(reservoir);
        return outside();
    }

    /// A reservoir, like a node whose temperature is held, is drawn wherever something leads to it, as lines to one of them would cross
    /// others.
    std::size_t again(const ReservoirState& reservoir) {
        Part part{reservoir.member.name(), "reservoir", add(reservoir.fluid.pressure), {}, {}};
        if (reservoir.fluid.temperature) part.temperature = add(*reservoir.fluid.temperature);
        return add(std::move(part));
    }

    void add_heat() {
        for (const auto& member : system_.scene.rods) add_cells(*member.item, 0);
        for (const auto& member : system_.scene.blocks) add_cells(*member.item, columns_of(*member.item));
        add_families();
        for (const NodeState& node : system_.heat.nodes)
            if (node.kind != NodeState::Kind::held && !cells_.contains(node.item)) {
                const std::size_t place =
                    add({node.name, node.kind == NodeState::Kind::sought ? "sought" : "node", {}, add(node.warmth.temperature), {}});
                nodes_[&node] = place;
                if (!node.source.is_zero()) link(node.name + ", heat", "heat", outside(), place, true, node.source);
            }
        for (const EnclosureState& enclosure : system_.heat.enclosures) add_enclosure(enclosure);
        for (const LinkState& one : system_.heat.links) {
            if (is_of_enclosure(one)) continue;
            if (one.from.node != nullptr && one.to.node != nullptr && one.from.node->item == one.to.node->item &&
                cells_.contains(one.from.node->item))
                continue;
            if (has_cells(one.from) || has_cells(one.to)) {
                add_to_bundle(one);
                continue;
            }
            const std::size_t from = end_of(one.from), to = end_of(one.to);
            link(one.name, one.radiates ? "radiation" : "heat", from, to, true, one.heat);
        }
        for (const Bundle& bundle : bundles_) {
            const std::size_t from = end_of(bundle.from), to = end_of(bundle.to);
            link(bundle.name, bundle.radiates ? "radiation" : "heat", from, to, true, bundle.heat);
        }
    }

    /// Of nodes that store or are sought.
    void add_families() {
        for (const auto& member : system_.scene.nodes) {
            const auto is_of_it = [&](const NodeState& node) { return node.item == member.item && node.kind != NodeState::Kind::held; };
            const auto count = static_cast<std::size_t>(std::count_if(system_.heat.nodes.begin(), system_.heat.nodes.end(), is_of_it));
            if (count <= most_members || cells_.contains(member.item)) continue;
            Part part{member.item->name, "cells", {}, {}, {}};
            part.cell_count = part.cells_across = count;
            ex source = 0;
            for (const NodeState& node : system_.heat.nodes) {
                if (!is_of_it(node)) continue;
                const NetworkDrawing::Place place = add(node.warmth.temperature);
                if (!part.cells) part.cells = place;
                source += node.source;
            }
            const std::size_t place = add(std::move(part));
            cells_[member.item] = place;
            if (!source.is_zero()) link(member.item->name + ", heat", "heat", outside(), place, true, source);
        }
    }

    /// The cells of a rod or block as one part, with what flows in through its borders and from its surroundings and sources.
    template <class Element>
    void add_cells(const Element& item, std::size_t across) {
        Part part{item.name, "cells", {}, {}, {}};
        std::vector<const NodeState*> row;
        for (const NodeState& node : system_.heat.nodes)
            if (node.item == &item) row.push_back(&node);
        if constexpr (std::is_same_v<Element, Rod>)  // its ends stand behind its cells
            std::stable_sort(row.begin(), row.end(),
                             [&](const NodeState* a, const NodeState* b) { return rank(*a, item) < rank(*b, item); });
        else
            std::erase_if(row, [](const NodeState* node) { return node->kind != NodeState::Kind::storing; });
        ex from_outside = 0;
        for (const NodeState* node : row) {
            const NetworkDrawing::Place place = add(node->warmth.temperature);
            if (part.cell_count++ == 0) part.cells = place;
            if (node->kind != NodeState::Kind::held) from_outside += node->source;
        }
        part.cells_across = across == 0 ? part.cell_count : across;
        const std::size_t place = add(std::move(part));
        cells_[&item] = place;
        for (const BorderState& border : system_.heat.borders) {
            if (!border.name.starts_with(item.name + ".") || border.heat.is_zero() || is_joined(item, border.name)) continue;
            const bool is_right = border.name.ends_with(".last") || border.name.ends_with(".right");
            if (is_right)
                link(border.name, "heat", place, outside(), true, -border.heat);
            else
                link(border.name, "heat", outside(), place, true, border.heat);
            const NodeState* end = system_.heat.find_node(border.name);
            if (end == nullptr || end->kind != NodeState::Kind::held) from_outside -= border.heat;
        }
        if (has_sources(item)) link(item.name + ", side and sources", "heat", outside(), place, true, from_outside);
    }

    static int rank(const NodeState& node, const Rod& rod) {
        return node.name == rod.name + ".first" ? 0 : node.name == rod.name + ".last" ? 2 : 1;
    }
    static bool has_sources(const Rod& rod) { return rod.source || rod.side_coefficient || rod.side_emissivity; }
    static bool has_sources(const Block& block) { return block.source.has_value(); }
    static bool is_joined(const Rod&, const std::string&) { return false; }
    /// Whether a node holds the side, so that links lead there.
    static bool is_joined(const Block& block, const std::string& border) {
        for (const auto& [side, name] :
             {std::pair{&block.left, ".left"}, {&block.right, ".right"}, {&block.bottom, ".bottom"}, {&block.top, ".top"}})
            if (border == block.name + name) return *side && (*side)->node;
        return false;
    }
    std::size_t columns_of(const Block& block) const {
        std::size_t count = 0;
        for (const BlockPiece& piece : block.columns) count += static_cast<std::size_t>(index_value(*piece.cells, system_.scene, {}));
        return count;
    }

    /// Links of a family, or from a node to all cells of a side, between the same two parts.
    struct Bundle {
        std::string name;
        LinkEnd from, to;
        bool radiates;
        ex heat;
    };
    bool has_cells(const LinkEnd& end) const { return end.node != nullptr && cells_.contains(end.node->item); }
    bool is_same_part(const LinkEnd& a, const LinkEnd& b) const {
        if (has_cells(a) && has_cells(b)) return a.node->item == b.node->item;
        return a.node == b.node && a.volume == b.volume && a.reservoir == b.reservoir;
    }
    void add_to_bundle(const LinkState& one) {
        const std::string base = one.name.starts_with("between ") ? one.from.node->item->name : one.name.substr(0, one.name.find('['));
        for (Bundle& bundle : bundles_)
            if (bundle.name == base && is_same_part(bundle.from, one.from) && is_same_part(bundle.to, one.to)) {
                bundle.heat += one.heat;
                return;
            }
        bundles_.push_back({base, one.from, one.to, one.radiates, one.heat});
    }

    std::size_t end_of(const LinkEnd& end) {
        if (end.volume != nullptr) return volumes_.at(end.volume);
        if (end.reservoir != nullptr) return again(*end.reservoir);
        if (const auto found = cells_.find(end.node->item); found != cells_.end()) return found->second;
        if (const auto found = nodes_.find(end.node); found != nodes_.end()) return found->second;
        return add({end.node->name, "held", {}, add(end.node->warmth.temperature), {}});
    }

    bool is_of_enclosure(const LinkState& one) const {
        return std::any_of(system_.heat.enclosures.begin(), system_.heat.enclosures.end(),
                           [&](const EnclosureState& enclosure) { return is_of(enclosure, one); });
    }
    static bool is_of(const EnclosureState& enclosure, const LinkState& one) {
        const auto has = [&](const NodeState* node) {
            return std::find(enclosure.nodes.begin(), enclosure.nodes.end(), node) != enclosure.nodes.end();
        };
        return one.radiates && one.name.starts_with(enclosure.name + ", ") && has(one.from.node) && has(one.to.node);
    }

    /// What each surface gives to all others, which meet in the middle.
    void add_enclosure(const EnclosureState& enclosure) {
        const std::size_t middle = add({enclosure.name, "enclosure", {}, {}, {}});
        std::vector<const NodeState*> seen;
        for (const NodeState* surface : enclosure.nodes) {
            if (std::find(seen.begin(), seen.end(), surface) != seen.end()) continue;
            seen.push_back(surface);
            ex leaves = 0;
            for (const LinkState& one : system_.heat.links) {
                if (!is_of(enclosure, one)) continue;
                if (one.from.node == surface) leaves += one.heat;
                if (one.to.node == surface) leaves -= one.heat;
            }
            link(surface->name + ", radiation", "radiation", end_of({.node = surface}), middle, true, leaves);
        }
    }

    const System& system_;
    const std::vector<Member<Flow>>& flows_;
    NetworkDrawing drawing_;
    std::map<const ControlVolume*, std::size_t> volumes_;
    std::map<const JunctionState*, std::size_t> junctions_;
    std::map<const NodeState*, std::size_t> nodes_;
    std::map<const Item*, std::size_t> cells_;
    std::vector<Bundle> bundles_;
};

}  // namespace

const ViewPart* find_view(const Model& model, const std::string& name) {
    if (!model.view) return nullptr;
    const std::string base = name.substr(0, name.find('['));
    for (const ViewPart& part : model.view->parts)
        if (part.name == base) return &part;
    return nullptr;
}

bool is_hidden(const Model& model, const std::string& name) {
    const ViewPart* part = find_view(model, name);
    return part != nullptr && part->hidden;
}

namespace {

bool is_same(const NetworkDrawing& a, const NetworkDrawing& b) {
    const auto same_part = [](const Part& one, const Part& other) {
        return one.name == other.name && one.kind == other.kind && one.pressure == other.pressure && one.temperature == other.temperature &&
               one.size == other.size && one.cells == other.cells;
    };
    const auto same_link = [](const NetworkDrawing::Link& one, const NetworkDrawing::Link& other) {
        return one.name == other.name && one.from == other.from && one.to == other.to && one.flow == other.flow;
    };
    return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), same_part) &&
           std::equal(a.links.begin(), a.links.end(), b.links.begin(), b.links.end(), same_link);
}

/// In order of declaration.
std::vector<Member<Flow>> flows_of_all_modes(const Machine& machine) {
    std::vector<Member<Flow>> flows;
    const auto add = [&](const System& system) {
        for (const FlowState& flow : system.fluids.flows) flows.push_back(flow.member);
    };
    add(*machine.system);
    for (const Machine& other : machine.other_modes) add(*other.system);
    const auto place = [](const Member<Flow>& flow) { return std::pair(flow.item, flow.index); };
    std::sort(flows.begin(), flows.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    flows.erase(std::unique(flows.begin(), flows.end(), [&](const auto& a, const auto& b) { return place(a) == place(b); }), flows.end());
    return flows;
}

}  // namespace

std::vector<NetworkDrawing> networks_of(const Machine& machine) {
    const std::vector<Member<Flow>> flows = flows_of_all_modes(machine);
    std::vector<NetworkDrawing> networks{NetworkMaker(*machine.system, flows).run()};
    for (const Machine& other : machine.other_modes) {
        networks.push_back(NetworkMaker(*other.system, flows).run());
        if (is_same(networks.front(), networks.back())) continue;
        NetworkDrawing none;
        none.not_drawn.push_back("the network of fluids and heat, whose parts differ between modes");
        return std::vector<NetworkDrawing>(1 + machine.other_modes.size(), none);
    }
    return networks;
}

}  // namespace dalembert
