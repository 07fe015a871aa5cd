// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/constrained_motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "balance/steps.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

std::string in_which_mode(const Scene& scene) { return scene.mode ? fmt::format(" in mode '{}'", scene.modes[*scene.mode].name) : std::string(); }

/// Rows of A qd + b = 0, eliminated until each gives the velocity of a coordinate that no other mentions.
class Elimination {
public:
    explicit Elimination(System& system) : system_(system), symbols_(system.symbols), n_(symbols_.degrees()) {}

    void run() {
        for (std::size_t i = 0; i < system_.constraints.size(); ++i)
            if (system_.constraints[i].holds) add(i);
        Motion& motion = system_.motion;
        for (std::size_t j = 0; j < n_; ++j)
            if (std::none_of(rows_.begin(), rows_.end(), [&](const Row& row) { return row.pivot == j; })) motion.free.push_back(j);
        if (rows_.empty()) return whole();
        dependent();
        reduced();
        forces();
    }

private:
    struct Row {
        std::vector<ex> factors;
        ex drift;
        std::vector<ex> made_of;  ///< factors of the constraints
        std::size_t pivot = 0;
        const Constraint* item = nullptr;
    };

    const ex& velocity(std::size_t j) const { return symbols_.get(SymbolKind::velocity, j); }
    const ex& acceleration(std::size_t j) const { return symbols_.get(SymbolKind::acceleration, j); }

    static void subtract(Row& from, const Row& row) {
        const ex factor = from.factors[row.pivot];
        if (factor.is_zero()) return;
        const auto take = [&](ex& a, const ex& b) { a = (a - factor * b).expand(); };
        for (std::size_t j = 0; j < from.factors.size(); ++j) take(from.factors[j], row.factors[j]);
        take(from.drift, row.drift);
        for (std::size_t i = 0; i < from.made_of.size(); ++i) take(from.made_of[i], row.made_of[i]);
    }

    void add(std::size_t constraint) {
        const ConstraintEquation& c = system_.constraints[constraint];
        Row row{c.rate.jacobian, c.rate.drift, std::vector<ex>(system_.constraints.size(), 0), 0, c.item};
        for (ex& factor : row.factors) factor = factor.expand();
        row.made_of[constraint] = 1;
        for (const Row& other : rows_) subtract(row, other);
        choose_pivot(row);
        const ex scale = row.factors[row.pivot];
        const auto divide = [&](ex& e) { e = (e / scale).expand(); };
        std::for_each(row.factors.begin(), row.factors.end(), divide);
        std::for_each(row.made_of.begin(), row.made_of.end(), divide);
        divide(row.drift);
        for (Row& other : rows_) subtract(other, row);
        rows_.push_back(std::move(row));
    }

    /// The last coordinate with a number as its factor, else with parameters that have a sign, else with parameters alone.
    void choose_pivot(Row& row) const {
        const auto is_good = [&](const ex& factor, int demand) {
            if (demand == 2) return GiNaC::is_a<GiNaC::numeric>(factor);
            const bool has_sign = factor.info(GiNaC::info_flags::positive) || ex(-factor).info(GiNaC::info_flags::positive);
            return is_of_parameters(factor, symbols_) && (demand == 0 || has_sign);
        };
        for (const int demand : {2, 1, 0})
            for (std::size_t j = n_; j-- > 0;) {
                const ex& factor = row.factors[j];
                if (factor.is_zero() || !is_good(factor, demand)) continue;
                row.pivot = j;
                return;
            }
        const bool is_empty = std::all_of(row.factors.begin(), row.factors.end(), [](const ex& f) { return f.is_zero(); });
        const bool is_alone = rows_.empty();
        if (is_empty && is_alone) throw Failure(Diagnostic{Id::undetermined, row.item->span, fmt::format("constraint '{}' holds a rate that no velocity changes", row.item->name)});
        if (is_empty) {
            std::vector<Note> notes;
            for (const Row& other : rows_) notes.push_back({other.item->span, fmt::format("'{}' holds, too", other.item->name)});
            throw Failure(Diagnostic{Id::doubly_determined, row.item->span,
                                     fmt::format("constraint '{}'{} follows from others, so that what each of them bears is not determined", row.item->name, in_which_mode(system_.scene)), std::move(notes)});
        }
        throw Failure(Diagnostic{Id::undetermined, row.item->span,
                                 fmt::format("constraint '{}'{} cannot be solved for a velocity{}: this version needs one whose factor in the rate does not move", row.item->name, in_which_mode(system_.scene), is_alone ? "" : " that others leave free")});
    }

    void whole() {
        Motion& motion = system_.motion;
        motion.mass = system_.mass;
        for (std::size_t j = 0; j < n_; ++j) motion.force.push_back(system_.supplied[j] - system_.bias[j]);
        motion.residual = system_.residual;
    }

    void dependent() {
        Motion& motion = system_.motion;
        for (const Row& row : rows_) {
            AffineRate by_free{{}, -row.drift};
            ex rate = velocity(row.pivot) + row.drift;
            for (const std::size_t k : motion.free) {
                by_free.jacobian.push_back(-row.factors[k]);
                rate += row.factors[k] * velocity(k);
            }
            const ex solved = (acceleration(row.pivot) - system_.with_rates(symbols_.time_derivative(rate))).expand();
            motion.velocities.emplace_back(row.pivot, std::move(by_free));
            motion.accelerations.emplace_back(row.pivot, solved);
            accelerations_[acceleration(row.pivot)] = solved;
        }
    }

    /// N' R with R = M qdd + bias - Q and N the motions that A leaves: R[k] - sum over rows of factor[k]*R[pivot].
    void reduced() {
        Motion& motion = system_.motion;
        const std::size_t free = motion.free.size();
        motion.mass = GiNaC::matrix(static_cast<unsigned>(free), static_cast<unsigned>(free));
        GiNaC::exmap at_rest;
        for (const std::size_t k : motion.free) at_rest[acceleration(k)] = 0;
        for (std::size_t i = 0; i < free; ++i) {
            GiNaC::exvector terms{along(motion.free[i])};
            for (const Row& row : rows_) terms.push_back(-row.factors[motion.free[i]] * along(row.pivot));
            const ex residual = ex(GiNaC::add(terms)).expand();
            const ex force = -residual.subs(at_rest, GiNaC::subs_options::no_pattern);
            GiNaC::exvector rebuilt{-force};
            for (std::size_t l = 0; l < free; ++l) {
                const ex factor = partial(residual, acceleration(motion.free[l]));
                motion.mass(static_cast<unsigned>(i), static_cast<unsigned>(l)) = factor;
                rebuilt.push_back(factor * acceleration(motion.free[l]));
            }
            motion.force.push_back(force);
            motion.residual.push_back(GiNaC::add(rebuilt));
        }
    }

    /// The residual of a coordinate, made of free accelerations.
    ex along(std::size_t j) const { return system_.residual[j].subs(accelerations_, GiNaC::subs_options::no_pattern); }

    /// R = A' lambda, and the rows bear mu = R[pivot].
    void forces() {
        for (std::size_t i = 0; i < system_.constraints.size(); ++i) {
            if (!system_.constraints[i].holds) continue;
            GiNaC::exvector terms;
            for (const Row& row : rows_) terms.push_back(row.made_of[i] * along(row.pivot));
            system_.constraints[i].force = ex(GiNaC::add(terms)).expand();
            system_.prescribed_power -= system_.constraints[i].force * system_.constraints[i].rate.drift;
        }
    }

    System& system_;
    const Symbols& symbols_;
    std::size_t n_;
    std::vector<Row> rows_;
    GiNaC::exmap accelerations_;
};

}  // namespace

std::optional<std::pair<std::size_t, ex>> coordinate_at_zero(const ex& position, const Symbols& symbols) {
    for (std::size_t j = symbols.degrees(); j-- > 0;) {
        const ex& q = symbols.get(SymbolKind::coordinate, j);
        const ex factor = partial(position, q).expand();
        if (!GiNaC::is_a<GiNaC::numeric>(factor) || factor.is_zero()) continue;
        return std::pair(j, ex((-position.subs(GiNaC::ex(q) == 0, GiNaC::subs_options::no_pattern) / factor).expand()));
    }
    return std::nullopt;
}

void constrain(System& system) {
    for (const auto& member : system.scene.constraints) {
        const Constraint& item = *member.item;
        ConstraintEquation c{&item, system.scene.holds(item.when), {}, std::nullopt, 0, 0};
        if (item.position) c.position = system.translate(item.position, {});
        c.whole_rate = item.rate ? system.translate(item.rate, {}) : system.symbols.time_derivative(*c.position);
        c.rate = affine_rate(c.whole_rate, system.symbols, item.span, fmt::format("the rate of constraint '{}'", item.name));
        if (item.elsewhere && !c.holds) c.force = system.translate(item.elsewhere, {});
        if (c.holds && c.position)
            if (auto at_zero = coordinate_at_zero(*c.position, system.symbols)) system.motion.positions.push_back(std::move(*at_zero));
        system.constraints.push_back(std::move(c));
    }
    Elimination(system).run();
}

}  // namespace dalembert
