// SPDX-License-Identifier: GPL-3.0-or-later
// Bars in the picture of a machine.
//
// note [bars]: Let r(q) be the position of a body and q one of its angles. It turns about p = r + J dr/dq, J a quarter turn, where p does
// not depend on q. That is a joint where the body itself turns by q, or where p is fixed to the ground, or is where another body is, or
// where a bar ends. Of several, the joint next to the body is the one that the most coordinates move. The bar reaches from p to r; and as
// far behind r where the inertia is that of a uniform bar, or another bar begins there. In space bars lead from joint to joint, the origins
// of the axes of bodies. Others join a body to what it keeps its distance from, whatever moves, or whatever a constraint lets move.
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "elements/bodies.hpp"
#include "report/machine_builder.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;
using Point = DrawnPoint;

class BarMaker {
public:
    explicit BarMaker(MachineBuilder& machine) : machine_(machine), system_(machine.system), has_bar_(machine.shown.size(), false) {
        int next = 0;
        for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::state, SymbolKind::parameter})
            for (const Variable& variable : system_.symbols.all(kind))
                somewhere_[variable.symbol] = GiNaC::numeric(37 + 11 * next, 59 + 7 * next), ++next;
        somewhere_[system_.symbols.time()] = GiNaC::numeric(5, 7);
    }

    void run() {
        if (machine_.drawing.plane == std::vector<std::size_t>{0, 1})
            add_bars_in_plane();
        else
            for (std::size_t b = 0; b < machine_.shown.size(); ++b) has_bar_[b] = !machine_.hidden[b] && add_bars_of_frame(b);
        add_bars_between();
    }

private:
    std::optional<std::size_t> place_of(const Point& point, std::size_t but) const {
        for (std::size_t i = 0; i < machine_.points.size(); ++i)
            if (const Point& p = machine_.points[i];
                i != but && is_zero_after_expansion(p[0] - point[0]) && is_zero_after_expansion(p[1] - point[1]))
                return i;
        return std::nullopt;
    }

    /// Bars in an order in which each may end where one before it does.
    void add_bars_in_plane() {
        for (bool is_new = true; is_new;) {
            is_new = false;
            for (std::size_t b = 0; b < machine_.shown.size(); ++b) {
                if (has_bar_[b] || machine_.hidden[b] || !add_bar(b)) continue;
                has_bar_[b] = is_new = true;
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
        const Point& r = machine_.points[body];
        const BodyMotion& motion = *machine_.shown[body];
        std::vector<Pivot> pivots;
        for (const Variable& coordinate : system_.symbols.all(SymbolKind::coordinate)) {
            if (coordinate.unit != "rad") continue;
            const auto& q = GiNaC::ex_to<GiNaC::symbol>(coordinate.symbol);
            const ex dx = r[0].diff(q), dy = r[1].diff(q);
            if (is_zero_after_expansion(dx) && is_zero_after_expansion(dy)) continue;
            Pivot pivot{{(r[0] - dy).expand(), (r[1] + dx).expand(), 0}, dx, dy};
            if (pivot.point[0].has(q) || pivot.point[1].has(q) || !is_of_one_length(dx, dy)) continue;
            pivot.turns_body = motion.has_rotation && !is_zero_after_expansion(machine_.plain(motion.rotation).diff(q));
            pivot.place = place_of(pivot.point, body);
            pivot.moved_by = coordinates_in({pivot.point[0], pivot.point[1]}, system_.symbols).size();
            const bool moves_unseen = !pivot.place && (moves(pivot.point[0], system_.symbols) || moves(pivot.point[1], system_.symbols));
            if (!moves_unseen || pivot.turns_body) pivots.push_back(std::move(pivot));
        }
        return pivots;
    }

    bool is_of_one_length(const ex& dx, const ex& dy) const {
        const ex square = dx * dx + dy * dy;
        const std::vector<ex> coordinates = coordinates_in({square}, system_.symbols);
        const double size = std::fabs(at_a_point(square));
        return std::all_of(coordinates.begin(), coordinates.end(), [&](const ex& q) {
            return std::fabs(at_a_point(square.diff(GiNaC::ex_to<GiNaC::symbol>(q)))) <= 1e-9 * size;
        });
    }

    /// Whether the inertia m (l^2 + b^2)/12 tells of a bar with the joint at its end; where a bar of another kind ends nobody knows.
    bool is_same_all_along(const BodyMotion& motion, const ex& dx, const ex& dy) const {
        GiNaC::exmap at_zero;  // the distance of the joint does not depend on coordinates
        for (const Variable& q : system_.symbols.all(SymbolKind::coordinate)) at_zero[q.symbol] = 0;
        if (motion.mass.is_zero()) return false;
        const ex square = 12 * machine_.plain(motion.inertia) / machine_.plain(motion.mass) - 4 * (dx * dx + dy * dy).subs(at_zero);
        const ex width = square.normal().expand();
        return width.is_zero() || width.match(GiNaC::pow(GiNaC::wild(), 2));
    }

    bool add_bar(std::size_t body) {
        const std::vector<Pivot> pivots = pivots_of(body);
        const auto pivot =
            std::max_element(pivots.begin(), pivots.end(), [](const Pivot& a, const Pivot& b) { return a.rank() < b.rank(); });
        if (pivot == pivots.end()) return false;
        const BodyMotion& motion = *machine_.shown[body];
        const Point r = machine_.points[body];
        const std::size_t joint = pivot->place ? *pivot->place : machine_.add(pivot->point);
        std::size_t end = body;
        if (pivot->turns_body) {
            const Point far{(2 * r[0] - pivot->point[0]).expand(), (2 * r[1] - pivot->point[1]).expand(), 0};
            const std::optional<std::size_t> there = place_of(far, body);
            if (there || is_same_all_along(motion, pivot->dx, pivot->dy)) end = there ? *there : machine_.add(far);
        }
        machine_.drawing.bars.push_back({joint, end});
        return true;
    }

    /// From the joint of the body that carries it, or its position, to its own joint, and from there to its position.
    bool add_bars_of_frame(std::size_t body) {
        const BodyMotion& motion = *machine_.shown[body];
        if (!motion.frame) return false;
        const SpaceVector origin = motion.frame->point_to_ground({0, 0, 0});
        const Point joint{machine_.plain(origin[0]), machine_.plain(origin[1]), machine_.plain(origin[2])};
        std::optional<std::size_t> place;
        const auto connect = [&](std::size_t other, bool is_to_joint) {
            if (distance(joint, machine_.points[other]) <= 1e-9) return;
            if (!place) place = machine_.add(joint);
            machine_.drawing.bars.push_back(is_to_joint ? MachineDrawing::Bar{other, *place} : MachineDrawing::Bar{*place, other});
        };
        if (const BodyMotion* carrier = carrier_of(motion)) {
            const auto base = static_cast<std::size_t>(
                std::find(machine_.shown.begin(), machine_.shown.end(), carrier) - machine_.shown.begin());
            if (base < machine_.shown.size()) connect(machine_.joints.contains(base) ? machine_.joints.at(base) : base, true);
        }
        const bool has_bar = place.has_value();
        connect(body, false);
        machine_.joints[body] = place.value_or(body);
        return has_bar || place;
    }

    const BodyMotion* carrier_of(const BodyMotion& motion) const {
        const Body& item = *motion.member.item;
        return item.on ? find_motion(system_.bodies, *item.on, system_.scene, Translator::indices_of(motion.member)) : nullptr;
    }

    /// Bodies whose distance from the origin of the ground, or from an earlier body, no velocity changes, or none that a constraint
    /// allows.
    void add_bars_between() {
        if (std::find(has_bar_.begin(), has_bar_.end(), false) == has_bar_.end()) return;
        for (std::size_t b = 0; b < machine_.shown.size(); ++b) numbers_.push_back(numbers_of(b));
        find_constraints();
        const Numbers ground{{0, 0, 0}, std::vector<Place>(system_.symbols.degrees(), Place{0, 0, 0})};
        for (std::size_t b = 0; b < machine_.shown.size(); ++b) {
            if (machine_.hidden[b] || has_bar_[b]) continue;
            if (keeps_distance(numbers_[b], ground)) {
                if (!origin_) origin_ = machine_.add({0, 0, 0});
                machine_.drawing.bars.push_back({*origin_, b});
                continue;
            }
            for (std::size_t other = 0; other < b; ++other) {
                if (!keeps_distance(numbers_[b], numbers_[other])) continue;
                machine_.drawing.bars.push_back({other, b});
                break;
            }
        }
    }

    using Place = std::array<double, 3>;
    /// The position of a body, and how it moves with each velocity.
    struct Numbers {
        Place position;
        std::vector<Place> along;
    };

    Numbers numbers_of(std::size_t body) const {
        Numbers numbers{numbers_at(machine_.points[body]), {}};
        for (std::size_t j = 0; j < system_.symbols.degrees(); ++j)
            numbers.along.push_back(numbers_at(machine_.shown[body]->along(j, system_.symbols)));
        return numbers;
    }
    Place numbers_at(const SpaceVector& v) const { return {at_a_point(v[0]), at_a_point(v[1]), at_a_point(v[2])}; }

    /// A value where no two letters are alike: enough for a drawing to see what is zero.
    double at_a_point(const ex& e) const {
        if (e.is_zero()) return 0;
        const ex value = machine_.plain(e).subs(somewhere_, GiNaC::subs_options::no_pattern).evalf();
        return GiNaC::is_a<GiNaC::numeric>(value) ? GiNaC::ex_to<GiNaC::numeric>(value).to_double() : 1.0;
    }

    double distance(const Point& a, const Point& b) const {
        const Place from = numbers_at(a), to = numbers_at(b);
        return std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    }

    bool keeps_distance(const Numbers& a, const Numbers& b) {
        double square = 0;
        for (std::size_t i = 0; i < 3; ++i) square += (a.position[i] - b.position[i]) * (a.position[i] - b.position[i]);
        if (!(square > 1e-18)) return false;
        std::vector<double> change(a.along.size(), 0);  // of half the square, by velocities
        for (std::size_t j = 0; j < change.size(); ++j)
            for (std::size_t i = 0; i < 3; ++i) change[j] += (a.position[i] - b.position[i]) * (a.along[j][i] - b.along[j][i]);
        const auto is_small = [&](double one) { return std::fabs(one) <= 1e-9 * square; };
        return std::all_of(change.begin(), change.end(), is_small) || is_held(change);
    }

    /// Rates of constraints on positions that always hold, by velocities.
    void find_constraints() {
        for (const ConstraintEquation& constraint : system_.constraints) {
            if (machine_.has_modes() || !constraint.position || !constraint.holds) continue;
            std::vector<double> row;
            for (const ex& e : constraint.rate.jacobian) row.push_back(at_a_point(e));
            rows_.emplace_back("constraint " + constraint.name, std::move(row));
        }
    }

    /// Whether one constraint keeps what changes so as it is.
    bool is_held(const std::vector<double>& change) {
        const auto is_smaller = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
        for (const auto& [name, row] : rows_) {
            const auto largest = static_cast<std::size_t>(std::max_element(row.begin(), row.end(), is_smaller) - row.begin());
            if (row[largest] == 0) continue;
            const double ratio = change[largest] / row[largest], size = std::fabs(change[largest]);
            std::size_t j = 0;
            while (j < row.size() && std::fabs(change[j] - ratio * row[j]) <= 1e-9 * size) ++j;
            if (j < row.size()) continue;
            machine_.drawn.insert(name);
            return true;
        }
        return false;
    }

    MachineBuilder& machine_;
    const System& system_;
    std::vector<bool> has_bar_;
    std::optional<std::size_t> origin_;  ///< of the ground
    GiNaC::exmap somewhere_;
    std::vector<Numbers> numbers_;  ///< of the bodies
    std::vector<std::pair<std::string, std::vector<double>>> rows_;
};

}  // namespace

void add_bars(MachineBuilder& machine) { BarMaker(machine).run(); }

}  // namespace dalembert
