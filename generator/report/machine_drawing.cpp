// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/machine_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/view.hpp"
#include "report/connectors.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;
using Point = DrawnPoint;

class DrawingMaker {
public:
    explicit DrawingMaker(const System& system) : system_(system) {}

    MachineDrawing run() {
        for (const BodyMotion& body : system_.bodies) {
            if (!body.has_position) {
                drawing_.not_drawn.push_back(fmt::format("body '{}', which has no position", body.member.name()));
                continue;
            }
            drawing_.bodies.push_back(body.member.name());
            hidden_.push_back(is_hidden(*system_.scene.model, body.member.name()));
            add({plain(body.position[0]), plain(body.position[1]), plain(body.position[2])});
            shown_.push_back(&body);
        }
        find_plane();
        if (drawing_.plane == std::vector<std::size_t>{0, 1})
            add_bars();
        else
            add_bars_in_space();
        add_forces();
        drawing_.framed = points_.size();
        left_out_ = add_connectors(system_, points_, drawing_);
        add_view();
        tell_rest();
        for (const Point& p : points_) drawing_.coordinates.insert(drawing_.coordinates.end(), p.begin(), p.end());
        return std::move(drawing_);
    }

private:
    ex plain(const ex& e) const { return system_.symbols.without_definitions(e); }

    /// Of the ground that nothing leaves.
    void find_plane() {
        for (const std::vector<std::size_t>& plane : {std::vector<std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
            const std::size_t across = 3 - plane[0] - plane[1];
            if (std::all_of(points_.begin(), points_.end(), [&](const Point& p) { return p[across].is_zero(); })) {
                drawing_.plane = plane;
                return;
            }
        }
    }

    std::size_t add(const Point& point) {
        points_.push_back(point);
        return points_.size() - 1;
    }

    std::optional<std::size_t> place_of(const Point& point, std::size_t but) const {
        for (std::size_t i = 0; i < points_.size(); ++i)
            if (i != but && is_zero_after_expansion(points_[i][0] - point[0]) && is_zero_after_expansion(points_[i][1] - point[1]))
                return i;
        return std::nullopt;
    }

    /// Bars in an order in which each may end where one before it does.
    void add_bars() {
        std::vector<bool> has_bar(shown_.size(), false);
        for (bool is_new = true; is_new;) {
            is_new = false;
            for (std::size_t b = 0; b < shown_.size(); ++b) {
                if (has_bar[b] || hidden_[b] || !add_bar(b)) continue;
                has_bar[b] = is_new = true;
            }
        }
    }

    /// What a body turns about with one coordinate.
    struct Pivot {
        Point point;
        ex dx, dy;  ///< of the body, by the coordinate
        bool turns_body = false;
        std::optional<std::size_t> place = std::nullopt;
        std::size_t moved_by = 0;  ///< coordinates: the most for the joint next to the body

        auto rank() const { return std::tuple(turns_body, moved_by, place.has_value()); }
    };

    std::vector<Pivot> pivots_of(std::size_t body) const {
        const Point& r = points_[body];
        const BodyMotion& motion = *shown_[body];
        std::vector<Pivot> pivots;
        for (const Variable& coordinate : system_.symbols.all(SymbolKind::coordinate)) {
            if (coordinate.unit != "rad") continue;
            const auto& q = GiNaC::ex_to<GiNaC::symbol>(coordinate.symbol);
            const ex dx = r[0].diff(q), dy = r[1].diff(q);
            if (is_zero_after_expansion(dx) && is_zero_after_expansion(dy)) continue;
            Pivot pivot{{(r[0] - dy).expand(), (r[1] + dx).expand(), 0}, dx, dy};
            if (pivot.point[0].has(q) || pivot.point[1].has(q)) continue;
            pivot.turns_body = motion.has_rotation && !is_zero_after_expansion(plain(motion.rotation).diff(q));
            pivot.place = place_of(pivot.point, body);
            pivot.moved_by = coordinates_in({pivot.point[0], pivot.point[1]}, system_.symbols).size();
            const bool moves_unseen = !pivot.place && (moves(pivot.point[0], system_.symbols) || moves(pivot.point[1], system_.symbols));
            if (!moves_unseen || pivot.turns_body) pivots.push_back(std::move(pivot));
        }
        return pivots;
    }

    /// Whether the inertia m (l^2 + b^2)/12 tells of a bar with the joint at its end; where a bar of another kind ends nobody knows.
    bool is_same_all_along(const BodyMotion& motion, const ex& dx, const ex& dy) const {
        GiNaC::exmap at_zero;  // the distance of the joint does not depend on coordinates
        for (const Variable& q : system_.symbols.all(SymbolKind::coordinate)) at_zero[q.symbol] = 0;
        if (motion.mass.is_zero()) return false;
        const ex square = 12 * plain(motion.inertia) / plain(motion.mass) - 4 * (dx * dx + dy * dy).subs(at_zero);
        const ex width = square.normal().expand();
        return width.is_zero() || width.match(GiNaC::pow(GiNaC::wild(), 2));
    }

    bool add_bar(std::size_t body) {
        const std::vector<Pivot> pivots = pivots_of(body);
        const auto pivot =
            std::max_element(pivots.begin(), pivots.end(), [](const Pivot& a, const Pivot& b) { return a.rank() < b.rank(); });
        if (pivot == pivots.end()) return false;
        const BodyMotion& motion = *shown_[body];
        const Point r = points_[body];
        const std::size_t joint = pivot->place ? *pivot->place : add(pivot->point);
        std::size_t end = body;
        if (pivot->turns_body) {
            const Point far{(2 * r[0] - pivot->point[0]).expand(), (2 * r[1] - pivot->point[1]).expand(), 0};
            const std::optional<std::size_t> there = place_of(far, body);
            if (there || is_same_all_along(motion, pivot->dx, pivot->dy)) end = there ? *there : add(far);
        }
        drawing_.bars.push_back({joint, end});
        return true;
    }

    /// Bodies whose distance from the origin of the ground, or from an earlier body, no velocity changes.
    void add_bars_in_space() {
        std::optional<std::size_t> origin;
        for (std::size_t b = 0; b < shown_.size(); ++b) {
            if (hidden_[b]) continue;
            const Point ground{0, 0, 0};
            if (keeps_distance(b, ground, nullptr)) {
                if (!origin) origin = add(ground);
                drawing_.bars.push_back({*origin, b});
                continue;
            }
            for (std::size_t other = 0; other < b; ++other) {
                if (!keeps_distance(b, points_[other], shown_[other])) continue;
                drawing_.bars.push_back({other, b});
                break;
            }
        }
    }

    /// The size of a value where no two letters are alike: enough for a drawing to see what is zero.
    double at_a_point(const ex& e) const {
        GiNaC::exmap values;
        int next = 0;
        for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::state, SymbolKind::parameter})
            for (const Variable& variable : system_.symbols.all(kind))
                values[variable.symbol] = GiNaC::numeric(37 + 11 * next, 59 + 7 * next), ++next;
        values[system_.symbols.time()] = GiNaC::numeric(5, 7);
        const ex value = plain(e).subs(values).evalf();
        return GiNaC::is_a<GiNaC::numeric>(value) ? std::fabs(GiNaC::ex_to<GiNaC::numeric>(value).to_double()) : 1.0;
    }

    bool keeps_distance(std::size_t body, const Point& from, const BodyMotion* other) const {
        ex square = 0;
        for (std::size_t i = 0; i < 3; ++i) square += GiNaC::pow(points_[body][i] - from[i], 2);
        const double size = at_a_point(square);
        if (!(size > 1e-9)) return false;
        for (std::size_t j = 0; j < system_.symbols.degrees(); ++j) {
            const SpaceVector along = shown_[body]->along(j, system_.symbols);
            const SpaceVector along_other = other != nullptr ? other->along(j, system_.symbols) : SpaceVector{};
            ex change = 0;
            for (std::size_t i = 0; i < 3; ++i) change += (points_[body][i] - from[i]) * (along[i] - along_other[i]);
            if (at_a_point(change) > 1e-9 * size) return false;
        }
        return true;
    }

    /// Those in the axes of the ground that are there in every mode.
    void add_forces() {
        for (const Member<Force>& member : system_.scene.forces) {
            const Force& force = *member.item;
            const Indices indices = Translator::indices_of(member);
            std::optional<std::size_t> at;
            if (force.at) {
                Point point;
                for (std::size_t i = 0; i < 3; ++i) point[i] = plain(system_.translate((*force.at)[i], indices));
                at = add(point);
            } else {
                const int index = force.on->index ? index_value(*force.on->index, system_.scene, indices) : 0;
                for (std::size_t b = 0; b < shown_.size(); ++b)
                    if (shown_[b]->member.item->name == force.on->name && shown_[b]->member.index == index) at = b;
            }
            if (!at || force.in_axes || (!system_.scene.modes.empty() && force.when)) {
                ++forces_not_drawn_;
                continue;
            }
            drawing_.forces.push_back({member.name(), *at});
            for (const ExpressionPtr& part : force.force) drawing_.force_values.push_back(plain(system_.translate(part, indices)));
        }
    }

    std::optional<std::size_t> measure(const ExpressionPtr& e) {
        if (!e) return std::nullopt;
        drawing_.measures.push_back(plain(system_.translate(*e, {})));
        return drawing_.measures.size() - 1;
    }

    void add_view() {
        const std::optional<View>& view = system_.scene.model->view;
        if (!view) return;
        drawing_.ground = measure(view->ground);
        drawing_.turn = measure(view->turn);
        drawing_.tilt = measure(view->tilt);
        drawing_.has_trails = view->trails.value_or(true);
        for (std::size_t b = 0; b < shown_.size(); ++b) {
            MachineDrawing::Look look;
            look.hidden = hidden_[b];
            if (const ViewPart* part = find_view(*system_.scene.model, drawing_.bodies[b])) {
                for (const auto& choice : view_shapes())
                    if (choice.value == part->shape) look.shape = choice.word;
                look.colour = part->colour;
                look.radius = measure(part->radius);
                look.width = measure(part->width);
                look.height = measure(part->height);
                if (shown_[b]->has_rotation && drawing_.plane == std::vector<std::size_t>{0, 1}) {
                    drawing_.measures.push_back(plain(shown_[b]->rotation));
                    look.rotation = drawing_.measures.size() - 1;
                }
                if (part->shape == ViewPart::Shape::wheel && !look.rotation)
                    drawing_.not_drawn.push_back(
                        fmt::format("how the wheel '{}' turns, as its body has no `rotation` in the plane of x and y", drawing_.bodies[b]));
                if (part->shape == ViewPart::Shape::box && drawing_.plane.empty()) {
                    drawing_.not_drawn.push_back(fmt::format("the box of body '{}', which moves in space", drawing_.bodies[b]));
                    look.shape.clear();
                }
            }
            drawing_.looks.push_back(std::move(look));
        }
    }

    void tell_rest() {
        const Scene& scene = system_.scene;
        const auto tell = [&](std::size_t count, const char* one, const char* many) {
            if (count > 0) drawing_.not_drawn.push_back(count == 1 ? std::string("1 ") + one : fmt::format("{} {}", count, many));
        };
        tell(left_out_.springs, "spring", "springs");
        tell(left_out_.dampers, "damper", "dampers");
        tell(forces_not_drawn_ + scene.torques.size(), "force or torque", "forces and torques");
        for (const ConstraintEquation& c : system_.constraints)
            if (c.holds) {
                drawing_.not_drawn.push_back("the joints of constraints");
                break;
            }
    }

    const System& system_;
    MachineDrawing drawing_;
    std::vector<Point> points_;
    std::vector<const BodyMotion*> shown_;
    std::vector<bool> hidden_;
    ConnectorsLeftOut left_out_;
    std::size_t forces_not_drawn_ = 0;
};

}  // namespace

MachineDrawing drawing_of(const Machine& machine) {
    MachineDrawing drawing = DrawingMaker(*machine.system).run();
    drawing.networks = networks_of(machine);
    const std::vector<std::string>& more = drawing.networks.front().not_drawn;
    drawing.not_drawn.insert(drawing.not_drawn.end(), more.begin(), more.end());
    return drawing;
}

}  // namespace dalembert
