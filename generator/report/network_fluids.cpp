// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes, reservoirs, junctions and the flows between them, in the picture of a network.
#include "elements/fluids.hpp"
#include "report/network_builder.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;
using Part = NetworkDrawing::Part;

class FluidsDrawn {
public:
    explicit FluidsDrawn(NetworkBuilder& network) : network_(network), system_(network.system) {}

    void run() {
        const Containers& all = system_.fluids.containers;
        for (const ControlVolume& volume : all.volumes) {
            const char* kind = volume.primary == ControlVolume::Primary::filling ? "tank"
                               : is_of_parameters(volume.size, system_.symbols) ? "vessel"
                                                                                        : "cylinder";
            Part part{.name = volume.member.name(), .kind = kind, .pressure = network_.add(volume.surface_pressure)};
            part.size = network_.add(volume.size);
            if (volume.fluid.temperature) part.temperature = network_.add(*volume.fluid.temperature);
            network_.volumes[&volume] = network_.add(std::move(part));
        }
        for (const JunctionState& junction : all.junctions) {
            const NetworkDrawing::Place pressure = network_.add(junction.fluid.pressure);
            junctions_[&junction] = network_.add({.name = junction.member.name(), .kind = "junction", .pressure = pressure});
        }
        for (const Member<Flow>& member : network_.lists.flows) {
            const FlowState* flow = system_.fluids.find_flow(member.item->name, member.index);
            const std::size_t from =
                flow != nullptr ? end_of(flow->from_volume, flow->from_junction, flow->from) : end_named(member.item->from, member);
            const std::size_t to =
                flow != nullptr ? end_of(flow->to_volume, flow->to_junction, flow->to) : end_named(member.item->to, member);
            network_.link(member.name(), law_of(*member.item), from, to, "mass", flow != nullptr ? flow->mass_flow : ex(0));
        }
        for (const ControlVolume& volume : all.volumes)
            if (network_.lists.heated.contains(volume.member.name())) {
                const std::size_t place = network_.volumes.at(&volume);
                network_.link(volume.member.name() + ", heat", "heat", network_.outside(), place, "heat", volume.heat);
            }
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
        if (volume != nullptr) return network_.volumes.at(volume);
        if (junction != nullptr) return junctions_.at(junction);
        for (const ReservoirState& reservoir : system_.fluids.containers.reservoirs)
            if (&reservoir.fluid == fluid) return network_.again(reservoir);
        return network_.outside();
    }

    NetworkBuilder& network_;
    const System& system_;
    std::map<const JunctionState*, std::size_t> junctions_;
};

}  // namespace

void add_fluids(NetworkBuilder& network) { FluidsDrawn(network).run(); }

}  // namespace dalembert
