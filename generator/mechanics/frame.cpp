// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/frame.hpp"

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

SpaceMatrix product(const SpaceMatrix& a, const SpaceMatrix& b) {
    SpaceMatrix result;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) result[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    return result;
}

SpaceMatrix turned_about(std::size_t axis, const ex& angle) {
    const ex c = GiNaC::cos(angle), s = GiNaC::sin(angle);
    if (axis == 0) return {SpaceVector{1, 0, 0}, SpaceVector{0, c, -s}, SpaceVector{0, s, c}};
    if (axis == 1) return {SpaceVector{c, 0, s}, SpaceVector{0, 1, 0}, SpaceVector{-s, 0, c}};
    return {SpaceVector{c, -s, 0}, SpaceVector{s, c, 0}, SpaceVector{0, 0, 1}};
}

}  // namespace

SpaceVector kept(const SpaceVector& v) {
    const auto one = [](const ex& e) { return GiNaC::is_a<GiNaC::add>(e) ? ex(whole(e)) : e; };
    return {one(v[0]), one(v[1]), one(v[2])};
}

SpaceVector operator+(const SpaceVector& a, const SpaceVector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
SpaceVector operator-(const SpaceVector& a, const SpaceVector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
SpaceVector operator*(const ex& factor, const SpaceVector& v) { return {factor * v[0], factor * v[1], factor * v[2]}; }
SpaceVector operator*(const SpaceMatrix& m, const SpaceVector& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }
SpaceVector cross(const SpaceVector& a, const SpaceVector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
SpaceMatrix transposed(const SpaceMatrix& m) {
    return {SpaceVector{m[0][0], m[1][0], m[2][0]}, SpaceVector{m[0][1], m[1][1], m[2][1]}, SpaceVector{m[0][2], m[1][2], m[2][2]}};
}
SpaceVector time_derivative(const SpaceVector& v, const Symbols& symbols) {
    return {symbols.time_derivative(v[0]), symbols.time_derivative(v[1]), symbols.time_derivative(v[2])};
}
bool is_zero(const SpaceVector& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

SpaceVector Frame::to_ground(SpaceVector v) const {
    for (const Frame* frame = this; frame != nullptr; frame = frame->base.get()) v = frame->axes * (frame == this ? v : kept(v));
    return v;
}

SpaceVector Frame::point_to_ground(SpaceVector p) const {
    for (const Frame* frame = this; frame != nullptr; frame = frame->base.get())
        p = frame->origin + frame->axes * (frame == this ? p : kept(p));
    return p;
}

SpaceVector Frame::from_ground(const SpaceVector& v) const { return transposed(axes) * (base ? kept(base->from_ground(v)) : v); }

Orientation by_turns(const std::vector<std::pair<std::size_t, ex>>& turns, const Symbols& symbols) {
    Orientation result{{SpaceVector{1, 0, 0}, SpaceVector{0, 1, 0}, SpaceVector{0, 0, 1}}, {0, 0, 0}};
    for (const auto& [axis, angle] : turns) {
        const SpaceMatrix turn = turned_about(axis, angle);
        result.axes = product(result.axes, turn);
        result.angular_velocity = transposed(turn) * result.angular_velocity;
        result.angular_velocity[axis] += symbols.time_derivative(angle);
    }
    return result;
}

Orientation by_attitude(const Symbols::AttitudeSymbols& attitude, const Symbols& symbols) {
    const auto e = [&](std::size_t i) { return symbols.get(SymbolKind::state, attitude.parts[i]); };
    const auto square = [&](std::size_t i) { return GiNaC::pow(e(i), 2); };
    Orientation result;
    for (std::size_t i = 1; i <= 3; ++i) {
        const std::size_t j = i % 3 + 1, k = j % 3 + 1;
        result.axes[i - 1][i - 1] = square(0) + square(i) - square(j) - square(k);
        result.axes[i - 1][j - 1] = 2 * (e(i) * e(j) - e(0) * e(k));
        result.axes[j - 1][i - 1] = 2 * (e(i) * e(j) + e(0) * e(k));
        result.angular_velocity[i - 1] = symbols.get(SymbolKind::velocity, attitude.coordinates[i - 1]);
    }
    return result;
}

std::shared_ptr<const Frame> placed(std::shared_ptr<const Frame> base, const Orientation& orientation, const SpaceVector& origin,
                                    const Symbols& symbols) {
    Frame frame{std::move(base), orientation.axes, origin, orientation.angular_velocity, {}};
    SpaceVector velocity = time_derivative(origin, symbols);
    const SpaceMatrix into = transposed(frame.axes);
    if (frame.base) {
        const SpaceVector omega = kept(frame.base->angular_velocity);
        velocity = velocity + kept(frame.base->velocity) + cross(omega, origin);
        frame.angular_velocity = frame.angular_velocity + into * omega;
    }
    frame.velocity = into * (frame.base ? kept(velocity) : velocity);
    return std::make_shared<const Frame>(std::move(frame));
}

}  // namespace dalembert
