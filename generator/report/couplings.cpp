// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/couplings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "report/drawn_points.hpp"
#include "report/maker.hpp"

namespace dalembert {

namespace {

using GiNaC::ex;
/// A rate by velocities.
using Row = std::vector<ex>;

Row rate_row(const ex& rate, const Item& of, const Symbols& symbols) { return affine_rate(rate, symbols, of.span, "the rate").jacobian; }
Row rate_row(const BodyMotion& rotor, const Symbols& symbols) { return rate_row(rotor.angular_velocity, *rotor.member.item, symbols); }

/// Constant factors, or nothing.
std::optional<Row> row_of(const std::vector<ex>& jacobian, const Symbols& symbols) {
    Row row;
    bool is_zero = true;
    for (const ex& e : jacobian) {
        row.push_back(symbols.without_definitions(e).expand());
        if (moves(row.back(), symbols)) return std::nullopt;
        is_zero = is_zero && row.back().is_zero();
    }
    return is_zero ? std::nullopt : std::optional(row);
}

class CouplingMaker {
public:
    CouplingMaker(const System& system, const std::vector<std::string>& unplaced)
        : system_(system), unplaced_(unplaced), rotors_(rotors_of(system)) {
        for (const BodyMotion* rotor : rotors_)
            rows_.push_back(row_of(rate_row(*rotor, system.symbols), system.symbols).value());
    }

    std::vector<Coupling> run() {
        if (rotors_.empty()) return {};
        add_shafts();
        for (const Member<Spring>& member : system_.scene.springs) {
            if (!is_looked_at("spring " + member.name())) continue;
            const ex elongation = system_.translate(*member.item->elongation, Translator::indices_of(member));
            Row row;
            for (std::size_t j = 0; j < system_.symbols.degrees(); ++j) row.push_back(system_.symbols.along(elongation, j));
            for (const Potential& one : system_.potentials)
                if (one.origin == Potential::Origin::spring && one.name == fmt::format("spring '{}'", member.name()))
                    add("torsion spring", member, row, one.force);
        }
        for (const Member<Damper>& member : system_.scene.dampers) {
            const std::string name = "damper " + member.name();
            if (!member.item->rate || !is_looked_at(name)) continue;
            const ex rate = system_.translate(*member.item->rate, Translator::indices_of(member));
            for (const Resistance& one : system_.resistances)
                if (one.name == name) add("torsion damper", member, rate_row(rate, *member.item, system_.symbols), one.force);
        }
        for (const Member<Torque>& member : system_.scene.torques)
            if (is_looked_at("torque " + member.name())) add_torque(member);
        for (const ConstraintEquation& constraint : system_.constraints)
            if (is_looked_at("constraint " + constraint.name)) add_constraint(constraint);
        return std::move(couplings_);
    }

private:
    bool is_looked_at(const std::string& name) const { return std::find(unplaced_.begin(), unplaced_.end(), name) != unplaced_.end(); }

    struct Ends {
        std::optional<std::size_t> from;
        std::size_t to;
        ex from_share = 0, to_share = 0;  ///< the rate is from_share*(speed of from) + to_share*(speed of to)
        /// How many turn as fast as the rate.
        int rank() const {
            const auto is_one = [](const ex& share) { return share.is_equal(1) || share.is_equal(-1); };
            return (from ? 0 : 4) + (is_one(to_share) ? 1 : 0) + (is_one(from_share) ? 1 : 0);
        }
    };

    /// A factor that some column asks for, where only one of the two turns.
    static std::optional<ex> share_of(const Row& rate, const Row& rotor, const Row* other) {
        for (std::size_t j = 0; j < rate.size(); ++j)
            if (!rotor[j].is_zero() && (other == nullptr || (*other)[j].is_zero())) return (rate[j] / rotor[j]).normal();
        return std::nullopt;
    }

    std::optional<Ends> between(const Row& rate, std::optional<std::size_t> from, std::size_t to) const {
        const Row* first = from ? &rows_[*from] : nullptr;
        Ends ends{from, to};
        if (first != nullptr) {
            const auto a = share_of(rate, *first, &rows_[to]);
            if (!a || a->is_zero()) return std::nullopt;
            ends.from_share = *a;
        }
        const auto b = share_of(rate, rows_[to], first);
        if (!b || b->is_zero()) return std::nullopt;
        ends.to_share = *b;
        for (std::size_t j = 0; j < rate.size(); ++j) {
            ex rest = rate[j] - ends.to_share * rows_[to][j];
            if (first != nullptr) rest -= ends.from_share * (*first)[j];
            if (!rest.normal().is_zero()) return std::nullopt;
        }
        return ends;
    }

    /// See note [ends of couplings].
    std::optional<Ends> ends_of(const std::vector<ex>& jacobian) const {
        const std::optional<Row> rate = row_of(jacobian, system_.symbols);
        if (!rate) return std::nullopt;
        std::optional<Ends> best;
        const auto take = [&](const std::optional<Ends>& one) {
            if (one && (!best || one->rank() > best->rank())) best = one;
        };
        for (std::size_t b = 0; b < rotors_.size(); ++b) {
            take(between(*rate, std::nullopt, b));
            for (std::size_t a = 0; a < b; ++a) take(between(*rate, a, b));
        }
        return best;
    }

    void put(Coupling one, const Item& item, const std::string& kind, const std::string& member) {
        const std::optional<Maker> maker = maker_of(item, *system_.scene.model);
        one.name = (maker ? maker->name : item.name) + member.substr(item.name.size());
        one.elements.insert(kind + " " + member);
        one.is_made = maker.has_value();
        for (Coupling& other : couplings_) {
            if (!one.is_made || !other.is_made || one.name != other.name || one.from != other.from || one.to != other.to) continue;
            if (one.kind == "clutch") other.kind = one.kind;
            other.torque += one.torque;
            other.holds += one.holds;
            other.elements.merge(one.elements);
            return;
        }
        couplings_.push_back(std::move(one));
    }

    /// `force`: on the machine, by coordinates.
    template <class Element>
    void add(const char* kind, const Member<Element>& member, const Row& rate, const Generalised& force) {
        const std::optional<Ends> ends = ends_of(rate);
        if (!ends) return;
        const Row row = row_of(rate, system_.symbols).value();
        const auto is_there = [](const ex& e) { return !e.is_zero(); };
        const auto j = static_cast<std::size_t>(std::find_if(row.begin(), row.end(), is_there) - row.begin());
        put({kind, "", ends->from, ends->to, ends->to_share * force[j] / row[j]}, *member.item, kind_of<Element>.word, member.name());
    }

    void add_torque(const Member<Torque>& member) {
        const Torque& torque = *member.item;
        const Indices indices = Translator::indices_of(member);
        const auto value = [&] { return system_.translate(torque.torque, indices); };
        if (torque.vector) return;
        if (torque.rate) {
            if (const auto ends = ends_of(rate_row(system_.translate(torque.rate, indices), torque, system_.symbols)))
                put({"torque", "", ends->from, ends->to, ends->to_share * value()}, torque, "torque", member.name());
            return;
        }
        const auto place_of = [&](const Reference& reference) -> std::optional<std::size_t> {
            const BodyMotion* body = find_motion(system_.bodies, reference, system_.scene, indices);
            const auto found = std::find(rotors_.begin(), rotors_.end(), body);
            if (found == rotors_.end()) return std::nullopt;
            return static_cast<std::size_t>(found - rotors_.begin());
        };
        const std::optional<std::size_t> on = place_of(*torque.on);
        const std::optional<std::size_t> against = torque.against ? place_of(*torque.against) : std::nullopt;
        if (on && (against || !torque.against)) put({"torque", "", against, *on, value()}, torque, "torque", member.name());
    }

    void add_constraint(const ConstraintEquation& constraint) {
        const std::optional<Ends> ends = ends_of(constraint.rate.jacobian);
        if (!ends) return;
        const Constraint& item = *constraint.item;
        const bool may_let_go = (item.when && !system_.scene.modes.empty()) || item.share || !constraint.holds;
        Coupling one{"gear", "", ends->from, ends->to};
        if (ends->from) one.ratio = (-ends->to_share / ends->from_share).normal();
        if (one.ratio && one.ratio->is_equal(1)) one.kind = "shaft";
        if (!ends->from || item.is_made || may_let_go) one.kind = "clutch";
        one.holds = item.share ? system_.translate(*item.share, {}) : ex(constraint.holds ? 1 : 0);
        put(std::move(one), item, "constraint", constraint.name);
    }

    /// Rotors whose speeds are in a constant ratio, one after the other.
    void add_shafts() {
        for (std::size_t b = 1; b < rotors_.size(); ++b)
            for (std::size_t a = b; a-- > 0;)
                if (const auto ends = between(rows_[a], std::nullopt, b)) {
                    const bool is_one = ends->to_share.is_equal(1);
                    couplings_.push_back({is_one ? "shaft" : "gear", "", a, b, 0, ends->to_share});
                    break;
                }
    }

    const System& system_;
    const std::vector<std::string>& unplaced_;
    std::vector<const BodyMotion*> rotors_;
    std::vector<Row> rows_;
    std::vector<Coupling> couplings_;
};

}  // namespace

std::vector<const BodyMotion*> rotors_of(const System& system) {
    std::vector<const BodyMotion*> rotors;
    for (const BodyMotion& body : system.bodies) {
        if (!body.has_position && body.turns && row_of(rate_row(body, system.symbols), system.symbols))
            rotors.push_back(&body);
    }
    return rotors;
}

std::vector<Coupling> couplings_of(const System& system, const std::vector<std::string>& unplaced) {
    return CouplingMaker(system, unplaced).run();
}

}  // namespace dalembert
