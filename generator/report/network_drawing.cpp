// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/network_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "elements/fluids.hpp"
#include "elements/view.hpp"
#include "report/network_builder.hpp"

namespace dalembert {

namespace {

using Part = NetworkDrawing::Part;

/// Beyond, nobody can read the picture.
constexpr std::size_t most_parts = 40;
constexpr std::size_t narrow = 3, wide = 5;

/// What the view hides, with the links that lead to it, and what then nothing leads to.
void hide(NetworkDrawing& drawing, const Model& model) {
    std::vector<bool> had_links(drawing.parts.size(), false), has_links(drawing.parts.size(), false);
    for (const NetworkDrawing::Link& link : drawing.links) had_links[link.from] = had_links[link.to] = true;
    std::erase_if(drawing.links, [&](const NetworkDrawing::Link& link) {
        return is_hidden(model, link.name) || is_hidden(model, drawing.parts[link.from].name) ||
               is_hidden(model, drawing.parts[link.to].name);
    });
    for (const NetworkDrawing::Link& link : drawing.links) has_links[link.from] = has_links[link.to] = true;
    std::vector<std::size_t> place;
    std::vector<Part> parts;
    for (std::size_t i = 0; i < drawing.parts.size(); ++i) {
        place.push_back(parts.size());
        const Part& part = drawing.parts[i];
        static const std::set<std::string> ends_of_links{"reservoir", "held", "ground", "fixed", "outside"};
        const bool is_end = ends_of_links.contains(part.kind);
        if (!is_hidden(model, part.name) && !(is_end && had_links[i] && !has_links[i])) parts.push_back(part);
    }
    drawing.parts = std::move(parts);
    for (NetworkDrawing::Link& link : drawing.links) {
        link.from = place[link.from];
        link.to = place[link.to];
    }
}

NetworkDrawing network_of(const System& system, const NetworkLists& lists) {
    NetworkBuilder network(system, lists);
    add_fluids(network);
    add_heat(network);
    add_circuit(network);
    add_rotors(network);
    NetworkDrawing drawing = std::move(network.drawing);
    hide(drawing, *system.scene.model);
    if (drawing.parts.size() > most_parts) {
        const std::string told = fmt::format("the network of fluids, heat, circuits and shafts, which has {} parts", drawing.parts.size());
        drawing = {};
        drawing.not_drawn.push_back(told);
        return drawing;
    }
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    for (const NetworkDrawing::Link& link : drawing.links) edges.emplace_back(link.from, link.to);
    if (!drawing.empty())
        for (const std::size_t columns : {narrow, wide}) drawing.layouts.push_back(layered_layout(drawing.parts.size(), edges, columns));
    return drawing;
}

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
               one.size == other.size && one.voltage == other.voltage && one.cells == other.cells && one.speed == other.speed &&
               one.angle == other.angle;
    };
    const auto same_link = [](const NetworkDrawing::Link& one, const NetworkDrawing::Link& other) {
        return one.name == other.name && one.from == other.from && one.to == other.to && one.flow == other.flow &&
               one.conducts == other.conducts && one.ratio == other.ratio;
    };
    return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), same_part) &&
           std::equal(a.links.begin(), a.links.end(), b.links.begin(), b.links.end(), same_link);
}

template <class Visit>
void in_all_modes(const Machine& machine, const Visit& visit) {
    visit(*machine.system);
    for (const Machine& other : machine.other_modes) visit(*other.system);
}

NetworkLists lists_of(const Machine& machine, const std::vector<std::string>& unplaced) {
    NetworkLists lists;
    in_all_modes(machine, [&](const System& system) {
        for (const FlowState& flow : system.fluids.flows) lists.flows.push_back(flow.member);
        for (const ControlVolume& volume : system.fluids.containers.volumes)
            if (!volume.heat.is_zero()) lists.heated.insert(volume.member.name());
        for (const NodeState& node : system.heat.nodes)
            if (!node.source.is_zero()) lists.heated.insert(node.name);
    });
    const auto place = [](const Member<Flow>& flow) { return std::pair(flow.item, flow.index); };
    std::vector<Member<Flow>>& flows = lists.flows;
    std::sort(flows.begin(), flows.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    flows.erase(std::unique(flows.begin(), flows.end(), [&](const auto& a, const auto& b) { return place(a) == place(b); }), flows.end());
    list_couplings(lists, machine, unplaced);
    return lists;
}

}  // namespace

std::vector<NetworkDrawing> networks_of(const Machine& machine, const std::vector<std::string>& unplaced) {
    const NetworkLists lists = lists_of(machine, unplaced);
    std::vector<NetworkDrawing> networks{network_of(*machine.system, lists)};
    for (const Machine& other : machine.other_modes) {
        networks.push_back(network_of(*other.system, lists));
        if (is_same(networks.front(), networks.back())) continue;
        NetworkDrawing none;
        none.not_drawn.push_back("the network of fluids, heat, circuits and shafts, whose parts differ between modes");
        return std::vector<NetworkDrawing>(1 + machine.other_modes.size(), none);
    }
    return networks;
}

}  // namespace dalembert
