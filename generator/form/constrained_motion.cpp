// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/constrained_motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "balance/steps.hpp"
#include "form/repeated_rates.hpp"
#include "form/shared_forces.hpp"
#include "symbolic/squares.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Rows of A qd + b = 0, eliminated until each gives the velocity of a coordinate that no other mentions; and rows from which none follows.
class Elimination {
    static constexpr std::size_t few = 4;  ///< coordinates, whose order is looked after

public:
    explicit Elimination(System& system) : system_(system), symbols_(system.symbols), n_(symbols_.degrees()) {}

    void run() {
        for (std::size_t i = 0; i < system_.constraints.size(); ++i)
            if (system_.constraints[i].holds) add(i);
        settle_repeated_rates(system_, rows_, kept_);
        Motion& motion = system_.motion;
        for (std::size_t j = 0; j < n_; ++j)
            if (std::none_of(rows_.begin(), rows_.end(), [&](const Row& row) { return row.pivot == j; })) motion.free.push_back(j);
        if (rows_.empty() && n_ <= few) constant_pivots_first();
        for (const Row& row : kept_) motion.multipliers.push_back(row.constraint);
        dependent();
        rows_.empty() ? whole() : reduced();
        forces();
    }

private:
    using Row = RateRow;

    Indices indices_of(std::size_t constraint) const { return Translator::indices_of(system_.scene.constraints[constraint]); }
    const ex& velocity(std::size_t j) const { return symbols_.get(SymbolKind::velocity, j); }
    const ex& acceleration(std::size_t j) const { return symbols_.get(SymbolKind::acceleration, j); }

    /// An entry of M on the diagonal that does not change is a pivot whose reciprocal is computed once, if it comes first.
    void constant_pivots_first() {
        Squares squares{PositiveByRange(system_.translate)};
        std::vector<std::size_t>& free = system_.motion.free;
        std::stable_partition(free.begin(), free.end(), [&](std::size_t k) {
            const ex& pivot = system_.mass(static_cast<unsigned>(k), static_cast<unsigned>(k));
            return symbols_.is_constant(pivot) || symbols_.is_constant(squares.shortened(pivot));
        });
    }

    void add(std::size_t constraint) {
        Row row = row_of(system_, constraint);
        if (!system_.scene.mode || is_zero(row)) check_rate(system_, row, rows_, kept_);
        for (const Row& other : rows_) subtract(row, other);
        if (!system_.scene.mode) check_rate(system_, row, rows_, kept_);
        if (is_zero(row) || !choose_pivot(row)) {
            kept_.push_back(std::move(row));
            return;
        }
        const ex scale = row.factors[row.pivot];
        const auto divide = [&](ex& e) { e = (e / scale).expand(); };
        std::for_each(row.factors.begin(), row.factors.end(), divide);
        std::for_each(row.made_of.begin(), row.made_of.end(), divide);
        divide(row.drift);
        for (auto* others : {&rows_, &kept_})
            for (Row& other : *others) subtract(other, row);
        if (!system_.scene.mode)
            for (const Row& other : kept_) check_rate(system_, other, rows_, kept_);
        rows_.push_back(std::move(row));
    }

    bool has_sign(const ex& factor) const {
        return factor.info(GiNaC::info_flags::positive) || ex(-factor).info(GiNaC::info_flags::positive);
    }

    /// The coordinate that is asked for; else the last one with a number as its factor, or with parameters that have a sign, or with
    /// parameters alone. False if there is none.
    bool choose_pivot(Row& row) const {
        if (row.item->multiplier) return false;
        if (row.item->eliminates) {
            const Reference& wanted = *row.item->eliminates;
            row.pivot = system_.translate.coordinate(wanted.name, wanted.index.get(), wanted.span, indices_of(row.constraint));
            const ex& factor = row.factors[row.pivot];
            if (!factor.is_zero() && is_of_parameters(factor, symbols_)) return true;
            throw Failure(Diagnostic{Id::undetermined,
                                     wanted.span,
                                     factor.is_zero()
                                         ? fmt::format("constraint '{}'{} cannot eliminate '{}': its rate does not contain this velocity{}",
                                                       system_.constraints[row.constraint].name, in_which_mode(system_.scene),
                                                       symbols_.all(SymbolKind::velocity)[row.pivot].name,
                                                       rows_.empty() ? "" : " after the other constraints are inserted")
                                         : fmt::format("constraint '{}'{} cannot eliminate '{}' everywhere: its factor in the rate changes "
                                                       "and may become zero; leave out 'eliminates'",
                                                       system_.constraints[row.constraint].name, in_which_mode(system_.scene),
                                                       symbols_.all(SymbolKind::velocity)[row.pivot].name),
                                     {{row.item->span, "the constraint"}}});
        }
        for (const int demand : {2, 1, 0})
            for (std::size_t j = n_; j-- > 0;) {
                const ex& factor = row.factors[j];
                if (factor.is_zero()) continue;
                if (demand == 2 ? !GiNaC::is_a<GiNaC::numeric>(factor)
                                : !is_of_parameters(factor, symbols_) || (demand == 1 && !has_sign(factor)))
                    continue;
                row.pivot = j;
                return true;
            }
        return false;
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

    /// R - J' lambda of the multipliers.
    ex remainder(std::size_t j) const {
        GiNaC::exvector terms{system_.residual[j]};
        for (const Row& row : kept_)
            terms.push_back(-system_.constraints[row.constraint].rate.jacobian[j] * symbols_.get(SymbolKind::multiplier, row.constraint));
        return GiNaC::add(terms);
    }

    /// -(J qdd - gamma), of free accelerations.
    ex held_rate(const Row& row) const {
        GiNaC::exvector terms{row.drift};
        for (const std::size_t k : system_.motion.free) terms.push_back(row.factors[k] * velocity(k));
        return -system_.with_rates(symbols_.time_derivative(GiNaC::add(terms))).subs(accelerations_, GiNaC::subs_options::no_pattern);
    }

    /// Nothing is eliminated: the rows are those of the equations of motion as they stand.
    void whole() {
        Motion& motion = system_.motion;
        const auto n = static_cast<unsigned>(n_), size = static_cast<unsigned>(motion.unknowns());
        motion.matrix = GiNaC::matrix(size, size);
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j)
                motion.matrix(i, j) = system_.mass(static_cast<unsigned>(motion.free[i]), static_cast<unsigned>(motion.free[j]));
        for (const std::size_t j : motion.free) {
            motion.force.push_back(system_.supplied[j] - system_.bias[j]);
            motion.residual.push_back(kept_.empty() ? system_.residual[j] : remainder(j));
        }
        GiNaC::exmap at_rest;
        for (std::size_t k = 0; k < n_; ++k) at_rest[acceleration(k)] = 0;
        for (unsigned i = 0; i < kept_.size(); ++i) {
            for (unsigned j = 0; j < n; ++j) motion.matrix(n + i, j) = motion.matrix(j, n + i) = -kept_[i].factors[motion.free[j]];
            const ex residual = held_rate(kept_[i]);
            motion.residual.push_back(residual);
            motion.force.push_back(-residual.subs(at_rest, GiNaC::subs_options::no_pattern));
        }
    }

    /// N' R with R = M qdd + bias - Q - J' lambda and N the motions that the eliminated rows leave: R[k] - sum over rows of
    /// factor[k]*R[pivot].
    void reduced() {
        Motion& motion = system_.motion;
        const std::vector<ex> unknowns = system_.unknowns();
        const auto size = static_cast<unsigned>(unknowns.size());
        motion.matrix = GiNaC::matrix(size, size);
        GiNaC::exmap at_rest;
        for (const ex& unknown : unknowns) at_rest[unknown] = 0;
        for (unsigned i = 0; i < size; ++i) {
            GiNaC::exvector terms;
            if (i < motion.free.size()) {
                terms.push_back(along(motion.free[i]));
                for (const Row& row : rows_) terms.push_back(-row.factors[motion.free[i]] * along(row.pivot));
            } else {
                terms.push_back(held_rate(kept_[i - motion.free.size()]));
            }
            const ex residual = ex(GiNaC::add(terms)).expand();
            const ex force = -residual.subs(at_rest, GiNaC::subs_options::no_pattern);
            GiNaC::exvector rebuilt{-force};
            for (unsigned l = 0; l < size; ++l) {
                motion.matrix(i, l) = partial(residual, unknowns[l]);
                rebuilt.push_back(motion.matrix(i, l) * unknowns[l]);
            }
            motion.force.push_back(force);
            motion.residual.push_back(GiNaC::add(rebuilt));
        }
    }

    /// What is left of a coordinate's residual, made of unknowns.
    ex along(std::size_t j) const { return remainder(j).subs(accelerations_, GiNaC::subs_options::no_pattern); }

    /// R = A' lambda, and the eliminated rows bear mu = R[pivot].
    void forces() {
        for (std::size_t i = 0; i < system_.constraints.size(); ++i) {
            ConstraintEquation& constraint = system_.constraints[i];
            if (!constraint.holds || (constraint.is_redundant && system_.scene.mode)) continue;
            constraint.has_multiplier = std::any_of(kept_.begin(), kept_.end(), [&](const Row& row) { return row.constraint == i; });
            if (constraint.has_multiplier) {
                constraint.force = symbols_.get(SymbolKind::multiplier, i);
            } else {
                GiNaC::exvector terms;
                for (const Row& row : rows_) terms.push_back(row.made_of[i] * along(row.pivot));
                constraint.force = ex(GiNaC::add(terms)).expand();
            }
            system_.prescribed_power -= constraint.force * constraint.rate.drift;
            if (constraint.item->share && constraint.item->elsewhere)
                constraint.force += system_.translate(*constraint.item->elsewhere, indices_of(i));
        }
    }

    System& system_;
    const Symbols& symbols_;
    std::size_t n_;
    std::vector<Row> rows_;  ///< eliminated
    std::vector<Row> kept_;  ///< with multipliers
    GiNaC::exmap accelerations_;
};

}  // namespace

std::optional<std::pair<std::size_t, ex>> coordinate_at_zero(const ex& position, const Symbols& symbols,
                                                             const std::function<bool(const ex&)>& may_divide_by) {
    for (std::size_t j = symbols.degrees(); j-- > 0;) {
        if (!symbols.has_value(j)) continue;
        const ex& q = symbols.get(SymbolKind::coordinate, j);
        const ex factor = partial(position, q).expand();
        if (factor.is_zero() || !(GiNaC::is_a<GiNaC::numeric>(factor) || (may_divide_by && may_divide_by(factor)))) continue;
        return std::pair(j, ex((-position.subs(GiNaC::ex(q) == 0, GiNaC::subs_options::no_pattern) / factor).expand()));
    }
    return std::nullopt;
}

std::size_t left_out_at_start(const System& system) {
    const auto& m = system.motion.multipliers;
    return static_cast<std::size_t>(
        std::count_if(m.begin(), m.end(), [&](std::size_t constraint) { return system.constraints[constraint].is_redundant; }));
}

void constrain(System& system) {
    for (const auto& member : system.scene.constraints) {
        const Constraint& item = *member.item;
        const Indices indices = Translator::indices_of(member);
        ConstraintEquation c{&item, system.scene.holds(item.when), false, false, {}, std::nullopt, 0, 0, member.name(), member.index};
        if (item.position) c.position = system.translate(*item.position, indices);
        c.whole_rate = item.rate ? system.translate(*item.rate, indices) : system.symbols.time_derivative(*c.position);
        c.rate = affine_rate(c.whole_rate, system.symbols, item.span, fmt::format("the rate of constraint '{}'", c.name));
        if (item.share) {
            const ex share = system.translate(*item.share, indices);
            c.whole_rate *= share;
            c.rate.drift *= share;
            for (ex& factor : c.rate.jacobian) factor *= share;
        }
        if (item.elsewhere && !c.holds) c.force = system.translate(*item.elsewhere, indices);
        if (c.holds && c.position)
            if (auto at_zero = coordinate_at_zero(*c.position, system.symbols)) system.motion.positions.push_back(std::move(*at_zero));
        system.constraints.push_back(std::move(c));
    }
    Elimination(system).run();
    weigh_constraints(system);
}

}  // namespace dalembert
