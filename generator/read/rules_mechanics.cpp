// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "read/rules.hpp"

namespace dalembert {

namespace {

/// A body that turns and has a mass has an inertia, too, even if it is zero: forgotten, the body would swing like a point.
void needs_inertia(const Entry& e, const char* turning, const char* of_a_point) {
    if (!e.has(turning) || !e.has("mass") || e.has("inertia") || e.has("solid")) return;
    e.error(Id::missing_key, e.span_of(turning),
            fmt::format("body '{}' has a mass and turns, but has no inertia; give it one, inertia = {} if it is a point, or leave out '{}'",
                        e.name(), of_a_point, turning));
}

/// What has axes of its own.
void in_space(const Entry& e, const Body& body) {
    for (const char* planar : {"rotation", "angular_velocity"})
        if (e.has(planar))
            e.error(Id::not_allowed_here, e.span_of(planar),
                    fmt::format("body '{}' turns in space; its orientation is given by 'turns' or by an 'attitude'", e.name()));
    if (body.inertia)
        e.error(Id::wrong_type, e.span_of("inertia"),
                fmt::format("the inertia of body '{}', which turns in space, is [Jx, Jy, Jz] or three rows", e.name()));
    const bool turns = e.has("turns") || e.has("attitude") || e.has("on");
    if (!body.tensor.empty() && !turns)
        e.error(Id::missing_key, e.span_of("inertia"), fmt::format("body '{}' has an inertia but neither turns nor an attitude", e.name()));
    needs_inertia(e, "turns", "[0, 0, 0]");
    needs_inertia(e, "attitude", "[0, 0, 0]");
}

}  // namespace

void check_rules(const Entry& e, Coordinate& coordinate) {
    coordinate.is_guess = e.has("guess");
    if (!coordinate.guess.empty()) coordinate.start = std::move(coordinate.guess);
}

void check_rules(const Entry& e, Attitude& attitude) {
    const auto has = [&](const std::vector<ExpressionPtr>& values, const char* key, std::size_t count, const char* what) {
        if (values.empty() || values.size() == count) return;
        e.error(Id::wrong_type, e.span_of(key),
                fmt::format("{} of attitude '{}' has {} numbers, not {}", what, e.name(), count, values.size()));
    };
    has(attitude.start, "start", 4, "the quaternion");
    has(attitude.start_rate, "start_rate", 3, "the angular velocity");
}

void check_rules(const Entry& e, Body& body) {
    if (body.is_jointed) return;  // checked with its joint
    if (body.has_axes()) return in_space(e, body);
    if (e.has("mass") && !e.has("position"))
        e.error(Id::missing_key, e.span(), fmt::format("body '{}' has a mass but no position", e.name()));
    if (!e.has("mass") && !e.has("inertia") && !body.solid)
        e.error(Id::missing_key, e.span(), fmt::format("body '{}' has neither mass nor inertia; a body needs one of them", e.name()));
    if (e.has("inertia") && !e.has("rotation") && !e.has("angular_velocity"))
        e.error(Id::missing_key, e.span_of("inertia"),
                fmt::format("body '{}' has an inertia but neither rotation nor angular_velocity", e.name()));
    needs_inertia(e, "rotation", "0");
    needs_inertia(e, "angular_velocity", "0");
}

void check_rules(const Entry& e, Torque& torque) {
    if (torque.vector && torque.rate)
        e.error(Id::wrong_type, e.span_of("torque"),
                fmt::format("torque '{}' acts along a rate, so it is one expression and no vector", e.name()));
    if (torque.in_axes && !torque.vector)
        e.error(Id::not_allowed_here, e.span_of("in_axes"),
                fmt::format("torque '{}' is one expression and no vector, so it has no axes", e.name()));
}

void check_rules(const Entry& e, Cut& cut) {
    if (e.has("bodies") && cut.bodies.empty())
        e.error(Id::missing_key, e.span_of("bodies"), fmt::format("cut '{}' frees no body", e.name()));
}

}  // namespace dalembert
