// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/constraint_validity.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "form/on_constraints.hpp"

namespace dalembert {

namespace {

class ConstraintCheck {
public:
    ConstraintCheck(const System& system, Values& values, std::vector<std::size_t> holding)
        : system_(system), values_(values), points_(system, std::move(holding), values) {}

    void run() {
        const ConstrainedPoint start = points_.near_start(true);
        if (!start.broken.empty() || !start.broken_rates.empty()) refuse(start);
        for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity})
            for (const Variable& variable : system_.symbols.all(kind))
                if (!values_.is_written(kind, variable.position) &&
                    (kind == SymbolKind::velocity || system_.symbols.has_value(variable.position)))
                    values_.find(kind, variable.position, start.values.at(variable.symbol));
    }

private:
    [[noreturn]] void refuse(const ConstrainedPoint& start) const {
        const ConstrainedPoint near = points_.near_start(false);
        if (!near.broken.empty()) contradiction(near.broken.front(), near, "position");
        if (!near.broken_rates.empty()) contradiction(near.broken_rates.front(), near, "rate");
        const bool is_position = !start.broken.empty();
        const ConstraintEquation& c = system_.constraints[is_position ? start.broken.front() : start.broken_rates.front()];
        const GiNaC::ex& held = is_position ? *c.position : c.whole_rate;
        throw Failure(Diagnostic{Id::value_out_of_range, c.item->span,
                                 fmt::format("the start values do not meet constraint '{}': its {} is {:.6g} there, not zero. Leave out a "
                                             "{} that the constraint can determine, or correct it",
                                             c.name, is_position ? "position" : "rate",
                                             cln::double_approx(points_.value(held, start.values)), is_position ? "start" : "start_rate"),
                                 written(held, is_position)});
    }

    [[noreturn]] void contradiction(std::size_t constraint, const ConstrainedPoint& near, const char* what) const {
        const ConstraintEquation& c = system_.constraints[constraint];
        const double left = cln::double_approx(points_.value(near.broken.empty() ? c.whole_rate : *c.position, near.values));
        std::vector<Note> notes;
        for (const ConstraintEquation& other : system_.constraints)
            if (other.holds && &other != &c) notes.push_back({other.item->span, fmt::format("'{}' holds, too", other.name)});
        throw Failure(Diagnostic{
            Id::doubly_determined, c.item->span,
            notes.empty()
                ? fmt::format("constraint '{}' cannot be met: near the start its {} comes no closer to zero than {:.6g}", c.name, what,
                              left)
                : fmt::format("constraint '{}' contradicts the others: where they come closest to being met together, its {} is {:.6g}",
                              c.name, what, left),
            std::move(notes)});
    }

    /// Where the start values stand that the constraint is about.
    std::vector<Note> written(const GiNaC::ex& held, bool is_position) const {
        std::vector<Note> notes;
        for (std::size_t j = 0; j < system_.scene.coordinates.size(); ++j) {
            const auto& member = system_.scene.coordinates[j];
            const ExpressionPtr& start = is_position ? start_of(member, system_.scene) : start_rate_of(member, system_.scene);
            const SymbolKind kind = is_position ? SymbolKind::coordinate : SymbolKind::velocity;
            if (start && values_.is_written(kind, j) && held.has(system_.symbols.get(kind, j)))
                notes.push_back(
                    {start->span, fmt::format("the {} of '{}' in the model", is_position ? "start" : "start_rate", member.item->name)});
        }
        return notes;
    }

    const System& system_;
    Values& values_;
    ConstraintPoints points_;
};

}  // namespace

namespace {

bool holds_always(const Scene& scene, const ConstraintEquation& c) { return c.holds && holds_in_all_modes(scene, c); }

/// Places of the constraints that a start meets whatever the mode.
std::vector<std::size_t> of_start(const System& system) {
    std::vector<std::size_t> result;
    if (!system.scene.modes.empty() && !mode_of_start(system)) return result;
    for (std::size_t i = 0; i < system.constraints.size(); ++i)
        if (holds_always(system.scene, system.constraints[i])) result.push_back(i);
    return result;
}

void meet(const System& system, Values& values, std::vector<std::size_t> constraints) {
    if (!constraints.empty()) ConstraintCheck(system, values, std::move(constraints)).run();
}

}  // namespace

std::optional<std::size_t> mode_of_start(const System& system) {
    const Scene& scene = system.scene;
    for (std::size_t mode = 0; mode < scene.modes.size(); ++mode)
        if (std::all_of(system.constraints.begin(), system.constraints.end(),
                        [&](const ConstraintEquation& c) { return holds_always(scene, c) || !holds_in(scene, c, mode); }))
            return mode;
    return {};
}

void meet_constraints_in_mode(const System& system, Values& values) {
    std::vector<std::size_t> holding;
    for (std::size_t i = 0; i < system.constraints.size(); ++i)
        if (system.constraints[i].holds) holding.push_back(i);
    meet(system, values, std::move(holding));
}

void meet_constraints(const System& system, Values& values) { meet(system, values, of_start(system)); }

std::vector<bool> starts_to_find(const System& system) {
    const Symbols& symbols = system.symbols;
    if (!system.needs_projection() || !symbols.attitudes().empty()) return {};
    const Values values(system.scene, system.translate);
    const std::size_t n = symbols.degrees();
    std::vector<bool> result(2 * n, false);
    for (const std::size_t i : of_start(system))
        for (std::size_t j = 0; j < n; ++j) {
            const ConstraintEquation& c = system.constraints[i];
            if (c.rate.jacobian[j].is_zero()) continue;
            if (c.position && !values.is_written(SymbolKind::coordinate, j)) result[j] = true;
            if (!values.is_written(SymbolKind::velocity, j)) result[n + j] = true;
        }
    return std::find(result.begin(), result.end(), true) == result.end() ? std::vector<bool>{} : result;
}

}  // namespace dalembert
