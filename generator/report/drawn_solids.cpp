// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of bodies in the picture of a machine, with the directions of their axes: the solids that they are made of, or what the view says
// where the machine moves in space. What a solid is `without` is not cut out.
#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/statics.hpp"
#include "elements/view.hpp"
#include "report/machine_builder.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;

class SolidMaker {
public:
    explicit SolidMaker(MachineBuilder& machine) : machine_(machine), system_(machine.system) {}

    void run() {
        for (std::size_t b = 0; b < machine_.shown.size(); ++b) {
            if (machine_.hidden[b]) continue;
            const ViewPart* part = find_view(*system_.scene.model, machine_.drawing.bodies[b]);
            const bool is_seen = part != nullptr && part->shape != ViewPart::Shape::usual;
            const BodyMotion& motion = *machine_.shown[b];
            if (is_seen && machine_.drawing.plane.empty()) add_view(b, *part);
            if (is_seen || !motion.member.item->solid) continue;
            frame_ = frame_of(motion, system_.symbols);
            const Reference& solid = *motion.member.item->solid;
            // The place of a body with a position is that of its centre of mass.
            const bool is_centred = motion.member.item->position.has_value();
            add(b, *system_.names.find_element<Solid>(solid.name), is_centred ? ex(-1) * system_.solids.of(solid.name).centre : zero(),
                unturned());
        }
    }

private:
    static SpaceVector zero() { return {0, 0, 0}; }
    static SpaceMatrix unturned() { return {SpaceVector{1, 0, 0}, SpaceVector{0, 1, 0}, SpaceVector{0, 0, 1}}; }

    void add_view(std::size_t body, const ViewPart& part) {
        using Shape = ViewPart::Shape;
        frame_ = frame_of(*machine_.shown[body], system_.symbols);
        const BodyMotion& motion = *machine_.shown[body];
        // The origin of the axes may be a joint; what is seen is around the position.
        frame_at_ = motion.position;
        const auto value = [&](const ExpressionPtr& e) { return system_.translate(e, {}); };
        if (part.shape == Shape::box) put(body, "box", {value(part.width), value(part.height), 0}, zero(), unturned());
        else put(body, part.shape == Shape::wheel ? "wheel" : "disc", {value(part.radius)}, zero(), unturned());
        frame_at_.reset();
    }

    /// In the axes of the body: `at` the origin of the axes that the solid is placed in.
    void add(std::size_t body, const Solid& solid, const SpaceVector& at, const SpaceMatrix& axes) {
        const auto value = [&](const ExpressionPtr& e) { return e ? system_.translate(e, {}) : ex(0); };
        std::vector<std::pair<std::size_t, ex>> turns;
        for (const Turn& turn : solid.turns) turns.emplace_back(turn.axis, value(turn.angle));
        const SpaceMatrix own = by_turns(turns, system_.symbols).axes;
        SpaceMatrix placed = {zero(), zero(), zero()};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < 3; ++k) placed[i][j] += axes[i][k] * own[k][j];
        const SpaceVector origin = solid.at ? at + axes * system_.translate(*solid.at, {}) : at;
        switch (solid.shape) {
            case Solid::Shape::box: {
                const SpaceVector size = system_.translate(*solid.size, {});
                return put(body, "box", {size[0], size[1], size[2]}, origin, placed);
            }
            case Solid::Shape::cylinder: return put(body, "cylinder", {value(solid.radius), value(solid.height)}, origin, placed);
            case Solid::Shape::cone:
                return put(body, "cone", {value(solid.radius), value(solid.height), value(solid.top_radius)}, origin, placed);
            case Solid::Shape::sphere: return put(body, "sphere", {value(solid.radius)}, origin, placed);
            case Solid::Shape::hemisphere: return put(body, "hemisphere", {value(solid.radius)}, origin, placed);
            case Solid::Shape::point: return;
            case Solid::Shape::composed:
                for (const Reference& part : solid.of) add(body, *system_.names.find_element<Solid>(part.name), origin, placed);
        }
    }

    void put(std::size_t body, const char* kind, const std::vector<ex>& sizes, const SpaceVector& at, const SpaceMatrix& axes) {
        MachineDrawing::Shape shape{body, kind, machine_.drawing.measures.size(), sizes.size()};
        for (const ex& size : sizes) machine_.measure(size);
        for (const ex& e : frame_at_ ? *frame_at_ : frame_->point_to_ground(at)) machine_.measure(e);
        for (std::size_t column = 0; column < 3; ++column)
            for (const ex& e : frame_->to_ground({axes[0][column], axes[1][column], axes[2][column]})) machine_.measure(e);
        machine_.drawing.shapes.push_back(shape);
    }

    MachineBuilder& machine_;
    const System& system_;
    std::shared_ptr<const Frame> frame_;
    std::optional<SpaceVector> frame_at_;
};

}  // namespace

void add_solids(MachineBuilder& machine) { SolidMaker(machine).run(); }

}  // namespace dalembert
