// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/interruptions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "text/diagnostic.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

bool is_diode(const BranchState* branch) { return branch->item->law == Branch::Law::diode; }

[[noreturn]] void refuse_without_path(const BranchState& found, const std::vector<const BranchState*>& around) {
    throw Failure(Diagnostic{Id::doubly_determined, around.front()->item->span,
                             fmt::format("where {}, the current of {} '{}' has no path; put a diode or a resistor across '{}', or give "
                                         "'{}' a conductance",
                                         interruption(around), found.item->law == Branch::Law::inductor ? "inductor" : "current source",
                                         found.name, found.name, around.front()->name),
                             {{found.item->span, fmt::format("'{}' is defined here", found.name)}}});
}

}  // namespace

std::vector<std::size_t> parts_of(const Circuit& circuit, const std::function<bool(const BranchState&)>& is_out) {
    std::vector<std::size_t> part(circuit.pins.size());
    std::iota(part.begin(), part.end(), std::size_t(0));
    for (const BranchState& branch : circuit.branches) {
        if (is_out(branch)) continue;
        const auto [low, high] = std::minmax({part[branch.from], part[branch.to]});
        std::replace(part.begin(), part.end(), high, low);
    }
    return part;
}

void cut_off_inductors(Circuit& circuit) {
    for (BranchState& found : circuit.branches) {
        if (found.known != BranchState::Known::current || found.is_interrupted()) continue;
        const auto part = parts_of(circuit, [&](const BranchState& other) { return &other == &found || other.is_interrupted(); });
        const std::size_t side = part[found.from];
        if (side == part[found.to]) continue;
        std::vector<const BranchState*> around;
        for (const BranchState& other : circuit.branches)
            if (other.is_interrupted() && (part[other.from] == side) != (part[other.to] == side)) around.push_back(&other);
        if (around.empty()) continue;
        if (found.item->law != Branch::Law::inductor || std::none_of(around.begin(), around.end(), is_diode))
            refuse_without_path(found, around);
        found.is_cut_off = true;
        found.known = BranchState::Known::voltage;
        found.fall = found.current = 0;
    }
}

std::string interruption(const std::vector<const BranchState*>& branches) {
    std::vector<std::string> diodes, switches;
    for (const BranchState* branch : branches) (is_diode(branch) ? diodes : switches).push_back(branch->name);
    const auto those = [](const std::vector<std::string>& names, const char* one, const char* does, const char* many, const char* all_do) {
        return names.empty() ? "" : fmt::format("{} {} {}", names.size() == 1 ? one : many, quoted_list(names),
                                                names.size() == 1 ? does : all_do);
    };
    return those(diodes, "diode", "blocks", "diodes", "block") + (diodes.empty() || switches.empty() ? "" : " and ") +
           those(switches, "switch", "is open", "switches", "are open");
}

}  // namespace dalembert
