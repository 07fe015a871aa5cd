// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/events.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "form/constrained_motion.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/sizes.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class EventMaker {
public:
    explicit EventMaker(System& system) : system_(system), symbols_(system.symbols), n_(symbols_.degrees()) {}

    EventEquation make(const Event& item) const {
        EventEquation event{&item, item.name, item.doc, item.ends, system_.scene.holds(item.when), 0, 0, {}, {}};
        if (!event.is_watched) return event;
        const ex guard = through_zero(system_.with_rates(system_.translate(item.guard, {})));
        event.guard = item.rises ? ex(-guard) : guard;
        event.rate = guard_rate(system_, event.guard);
        if (item.meets) {
            meet(event.reset, *item.meets, item.restitution ? system_.translate(item.restitution, {}) : ex(0), &event.guard);
            if (!item.rest.empty()) meet(event.rest, *item.meets, 0, nullptr);
        }
        end_current(event);
        if (!item.meets && !item.next.empty()) begin_at_rest(event.reset);
        values(event.reset, item.reset);
        values(event.rest, item.rest_reset);
        return event;
    }

private:
    const ex& velocity(std::size_t j) const { return symbols_.get(SymbolKind::velocity, j); }

    /// What is integrated as its root w falls to zero as w^2, and not through it. The root itself does, at the same time.
    ex through_zero(const ex& guard) const {
        if (GiNaC::is_a<GiNaC::mul>(guard)) {
            ex product = 1;
            for (const ex& factor : guard) product *= through_zero(factor);
            return product;
        }
        if (!GiNaC::is_a<GiNaC::power>(guard) || !guard.op(1).is_equal(2)) return guard;
        const Variable* root = symbols_.find(guard.op(0));
        return root != nullptr && root->is_root ? guard.op(0) : guard;
    }

    /// The current of a diode that ends may be that of an inductor, which is cut off: then it is zero exactly.
    void end_current(EventEquation& event) const {
        if (!event.item->is_made || event.item->guard->name != "current") return;
        for (const BranchState& branch : system_.circuit.branches)
            if (branch.item->law == Branch::Law::inductor && event.guard.has(branch.level) &&
                event.guard.subs(branch.level == 0, GiNaC::subs_options::no_pattern).is_zero())
                set(event.reset, symbols_.place(SymbolKind::state, *branch.state), 0);
    }

    /// Where frictions of a loop let it go, its velocities are zero but for roundings. Only where they are zero exactly does the direction
    /// in which it begins to move show.
    void begin_at_rest(Reset& reset) const {
        const Motion& motion = system_.motion;
        if (std::none_of(system_.repetitions.begin(), system_.repetitions.end(), [](const Repetition& r) { return r.is_even; })) return;
        const auto is_zero = [](const ex& factor) { return factor.is_zero(); };
        const bool all_rest = motion.multipliers.size() == motion.free.size() &&
                              std::all_of(motion.multipliers.begin(), motion.multipliers.end(),
                                          [&](std::size_t i) { return system_.constraints[i].rate.drift.is_zero(); });
        for (std::size_t i = 0; all_rest && i < motion.free.size(); ++i)
            set(reset, symbols_.place(SymbolKind::velocity, motion.free[i]), 0);
        for (const auto& [coordinate, rate] : motion.velocities)
            if (all_rest || std::all_of(rate.jacobian.begin(), rate.jacobian.end(), is_zero))
                set(reset, symbols_.place(SymbolKind::velocity, coordinate), rate.drift);
    }

    void values(Reset& reset, const std::vector<RunEntry>& entries) const {
        for (const RunEntry& entry : entries) {
            const Expression& variable = *entry.variable;
            const bool is_rate = variable.kind == Expression::Kind::call;
            const Expression& named = is_rate ? *variable.children[0] : variable;
            const int index = named.children.empty() ? 0 : index_value(*named.children[0], system_.scene, {});
            ex value = system_.translate(entry.value, {});
            if (const Variable* q = symbols_.find(SymbolKind::coordinate, named.name, index)) {
                set(reset, symbols_.place(is_rate ? SymbolKind::velocity : SymbolKind::coordinate, q->position), value);
            } else if (const Variable* z = symbols_.find(SymbolKind::state, named.name, index)) {
                set(reset, symbols_.place(SymbolKind::state, z->position), z->is_root ? ex(GiNaC::sqrt(value)) : value);
            } else {
                throw Failure(Diagnostic{Id::index_out_of_range, entry.span,
                                         fmt::format("scene '{}' has no '{}'", system_.scene.name, variable.written())});
            }
        }
    }

    static void set(Reset& reset, std::size_t place, const ex& value) {
        std::erase_if(reset.values, [&](const auto& v) { return v.first == place; });
        reset.values.emplace_back(place, value);
    }

    /// A velocity that becomes what follows from a rate of zero: see note [dead centres].
    ex but_for_roundings(const ex& before, const ex& after, const ex& factor) const {
        if (symbols_.is_constant(factor)) return after;
        const ex rounding = (GiNaC::numeric(1, roundings_squared) - GiNaC::pow(before - after, 2)).expand();
        return if_else(GiNaC::pow(factor, 2) - least_square(factor), if_else(rounding, after, before), before);
    }

    /// The velocities after an impact on a constraint, and the position exactly on it. What is zero when it happens may be its rate.
    void meet(Reset& reset, const Reference& met, const ex& restitution, const ex* guard) const {
        const int index = met.index ? index_value(*met.index, system_.scene, {}) : 0;
        const auto constraint = std::find_if(system_.constraints.begin(), system_.constraints.end(),
                                             [&](const ConstraintEquation& c) { return c.item->name == met.name && c.index == index; });
        if (constraint == system_.constraints.end())
            throw Failure(Diagnostic{Id::needs_absent, met.span,
                                     fmt::format("scene '{}' has no constraint '{}'", system_.scene.name,
                                                 met.index ? fmt::format("{}[{}]", met.name, index) : met.name)});
        // Else the position is as near to zero as roundings allow.
        if (constraint->position)
            if (const auto at_zero = coordinate_at_zero(*constraint->position, symbols_))
                set(reset, symbols_.place(SymbolKind::coordinate, at_zero->first), at_zero->second);
        const Motion& motion = system_.motion;
        if (constraint->item->share) return meet_apart(reset, *constraint);
        const bool is_stop = guard != nullptr && restitution.is_zero() &&
                             ((*guard - constraint->whole_rate).expand().is_zero() || (*guard + constraint->whole_rate).expand().is_zero());
        Impact impact{{}, constraint->rate.drift, restitution, std::nullopt};
        // Other constraints that hold go on holding.
        for (std::size_t i = 0; i < motion.free.size(); ++i) {
            ex factor = constraint->rate.jacobian[motion.free[i]];
            for (const auto& [coordinate, rate] : motion.velocities) factor += constraint->rate.jacobian[coordinate] * rate.jacobian[i];
            impact.direction.push_back(factor.expand());
        }
        // What other constraints hold already cannot be struck.
        if (std::all_of(impact.direction.begin(), impact.direction.end(), [](const ex& factor) { return factor.is_zero(); })) return;
        for (const auto& [coordinate, rate] : motion.velocities) impact.drift += constraint->rate.jacobian[coordinate] * rate.drift;
        if (restitution.is_zero()) {
            for (std::size_t i = 0; i < motion.free.size(); ++i)
                if (GiNaC::is_a<GiNaC::numeric>(impact.direction[i]) && !impact.direction[i].is_zero()) impact.pivot = i;
        }
        if (const auto alone = single_direction(impact)) {
            const std::size_t k = motion.free[*alone];
            const ex& factor = impact.direction[*alone];
            ex after = restitution.is_zero() ? ex(-impact.drift / factor)
                                             : ex((velocity(k) - (1 + restitution) * (velocity(k) + impact.drift / factor)).expand());
            if (is_stop) after = but_for_roundings(velocity(k), after, factor);
            set(reset, symbols_.place(SymbolKind::velocity, k), after);
            for (const auto& [coordinate, rate] : motion.velocities) {
                ex value = rate.drift;
                for (std::size_t i = 0; i < motion.free.size(); ++i)
                    value += rate.jacobian[i] * (i == *alone ? after : velocity(motion.free[i]));
                set(reset, symbols_.place(SymbolKind::velocity, coordinate), value);
            }
            return;
        }
        impact.takes_roundings = is_stop && (!impact.pivot || !motion.multipliers.empty());
        if (impact.takes_roundings) impact.pivot.reset();  // or the velocity stays
        for (const ex& factor : impact.direction)
            if (impact.takes_roundings) impact.least += least_square(factor);
        reset.impact = std::move(impact);
    }

    /// Of friction with a state in place of modes the rate is zero but for roundings where it stops, and where it breaks away after having
    /// stuck for some time. Then it is zero exactly, by one velocity.
    void meet_apart(Reset& reset, const ConstraintEquation& constraint) const {
        const Motion& motion = system_.motion;
        const ex share = system_.translate(*constraint.item->share, {});
        const auto own = [&](const ex& e) { return ex(e / share).normal(); };
        const auto factor = [&](std::size_t i) {
            ex sum = constraint.rate.jacobian[motion.free[i]];
            for (const auto& [coordinate, rate] : motion.velocities) sum += constraint.rate.jacobian[coordinate] * rate.jacobian[i];
            return own(sum);
        };
        std::optional<std::size_t> pivot;
        std::vector<ex> factors;
        for (std::size_t i = 0; i < motion.free.size(); ++i) {
            factors.push_back(factor(i));
            if (!factors[i].is_zero() && (!pivot || GiNaC::is_a<GiNaC::numeric>(factors[i]))) pivot = i;
        }
        if (!pivot) return;
        ex drift = constraint.rate.drift;
        for (const auto& [coordinate, rate] : motion.velocities) drift += constraint.rate.jacobian[coordinate] * rate.drift;
        ex others = own(drift);
        for (std::size_t i = 0; i < factors.size(); ++i)
            if (i != *pivot) others += factors[i] * velocity(motion.free[i]);
        const ex after = but_for_roundings(velocity(motion.free[*pivot]), (-others / factors[*pivot]).expand(), factors[*pivot]);
        set(reset, symbols_.place(SymbolKind::velocity, motion.free[*pivot]), after);
        for (const auto& [coordinate, rate] : motion.velocities) {
            ex value = rate.drift;
            for (std::size_t i = 0; i < motion.free.size(); ++i)
                value += rate.jacobian[i] * (i == *pivot ? after : velocity(motion.free[i]));
            set(reset, symbols_.place(SymbolKind::velocity, coordinate), value);
        }
    }

    /// The free coordinate that alone is struck: the only one in the direction, whose inertia is not coupled with others.
    std::optional<std::size_t> single_direction(const Impact& impact) const {
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < impact.direction.size(); ++i) {
            if (impact.direction[i].is_zero()) continue;
            if (found) return std::nullopt;
            found = i;
        }
        for (std::size_t l = 0; found && l < impact.direction.size(); ++l)
            if (l != *found && !system_.motion.matrix(static_cast<unsigned>(*found), static_cast<unsigned>(l)).is_zero())
                return std::nullopt;
        for (std::size_t l = impact.direction.size(); found && l < system_.motion.unknowns(); ++l)
            if (!system_.motion.matrix(static_cast<unsigned>(l), static_cast<unsigned>(*found)).is_zero()) return std::nullopt;
        return found;
    }

    System& system_;
    const Symbols& symbols_;
    std::size_t n_;
};

}  // namespace

std::vector<Condition> EventEquation::next() const {
    if (together.empty()) return item->next;
    std::vector<Condition> all{Condition{Condition::Kind::conjunction, item->span, {}, {}}};
    std::vector<Condition> alone;
    std::vector<const Event*> events{item};
    events.insert(events.end(), together.begin(), together.end());
    for (const Event* event : events) {
        std::vector<Condition> longer;
        for (const Condition& before : all)
            for (const Condition& to : event->next) {
                longer.push_back(before);
                longer.back().parts.push_back(to);
            }
        all = std::move(longer);
        alone.insert(alone.end(), event->next.begin(), event->next.end());
    }
    all.insert(all.end(), alone.begin(), alone.end());
    return all;
}

ex guard_rate(const System& system, const ex& guard) { return system.with_rates(system.symbols.time_derivative(guard)); }

void events(System& system) {
    const EventMaker maker(system);
    for (const auto& member : system.scene.events) system.events.push_back(maker.make(*member.item));
    if (system.scene.modes.empty()) return;
    for (const Guard& guard : system.guards)
        if (guard.ends)
            system.events.push_back({nullptr, guard.name, guard.doc, true, true, guard.value, guard_rate(system, guard.value), {}, {}});
}

}  // namespace dalembert
