// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "form/linear_system.hpp"
#include "form/quantities.hpp"
#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "language/vocabulary.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

const BodyMotion& body(const System& system, const Expression& reference, const Indices& indices) {
    const Reference named{reference.name, reference.children.empty() ? nullptr : reference.children[0], reference.span};
    if (const BodyMotion* motion = find_motion(system.bodies, named, system.scene, indices)) return *motion;
    const bool left_out = !system.scene.holds(system.names.find_element<Body>(reference.name)->when);
    throw Failure(Diagnostic{left_out ? Id::needs_absent : Id::index_out_of_range, reference.span,
                             fmt::format("scene '{}' has no body '{}'", system.scene.name, reference.written())});
}

std::size_t coordinate(const System& system, const Expression& reference, const Indices& indices) {
    return system.translate.coordinate(reference.name, reference.children.empty() ? nullptr : reference.children[0].get(), reference.span,
                                       indices);
}

ex component(const SpaceVector& vector, const System& system, const Expression& index, const Indices& indices) {
    return vector[axis_place(system, index, indices)];
}

/// A component in the axes of the ground of a body's own axis.
ex axis(const System& system, const Expression& e, const Indices& indices) {
    const BodyMotion& of = body(system, *e.children[0], indices);
    if (!of.frame && of.turns && !of.has_rotation)
        throw Failure(
            Diagnostic{Id::needs_absent, e.span,
                       fmt::format("body '{}' has an angular velocity but no rotation, so its axes are not known", of.member.name())});
    SpaceVector own{0, 0, 0};
    own[axis_place(system, *e.children[1], indices)] = 1;
    return component(frame_of(of, system.symbols)->to_ground(own), system, *e.children[2], indices);
}

SpaceVector own_angular_velocity(const BodyMotion& body) {
    return body.frame ? body.frame->angular_velocity : SpaceVector{0, 0, body.angular_velocity};
}

SpaceVector angular_momentum(const BodyMotion& body) {
    if (body.frame) return body.frame->to_ground(body.tensor * body.frame->angular_velocity);
    return {0, 0, body.inertia * body.angular_velocity};
}

/// (3.40)-(3.42), (3.31), (3.37) and the like at a pressure and a temperature.
ex property_of_medium(const MediumModel& medium, const Expression& e, const ex& p, const ex& T) {
    const MediumState& law = medium.law();
    const auto at = [&](const ex& value) {
        return value.subs(GiNaC::lst{medium.p() == p, medium.T() == T}, GiNaC::subs_options::no_pattern);
    };
    const MediumState state = medium.at_pressure(p, T);
    if (e.name == "density") return state.density;
    if (e.name == "specific_energy") return state.energy;
    if (e.name == "specific_enthalpy") return state.enthalpy;
    if (e.name == "isochoric_heat") return state.isochoric_heat;
    if (e.name == "isobaric_heat") return at(partial(law.enthalpy, medium.T()));
    if (e.name == "expansion") return at(-partial(law.density, medium.T()) / law.density);
    if (!medium.is_compressible())
        throw Failure(Diagnostic{Id::wrong_medium, e.span,
                                 fmt::format("'{}' has no value: medium '{}' is incompressible", e.written(), medium.item().name)});
    if (e.name == "bulk_modulus") return at(law.density / partial(law.density, medium.p()));
    return state.pressure_by_temperature / p;
}

/// What a loop adds up, which outputs alone can ask for.
ex over_cells(const System& system, const CellField& field, const CellRange& cells, const ex& term, const Expression& e) {
    if (term.is_zero()) return 0;
    if (system.sum_over_cells) return system.sum_over_cells(field, cells, term, e);
    throw Failure(Diagnostic{Id::not_allowed_here,
                             e.span,
                             fmt::format("'{}' is a sum over {} cells of {}, which a loop computes; use it in an output, or give the {} "
                                         "loops = false or fewer cells",
                                         e.written(), cells.count(), field.written(), field.kind),
                             {{field.body->span, fmt::format("the {} is defined here", field.kind)}}});
}

/// Of a node, a link, a cell of a rod or block, or its border.
std::optional<ex> heat_quantity(const System& system, const Expression& e, const std::string& name) {
    if (const LinkState* link = system.heat.find_link(name)) return link->heat;
    if (const BorderState* border = system.heat.find_border(name)) {
        ex heat = border->heat;
        for (const CellField& field : system.heat.fields)
            for (const SideLaw& side : field.sides)
                if (side.border == name) heat += over_cells(system, field, side.cells, side.heat, e);
        return heat;
    }
    const NodeState* node = system.heat.find_node(name);
    if (node == nullptr) return std::nullopt;
    if (e.name == "temperature") return node->warmth.temperature;
    return e.name == "heat" ? system.heat.heat_into(*node) : node->stored_energy;
}

/// Of a pin or branch.
std::optional<ex> circuit_quantity(const System& system, const Expression& e, const std::string& name) {
    if (e.name == "voltage")
        if (const PinState* pin = system.circuit.find_pin(name)) return pin->potential;
    const BranchState* branch = system.circuit.find_branch(name);
    if (branch == nullptr) return std::nullopt;
    if (e.name == "voltage") return branch->voltage();
    if (e.name == "current") return branch->current;
    return e.name == "dissipated_power" ? branch->dissipated_power() : branch->stored_energy;
}

/// Of surfaces of an enclosure, counted from 1.
ex surface_quantity(const System& system, const Expression& e, const Indices& indices) {
    const Expression& named = *e.children[0];
    for (const EnclosureState& enclosure : system.heat.enclosures) {
        if (enclosure.name != named.name) continue;
        const auto surface = [&](std::size_t child) {
            const int number = index_value(*e.children[child], system.scene, indices);
            if (number >= 1 && static_cast<std::size_t>(number) <= enclosure.nodes.size()) return static_cast<std::size_t>(number - 1);
            throw Failure(
                Diagnostic{Id::index_out_of_range, e.children[child]->span,
                           fmt::format("enclosure '{}' has the surfaces 1 to {}, not {}", enclosure.name, enclosure.nodes.size(), number)});
        };
        const std::size_t i = surface(1);
        if (e.name == "radiosity") return enclosure.radiosity(i);
        if (e.name == "irradiation") return enclosure.irradiation(i);
        const std::size_t j = surface(2);
        return e.name == "view_factor" ? enclosure.view_factors[i][j] : enclosure.radiation.exchange[i][j];
    }
    throw Failure(Diagnostic{Id::needs_absent, named.span, fmt::format("scene '{}' has no '{}'", system.scene.name, named.written())});
}

/// What cells in loops store or take up.
ex over_cells(const System& system, const Expression& e) {
    ex sum = 0;
    for (const CellField& field : system.heat.fields) {
        const bool is_power = e.name == "exchanged_power";
        for (const CellLaw& law : field.laws) sum += over_cells(system, field, law.cells, is_power ? law.source : law.energy, e);
        for (const SideLaw& side : field.sides)
            if (is_power) sum += over_cells(system, field, side.cells, side.heat, e);
    }
    return sum;
}

/// A property of a volume or reservoir, of a medium at a state, or what a flow or volume does.
std::optional<ex> fluid_quantity(const System& system, const Expression& e, const Indices& indices, const std::vector<ex>& arguments) {
    const Fluids& fluids = system.fluids;
    if (e.name == "exchanged_power" || (e.name == "internal_energy" && e.children.empty())) {
        return over_cells(system, e) + (e.name == "exchanged_power" ? system.exchanged_power : system.internal_energy);
    }
    const QuantitySpec& spec = *find_quantity(e.name);
    if (spec.subscript < Subscript::fluid) return std::nullopt;
    const Expression& named = *e.children[0];
    const auto absent = [&](const Expression& part) {
        const bool left_out = !system.scene.holds(system.names.find_element(part.name, kinds_of_first(spec, e.children.size())).item->when);
        return Failure(Diagnostic{left_out || part.children.empty() ? Id::needs_absent : Id::index_out_of_range, part.span,
                                  fmt::format("scene '{}' has no '{}'", system.scene.name, part.written())});
    };
    if (e.children.size() == 3) {
        const MediumModel* medium = fluids.containers.find_medium(named.name);
        if (medium == nullptr) throw absent(named);
        return property_of_medium(*medium, e, arguments[1], arguments[2]);
    }
    const int index = named.children.empty() ? 0 : index_value(*named.children[0], system.scene, indices);
    const std::string whole_name = named.children.empty() ? named.name : fmt::format("{}[{}]", named.name, index);
    if (const auto of_heat = heat_quantity(system, e, whole_name)) return *of_heat;
    if (const auto of_circuit = circuit_quantity(system, e, whole_name)) return *of_circuit;
    if (spec.subscript >= Subscript::branch) throw absent(named);
    if (spec.subscript == Subscript::flow) {
        const FlowState* flow = fluids.find_flow(named.name, index);
        if (flow == nullptr) throw absent(named);
        if (e.name == "mass_flow") return flow->mass_flow;
        if (e.name == "volume_flow") return flow->mass_flow / flow->density;
        return flow->shaft_power;
    }
    const ControlVolume* volume = fluids.containers.find_volume(named.name, index);
    const ReservoirState* reservoir = fluids.containers.find_reservoir(named.name, index);
    const JunctionState* junction = fluids.containers.find_junction(named.name, index);
    if (volume == nullptr && reservoir == nullptr && junction == nullptr) throw absent(named);
    const FluidState& fluid = volume != nullptr ? volume->fluid : reservoir != nullptr ? reservoir->fluid : junction->fluid;
    if (e.name == "pressure") return fluid.pressure;
    if (e.name == "density") return fluid.density;
    if (e.name == "specific_energy") return fluid.energy;
    if (e.name == "specific_enthalpy") return fluid.enthalpy;
    if (e.name == "temperature") {
        if (fluid.temperature) return *fluid.temperature;
        throw Failure(
            Diagnostic{Id::needs_absent, e.span, fmt::format("scene '{}' gives '{}' no temperature", system.scene.name, named.written())});
    }
    if (e.name == "inflow") {
        ex sum = 0;
        for (const FlowState& f : fluids.flows) sum += (f.to == &fluid ? f.mass_flow : ex(0)) - (f.from == &fluid ? f.mass_flow : ex(0));
        return sum;
    }
    if (e.name == "surplus") {
        ex sum = 0;
        for (const FlowState& f : fluids.flows)
            sum += (f.to_volume == volume ? f.mass_flow : ex(0)) - (f.from_volume == volume ? f.demand : ex(0));
        return sum;
    }
    const VolumeBalance* balance = nullptr;
    for (std::size_t i = 0; i < fluids.balances.size(); ++i)
        if (&fluids.containers.volumes[i] == volume) balance = &fluids.balances[i];
    if (e.name == "mass") return volume->mass();
    if (e.name == "volume") return volume->size;
    if (e.name == "heat") return balance->heat;
    return volume->stored_energy();
}

}  // namespace

std::size_t axis_place(const System& system, const Expression& index, const Indices& indices) {
    const int i = index_value(index, system.scene, indices);
    if (i >= 1 && i <= 3) return static_cast<std::size_t>(i - 1);
    throw Failure(Diagnostic{Id::index_out_of_range, index.span, fmt::format("the axes are 1, 2 and 3, not {}", i)});
}

ex quantity(const System& system, const Expression& e, const Indices& indices, const std::vector<ex>& arguments) {
    if (const auto of_statics = statics_quantity(system, e, indices)) return *of_statics;
    if (const auto of_fluid = fluid_quantity(system, e, indices, arguments)) return *of_fluid;
    const Subscript subscript = find_quantity(e.name)->subscript;
    if (subscript == Subscript::surface || subscript == Subscript::two_surfaces) return surface_quantity(system, e, indices);
    const auto child = [&](std::size_t i) -> const Expression& { return *e.children[i]; };
    if (subscript == Subscript::body_and_line || subscript == Subscript::body_and_three_lines) {
        std::vector<std::size_t> lines;
        for (std::size_t i = 1; i < e.children.size(); ++i) lines.push_back(coordinate(system, child(i), indices));
        return curvilinear_quantity(system, e, body(system, child(0), indices), lines);
    }
    if (e.name == "kinetic_energy") {
        if (e.children.empty()) return system.kinetic_energy;
        const BodyMotion& motion = body(system, child(0), indices);
        return translational_energy(motion) + rotational_energy(motion);
    }
    if (e.name == "translational_energy") return translational_energy(body(system, child(0), indices));
    if (e.name == "rotational_energy") return rotational_energy(body(system, child(0), indices));
    if (e.name == "potential_energy") return system.potential_energy;
    if (e.name == "supplied_power") return system.supplied_power;
    if (e.name == "dissipated_power") {
        if (e.children.empty()) return system.dissipated_power;
        const int index = child(0).children.empty() ? 0 : index_value(*child(0).children[0], system.scene, indices);
        if (system.names.find_element<Branch>(child(0).name) != nullptr) {
            const auto of_branch =
                circuit_quantity(system, e, child(0).children.empty() ? child(0).name : fmt::format("{}[{}]", child(0).name, index));
            if (of_branch) return *of_branch;
            throw Failure(Diagnostic{Id::needs_absent, child(0).span,
                                     fmt::format("scene '{}' has no branch '{}'", system.scene.name, child(0).written())});
        }
        const Friction* friction = system.names.find_element<Friction>(child(0).name);
        ex sum = 0;
        bool any = false;
        for (std::size_t i = 0; i < system.scene.dampers.size(); ++i) {
            const Damper& damper = *system.scene.dampers[i].item;
            // Dry friction slides by dampers of its own, at its place.
            const bool is_friction =
                friction != nullptr && damper.span.begin == friction->span.begin && damper.span.end == friction->span.end;
            if (!is_friction && (damper.name != child(0).name || system.scene.dampers[i].index != index)) continue;
            sum += system.resistances[i].power;
            any = true;
        }
        if (any) return sum;
        // In another mode it is there.
        const std::optional<Condition>& when =
            friction != nullptr ? friction->when : system.names.find_element<Damper>(child(0).name)->when;
        for (std::size_t mode = 0; mode < system.scene.modes.size(); ++mode)
            if (system.scene.holds(when, mode)) return 0;
        const bool left_out = !system.scene.holds(when);
        throw Failure(Diagnostic{left_out ? Id::needs_absent : Id::index_out_of_range, child(0).span,
                                 fmt::format("scene '{}' has no damper '{}'", system.scene.name, child(0).written())});
    }
    if (e.name == "constraint_force") {
        const int index = system.translate.member_index(child(0), *system.names.find_element<Constraint>(child(0).name), indices);
        for (const ConstraintEquation& constraint : system.constraints)
            if (constraint.item->name == child(0).name && constraint.index == index) return constraint.force;
        throw Failure(Diagnostic{Id::needs_absent, child(0).span,
                                 fmt::format("scene '{}' has no constraint '{}'", system.scene.name, child(0).written())});
    }
    if (e.name == "cut_force") {
        const Cut& cut = *system.names.find_element<Cut>(child(0).name);
        const int index = system.translate.member_index(child(0), cut, indices);
        if (system.scene.holds(cut.when)) return cut_force(system, cut, index);
        throw Failure(Diagnostic{Id::needs_absent, child(0).span, fmt::format("scene '{}' has no cut '{}'", system.scene.name, cut.name)});
    }
    if (e.name == "angular_velocity") return component(own_angular_velocity(body(system, child(0), indices)), system, child(1), indices);
    if (e.name == "spin") return component(angular_momentum(body(system, child(0), indices)), system, child(1), indices);
    if (e.name == "axis") return axis(system, e, indices);
    if (e.name == "prescribed_power") return system.prescribed_power;
    if (e.name == "position") return component(body(system, child(0), indices).position, system, child(1), indices);
    if (e.name == "velocity") return component(body(system, child(0), indices).velocity, system, child(1), indices);
    if (e.name == "generalised_force" || e.name == "nonpotential_force" || e.name == "bias") {
        const std::size_t j = coordinate(system, child(0), indices);
        if (e.name == "bias") return system.bias[j];
        const ex nonpotential = system.supplied[j] + system.dissipative[j] + system.fluids.force[j] + system.circuit.force[j];
        return e.name == "nonpotential_force" ? nonpotential : nonpotential + system.gravity[j] + system.elastic[j];
    }
    if (subscript == Subscript::two_coordinates) {
        const std::size_t i = coordinate(system, child(0), indices), j = coordinate(system, child(1), indices);
        if (e.name == "damping_matrix") return damping_entry(system, i, j);
        if (e.name == "stiffness_matrix") return stiffness_entry(system, i, j);
        return system.mass(static_cast<unsigned>(i), static_cast<unsigned>(j));
    }
    throw Failure(Diagnostic{Id::unknown_name, e.span, fmt::format("'{}' has no meaning here", e.written())});
}

}  // namespace dalembert
