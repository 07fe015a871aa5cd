// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/machine_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "elements/bodies.hpp"
#include "elements/fluids.hpp"
#include "elements/forces.hpp"
#include "elements/heat.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;
using Point = std::array<ex, 3>;

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
            add({plain(body.position[0]), plain(body.position[1]), plain(body.position[2])});
            shown_.push_back(&body);
        }
        for (const Point& p : points_) drawing_.is_planar = drawing_.is_planar && p[2].is_zero();
        if (drawing_.is_planar) add_bars();
        else
            add_bars_in_space();
        tell_rest();
        for (const Point& p : points_) drawing_.coordinates.insert(drawing_.coordinates.end(), p.begin(), p.end());
        return std::move(drawing_);
    }

private:
    ex plain(const ex& e) const { return system_.symbols.without_definitions(e); }

    std::size_t add(const Point& point) {
        points_.push_back(point);
        return points_.size() - 1;
    }

    static bool is_zero_after_expansion(const ex& e) { return e.expand().is_zero(); }

    std::optional<std::size_t> place_of(const Point& point, std::size_t but) const {
        for (std::size_t i = 0; i < points_.size(); ++i)
            if (i != but && is_zero_after_expansion(points_[i][0] - point[0]) && is_zero_after_expansion(points_[i][1] - point[1])) return i;
        return std::nullopt;
    }

    bool moves(const ex& e) const {
        for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::state})
            for (const Variable& variable : system_.symbols.all(kind))
                if (e.has(variable.symbol)) return true;
        return e.has(system_.symbols.time());
    }

    /// Bars in an order in which each may end where one before it does.
    void add_bars() {
        std::vector<bool> has_bar(shown_.size(), false);
        for (bool is_new = true; is_new;) {
            is_new = false;
            for (std::size_t b = 0; b < shown_.size(); ++b) {
                if (has_bar[b] || !add_bar(b)) continue;
                has_bar[b] = is_new = true;
            }
        }
    }

    bool add_bar(std::size_t body) {
        const std::vector<Variable>& coordinates = system_.symbols.all(SymbolKind::coordinate);
        for (auto q = coordinates.rbegin(); q != coordinates.rend(); ++q) {
            if (q->unit != "rad") continue;
            const ex& symbol = q->symbol;
            const Point r = points_[body];
            const ex dx = r[0].diff(GiNaC::ex_to<GiNaC::symbol>(symbol)), dy = r[1].diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
            if (is_zero_after_expansion(dx) && is_zero_after_expansion(dy)) continue;
            const Point pivot{(r[0] - dy).expand(), (r[1] + dx).expand(), 0};
            if (pivot[0].has(symbol) || pivot[1].has(symbol)) continue;
            std::optional<std::size_t> joint = place_of(pivot, body);
            if (!joint && (moves(pivot[0]) || moves(pivot[1]))) continue;
            if (!joint) joint = add(pivot);
            const BodyMotion& motion = *shown_[body];
            const bool turns_itself = motion.has_rotation && !is_zero_after_expansion(plain(motion.rotation).diff(GiNaC::ex_to<GiNaC::symbol>(symbol)));
            std::size_t end = body;
            if (turns_itself) {
                const Point far{(2 * r[0] - pivot[0]).expand(), (2 * r[1] - pivot[1]).expand(), 0};
                const std::optional<std::size_t> there = place_of(far, body);
                end = there ? *there : add(far);
            }
            drawing_.bars.push_back({*joint, end});
            return true;
        }
        return false;
    }

    /// Bodies whose distance from the origin of the ground, or from an earlier body, no velocity changes.
    void add_bars_in_space() {
        std::optional<std::size_t> origin;
        for (std::size_t b = 0; b < shown_.size(); ++b) {
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

    /// Seen by numbers at one point where no two letters are alike.
    bool keeps_distance(std::size_t body, const Point& from, const BodyMotion* other) const {
        GiNaC::exmap values;
        int next = 0;
        for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::state, SymbolKind::parameter})
            for (const Variable& variable : system_.symbols.all(kind)) values[variable.symbol] = GiNaC::numeric(37 + 11 * next, 59 + 7 * next), ++next;
        values[system_.symbols.time()] = GiNaC::numeric(5, 7);
        const auto number = [&](const ex& e) {
            const ex value = plain(e).subs(values).evalf();
            return GiNaC::is_a<GiNaC::numeric>(value) ? std::fabs(GiNaC::ex_to<GiNaC::numeric>(value).to_double()) : 1.0;
        };
        ex square = 0;
        for (std::size_t i = 0; i < 3; ++i) square += GiNaC::pow(points_[body][i] - from[i], 2);
        const double size = number(square);
        if (!(size > 1e-9)) return false;
        for (std::size_t j = 0; j < system_.symbols.degrees(); ++j) {
            const SpaceVector along = shown_[body]->along(j, system_.symbols);
            const SpaceVector along_other = other != nullptr ? other->along(j, system_.symbols) : SpaceVector{};
            ex change = 0;
            for (std::size_t i = 0; i < 3; ++i) change += (points_[body][i] - from[i]) * (along[i] - along_other[i]);
            if (number(change) > 1e-9 * size) return false;
        }
        return true;
    }

    void tell_rest() {
        const Scene& scene = system_.scene;
        const auto tell = [&](std::size_t count, const char* one, const char* many) {
            if (count > 0) drawing_.not_drawn.push_back(count == 1 ? std::string("1 ") + one : fmt::format("{} {}", count, many));
        };
        tell(scene.springs.size(), "spring", "springs");
        tell(scene.dampers.size(), "damper", "dampers");
        tell(scene.forces.size() + scene.torques.size(), "force or torque", "forces and torques");
        tell(scene.volumes.size(), "volume of a fluid", "volumes of fluids");
        tell(scene.flows.size(), "flow", "flows");
        tell(scene.nodes.size(), "node that stores heat", "nodes that store heat");
        tell(scene.rods.size(), "rod that conducts heat", "rods that conduct heat");
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
};

}  // namespace

MachineDrawing drawing_of(const System& system) { return DrawingMaker(system).run(); }

}  // namespace dalembert
