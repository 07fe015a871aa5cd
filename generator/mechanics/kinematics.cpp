// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/kinematics.hpp"

#include <fmt/format.h>

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

}  // namespace

const BodyMotion* find_motion(const std::vector<BodyMotion>& motions, const Reference& reference, const Scene& scene, const Indices& indices) {
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
                const bool is_first_of_chain = item.on->name == item.name && index_value(*item.on->index, scene, indices) < bounds(*item.family, scene).first;
                if (base == nullptr && !is_first_of_chain) {
                    waiting.push_back(member);
                    continue;
                }
            }
            BodyMotion body{member};
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
                affine_rate(body.angular_velocity, symbols, item.angular_velocity->span, fmt::format("the angular velocity of body '{}'", member.name()));
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
