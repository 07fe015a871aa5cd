// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes, rods, blocks, enclosures and the heat between them, in the picture of a network.
#include <algorithm>

#include "elements/conduction.hpp"
#include "elements/heat.hpp"
#include "report/network_builder.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;
using Part = NetworkDrawing::Part;

/// Nodes of a family that are drawn one by one; more are the cells of one part.
constexpr std::size_t most_members = 5;

class HeatDrawn {
public:
    explicit HeatDrawn(NetworkBuilder& network) : network_(network), system_(network.system) {}

    void run() {
        for (const auto& member : system_.scene.rods) add_cells(*member.item, 0);
        for (const auto& member : system_.scene.blocks) add_cells(*member.item, columns_of(*member.item));
        add_families();
        for (const NodeState& node : system_.heat.nodes)
            if (node.kind != NodeState::Kind::held && !cells_.contains(node.item)) {
                const char* kind = node.kind == NodeState::Kind::sought ? "sought" : "node";
                const NetworkDrawing::Place temperature = network_.add(node.warmth.temperature);
                const std::size_t place = network_.add({.name = node.name, .kind = kind, .temperature = temperature});
                nodes_[&node] = place;
                if (network_.lists.heated.contains(node.name))
                    network_.link(node.name + ", heat", "heat", network_.outside(), place, "heat", node.source);
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
            network_.link(one.name, one.radiates ? "radiation" : "heat", from, to, "heat", one.heat);
        }
        for (const Bundle& bundle : bundles_) {
            const std::size_t from = end_of(bundle.from), to = end_of(bundle.to);
            network_.link(bundle.name, bundle.radiates ? "radiation" : "heat", from, to, "heat", bundle.heat);
        }
    }

    /// Of nodes that store or are sought.
    void add_families() {
        for (const auto& member : system_.scene.nodes) {
            const auto is_of_it = [&](const NodeState& node) { return node.item == member.item && node.kind != NodeState::Kind::held; };
            const auto count = static_cast<std::size_t>(std::count_if(system_.heat.nodes.begin(), system_.heat.nodes.end(), is_of_it));
            if (count <= most_members || cells_.contains(member.item)) continue;
            Part part{.name = member.item->name, .kind = "cells"};
            part.cell_count = part.cells_across = count;
            ex source = 0;
            bool is_heated = false;
            for (const NodeState& node : system_.heat.nodes) {
                if (!is_of_it(node)) continue;
                const NetworkDrawing::Place place = network_.add(node.warmth.temperature);
                if (!part.cells) part.cells = place;
                source += node.source;
                is_heated = is_heated || network_.lists.heated.contains(node.name);
            }
            const std::size_t place = network_.add(std::move(part));
            cells_[member.item] = place;
            if (is_heated) network_.link(member.item->name + ", heat", "heat", network_.outside(), place, "heat", source);
        }
    }

    /// The cells of a rod or block as one part, with what flows in through its borders and from its surroundings and sources.
    template <class Element>
    void add_cells(const Element& item, std::size_t across) {
        Part part{.name = item.name, .kind = "cells"};
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
            const NetworkDrawing::Place place = network_.add(node->warmth.temperature);
            if (part.cell_count++ == 0) part.cells = place;
            if (node->kind != NodeState::Kind::held) from_outside += node->source;
        }
        part.cells_across = across == 0 ? part.cell_count : across;
        const std::size_t place = network_.add(std::move(part));
        cells_[&item] = place;
        for (const BorderState& border : system_.heat.borders) {
            if (!border.name.starts_with(item.name + ".") || border.heat.is_zero() || is_joined(item, border.name)) continue;
            const bool is_right = border.name.ends_with(".last") || border.name.ends_with(".right");
            if (is_right)
                network_.link(border.name, "heat", place, network_.outside(), "heat", -border.heat);
            else
                network_.link(border.name, "heat", network_.outside(), place, "heat", border.heat);
            const NodeState* end = system_.heat.find_node(border.name);
            if (end == nullptr || end->kind != NodeState::Kind::held) from_outside -= border.heat;
        }
        if (has_sources(item)) network_.link(item.name + ", side and sources", "heat", network_.outside(), place, "heat", from_outside);
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
        if (end.volume != nullptr) return network_.volumes.at(end.volume);
        if (end.reservoir != nullptr) return network_.again(*end.reservoir);
        if (const auto found = cells_.find(end.node->item); found != cells_.end()) return found->second;
        if (const auto found = nodes_.find(end.node); found != nodes_.end()) return found->second;
        return network_.add({.name = end.node->name, .kind = "held", .temperature = network_.add(end.node->warmth.temperature)});
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
        const std::size_t middle = network_.add({.name = enclosure.name, .kind = "enclosure"});
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
            network_.link(surface->name + ", radiation", "radiation", end_of({.node = surface}), middle, "heat", leaves);
        }
    }

    NetworkBuilder& network_;
    const System& system_;
    std::map<const NodeState*, std::size_t> nodes_;
    std::map<const Item*, std::size_t> cells_;
    std::vector<Bundle> bundles_;
};

}  // namespace

void add_heat(NetworkBuilder& network) { HeatDrawn(network).run(); }

}  // namespace dalembert
