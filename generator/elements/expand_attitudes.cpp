// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/bodies.hpp"
#include "elements/element.hpp"
#include "elements/expand_switching.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

/// de/dt = e*(0, omega)/2 with the product of quaternions, omega in the axes of what turns.
void expand(Model& model, const Attitude& attitude) {
    const Element made(model, attitude);
    static constexpr const char* axes[]{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        Coordinate turned = made.make<Coordinate>(made.part(axes[axis]), attitude.when);
        turned.unit.written = "rad";
        turned.quasi_axis = axis;
        turned.start_rate =
            attitude.start_rate.size() == 3 ? attitude.start_rate[static_cast<std::size_t>(axis)] : make_number(0, attitude.span);
        turned.doc = std::string("angle turned about the own ") + axes[axis] + " axis";
        model.coordinates.push_back(std::move(turned));
    }
    const auto e = [&](int part) { return made.name(made.part(std::to_string(part))); };
    const auto omega = [&](int axis) { return rate_of(made.name(made.part(axes[axis - 1]))); };
    const auto half = [&](const ExpressionPtr& sum) { return over(sum, make_number(2, attitude.span)); };
    for (int part = 0; part < 4; ++part) {
        State state = made.make<State>(made.part(std::to_string(part)), attitude.when);
        state.unit.written = "1";
        state.quaternion_part = part;
        state.start =
            attitude.start.size() == 4 ? attitude.start[static_cast<std::size_t>(part)] : make_number(part == 0 ? 1 : 0, attitude.span);
        // 0: -(e1 w1 + e2 w2 + e3 w3); i: e0 wi + ej wk - ek wj with (i, j, k) cyclic
        const int j = part % 3 + 1, k = j % 3 + 1;
        state.derivative = part == 0 ? half(minus(minus(negative(times(e(1), omega(1))), times(e(2), omega(2))), times(e(3), omega(3))))
                                     : half(minus(plus(times(e(0), omega(part)), times(e(j), omega(k))), times(e(k), omega(j))));
        state.doc = part == 0 ? "scalar part of the quaternion" : std::string(axes[part - 1]) + " part of the quaternion";
        model.states.push_back(std::move(state));
    }
}

}  // namespace

void expand_attitudes(Model& model) {
    for (const Attitude& attitude : model.attitudes) expand(model, attitude);
}

}  // namespace dalembert
