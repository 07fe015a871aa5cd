// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/read_mechanics.hpp"

#include <fmt/format.h>

namespace dalembert {

namespace {

std::vector<CoordinateEntry> coordinates(const Entry& e, std::string_view key) {
    std::vector<CoordinateEntry> result;
    for (const RunEntry& entry : e.by_name(key)) {
        const Expression& name = *entry.variable;
        if (name.kind == Expression::Kind::name && name.children.size() <= 1)
            result.push_back({name.name, name.children.empty() ? nullptr : name.children[0], entry.value, entry.span});
        else
            e.error(Id::wrong_type, entry.span, fmt::format("'{}' is not the name of a coordinate", name.written()));
    }
    return result;
}

/// A body that turns and has a mass has an inertia, too, even if it is zero: forgotten, the body would swing like a point.
void needs_inertia(const Entry& e, const char* turning, const char* of_a_point) {
    if (!e.has(turning) || !e.has("mass") || e.has("inertia") || e.has("solid")) return;
    e.error(Id::missing_key, e.span_of(turning), fmt::format("body '{}' has a mass and turns, but has no inertia, so that it would move like a point; give it one, inertia = {} if it is a point, or leave out '{}'", e.name(), of_a_point, turning));
}

/// What has axes of its own.
void in_space(const Entry& e, const Body& body) {
    const auto both = [&](const char* a, const char* b, const char* why) {
        if (e.has(a) && e.has(b)) e.error(Id::doubly_defined, e.span_of(b), fmt::format("body '{}' has both '{}' and '{}'; {}", e.name(), a, b, why), {{e.span_of(a), "the first stands here"}});
    };
    both("turns", "attitude", "either orients it alone");
    both("position", "origin", "the position is that of its centre of mass");
    both("position", "centre", "the position is that of its centre of mass");
    for (const char* planar : {"rotation", "angular_velocity"})
        if (e.has(planar)) e.error(Id::not_allowed_here, e.span_of(planar), fmt::format("body '{}' turns in space; its orientation is given by 'turns' or by an 'attitude'", e.name()));
    if (body.inertia) e.error(Id::wrong_type, e.span_of("inertia"), fmt::format("the inertia of body '{}', which turns in space, is [Jx, Jy, Jz] or three rows", e.name()));
    const bool turns = e.has("turns") || e.has("attitude") || e.has("on");
    if (!body.tensor.empty() && !turns) e.error(Id::missing_key, e.span_of("inertia"), fmt::format("body '{}' has an inertia but neither turns nor an attitude", e.name()));
    needs_inertia(e, "turns", "[0, 0, 0]");
    needs_inertia(e, "attitude", "[0, 0, 0]");
}

}  // namespace

void read(const Entry& e, Attitude& attitude) {
    attitude.start = e.expressions("start");
    attitude.start_rate = e.expressions("start_rate");
    const auto has = [&](const std::vector<ExpressionPtr>& values, const char* key, std::size_t count, const char* what) {
        if (!values.empty() && values.size() != count) e.error(Id::wrong_type, e.span_of(key), fmt::format("{} of attitude '{}' has {} numbers, not {}", what, e.name(), count, values.size()));
    };
    has(attitude.start, "start", 4, "the quaternion");
    has(attitude.start_rate, "start_rate", 3, "the angular velocity");
}

void read(const Entry& e, Body& body) {
    body.mass = e.expression("mass");
    body.position = e.vector("position");
    body.rotation = e.expression("rotation");
    body.angular_velocity = e.expression("angular_velocity");
    body.tensor = e.tensor("inertia");
    if (body.tensor.size() == 1 && body.tensor[0].size() == 1) {
        body.inertia = body.tensor[0][0];
        body.tensor.clear();
    }
    body.turns = e.turns("turns");
    body.attitude = e.part("attitude");
    body.origin = e.vector("origin");
    body.centre = e.vector("centre");
    body.on = e.body("on");
    body.solid = e.part("solid");
    for (const char* key : {"mass", "inertia", "centre"})
        if (body.solid && e.has(key))
            e.error(Id::doubly_defined, e.span_of(key), fmt::format("body '{}' has a solid and a {}; the solid brings its {}", e.name(), key, key), {{e.span_of("solid"), "the solid stands here"}});
    if (body.has_axes()) return in_space(e, body);
    if (e.has("mass") && !e.has("position")) e.error(Id::missing_key, e.span(), fmt::format("body '{}' has a mass but no position", e.name()));
    if (!e.has("mass") && !e.has("inertia") && !body.solid)
        e.error(Id::missing_key, e.span(), fmt::format("body '{}' has neither mass nor inertia; without either it is no body", e.name()));
    if (e.has("rotation") && e.has("angular_velocity"))
        e.error(Id::doubly_defined, e.span_of("angular_velocity"),
                fmt::format("body '{}' has a rotation and an angular_velocity; the velocity follows from the rotation", e.name()),
                {{e.span_of("rotation"), "the rotation stands here"}});
    if (e.has("inertia") && !e.has("rotation") && !e.has("angular_velocity"))
        e.error(Id::missing_key, e.span_of("inertia"),
                fmt::format("body '{}' has an inertia but neither rotation nor angular_velocity", e.name()));
    needs_inertia(e, "rotation", "0");
    needs_inertia(e, "angular_velocity", "0");
}

void read(const Entry& e, Spring& spring) {
    spring.elongation = e.expression("elongation");
    spring.stiffness = e.expression("stiffness");
    spring.force = e.law("force");
    spring.energy = e.law("energy");
    if (e.has("stiffness") == e.has("force"))
        e.error(Id::missing_key, e.span(), fmt::format("spring '{}' needs either a stiffness or a force law, and not both", e.name()));
    if (e.has("energy") && !e.has("force"))
        e.error(Id::missing_key, e.span_of("energy"), fmt::format("spring '{}' has an energy but no force law that it belongs to", e.name()));
}

void read(const Entry& e, Damper& damper) {
    damper.rate = e.expression("rate");
    damper.on = e.body("on");
    damper.coefficient = e.expression("coefficient");
    damper.force = e.law("force");
    if (e.has("rate") == e.has("on"))
        e.error(Id::missing_key, e.span(), fmt::format("damper '{}' needs either a rate or the body that it acts on", e.name()));
    if (e.has("coefficient") == e.has("force"))
        e.error(Id::missing_key, e.span(), fmt::format("damper '{}' needs either a coefficient or a force law", e.name()));
}

void read(const Entry& e, Force& force) {
    if (auto vector = e.vector("force")) force.force = *vector;
    force.on = e.body("on");
    force.at = e.vector("at");
    force.in_axes = e.boolean("in_axes");
    if (force.in_axes && !force.on) e.error(Id::missing_key, e.span_of("in_axes"), fmt::format("force '{}' acts on no body whose axes could be meant", e.name()));
    if (e.has("on") == e.has("at"))
        e.error(Id::missing_key, e.span(), fmt::format("force '{}' needs either the body that it acts on or the point at which it acts", e.name()));
}

void read(const Entry& e, Torque& torque) {
    if (e.is_list("torque")) torque.vector = e.vector("torque");
    else torque.torque = e.expression("torque");
    torque.in_axes = e.boolean("in_axes");
    torque.on = e.body("on");
    torque.against = e.body("against");
    torque.rate = e.expression("rate");
    if (e.has("on") == e.has("rate"))
        e.error(Id::missing_key, e.span(), fmt::format("torque '{}' needs either the body that it turns or a rate", e.name()));
    if (torque.vector && torque.rate) e.error(Id::wrong_type, e.span_of("torque"), fmt::format("torque '{}' works along a rate, so that it is no vector", e.name()));
    if (torque.in_axes && !torque.vector) e.error(Id::not_allowed_here, e.span_of("in_axes"), fmt::format("torque '{}' is no vector, so that it is in no axes", e.name()));
}

void read(const Entry& e, Jet& jet) {
    if (const auto from = e.body("from")) jet.from = *from;
    jet.mass_flow = e.expression("mass_flow");
    if (auto velocity = e.vector("velocity")) jet.velocity = *velocity;
    jet.in_axes = e.boolean("in_axes");
}

void read(const Entry& e, Cut& cut) {
    cut.bodies = e.parts("bodies");
    if (auto direction = e.vector("direction")) cut.direction = *direction;
    cut.about = e.vector("about");
    if (e.has("bodies") && cut.bodies.empty()) e.error(Id::missing_key, e.span_of("bodies"), fmt::format("cut '{}' frees no body", e.name()));
}

void read(const Entry& e, KineticTerm& term) { term.energy = e.expression("energy"); }

void read(const Entry& e, PotentialTerm& term) {
    term.energy = e.expression("energy");
    term.forces = coordinates(e, "forces");
    term.reference = coordinates(e, "reference");
    if (e.has("energy") == e.has("forces"))
        e.error(Id::missing_key, e.span(), fmt::format("potential '{}' needs either an energy or its forces", e.name()));
    if (e.has("reference") && !e.has("forces"))
        e.error(Id::missing_key, e.span_of("reference"), fmt::format("potential '{}' has a reference but no forces", e.name()));
}

void read(const Entry& e, GeneralisedForce& force) {
    if (auto coordinate = e.coordinate("coordinate")) force.coordinate = *coordinate;
    force.coordinate.value = e.expression("force");
    const std::string power = e.text("power");
    force.dissipated = power == "dissipated";
    if (!power.empty() && power != "dissipated" && power != "supplied")
        e.error(Id::wrong_type, e.span_of("power"), fmt::format("the power is 'supplied' or 'dissipated', not '{}'", power));
}

}  // namespace dalembert
