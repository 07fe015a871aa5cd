// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/repeated_rates.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "balance/steps.hpp"
#include "form/on_constraints.hpp"
#include "form/shared_forces.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/squares.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class RepeatedRates {
    using Row = RateRow;

public:
    RepeatedRates(System& system, const std::vector<Row>& eliminated, std::vector<Row>& kept)
        : system_(system), symbols_(system.symbols), rows_(eliminated), kept_(kept) {}

    void run() {
        find_repetitions();
        leave_out_redundant();
        check_sliding();
        for (Repetition& r : system_.repetitions)
            if (r.is_even) std::transform(r.made_of.begin(), r.made_of.end(), r.made_of.begin(), kept_fraction);
        check_shares();
    }

private:
    /// Its sums stay letters where it is multiplied out.
    static ex kept_fraction(const ex& factor) {
        const ex fraction = factor.normal().numer_denom();
        const auto kept = [](const ex& e) { return GiNaC::is_a<GiNaC::add>(e) ? ex(dalembert::whole(e)) : e; };
        return kept(in_cosines(fraction.op(0))) / kept(in_cosines(fraction.op(1)));
    }
    /// Of what constraints in a mode repeat each other, each of which may have to let go.
    void find_repetitions() {
        if (!system_.scene.mode) return;
        std::vector<std::vector<ex>> repeated;
        std::vector<Row> kept;
        for (Row& row : kept_) {
            for (const Row& other : kept)
                if (const auto factor = multiple_of(row, other, symbols_)) take(row, *factor, other);
            if (!is_zero(row)) {
                kept.push_back(std::move(row));
                continue;
            }
            // What moves at a rate of its own cannot be held.
            if (!row.drift.is_zero() && !row.drift.normal().is_zero()) check_rate(system_, row, rows_, kept_);
            repeated.push_back(row.made_of);
        }
        kept_ = std::move(kept);
        system_.repetitions = repetitions(system_, std::move(repeated));
        if (auto why = why_not_shared(system_, system_.repetitions)) throw Failure(std::move(*why));
    }

    /// Where friction slides: 1 forwards, -1 backwards.
    int slides(const ConstraintEquation& c) const {
        if (c.holds || c.item->elsewhere == nullptr) return 0;
        return system_.scene.modes[*system_.scene.mode].is_in(c.item->name + "_slides_forwards") ? 1 : -1;
    }

    /// Frictions on the same rate slide the same way.
    void check_directions(std::size_t i) const {
        const Row row = row_of(system_, i);
        for (std::size_t j = 0; j < i; ++j) {
            const ConstraintEquation& before = system_.constraints[j];
            if (slides(before) == 0) continue;
            const Row other = row_of(system_, j);
            const auto factor = multiple_of(row, other, symbols_);
            if (!factor || !ex(row.drift - *factor * other.drift).expand().is_zero() ||
                slides(before) * sign_of_factor(*factor) != -slides(system_.constraints[i]))
                continue;
            throw Failure(Diagnostic{Id::doubly_determined,
                                     row.item->span,
                                     fmt::format("frictions '{}' and '{}' have the same rate and cannot slide in opposite directions",
                                                 before.name, system_.constraints[row.constraint].name),
                                     {{before.item->span, "the other friction"}}});
        }
    }

    /// Friction does not slide where other constraints hold its rate: then the mode in which it sticks is the one that counts.
    void check_sliding() const {
        if (!system_.scene.mode) return;
        for (std::size_t i = 0; i < system_.constraints.size(); ++i) {
            const ConstraintEquation& c = system_.constraints[i];
            if (slides(c) == 0) continue;
            check_directions(i);
            Row row = row_of(system_, i);
            if (is_zero(row)) continue;
            for (const Row& other : rows_) subtract(row, other);
            for (const Row& other : kept_)
                if (const auto factor = multiple_of(row, other, symbols_)) take(row, *factor, other);
            if (is_zero(row)) {
                if (!vanishes(row.drift)) continue;
                std::vector<std::vector<ex>> repeated = known_repetitions();
                repeated.push_back(row.made_of);
                if (why_not_shared(system_, repetitions(system_, std::move(repeated)))) continue;
            } else {
                auto followed = what_follows(row, kept_);
                if (!followed || !vanishes(followed->drift) || !are_of_frictions(system_, followed->made_of)) continue;
                row = std::move(*followed);
            }
            std::vector<Note> notes;
            for (std::size_t other = 0; other < row.made_of.size(); ++other)
                if (other != i && !row.made_of[other].is_zero())
                    notes.push_back({system_.constraints[other].item->span, fmt::format("'{}' holds it", system_.constraints[other].name)});
            throw Failure(
                Diagnostic{Id::doubly_determined, c.item->span,
                           fmt::format("friction '{}' does not slide{}: its rate is held at zero", c.name, in_which_mode(system_.scene)),
                           std::move(notes)});
        }
    }

    /// What a state lets go has a row that is zero there, and is not brought back to zero.
    [[noreturn]] static void refuse_apart(const ConstraintEquation& c, const std::string& why) {
        throw Failure(Diagnostic{
            Id::too_large, c.item->span,
            fmt::format("there are so many combinations of modes that friction '{}' gets a state instead of modes. This is impossible: "
                        "where it {}. It keeps its modes if there are fewer combinations, or if the file names one of its modes",
                        c.name, why)});
    }

    void check_shares() const {
        const auto find = [&](bool has_share) {
            return std::find_if(kept_.begin(), kept_.end(), [&](const Row& row) { return (row.item->share != nullptr) == has_share; });
        };
        const auto apart = find(true), other = find(false);
        if (apart == kept_.end()) return;
        if (other != kept_.end())
            refuse_apart(system_.constraints[apart->constraint],
                         fmt::format("sticks, constraint '{}' holds a rate that determines no velocity of a coordinate",
                                     system_.constraints[other->constraint].name));
        for (const Row& row : kept_) {
            const ConstraintEquation& c = system_.constraints[row.constraint];
            const ex share = system_.translate(c.item->share, {});
            const auto moves = [&](const ex& factor) { return !is_of_parameters(ex(factor / share).normal(), symbols_); };
            if (std::any_of(row.factors.begin(), row.factors.end(), moves))
                refuse_apart(c, "sticks, the factors of the velocities in its rate change with time or position");
            if (moves(row.drift)) refuse_apart(c, "sticks, the speed of its surface is not constant");
        }
    }

    std::vector<std::vector<ex>> known_repetitions() const {
        std::vector<std::vector<ex>> known;
        for (const Repetition& r : system_.repetitions) known.push_back(r.made_of);
        return known;
    }

    /// Frictions that stick in one loop: each rate follows from that of another one, with a factor that changes with the motion. Takes
    /// those that share what they hold out of the redundant ones.
    void share_evenly(std::vector<std::size_t>& redundant) {
        if (!system_.scene.mode) return;
        const auto is_redundant = [&](const Row& row) { return std::count(redundant.begin(), redundant.end(), row.constraint) > 0; };
        std::vector<Row> independent, left;
        for (const Row& row : kept_) (is_redundant(row) ? left : independent).push_back(row);
        std::vector<std::vector<ex>> repeated = known_repetitions();
        for (const Row& row : left) {
            const auto followed = what_follows(row, independent);
            if (!followed || !are_of_frictions(system_, followed->made_of)) continue;
            if (!vanishes(followed->drift)) refuse_sticking(row);
            repeated.push_back(followed->made_of);
            std::erase(redundant, row.constraint);
            std::erase_if(kept_, [&](const Row& one) { return one.constraint == row.constraint; });
        }
        system_.repetitions = repetitions(system_, std::move(repeated));
    }

    /// What moves at a rate of its own, as a belt does, is not held by those that hold the rest of a loop.
    [[noreturn]] void refuse_sticking(const Row& row) const {
        throw Failure(Diagnostic{Id::doubly_determined, row.item->span,
                                 fmt::format("constraint '{}'{} contradicts the others: these hold its rate at another value than zero",
                                             system_.constraints[row.constraint].name, in_which_mode(system_.scene))});
    }

    /// What follows from others wherever they hold cannot be told from these by its force. Neither elimination nor letters show it, but
    /// numbers do.
    void leave_out_redundant() {
        if (kept_.empty()) return;
        std::vector<std::size_t> order;
        for (const std::vector<Row>* rows : {&rows_, static_cast<const std::vector<Row>*>(&kept_)})
            for (const Row& row : *rows) order.push_back(row.constraint);
        if (order.size() < 2) return;
        const Values defaults(system_.scene, system_.translate);
        std::vector<std::size_t> redundant = ConstraintPoints(system_, order, defaults).redundant();
        share_evenly(redundant);
        for (const std::size_t constraint : redundant) {
            if (std::none_of(kept_.begin(), kept_.end(), [&](const Row& row) { return row.constraint == constraint; })) continue;
            ConstraintEquation& c = system_.constraints[constraint];
            if (c.item->share) refuse_apart(c, "and all others stick, its rate follows from theirs");
            c.is_redundant = true;
            std::vector<Note> notes;
            for (const std::size_t other : order)
                if (other != constraint && !system_.constraints[other].is_redundant)
                    notes.push_back({system_.constraints[other].item->span, "it holds, too"});
            system_.warnings.push_back(
                {Id::doubly_determined, c.item->span, why_alone(system_, constraint), std::move(notes), Severity::warning});
        }
        const auto is_redundant = [&](const Row& row) { return system_.constraints[row.constraint].is_redundant; };
        if (system_.scene.mode) std::erase_if(kept_, is_redundant);
        else std::stable_partition(kept_.begin(), kept_.end(), [&](const Row& row) { return !is_redundant(row); });
    }

    System& system_;
    const Symbols& symbols_;
    const std::vector<Row>& rows_;  ///< eliminated
    std::vector<Row>& kept_;        ///< with multipliers
};

}  // namespace

void check_rate(const System& system, const RateRow& row, const std::vector<RateRow>& eliminated, const std::vector<RateRow>& kept) {
    if (!is_zero(row)) return;
    if (eliminated.empty() && kept.empty())
        throw Failure(Diagnostic{
            Id::undetermined, row.item->span,
            fmt::format("constraint '{}' holds a rate that contains no velocity", system.constraints[row.constraint].name)});
    std::vector<Note> notes;
    for (const auto* others : {&eliminated, &kept})
        for (const RateRow& other : *others)
            if (other.constraint != row.constraint)
                notes.push_back({other.item->span, fmt::format("'{}' holds, too", system.constraints[other.constraint].name)});
    throw Failure(Diagnostic{Id::doubly_determined, row.item->span,
                             fmt::format("constraint '{}'{} follows from others, so the force of each is not determined",
                                         system.constraints[row.constraint].name, in_which_mode(system.scene)),
                             std::move(notes)});
}

void settle_repeated_rates(System& system, const std::vector<RateRow>& eliminated, std::vector<RateRow>& kept) {
    RepeatedRates(system, eliminated, kept).run();
}

}  // namespace dalembert
