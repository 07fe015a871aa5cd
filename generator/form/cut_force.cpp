// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/gravity.hpp"
#include "form/quantities.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// d'Alembert's principle of one body: the inertial force and moment that are left when what acts on it by name is taken off.
struct Remainder {
    SpaceVector force{0, 0, 0};
    SpaceVector moment{0, 0, 0};  ///< about the centre of mass
};

bool is_body(const Reference& reference, const BodyMotion& body, const Scene& scene, const Indices& indices) {
    return reference.name == body.member.item->name &&
           (reference.index ? index_value(*reference.index, scene, indices) : 0) == body.member.index;
}

Remainder remainder(const System& system, const BodyMotion& body) {
    const Symbols& symbols = system.symbols;
    const Scene& scene = system.scene;
    Remainder result;
    if (!body.mass.is_zero()) {
        result.force = body.mass * time_derivative(body.velocity, symbols);
        if (scene.gravity != nullptr) result.force = result.force - body.mass * system.translate(scene.gravity->acceleration, {});
    }
    if (body.has_tensor()) {
        const SpaceVector& omega = body.frame->angular_velocity;
        result.moment = body.frame->to_ground(body.tensor * time_derivative(omega, symbols) + cross(omega, body.tensor * omega));
    } else {
        result.moment[2] = body.inertia * symbols.time_derivative(body.angular_velocity);
    }
    for (const auto& member : scene.forces) {
        const Indices indices = Translator::indices_of(member);
        if (!member.item->on || !is_body(*member.item->on, body, scene, indices)) continue;
        const SpaceVector given = system.translate(member.item->force, indices);
        result.force = result.force - (member.item->in_axes ? body.frame->to_ground(given) : given);
    }
    for (const Ejection& jet : system.ejections) {
        if (jet.body != &body) continue;
        const SpaceVector given = system.translate(jet.member.item->velocity, Translator::indices_of(jet.member));
        result.force = result.force + jet.mass_flow * (jet.member.item->in_axes ? body.frame->to_ground(given) : given);
    }
    for (const auto& member : scene.torques) {
        const Torque& torque = *member.item;
        const Indices indices = Translator::indices_of(member);
        const auto act = [&](const std::optional<Reference>& on, int sign) {
            if (!on || !is_body(*on, body, scene, indices)) return;
            SpaceVector given{0, 0, 0};
            if (torque.torque) given[2] = system.translate(torque.torque, indices);
            else given = system.translate(*torque.vector, indices);
            if (torque.in_axes) {
                const BodyMotion* axes = find_motion(system.bodies, *torque.on, scene, indices);
                given = axes->frame->to_ground(given);
            }
            result.moment = result.moment - ex(sign) * given;
        };
        act(torque.on, 1);
        act(torque.against, -1);
    }
    return result;
}

}  // namespace

ex cut_force(const System& system, const Cut& cut, int index) {
    SpaceVector force{0, 0, 0}, moment{0, 0, 0};
    const Indices indices = Translator::indices_of(Member<Cut>{&cut, index});
    const SpaceVector point = cut.about ? system.translate(*cut.about, indices) : SpaceVector{0, 0, 0};
    for (const Reference& reference : cut.bodies) {
        const BodyMotion* body = find_motion(system.bodies, reference, system.scene, indices);
        if (body == nullptr)
            throw Failure(Diagnostic{Id::needs_absent, reference.span,
                                     fmt::format("scene '{}' has no body '{}'", system.scene.name, std::string(reference.span.text()))});
        const Remainder one = remainder(system, *body);
        force = force + one.force;
        moment = moment + one.moment + cross(body->position - point, one.force);
    }
    return system.with_rates(dot(system.translate(cut.direction, indices), cut.about ? moment : force));
}

}  // namespace dalembert
