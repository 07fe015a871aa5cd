// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and dampers in the picture of a machine: between which bodies they are, or what kind of wall they hang on.
//
// note [connectors]: Where an elongation e and the positions of one body change with one coordinate alone, e in proportion to r, the spring
// pulls along d = dr/de, and r - e d is fixed, or moves with the time alone: what the spring hangs on is somewhere behind. Where e changes
// with the coordinates of two bodies alone, the spring is between them. Where r is in proportion to the coordinate, it hangs on the
// origin. The elongation of a damper is what its rate is the rate of.
#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "report/machine_builder.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;

class ConnectorMaker {
public:
    explicit ConnectorMaker(MachineBuilder& machine)
        : machine_(machine), system_(machine.system), points_(machine.points), drawing_(machine.drawing) {}

    void run() {
        const auto is_drawn = [&](const std::string& name, const std::optional<ex>& elongation, bool is_damper) {
            return is_hidden(*system_.scene.model, name) || (elongation && add(*elongation, is_damper));
        };
        for (const Member<Spring>& member : system_.scene.springs) {
            const ex elongation = system_.translate(*member.item->elongation, Translator::indices_of(member));
            if (is_drawn(member.name(), system_.symbols.without_definitions(elongation), false))
                machine_.drawn.insert("spring " + member.name());
        }
        for (const Member<Damper>& member : system_.scene.dampers)
            if (is_drawn(member.name(), elongation_of(member), true)) machine_.drawn.insert("damper " + member.name());
    }

private:
    /// Nothing where a friction or contact brings the damper, or its rate is not that of coordinates.
    std::optional<ex> elongation_of(const Member<Damper>& member) const {
        const Damper& damper = *member.item;
        if (!damper.rate || damper.is_made) return std::nullopt;
        ex rest = system_.symbols.without_definitions(system_.translate(*damper.rate, Translator::indices_of(member))).expand();
        ex elongation = 0;
        for (std::size_t j = 0; j < system_.symbols.degrees(); ++j) {
            const ex& velocity = system_.symbols.get(SymbolKind::velocity, j);
            const ex change = rest.coeff(velocity, 1);
            if (moves(change, system_.symbols)) return std::nullopt;
            rest = (rest - change * velocity).expand();
            elongation += change * system_.symbols.get(SymbolKind::coordinate, j);
        }
        return rest.is_zero() ? std::optional(elongation) : std::nullopt;
    }

    bool add(const ex& elongation, bool is_damper) {
        const std::vector<ex> moving = coordinates_in({elongation}, system_.symbols);
        std::vector<std::size_t> moved;
        for (std::size_t b = 0; b < drawing_.bodies.size(); ++b) {
            const std::vector<ex> own = coordinates_in({points_[b][0], points_[b][1], points_[b][2]}, system_.symbols);
            const auto counts = [&](const ex& q) {
                return std::any_of(moving.begin(), moving.end(), [&](const ex& m) { return m.is_equal(q); });
            };
            if (!own.empty() && std::all_of(own.begin(), own.end(), counts)) moved.push_back(b);
        }
        if (moving.size() == 2 && moved.size() == 2) return add_between(moved, elongation, moving, is_damper);
        if (moving.size() != 1 || turns(elongation, moving[0])) return false;
        if (std::any_of(moved.begin(), moved.end(), [&](std::size_t b) { return add_at_wall(b, elongation, moving[0], is_damper); }))
            return true;
        for (std::size_t b = 0; b < drawing_.bodies.size(); ++b)
            if (add_at_origin(b, GiNaC::ex_to<GiNaC::symbol>(moving[0]), is_damper)) return true;
        return false;
    }

    bool add_between(const std::vector<std::size_t>& bodies, const ex& elongation, const std::vector<ex>& coordinates, bool is_damper) {
        ex sum = 0;
        for (const ex& q : coordinates) {
            const ex change = elongation.diff(GiNaC::ex_to<GiNaC::symbol>(q)).expand();
            if (moves(change, system_.symbols)) return false;
            sum += change;
        }
        if (!is_zero_after_expansion(sum)) return false;
        put({bodies[0], bodies[1], false, is_damper});
        return true;
    }

    bool add_at_wall(std::size_t body, const ex& elongation, const ex& coordinate, bool is_damper) {
        const auto& q = GiNaC::ex_to<GiNaC::symbol>(coordinate);
        const ex change = elongation.diff(q).expand();
        if (change.is_zero() || moves(change, system_.symbols)) return false;
        DrawnPoint fixed, direction;
        for (std::size_t i = 0; i < 3; ++i) {
            direction[i] = (points_[body][i].diff(q) / change).expand();
            if (moves(direction[i], system_.symbols)) return false;
            fixed[i] = (points_[body][i] - elongation * direction[i]).expand();
        }
        if (std::all_of(points_[body].begin(), points_[body].end(), [&](const ex& e) { return e.diff(q).is_zero(); })) return false;
        put({body, wall(body, fixed, direction), true, is_damper});
        return true;
    }

    /// Where the coordinate is the distance from the origin of the ground.
    bool add_at_origin(std::size_t body, const GiNaC::symbol& q, bool is_damper) {
        const DrawnPoint& r = points_[body];
        if (std::none_of(r.begin(), r.end(), [&](const ex& component) { return component.has(q); })) return false;
        for (const ex& component : r)
            if (!is_zero_after_expansion(component - q * component.diff(q))) return false;
        if (!origin_) origin_ = machine_.add({0, 0, 0});
        put({body, *origin_, false, is_damper});
        return true;
    }

    /// Whether the elongation is an angle, whatever the coordinate moves.
    bool turns(const ex& elongation, const ex& coordinate) const {
        if (!GiNaC::is_a<GiNaC::numeric>(elongation.diff(GiNaC::ex_to<GiNaC::symbol>(coordinate)))) return false;
        for (const Variable& q : system_.symbols.all(SymbolKind::coordinate))
            if (coordinate.is_equal(q.symbol)) return q.unit == "rad";
        return false;
    }

    /// That of another spring or damper on this side of the body, or a new one.
    std::size_t wall(std::size_t body, const DrawnPoint& fixed, const DrawnPoint& direction) {
        for (const MachineDrawing::Connector& one : drawing_.connectors) {
            if (!one.has_wall || one.from != body) continue;
            const auto is_same = [&](std::size_t i) {
                return is_zero_after_expansion(points_[one.to][i] - points_[one.to + 1][i] - direction[i]);
            };
            if (is_same(0) && is_same(1) && is_same(2)) return one.to;
        }
        points_.push_back(fixed);
        points_.push_back({fixed[0] - direction[0], fixed[1] - direction[1], fixed[2] - direction[2]});
        return points_.size() - 2;
    }

    /// Those between the same two ends lie side by side.
    void put(MachineDrawing::Connector connector) {
        const auto is_beside = [&](const MachineDrawing::Connector& one) {
            return std::minmax(one.from, one.to) == std::minmax(connector.from, connector.to);
        };
        for (MachineDrawing::Connector& one : drawing_.connectors)
            if (is_beside(one)) connector.beside = one.beside + 1;
        drawing_.connectors.push_back(connector);
        for (MachineDrawing::Connector& one : drawing_.connectors)
            if (is_beside(one)) one.together = connector.beside + 1;
    }

    MachineBuilder& machine_;
    const System& system_;
    std::vector<DrawnPoint>& points_;
    MachineDrawing& drawing_;
    std::optional<std::size_t> origin_;
};

}  // namespace

void add_connectors(MachineBuilder& machine) { ConnectorMaker(machine).run(); }

}  // namespace dalembert
