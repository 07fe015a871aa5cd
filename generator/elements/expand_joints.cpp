// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/element.hpp"
#include "elements/joints.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

using Law = Joint::Law;

/// What the body has of its own where the joint would bring it, or null.
const char* own_place(const Body& body) {
    if (body.position) return "position";
    if (body.rotation) return "rotation";
    if (body.angular_velocity) return "angular_velocity";
    if (body.origin) return "origin";
    if (body.on) return "on";
    if (body.attitude) return "attitude";
    return body.turns.empty() ? nullptr : "turns";
}

Unit angle_unit() { return {.dimension = Dimension::none(), .written = "rad"}; }
Unit length_unit() { return {.dimension = Dimension::length(), .written = "m"}; }

class Expansion {
public:
    Expansion(Model& model, const Joint& joint, Diagnostics& diagnostics)
        : model_(model), joint_(joint), made_(model, joint), diagnostics_(diagnostics) {}

    void place(Body& body) {
        if (joint_.when) {
            diagnostics_.error(Id::not_allowed_here, joint_.span,
                               fmt::format("joint '{}' places body '{}' and has a 'when'; the body needs its place in every scene",
                                           joint_.name, body.name),
                               {{body.span, "the body is defined here"}});
            return;
        }
        for (const Joint& other : model_.joints)
            if (&other != &joint_ && other.is_expanded && other.body && other.places_body() && other.body->name == body.name) {
                diagnostics_.error(Id::doubly_defined, joint_.span,
                                   fmt::format("joints '{}' and '{}' both place body '{}'", other.name, joint_.name, body.name),
                                   {{other.span, "the other one is defined here"}});
                return;
            }
        if (body.family) {
            diagnostics_.error(Id::not_allowed_here, joint_.span,
                               fmt::format("joint '{}' places one body, but '{}' is a family; give its members 'on', 'origin' and 'turns'",
                                           joint_.name, body.name),
                               {{body.span, "the family is defined here"}});
            return;
        }
        if (const char* own = own_place(body)) {
            diagnostics_.error(Id::doubly_defined, joint_.span,
                               fmt::format("joint '{}' places body '{}', which already has its '{}'", joint_.name, body.name, own),
                               {{body.span, "the body is defined here"}});
            return;
        }
        if (!has_mass(body)) return;
        const ExpressionPtr zero = make_number(0, joint_.span);
        body.on = joint_.on;
        body.origin = joint_.at ? *joint_.at : VectorExpression{zero, zero, zero};
        body.turns = joint_.turns;
        if (joint_.law == Law::revolute)
            body.turns.push_back({joint_.axis, given_or_coordinate(joint_.angle, joint_.name, angle_unit(), body)});
        if (joint_.law == Law::prismatic) slide(body);
        if (joint_.law == Law::universal) {
            body.turns.push_back({0, given_or_coordinate(joint_.angle, made_.part("1"), angle_unit(), body)});
            body.turns.push_back({1, given_or_coordinate(joint_.second_angle, made_.part("2"), angle_unit(), body)});
        }
        if (joint_.law == Law::ball) {
            model_.attitudes.push_back(made_.make<Attitude>(joint_.name, body.when));
            body.attitude = made_.itself();
        }
    }

    void hold() {
        switch (joint_.law) {
            case Law::gear: return hold(joint_.name, joint_.angle, joint_.ratio, joint_.second_angle);
            case Law::rack: return hold(joint_.name, joint_.position, joint_.radius, joint_.angle);
            case Law::cam: return hold(joint_.name, joint_.position, make_number(1, joint_.span), joint_.course);
            case Law::belt:
                if (joint_.radius && joint_.angle && joint_.second_radius && joint_.second_angle)
                    hold(joint_.name, times(joint_.radius, joint_.angle), joint_.second_radius, joint_.second_angle);
                return;
            case Law::wheel: return roll();
            default: return;
        }
    }

private:
    /// What reading asks of other bodies.
    bool has_mass(const Body& body) {
        const auto refuse = [&](Id id, const char* sentence) {
            diagnostics_.error(id, body.span, fmt::format("body '{}', which joint '{}' places, {}", body.name, joint_.name, sentence),
                               {{joint_.span, "the joint is defined here"}});
            return false;
        };
        if (body.inertia) return refuse(Id::wrong_type, "turns in space; its inertia is [Jx, Jy, Jz] or three rows");
        if (body.solid) return true;
        if (!body.mass && body.tensor.empty()) return refuse(Id::missing_key, "has neither mass nor inertia; a body needs one of them");
        if (body.tensor.empty() && joint_.law != Law::prismatic)
            return refuse(Id::missing_key, "turns, but has no inertia; give it one, inertia = [0, 0, 0] if it is a point");
        return true;
    }

    ExpressionPtr given_or_coordinate(const ExpressionPtr& given, const std::string& name, const Unit& unit, const Body& body) {
        if (given) return given;
        Coordinate coordinate = made_.make<Coordinate>(name, body.when);
        coordinate.unit = unit;
        coordinate.start = joint_.start;
        coordinate.doc = joint_.doc;
        model_.coordinates.push_back(std::move(coordinate));
        return made_.name(name);
    }

    /// Along an axis of the joint, whose turns keep their own place: the column of their matrix.
    void slide(Body& body) {
        const ExpressionPtr way = given_or_coordinate(joint_.position, joint_.name, length_unit(), body);
        std::array<ExpressionPtr, 3> along;  // in the axes of `on`
        along[joint_.axis] = way;
        for (auto turn = joint_.turns.rbegin(); turn != joint_.turns.rend(); ++turn) {
            if (!turn->angle) return;
            const std::size_t i = (turn->axis + 1) % 3, j = (turn->axis + 2) % 3;
            const ExpressionPtr c = call_of("cos", turn->angle), s = call_of("sin", turn->angle), a = along[i], b = along[j];
            along[i] = sum(scaled(a, c), b ? negative(times(b, s)) : nullptr);
            along[j] = sum(scaled(a, s), scaled(b, c));
        }
        for (std::size_t k = 0; k < 3; ++k)
            if (along[k]) (*body.origin)[k] = joint_.at && !is_zero((*joint_.at)[k]) ? plus((*joint_.at)[k], along[k]) : along[k];
    }

    static bool is_zero(const ExpressionPtr& e) { return !e || (e->kind == Expression::Kind::number && cln::zerop(e->value)); }
    static ExpressionPtr scaled(const ExpressionPtr& a, const ExpressionPtr& factor) { return a ? times(a, factor) : nullptr; }
    static ExpressionPtr sum(const ExpressionPtr& a, const ExpressionPtr& b) { return !a ? b : !b ? a : plus(a, b); }

    /// left = factor*right
    void hold(const std::string& name, const ExpressionPtr& left, const ExpressionPtr& factor, const ExpressionPtr& right) {
        if (!left || !factor || !right) return;
        Constraint constraint = made_.make<Constraint>(name, joint_.when);
        constraint.position = minus(left, times(factor, right));
        constraint.doc = joint_.doc;
        model_.constraints.push_back(std::move(constraint));
    }

    void hold_rate(const char* name, const ExpressionPtr& rate) {
        Constraint constraint = made_.make<Constraint>(made_.part(name), joint_.when);
        constraint.rate = rate;
        constraint.doc = joint_.doc;
        model_.constraints.push_back(std::move(constraint));
    }

    void roll() {
        if (!joint_.at || !joint_.heading || !joint_.radius || !joint_.angle) return;
        const ExpressionPtr c = call_of("cos", joint_.heading), s = call_of("sin", joint_.heading);
        const ExpressionPtr x = rate_of((*joint_.at)[0]), y = rate_of((*joint_.at)[1]);
        hold_rate("rolls", minus(plus(times(c, x), times(s, y)), times(joint_.radius, rate_of(joint_.angle))));
        if (!joint_.only_rolls) hold_rate("side", minus(times(c, y), times(s, x)));
    }

    Model& model_;
    const Joint& joint_;
    Element made_;
    Diagnostics& diagnostics_;
};

}  // namespace

void expand_joints(Model& model, Diagnostics& diagnostics) {
    for (Joint& joint : model.joints) {
        if (joint.is_expanded) continue;
        Expansion expansion(model, joint, diagnostics);
        if (!joint.places_body()) {
            expansion.hold();
        } else {
            if (!joint.body) continue;  // told where it was read
            const auto body = std::find_if(model.bodies.begin(), model.bodies.end(),
                                           [&](const Body& one) { return one.name == joint.body->name; });
            if (body == model.bodies.end()) continue;
            expansion.place(*body);
        }
        joint.is_expanded = true;
    }
}

}  // namespace dalembert
