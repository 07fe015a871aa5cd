// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/connectors.hpp"

#include <algorithm>

#include "elements/forces.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;

class ConnectorMaker {
public:
    ConnectorMaker(const System& system, std::vector<DrawnPoint>& points, MachineDrawing& drawing)
        : system_(system), points_(points), drawing_(drawing) {}

    ConnectorsLeftOut run() {
        ConnectorsLeftOut left_out;
        for (const Member<Spring>& member : system_.scene.springs) {
            if (is_hidden(*system_.scene.model, member.name())) continue;
            const ex elongation = system_.translate(*member.item->elongation, Translator::indices_of(member));
            if (!add(system_.symbols.without_definitions(elongation), false)) ++left_out.springs;
        }
        for (const Member<Damper>& member : system_.scene.dampers) {
            if (is_hidden(*system_.scene.model, member.name())) continue;
            const auto elongation = elongation_of(member);
            if (!elongation || !add(*elongation, true)) ++left_out.dampers;
        }
        return left_out;
    }

private:
    /// Nothing where the damper is not there in every mode, or its rate is that of nothing, or more than of coordinates.
    std::optional<ex> elongation_of(const Member<Damper>& member) const {
        const Damper& damper = *member.item;
        if (!damper.rate || (!system_.scene.modes.empty() && damper.when)) return std::nullopt;
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
        if (moving.size() != moved.size()) return false;
        if (moving.size() == 1) return add_at_wall(moved[0], elongation, moving[0], is_damper);
        return moving.size() == 2 && add_between(moved, elongation, moving, is_damper);
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

    const System& system_;
    std::vector<DrawnPoint>& points_;
    MachineDrawing& drawing_;
};

}  // namespace

ConnectorsLeftOut add_connectors(const System& system, std::vector<DrawnPoint>& points, MachineDrawing& drawing) {
    return ConnectorMaker(system, points, drawing).run();
}

}  // namespace dalembert
