// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/shared_forces.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "balance/steps.hpp"
#include "form/events.hpp"
#include "form/on_constraints.hpp"
#include "symbolic/functions.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

bool is_friction(const ConstraintEquation& c) { return c.item->elsewhere != nullptr; }

/// Positions, other rates, friction.
int rank(const ConstraintEquation& c) { return is_friction(c) ? 2 : c.position ? 0 : 1; }

std::vector<std::size_t> last_first(const System& system) {
    std::vector<std::size_t> order;
    for (std::size_t i = system.constraints.size(); i-- > 0;) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return rank(system.constraints[a]) > rank(system.constraints[b]); });
    return order;
}

Diagnostic repeated(const System& system, const Repetition& r, std::string why, Severity severity) {
    std::vector<Note> notes;
    for (std::size_t i = 0; i < r.made_of.size(); ++i)
        if (i != r.last && !r.made_of[i].is_zero())
            notes.push_back({system.constraints[i].item->span, fmt::format("'{}' holds, too", system.constraints[i].name)});
    return {Id::doubly_determined, system.constraints[r.last].item->span, std::move(why), std::move(notes), severity};
}

/// a + b*factor, entry by entry.
void add_multiple(std::vector<ex>& a, const ex& factor, const std::vector<ex>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = ex(a[i] + factor * b[i]).normal();
}

}  // namespace

int sign_of_factor(const ex& factor) {
    if (factor.info(GiNaC::info_flags::positive)) return 1;
    return ex(-factor).info(GiNaC::info_flags::positive) ? -1 : 0;
}

bool are_of_frictions(const System& system, const std::vector<ex>& factors) {
    for (std::size_t i = 0; i < factors.size(); ++i) {
        const ConstraintEquation& c = system.constraints[i];
        if (factors[i].is_zero()) continue;
        if (c.item->share || !(is_friction(c) || holds_in_all_modes(system.scene, c))) return false;
    }
    return true;
}

std::string in_which_mode(const Scene& scene) {
    return scene.mode ? fmt::format(" in mode '{}'", scene.modes[*scene.mode].name) : std::string();
}

std::string why_alone(const System& system, std::size_t constraint) {
    return fmt::format("constraint '{}'{} follows from the others wherever they hold: the motion is determined without it, but the force "
                       "of each constraint is not. {}",
                       system.constraints[constraint].name, in_which_mode(system.scene),
                       system.scene.mode ? "Its force is set to zero, and the others carry the whole load"
                                         : "At each state, a set of independent constraints carries the whole load; the forces of the "
                                           "others are set to zero");
}

std::vector<Repetition> repetitions(const System& system, std::vector<std::vector<ex>> rows) {
    std::vector<Repetition> result;
    for (const std::size_t last : last_first(system)) {
        const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return !row[last].is_zero(); });
        if (found == rows.end()) continue;
        Repetition one{last, std::vector<ex>(found->size(), 0)};
        add_multiple(one.made_of, 1 / (*found)[last], *found);
        rows.erase(found);
        for (auto& row : rows) add_multiple(row, -row[last], one.made_of);
        for (Repetition& other : result) add_multiple(other.made_of, -ex(other.made_of[last]), one.made_of);
        result.push_back(std::move(one));
    }
    std::reverse(result.begin(), result.end());
    for (Repetition& one : result)
        one.is_even = std::any_of(one.made_of.begin(), one.made_of.end(),
                                  [&](const ex& factor) { return !is_of_parameters(factor, system.symbols); });
    return result;
}

std::optional<Diagnostic> why_not_shared(const System& system, const std::vector<Repetition>& repetitions) {
    const std::string mode = system.scene.modes[*system.scene.mode].name;
    for (const Repetition& r : repetitions) {
        if (r.is_even && are_of_frictions(system, r.made_of)) continue;
        const std::string& last = system.constraints[r.last].name;
        ex position = 0;
        for (std::size_t i = 0; i < r.made_of.size(); ++i) {
            const ex& factor = r.made_of[i];
            if (factor.is_zero()) continue;
            if (!is_of_parameters(factor, system.symbols) || sign_of_factor(factor) == 0)
                return repeated(system, r,
                                fmt::format("constraint '{}' repeats '{}' with a factor whose sign is not known, so mode '{}' is left out; "
                                            "give ranges to the parameters of both",
                                            last, system.constraints[i].name, mode),
                                Severity::warning);
            if (system.constraints[i].position) position += factor * *system.constraints[i].position;
        }
        if (rank(system.constraints[r.last]) == 0 && !position.expand().is_zero() && !position.normal().is_zero())
            return repeated(system, r, fmt::format("constraint '{}' in mode '{}' contradicts the others", last, mode), Severity::error);
    }
    return std::nullopt;
}

/// A guard or a sum of guards, which is positive where nothing lets go.
struct SharedForces::Row {
    ex value;                        ///< with letters of forces
    std::vector<ex> shares;          ///< factors of the shares in it
    std::set<std::size_t> events;    ///< whose guards it is made of
};

SharedForces::~SharedForces() = default;

SharedForces::SharedForces(System& system) : system_(system) {
    if (system.repetitions.empty()) return;
    for (std::size_t i = 0; i < system.constraints.size(); ++i) {
        ConstraintEquation& c = system.constraints[i];
        ex solved = c.force;
        bool is_shared = false;
        for (const Repetition& r : system.repetitions) {
            is_shared = is_shared || !r.made_of[i].is_zero();
            solved -= r.made_of[i] * system.constraints[r.last].force;  // which is the share itself
        }
        if (!is_shared) continue;
        letters_.emplace_back(i, GiNaC::symbol("force_" + c.name));
        solved_[letters_.back().second] = solved.expand();
    }
    for (const auto& [constraint, letter] : letters_) system.constraints[constraint].force = letter;
}

bool SharedForces::has_letters(const ex& e) const {
    return std::any_of(letters_.begin(), letters_.end(), [&](const auto& letter) { return e.has(letter.second); });
}

/// Nothing where the guard is not linear in the forces, with factors of parameters.
std::optional<std::vector<ex>> SharedForces::share_factors(const ex& guard) const {
    std::vector<ex> result(system_.repetitions.size(), 0);
    for (const auto& [constraint, letter] : letters_) {
        const ex factor = guard.diff(GiNaC::ex_to<GiNaC::symbol>(letter)).expand();
        if (!is_of_parameters(factor, system_.symbols)) return std::nullopt;
        for (std::size_t r = 0; r < result.size(); ++r) result[r] += factor * system_.repetitions[r].made_of[constraint];
    }
    for (ex& factor : result) factor = factor.normal();
    return result;
}

/// Of events that let go: they change nothing but modes.
std::vector<SharedForces::Row> SharedForces::rows_of_events() {
    std::vector<Row> rows;
    for (std::size_t e = 0; e < system_.events.size(); ++e) {
        const EventEquation& event = system_.events[e];
        if (!event.is_watched || event.ends || event.item == nullptr || event.item->meets || !event.item->reset.empty() ||
            event.item->next.empty() || !has_letters(event.guard))
            continue;
        auto factors = share_factors(event.guard);
        if (!factors || std::all_of(factors->begin(), factors->end(), [](const ex& factor) { return factor.is_zero(); })) continue;
        for (std::size_t r = 0; r < factors->size(); ++r)
            if (!(*factors)[r].is_zero() && sign_of_factor((*factors)[r]) == 0 && !system_.repetitions[r].is_even)
                throw Failure(repeated(system_, system_.repetitions[r],
                                       fmt::format("in mode '{}' event '{}' depends on a shared force with a factor whose sign is not "
                                                   "known, so the mode is left out; give ranges to the parameters of its guard",
                                                   system_.scene.modes[*system_.scene.mode].name, event.name),
                                       Severity::warning));
        rows.push_back({event.guard, std::move(*factors), {e}});
    }
    return rows;
}

/// Sums of two rows in which the share cancels (Fourier and Motzkin). Those of more rows than were needed follow from others (Kohler);
/// those without any force, such as what friction holds in both directions, are positive.
std::vector<SharedForces::Row> SharedForces::without_share(const std::vector<Row>& rows, std::size_t share) const {
    std::vector<Row> result;
    for (const Row& row : rows)
        if (row.shares[share].is_zero()) result.push_back(row);
    for (const Row& a : rows)
        for (const Row& b : rows) {
            if (sign_of_factor(a.shares[share]) != 1 || sign_of_factor(b.shares[share]) != -1) continue;
            Row sum{ex(a.value / a.shares[share] - b.value / b.shares[share]).expand(), {}, a.events};
            for (std::size_t r = 0; r < a.shares.size(); ++r)
                sum.shares.push_back(ex(a.shares[r] / a.shares[share] - b.shares[r] / b.shares[share]).normal());
            sum.events.insert(b.events.begin(), b.events.end());
            if (sum.events.size() <= share + 2 && has_letters(sum.value)) result.push_back(std::move(sum));
        }
    return result;
}

/// Guards of two frictions: holds + share and holds - share, limit + factor*share and limit - factor*share.
struct SharedForces::Pair {
    const Row *own, *own_back, *other, *other_back;
    ex factor;

    ex holds() const { return (own->value + own_back->value) / 2; }
    ex limit() const { return (other->value + other_back->value) / 2; }
};

/// Nothing where others are in it.
std::optional<SharedForces::Pair> SharedForces::pair_of(const std::vector<Row>& rows, std::size_t share) const {
    const std::size_t last = system_.repetitions[share].last;
    const ex force = std::find_if(letters_.begin(), letters_.end(), [&](const auto& letter) { return letter.first == last; })->second;
    std::vector<const Row*> own, others;
    for (const Row& row : rows) {
        if (row.shares[share].is_zero()) continue;
        const bool is_own = row.shares[share].is_equal(1) || row.shares[share].is_equal(-1);
        const bool has_own = is_own && !has_letters(ex(row.value - row.shares[share] * force).expand());
        (has_own ? own : others).push_back(&row);
    }
    if (own.size() != 2 || others.size() != 2) return std::nullopt;
    const Pair pair{own[0], own[1], others[0], others[1], others[0]->shares[share]};
    const auto are_opposite = [&](const Row& a, const Row& b) {
        for (std::size_t r = 0; r < a.shares.size(); ++r)
            if (!ex(a.shares[r] + b.shares[r]).normal().is_zero()) return false;
        return !has_letters(ex(a.value + b.value).expand());
    };
    if (!are_opposite(*own[0], *own[1]) || !are_opposite(*others[0], *others[1])) return std::nullopt;
    return pair;
}

/// Each way the other one lets go when what both can hold together is gone. Where there is no such pair, the share is zero.
std::vector<SharedForces::Row> SharedForces::without_even_share(const std::vector<Row>& rows, std::size_t share) const {
    const auto pair = pair_of(rows, share);
    const ex force = system_.constraints[system_.repetitions[share].last].force;
    std::vector<Row> result;
    for (const Row& row : rows) {
        if (pair && (&row == pair->own || &row == pair->own_back)) continue;
        if (!pair && row.value.has(force) && !row.shares[share].is_zero() && sign_of_factor(row.shares[share]) != 0) continue;
        Row left = row;
        if (!row.shares[share].is_zero()) {
            left.value -= row.shares[share] * force;
            if (pair) left.value += magnitude(pair->factor) * pair->holds();
            left.shares[share] = 0;
        }
        result.push_back(std::move(left));
    }
    return result;
}

/// Splits a load in proportion to what each of the two can hold. The shares behind this one are chosen already.
ex SharedForces::even_share(std::size_t share, const std::vector<ex>& chosen) const {
    const auto pair = pair_of(stages_[share], share);
    if (!pair) return 0;
    ex held = with_solved((pair->other->value - pair->other_back->value) / 2);
    for (std::size_t l = share + 1; l < chosen.size(); ++l) held += pair->other->shares[l] * chosen[l];
    const ex holds = with_solved(pair->holds()), limit = with_solved(pair->limit());
    return -sign_of(pair->factor) * holds * held / (limit + magnitude(pair->factor) * holds);
}

/// As small as it can be, the last one first.
void SharedForces::choose_shares() {
    std::vector<ex> chosen(system_.repetitions.size(), 0);
    for (std::size_t r = chosen.size(); r-- > 0;) {
        if (system_.repetitions[r].is_even) {
            chosen[r] = even_share(r, chosen);
            continue;
        }
        std::vector<ex> lower, upper;
        for (const Row& row : stages_[r]) {
            // Its own events allow zero.
            const ex others = row.value.subs(system_.constraints[system_.repetitions[r].last].force == 0, GiNaC::subs_options::no_pattern);
            if (row.events.size() == 1 && system_.events[*row.events.begin()].item->is_made && !has_letters(others)) continue;
            ex value = with_solved(row.value);
            for (std::size_t l = r + 1; l < chosen.size(); ++l) value += row.shares[l] * chosen[l];
            (sign_of_factor(row.shares[r]) > 0 ? lower : upper).push_back(ex(-value / row.shares[r]).expand());
        }
        for (const ex& bound : upper) chosen[r] = minimum(chosen[r], bound);
        for (const ex& bound : lower) chosen[r] = maximum(chosen[r], bound);
    }
    for (const auto& [constraint, letter] : letters_) {
        ex force = solved_.at(letter);
        for (std::size_t r = 0; r < chosen.size(); ++r) force += system_.repetitions[r].made_of[constraint] * chosen[r];
        shown_[letter] = force;
    }
}

/// Each row needs an event of its own among those that it is made of: found by augmenting paths.
void SharedForces::watch(const std::vector<Row>& rows) {
    std::map<std::size_t, std::size_t> row_of;
    std::set<std::size_t> tried;
    const auto place = [&](const auto& self, std::size_t row) -> bool {
        for (const std::size_t e : rows[row].events) {
            if (!tried.insert(e).second) continue;
            const auto taken = row_of.find(e);
            if (taken != row_of.end() && !self(self, taken->second)) continue;
            row_of[e] = row;
            return true;
        }
        return false;
    };
    for (std::size_t row = 0; row < rows.size(); ++row) {
        tried.clear();
        if (place(place, row)) continue;
        throw Failure(repeated(
            system_, system_.repetitions.front(),
            fmt::format(
                "in mode '{}' constraints that repeat each other can release in more ways than they have events, so the mode is left out",
                system_.scene.modes[*system_.scene.mode].name),
            Severity::warning));
    }
    for (const auto& [e, row] : row_of) {
        EventEquation& event = system_.events[e];
        event.is_watched = true;
        event.guard = with_solved(rows[row].value).expand();
        event.rate = guard_rate(system_, event.guard);
        for (const std::size_t other : rows[row].events)
            if (other != e) event.together.push_back(system_.events[other].item);
    }
}

/// Where somebody looks at a share.
void SharedForces::tell() const {
    for (std::size_t number = 0; number < system_.repetitions.size(); ++number) {
        const Repetition& r = system_.repetitions[number];
        if (r.is_even && !pair_of(stages_[number], number)) continue;  // it was told
        const auto asks = [&](const ex& e) {
            return std::any_of(letters_.begin(), letters_.end(),
                               [&](const auto& letter) { return !r.made_of[letter.first].is_zero() && e.has(letter.second); });
        };
        const bool is_asked =
            std::any_of(system_.outputs.begin(), system_.outputs.end(), [&](const OutputEquation& output) { return asks(output.value); }) ||
            std::any_of(system_.events.begin(), system_.events.end(),
                        [&](const EventEquation& event) { return event.is_watched && asks(event.guard); });
        if (!is_asked) continue;
        std::vector<std::string> names;
        std::vector<Note> notes;
        std::vector<std::size_t> order = last_first(system_);
        std::reverse(order.begin(), order.end());
        for (const std::size_t i : order) {
            if (i == r.last || r.made_of[i].is_zero()) continue;
            names.push_back(fmt::format("'{}'", system_.constraints[i].name));
            notes.push_back({system_.constraints[i].item->span, "it holds, too"});
        }
        const Constraint& last = *system_.constraints[r.last].item;
        system_.warnings.push_back(
            {Id::doubly_determined, last.span,
             fmt::format("where '{}' and {} hold the same motion, the force of each is not determined. {}", last.name,
                         fmt::join(names, ", "),
                         r.is_even ? "Each friction is shown with the same fraction of its holding force"
                                   : fmt::format("'{}' gets the part that {} cannot carry", last.name, fmt::join(names, ", "))),
             std::move(notes), Severity::warning});
    }
}

void SharedForces::settle() {
    if (letters_.empty()) return;
    std::vector<Row> rows = rows_of_events();
    for (const Row& row : rows) {
        const EventEquation& event = system_.events[*row.events.begin()];
        system_.events[*row.events.begin()] = {event.item, event.name, event.doc, event.ends, false, 0, 0, event.reset, {}};
    }
    for (std::size_t r = 0; r < system_.repetitions.size(); ++r) {
        stages_.emplace_back();
        for (const Row& row : rows)
            if (!row.shares[r].is_zero()) stages_.back().push_back(row);
        const Repetition& one = system_.repetitions[r];
        if (one.is_even && !pair_of(rows, r))
            system_.warnings.push_back(repeated(system_, one, why_alone(system_, one.last), Severity::warning));
        rows = one.is_even ? without_even_share(rows, r) : without_share(rows, r);
    }
    choose_shares();
    watch(rows);
    for (EventEquation& event : system_.events)
        if (!event.is_watched) event.reset = {};
    tell();
    const auto show = [&](ex& e) { e = e.subs(shown_, GiNaC::subs_options::no_pattern); };
    for (OutputEquation& output : system_.outputs) show(output.value);
    for (EventEquation& event : system_.events) {
        if (!event.is_watched || !has_letters(event.guard)) continue;
        show(event.guard);
        event.rate = guard_rate(system_, event.guard);
    }
    for (const auto& [constraint, letter] : letters_) system_.constraints[constraint].force = shown_.at(letter);
    system_.translate.forget();
}

}  // namespace dalembert
