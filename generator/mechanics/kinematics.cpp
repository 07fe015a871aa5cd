// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/kinematics.hpp"

#include <fmt/format.h>

#include "elements/bodies.hpp"
#include "mechanics/body_letters.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Position and rotation of a body that is measured in the frame of another one. A base that only turns does so about the origin.
void place_on(BodyMotion& body, const BodyMotion& base) {
    if (body.has_position) {
        SpaceVector& r = body.position;
        if (base.has_rotation) {
            const ex c = GiNaC::cos(base.rotation);
            const ex s = GiNaC::sin(base.rotation);
            r = {c * r[0] - s * r[1], s * r[0] + c * r[1], r[2]};
        }
        for (std::size_t i = 0; i < 3; ++i) r[i] += base.position[i];
    }
    if (body.has_rotation && base.has_rotation) body.rotation += base.rotation;
}

SpaceMatrix tensor_of(const Body& item, const Translator& translate, const Indices& indices) {
    SpaceMatrix tensor{SpaceVector{0, 0, 0}, SpaceVector{0, 0, 0}, SpaceVector{0, 0, 0}};
    for (std::size_t i = 0; i < 3 && !item.tensor.empty(); ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            if (item.tensor.size() == 3) tensor[i][j] = translate(item.tensor[i][j], indices);
            else if (i == j) tensor[i][i] = translate(item.tensor[0][i], indices);
        }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!(tensor[i][j] - tensor[j][i]).expand().is_zero())
                throw Failure(
                    Diagnostic{Id::wrong_inertia, item.tensor[i][j]->span,
                               fmt::format("the inertia of body '{}' is not symmetric: there is '{}' in row {}, but '{}' in row {}",
                                           item.name, item.tensor[i][j]->written(), i + 1, item.tensor[j][i]->written(), j + 1)});
    return tensor;
}

Orientation orientation_of(const Body& item, const Translator& translate, const Indices& indices) {
    const Symbols& symbols = translate.symbols();
    if (item.attitude) {
        if (const auto* attitude = symbols.find_attitude(item.attitude->name)) return by_attitude(*attitude, symbols);
        throw Failure(Diagnostic{Id::needs_absent, item.attitude->span,
                                 fmt::format("scene '{}' has no attitude '{}'", translate.scene().name, item.attitude->name)});
    }
    std::vector<std::pair<std::size_t, ex>> turns;
    for (const Turn& turn : item.turns) turns.emplace_back(turn.axis, translate(turn.angle, indices));
    if (item.rotation) turns.emplace_back(2, translate(item.rotation, indices));
    return by_turns(turns, symbols);
}

/// The velocity of the centre of mass in own axes: that of the origin and what turning and moving about it adds.
void move_in_space(BodyMotion& body, const BodyMotion* base, const Translator& translate) {
    const Body& item = *body.member.item;
    const Indices indices = Translator::indices_of(body.member);
    const Symbols& symbols = translate.symbols();
    if (item.inertia || item.angular_velocity)
        throw Failure(Diagnostic{Id::not_allowed_here,
                                 (item.inertia ? item.inertia : item.angular_velocity)->span,
                                 fmt::format("body '{}' is placed on '{}', which turns in space: its inertia is [Jx, Jy, Jz] or three "
                                             "rows, and its orientation is given by 'turns'",
                                             item.name, item.on->name),
                                 {{item.on->span, "it is placed here"}}});
    const auto vector = [&](const std::optional<VectorExpression>& v) { return v ? translate(*v, indices) : SpaceVector{0, 0, 0}; };
    if (item.mass) body.mass = translate(item.mass, indices);
    body.tensor = tensor_of(item, translate, indices);
    body.turns = true;
    body.has_position = true;
    const SpaceVector& centre = body.centre = vector(item.centre);
    const SpaceVector origin = vector(item.position ? item.position : item.origin);
    body.frame = placed(base != nullptr ? frame_of(*base, symbols) : nullptr, orientation_of(item, translate, indices), origin, symbols);
    const SpaceVector omega = as_letters(body.frame->angular_velocity, *body.frame);
    body.own_velocity = as_letters(body.frame->velocity, *body.frame) + cross(omega, centre) + time_derivative(centre, symbols);
    body.position = body.frame->point_to_ground(centre);
    body.velocity = time_derivative(body.position, symbols);
    body.is_seen_from_ground = base == nullptr && is_zero(centre);
}

}  // namespace

std::shared_ptr<const Frame> frame_of(const BodyMotion& base, const Symbols& symbols) {
    if (base.frame) return base.frame;
    return placed(nullptr, by_turns({{2, base.rotation}}, symbols), base.has_position ? base.position : SpaceVector{0, 0, 0}, symbols);
}

const BodyMotion* find_motion(const std::vector<BodyMotion>& motions, const Reference& reference, const Scene& scene,
                              const Indices& indices) {
    const int index = reference.index ? index_value(*reference.index, scene, indices) : 0;
    for (const BodyMotion& motion : motions)
        if (motion.member.item->name == reference.name && motion.member.index == index) return &motion;
    return nullptr;
}

std::vector<BodyMotion> body_motions(const Scene& scene, const Translator& translate) {
    const Symbols& symbols = translate.symbols();
    std::vector<BodyMotion> motions;
    std::vector<Member<Body>> pending = scene.bodies;
    // A body may stand in the file before the one that it is placed on, so bodies are taken when their base is known.
    while (!pending.empty()) {
        std::vector<Member<Body>> waiting;
        for (const Member<Body>& member : pending) {
            const Body& item = *member.item;
            const Indices indices = Translator::indices_of(member);
            const BodyMotion* base = nullptr;
            if (item.on) {
                base = find_motion(motions, *item.on, scene, indices);
                const bool is_first_of_chain =
                    item.on->name == item.name && index_value(*item.on->index, scene, indices) < bounds(*item.family, scene).first;
                if (base == nullptr && !is_first_of_chain) {
                    waiting.push_back(member);
                    continue;
                }
            }
            BodyMotion body;
            body.member = member;
            if (item.has_axes() || (base != nullptr && base->frame)) {
                move_in_space(body, base, translate);
                motions.push_back(std::move(body));
                continue;
            }
            if (item.mass) body.mass = translate(item.mass, indices);
            if (item.position) {
                body.has_position = true;
                body.position = translate(*item.position, indices);
            }
            body.turns = item.rotation || item.angular_velocity;
            body.has_rotation = item.rotation != nullptr;
            if (item.inertia) body.inertia = translate(item.inertia, indices);
            if (item.rotation) body.rotation = translate(item.rotation, indices);
            if (base != nullptr) place_on(body, *base);
            for (std::size_t i = 0; i < 3; ++i) body.velocity[i] = symbols.time_derivative(body.position[i]);
            if (item.rotation) body.angular_velocity = symbols.time_derivative(body.rotation);
            if (item.angular_velocity) {
                body.angular_velocity = translate(item.angular_velocity, indices);
                affine_rate(body.angular_velocity, symbols, item.angular_velocity->span,
                            fmt::format("the angular velocity of body '{}'", member.name()));
            }
            motions.push_back(std::move(body));
        }
        if (waiting.size() == pending.size()) {
            const Reference& missing = *waiting.front().item->on;
            throw Failure(Diagnostic{Id::index_out_of_range, missing.span,
                                     fmt::format("body '{}' is placed on '{}', which does not exist or is placed on it",
                                                 waiting.front().name(), std::string(missing.span.text()))});
        }
        pending = std::move(waiting);
    }
    // Back to the order of declaration, which the order of everything derived follows.
    std::vector<BodyMotion> ordered;
    for (const Member<Body>& member : scene.bodies)
        for (const BodyMotion& motion : motions)
            if (motion.member.item == member.item && motion.member.index == member.index) ordered.push_back(motion);
    return ordered;
}

}  // namespace dalembert
