// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/model.hpp"
#include "mechanics/forces.hpp"
#include "symbolic/curve_dissipation.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/parts.hpp"
#include "symbolic/ranges.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

Generalised slopes_of_power(const SpaceVector& force, const SpaceVector& velocity, const Symbols& symbols) {
    const LettersInside moving = letters_in(GiNaC::lst{velocity[0], velocity[1], velocity[2]});
    Generalised result;
    for (const Variable& qd : symbols.all(SymbolKind::velocity))
        result.push_back(moving.contains(qd.symbol) ? dot(force, partial_of_kept(velocity, qd.symbol)) : ex(0));
    return result;
}

namespace {

/// Without generalised forces; what of the power is there at rest is put in by moving parts.
Supply of_power(std::string name, const ex& power, const Symbols& symbols) {
    GiNaC::exmap still;
    for (const Variable& qd : symbols.all(SymbolKind::velocity)) still[qd.symbol] = 0;
    return {std::move(name), {}, power, -WithLetters(std::move(still))(power)};
}

}  // namespace

Supply along_velocity(std::string name, const SpaceVector& force, const SpaceVector& velocity, const Symbols& symbols) {
    Supply result = of_power(std::move(name), dot(force, velocity), symbols);
    for (const Variable& qd : symbols.all(SymbolKind::velocity)) result.force.push_back(dot(force, partial(velocity, qd.symbol)));
    return result;
}

const BodyMotion& body_of(const Reference& reference, const std::vector<BodyMotion>& bodies, const Scene& scene, const Indices& indices) {
    if (const BodyMotion* body = find_motion(bodies, reference, scene, indices)) return *body;
    throw Failure(
        Diagnostic{Id::index_out_of_range, reference.span, fmt::format("there is no body '{}'", std::string(reference.span.text()))});
}

SpaceVector in_used_axes_of(const BodyMotion& body, const SpaceVector& given, bool in_axes, const Span& place, const std::string& what) {
    if (in_axes && !body.frame)
        throw Failure(
            Diagnostic{Id::not_allowed_here, place,
                       fmt::format("{} is given in the axes of body '{}', which has none: it has no 'turns', 'attitude' or 'origin'", what,
                                   body.member.name())});
    if (!body.frame) return given;
    if (!in_axes) return body.in_used_axes(given);
    return body.is_seen_from_ground ? body.frame->to_ground(given) : given;
}

namespace {

/// A linear rate w = A qd + b resisted by f: Q = -A' f, dissipated f w; f b of that is put in by what moves in a prescribed way.
void resist(Resistance& resistance, const AffineRate& rate, const ex& force, const ex& speed) {
    for (std::size_t j = 0; j < rate.jacobian.size(); ++j) resistance.force[j] -= rate.jacobian[j] * force;
    resistance.power += force * speed;
    resistance.prescribed += force * rate.drift;
}

/// Measured points that show that a damper would drive.
void refuse_driving(const ex& power, const Damper& damper, const Translator& translate) {
    if (translate.scene().model->curves.empty()) return;
    const auto found = dissipation_by_curve(power, declared_bounds(translate));
    if (!found || !found->against) return;
    const Curve& curve = *translate.names().find_element<Curve>(found->name);
    const Rational at = *found->against, value = cln::rational(found->curve->at(0, at));
    throw Failure(Diagnostic{Id::value_out_of_range,
                             damper.span,
                             fmt::format("damper '{}' must resist its rate, but it drives where its curve '{}' is {} at {} = {}; {}",
                                         damper.name, curve.name, written_in(value, curve.unit), curve.variable, written_in(at, curve.of),
                                         found->is_of_rate ? "the force of a damper is zero at rest and has the sign of its rate elsewhere"
                                                           : "the coefficient of a damper is not negative"),
                             {{curve.span, "the curve is defined here"}}});
}

ex damper_law(const Damper& damper, const ex& rate, const Translator& translate, Symbols& symbols, const Indices& indices) {
    if (damper.coefficient) return translate(damper.coefficient, indices) * rate;
    const ex letter = symbols.letter(damper.force->variable);
    return translate(*damper.force->body, indices, {{damper.force->variable, letter}}).subs(letter == rate);
}

/// Resistance of a medium at rest: a force against the velocity, with the law of the speed (2.94).
void resist_body(Resistance& resistance, const Damper& damper, const BodyMotion& body, const Translator& translate, Symbols& symbols,
                 const Indices& indices) {
    const std::string what = fmt::format("the velocity of body '{}'", body.member.name());
    if (damper.coefficient) {
        const ex coefficient = translate(damper.coefficient, indices);
        for (const ex& component : body.used_velocity())
            resist(resistance, affine_rate(component, symbols, damper.span, what), coefficient * component, component);
        return;
    }
    const ex square = dot(body.used_velocity(), body.used_velocity()).expand();
    const ex letter = symbols.letter(damper.force->variable);
    const ex law = translate(*damper.force->body, indices, {{damper.force->variable, letter}});
    const ex quotient = (law / letter).expand();
    // Where the quotient has a value and a slope at rest, the force and its derivatives have one too.
    const bool is_smooth = quotient.is_polynomial(letter);
    const ex force_per_speed = quotient.subs(letter == (is_smooth ? ex(norm(square)) : ex(GiNaC::sqrt(square))));
    for (const ex& component : body.used_velocity())
        resist(resistance, affine_rate(component, symbols, damper.span, what), force_per_speed * component, component);
}

/// Q_j = F.dr/dq_j (2.206); the power of a force at a moving point includes what the motion of the point itself contributes.
Supply force_at(std::string name, const SpaceVector& force, const SpaceVector& point, const Symbols& symbols) {
    Supply result{std::move(name), {}, 0, 0};
    SpaceVector velocity;
    for (std::size_t i = 0; i < 3; ++i) velocity[i] = symbols.time_derivative(point[i]);
    for (std::size_t j = 0; j < symbols.degrees(); ++j)
        result.force.push_back(dot(force, {symbols.along(point[0], j), symbols.along(point[1], j), symbols.along(point[2], j)}));
    result.power = dot(force, velocity);
    result.prescribed = -dot(force, partial(point, symbols.time()));
    return result;
}

void subtract(Supply& from, const Supply& other) {
    for (std::size_t j = 0; j < from.force.size(); ++j) from.force[j] -= other.force[j];
    from.power -= other.power;
    from.prescribed -= other.prescribed;
    for (const Wrench& wrench : other.wrenches) from.wrenches.push_back(reversed(wrench));
}

/// Forces and torques, as vectors, on bodies with axes of their own.
class InSpace {
public:
    InSpace(const Translator& translate, const std::vector<BodyMotion>& bodies, const Chain* chain)
        : translate_(translate), symbols_(translate.symbols()), bodies_(bodies), chain_(chain) {}

    /// At the centre of mass.
    Supply force(const Member<Force>& member, const BodyMotion& body) const {
        const Force& item = *member.item;
        const std::string name = fmt::format("force {}", member.name());
        const SpaceVector given = translate_(item.force, Translator::indices_of(member));
        if (chain_ != nullptr && !body.is_seen_from_ground) return handed(name, wrench(body, {{}, given}, item.in_axes));
        const SpaceVector used = in_used_axes_of(body, given, item.in_axes, item.span, fmt::format("force '{}'", member.name()));
        return along_velocity(name, used, body.used_velocity(), symbols_);
    }

    /// The reaction is the same vector, taken into the axes of the other body.
    Supply torque(const Member<Torque>& member) const {
        const Torque& item = *member.item;
        const BodyMotion& body = in_space(*item.on, member);
        const std::string name = fmt::format("torque {}", member.name());
        const SpaceVector given = translate_(*item.vector, Translator::indices_of(member));
        Supply result = torque_on(name, body, given, item.in_axes);
        if (item.against)
            subtract(result, torque_on(name, in_space(*item.against, member), item.in_axes ? body.frame->to_ground(given) : given, false));
        return result;
    }

private:
    const BodyMotion& in_space(const Reference& reference, const Member<Torque>& member) const {
        const BodyMotion& body = body_of(reference, bodies_, translate_.scene(), Translator::indices_of(member));
        if (body.frame) return body;
        throw Failure(Diagnostic{Id::wrong_type, member.item->span,
                                 fmt::format("torque '{}' is a vector, but body '{}' does not turn in space; give it as one expression",
                                             member.name(), body.member.name())});
    }

    Supply torque_on(const std::string& name, const BodyMotion& body, const SpaceVector& given, bool in_axes) const {
        if (chain_ != nullptr) return handed(name, wrench(body, {given, {}}, in_axes));
        return along_velocity(name, in_axes ? given : body.frame->from_ground(given), body.frame->angular_velocity, symbols_);
    }

    struct MomentAndForce {
        SpaceVector moment, force;
    };
    Wrench wrench(const BodyMotion& body, const MomentAndForce& given, bool in_axes) const {
        Wrench result{static_cast<std::size_t>(&body - bodies_.data())};
        (in_axes ? result.own : result.ground) = joined(given.moment, given.force);
        return result;
    }

    Supply handed(const std::string& name, const Wrench& wrench) const {
        Supply result = of_power(name, power_of(wrench, bodies_), symbols_);
        result.force = handed_on(wrench, *chain_, bodies_, symbols_.degrees());
        result.wrenches = {wrench};
        return result;
    }

    const Translator& translate_;
    const Symbols& symbols_;
    const std::vector<BodyMotion>& bodies_;
    const Chain* chain_;
};

Supply torque_on(const Member<Torque>& member, const Translator& translate, const std::vector<BodyMotion>& bodies) {
    const Torque& torque = *member.item;
    const Indices indices = Translator::indices_of(member);
    ex rate;
    if (torque.rate) {
        rate = translate(torque.rate, indices);
    } else {
        rate = body_of(*torque.on, bodies, translate.scene(), indices).angular_velocity;
        if (torque.against) rate -= body_of(*torque.against, bodies, translate.scene(), indices).angular_velocity;
    }
    const Span& place = torque.rate ? torque.rate->span : torque.span;
    const AffineRate affine = affine_rate(rate, translate.symbols(), place, fmt::format("the rate of torque '{}'", member.name()));
    const ex value = translate(torque.torque, indices);
    Supply result{fmt::format("torque {}", member.name()), {}, value * rate, -value * affine.drift};
    for (const ex& slope : affine.jacobian) result.force.push_back(value * slope);
    return result;
}

}  // namespace

std::vector<Resistance> resistances(const Scene& scene, const Translator& translate, Symbols& symbols,
                                    const std::vector<BodyMotion>& bodies) {
    std::vector<Resistance> result;
    for (const auto& member : scene.dampers) {
        const Damper& damper = *member.item;
        const Indices indices = Translator::indices_of(member);
        Resistance resistance{fmt::format("damper {}", member.name()), Generalised(symbols.degrees(), 0), 0, 0};
        if (damper.rate) {
            const ex rate = translate(damper.rate, indices);
            const AffineRate affine = affine_rate(rate, symbols, damper.rate->span, fmt::format("the rate of damper '{}'", member.name()));
            resist(resistance, affine, damper_law(damper, rate, translate, symbols, indices), rate);
        } else {
            resist_body(resistance, damper, body_of(*damper.on, bodies, scene, indices), translate, symbols, indices);
        }
        refuse_driving(resistance.power, damper, translate);
        result.push_back(std::move(resistance));
    }
    for (const auto& member : scene.generalised_forces) {
        if (!member.item->dissipated) continue;
        const Indices indices = Translator::indices_of(member);
        const CoordinateEntry& entry = member.item->coordinate;
        const std::size_t j = translate.coordinate(entry.coordinate, entry.index.get(), entry.span, indices);
        Resistance resistance{fmt::format("generalised force {}", member.name()), Generalised(symbols.degrees(), 0), 0, 0};
        resistance.force[j] = translate(entry.value, indices);
        resistance.power = -resistance.force[j] * symbols.get(SymbolKind::velocity, j);
        result.push_back(std::move(resistance));
    }
    return result;
}

std::vector<Supply> supplies(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies, const Chain* chain) {
    const Symbols& symbols = translate.symbols();
    const InSpace in_space(translate, bodies, chain);
    std::vector<Supply> result;
    for (const auto& member : scene.forces) {
        const Force& force = *member.item;
        const Indices indices = Translator::indices_of(member);
        const BodyMotion* body = force.on ? &body_of(*force.on, bodies, scene, indices) : nullptr;
        if (force.in_axes || (body != nullptr && body->frame)) {
            result.push_back(in_space.force(member, *body));
            continue;
        }
        const SpaceVector point = force.at ? translate(*force.at, indices) : body_of(*force.on, bodies, scene, indices).position;
        result.push_back(force_at(fmt::format("force {}", member.name()), translate(force.force, indices), point, symbols));
    }
    for (const auto& member : scene.torques)
        result.push_back(member.item->vector ? in_space.torque(member) : torque_on(member, translate, bodies));
    for (const auto& member : scene.generalised_forces) {
        if (member.item->dissipated) continue;
        const Indices indices = Translator::indices_of(member);
        const CoordinateEntry& entry = member.item->coordinate;
        const std::size_t j = translate.coordinate(entry.coordinate, entry.index.get(), entry.span, indices);
        const ex value = translate(entry.value, indices);
        Supply supply{fmt::format("generalised force {}", member.name()), Generalised(symbols.degrees(), 0),
                      value * symbols.get(SymbolKind::velocity, j), 0};
        supply.force[j] = value;
        result.push_back(std::move(supply));
    }
    return result;
}

}  // namespace dalembert
