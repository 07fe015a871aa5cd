// SPDX-License-Identifier: GPL-3.0-or-later
// Heat between places with one temperature: nodes, cells of rods and blocks, volumes and reservoirs. Each node balances what flows in,
// C(T)*dT/dt = sum of the heat flows + what comes from outside (4.103b); one without a capacity has its temperature from the balance.
#pragma once

#include <deque>
#include <map>

#include "balance/control_volume.hpp"
#include "balance/net_radiation.hpp"

namespace dalembert {

/// A temperature, and its fourth power, which has a letter of its own where the temperature is still sought.
struct Warmth {
    GiNaC::ex temperature;
    GiNaC::ex fourth;
    bool is_sought = false;
};

/// Of what boils: heat makes steam, which takes its enthalpy along.
struct BoilingState {
    std::size_t mass;      ///< the state that is left
    GiNaC::ex enthalpy;    ///< J/kg, of evaporation
    bool boils;            ///< in this mode
};

/// A node of [nodes], or a cell or surface of a rod or block.
struct NodeState {
    enum class Kind { storing, held, sought };
    Kind kind;
    std::string name;                  ///< "plate", "bar[3]"
    const Item* item;
    Span place;                        ///< what a message about its temperature points at
    Warmth warmth;
    std::optional<std::size_t> state;  ///< of one that stores
    GiNaC::ex capacity = 0;            ///< J/K
    GiNaC::ex stored_energy = 0;       ///< J, the integral of the capacity over the temperature
    GiNaC::ex source = 0;              ///< W, from outside
    GiNaC::ex letter = 0;              ///< of a sought temperature, before it was found
    GiNaC::ex fourth_letter = 0;       ///< of its fourth power
    GiNaC::ex balance = 0;             ///< W into it, in the letters of sought temperatures; zero of one that is held
    std::optional<BoilingState> boiling = {};
    bool is_tapped = false;            ///< a cell of a field, of which only what comes from elsewhere is balanced here
    bool radiates = false;             ///< to what surrounds it, as part of the source
    bool is_surface = false;           ///< of a rod or block: stores nothing, and is drawn towards the temperature of what surrounds it
};

/// Where a link ends. Exactly one of the three is there.
struct LinkEnd {
    const NodeState* node = nullptr;
    const ControlVolume* volume = nullptr;
    const ReservoirState* reservoir = nullptr;
};

struct LinkState {
    std::string name;
    Span place;
    LinkEnd from, to;
    GiNaC::ex heat;  ///< W, positive from `from` to `to`
    bool radiates = false;
};

/// An end of a rod or a side of a block.
struct BorderState {
    std::string name;      ///< "bar.first"
    GiNaC::ex heat = 0;    ///< W, into the rod or block
};

/// Surfaces that radiate at each other, with what they see and exchange.
struct EnclosureState {
    std::string name;
    std::vector<const NodeState*> nodes;
    std::vector<std::vector<GiNaC::ex>> view_factors;
    Surroundings surroundings;
    NetRadiation radiation;

    /// W/m^2 that leaves surface i (4.42), and that arrives at it (4.48).
    GiNaC::ex radiosity(std::size_t i) const;
    GiNaC::ex irradiation(std::size_t i) const;
};

struct CellField;

/// All that heat does outside of fluids.
struct HeatNetwork {
    std::deque<NodeState> nodes;  ///< addresses are kept
    std::vector<LinkState> links;
    std::vector<CellField> fields;
    std::vector<EnclosureState> enclosures;
    std::vector<BorderState> borders;
    GiNaC::ex stored_energy = 0;    ///< J
    GiNaC::ex exchanged_power = 0;  ///< W, from sources, held nodes and reservoirs
    GiNaC::exmap solved;            ///< the letters of sought temperatures, with what they are
    std::map<const NodeState*, GiNaC::ex>
        defined;  ///< W into nodes that hold each other in balance: zero by definition of their temperatures

    bool empty() const { return nodes.empty() && links.empty(); }
    /// Null where the scene has none of that name: "plate", "bar[3]".
    const NodeState* find_node(const std::string& name) const;
    const LinkState* find_link(const std::string& name) const;
    const BorderState* find_border(const std::string& name) const;
    /// W, along links and from outside.
    GiNaC::ex heat_into(const NodeState& node) const;
    GiNaC::ex heat_into(const ControlVolume& volume) const;
    /// dT/dt of a node that stores: none while it boils.
    GiNaC::ex rate(const NodeState& node) const {
        return node.boiling && node.boiling->boils ? GiNaC::ex(0) : heat_into(node) / node.capacity;
    }
    /// kg/s that evaporate, of one that boils, in any of its modes.
    GiNaC::ex steam(const NodeState& node) const { return node.boiling->boils ? heat_into(node) / node.boiling->enthalpy : GiNaC::ex(0); }
    /// W that the steam takes along: its enthalpy of evaporation, and what was stored in it; zero of what does not boil.
    GiNaC::ex steam_power(const NodeState& node, const Symbols& symbols) const;
    GiNaC::ex power_over_border(const Symbols& symbols) const;
    /// Parts of the network that no link joins to a temperature that is held, and that nothing outside cools or warms towards its own:
    /// the states of their nodes.
    std::vector<std::vector<std::size_t>> floating_parts() const;
};

/// The nodes with their temperatures; the cells of rods and blocks with all that is theirs. Throws Failure.
HeatNetwork make_nodes(const Scene& scene, const Translator& translate, Symbols& symbols);
/// Sources and links, and the temperatures that are sought. Throws Failure (cannot-integrate, index-out-of-range, undetermined,
/// needs-absent).
void complete_heat(HeatNetwork& network, const Scene& scene, const Translator& translate, Symbols& symbols, const Containers& containers);

// For rods and blocks, which are made of nodes and links too.

/// A node that stores: capacity as an expression (no variables) or law of its temperature, times `amount`.
void store(NodeState& node, const Property& capacity, const GiNaC::ex& amount, const Translator& translate, Symbols& symbols,
           const Indices& indices);
NodeState& add_sought(HeatNetwork& network, std::string name, const Item& item, const Span& place, Symbols& symbols);
/// shape*(integral of the conductivity from T_b to T_a): W.
GiNaC::ex conduct(const Property& conductivity, const GiNaC::ex& shape, const Warmth& a, const Warmth& b, const Translator& translate,
                  Symbols& symbols, const Indices& indices);
/// factor*(T_a - T_b), W.
GiNaC::ex exchange(const GiNaC::ex& factor, const Warmth& a, const Warmth& b);
/// area*stefan_boltzmann*(T_a^4 - T_b^4), W; the area times what emissivities and reflections leave of it.
GiNaC::ex radiate(const GiNaC::ex& area, const Warmth& a, const Warmth& b);
Warmth warmth_of(const GiNaC::ex& temperature);
/// What a surface of a size (m^2) takes up from what surrounds it, by convection and radiation where they are given; W.
GiNaC::ex taken_up(const Warmth& surface, const GiNaC::ex& size, const ExpressionPtr& coefficient, const ExpressionPtr& emissivity,
                   const ExpressionPtr& ambient, const Translator& translate);
/// Heat from `a` to `b`, W.
void add_link(HeatNetwork& network, const Item& item, const NodeState& a, const NodeState& b, const GiNaC::ex& heat);

}  // namespace dalembert
