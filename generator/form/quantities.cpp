// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "form/system.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

const BodyMotion& body(const System& system, const Expression& reference, const Indices& indices) {
    const BodyReference named{reference.name, reference.children.empty() ? nullptr : reference.children[0], reference.span};
    if (const BodyMotion* motion = find_motion(system.bodies, named, system.scene, indices)) return *motion;
    const bool left_out = !system.scene.holds(system.names.find_body(reference.name)->when);
    throw Failure(Diagnostic{left_out ? Id::needs_absent : Id::index_out_of_range, reference.span, fmt::format("scene '{}' has no body '{}'", system.scene.name, reference.written())});
}

std::size_t coordinate(const System& system, const Expression& reference, const Indices& indices) {
    return system.translate.coordinate(reference.name, reference.children.empty() ? nullptr : reference.children[0].get(), reference.span, indices);
}

const ex& component(const SpaceVector& vector, const System& system, const Expression& index, const Indices& indices) {
    const int i = index_value(index, system.scene, indices);
    if (i >= 1 && i <= 3) return vector[static_cast<std::size_t>(i - 1)];
    throw Failure(Diagnostic{Id::index_out_of_range, index.span, fmt::format("a vector has the components 1, 2 and 3, not {}", i)});
}

}  // namespace

ex quantity(const System& system, const Expression& e, const Indices& indices) {
    const auto child = [&](std::size_t i) -> const Expression& { return *e.children[i]; };
    if (e.name == "kinetic_energy") {
        if (e.children.empty()) return system.kinetic_energy;
        const BodyMotion& motion = body(system, child(0), indices);
        return translational_energy(motion) + rotational_energy(motion);
    }
    if (e.name == "translational_energy") return translational_energy(body(system, child(0), indices));
    if (e.name == "rotational_energy") return rotational_energy(body(system, child(0), indices));
    if (e.name == "potential_energy") return system.potential_energy;
    if (e.name == "supplied_power") return system.supplied_power;
    if (e.name == "dissipated_power") return system.dissipated_power;
    if (e.name == "prescribed_power") return system.prescribed_power;
    if (e.name == "position") return component(body(system, child(0), indices).position, system, child(1), indices);
    if (e.name == "velocity") return component(body(system, child(0), indices).velocity, system, child(1), indices);
    if (e.name == "generalised_force" || e.name == "nonpotential_force" || e.name == "bias") {
        const std::size_t j = coordinate(system, child(0), indices);
        if (e.name == "bias") return system.bias[j];
        const ex nonpotential = system.supplied[j] + system.dissipative[j];
        return e.name == "nonpotential_force" ? nonpotential : nonpotential + system.gravity[j] + system.elastic[j];
    }
    if (e.name == "mass_matrix")
        return system.mass(static_cast<unsigned>(coordinate(system, child(0), indices)), static_cast<unsigned>(coordinate(system, child(1), indices)));
    throw Failure(Diagnostic{Id::unknown_name, e.span, fmt::format("'{}' has no meaning here", e.written())});
}

}  // namespace dalembert
