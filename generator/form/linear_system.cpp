// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/linear_system.hpp"

#include <fmt/format.h>

#include "form/random_points.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// What moves: q, qd, z, u and t.
std::vector<const Variable*> movers(const Symbols& symbols) {
    std::vector<const Variable*> result;
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state, SymbolKind::input, SymbolKind::time})
        for (const Variable& variable : symbols.all(kind)) result.push_back(&variable);
    return result;
}

/// Reduces entries that look as if they moved, and do not, and tells of the first one that does.
class Constants {
public:
    explicit Constants(const System& system) : symbols_(system.symbols), movers_(movers(system.symbols)), seems_zero_(system) {
        for (const Variable* mover : movers_) rest_[mover->symbol] = 0;
    }

    ex operator()(const ex& entry, const std::string& name) {
        if (!reason_.empty()) return entry;
        bool any = false;
        for (const Variable* mover : movers_) {
            if (!entry.has(mover->symbol)) continue;
            any = true;
            const ex slope = symbols_.without_definitions(partial(entry, mover->symbol));
            if (!seems_zero_(slope) || !slope.expand().is_zero()) {
                reason_ = fmt::format("{} depends on '{}'", name, mover->name);
                return entry;
            }
        }
        if (!any) return entry;
        try {
            return entry.subs(rest_, GiNaC::subs_options::no_pattern);
        } catch (const GiNaC::pole_error&) {
            reason_ = fmt::format("{} has no value where everything is zero", name);
            return entry;
        }
    }
    const std::string& reason() const { return reason_; }

private:
    const Symbols& symbols_;
    std::vector<const Variable*> movers_;
    ZeroAtPoints seems_zero_;
    GiNaC::exmap rest_;
    std::string reason_;
};

/// bias - Q, which is D qd + C q - k - B u where everything is linear.
ex left_over(const System& system, std::size_t i) { return system.bias[i] - system.supplied[i]; }

}  // namespace

ex damping_entry(const System& system, std::size_t i, std::size_t j) {
    return partial(left_over(system, i), system.symbols.get(SymbolKind::velocity, j));
}
ex stiffness_entry(const System& system, std::size_t i, std::size_t j) { return system.symbols.along(left_over(system, i), j); }

Linearity linear_system(const System& system) {
    const Symbols& symbols = system.symbols;
    const auto& q = symbols.all(SymbolKind::coordinate);
    const auto& inputs = symbols.all(SymbolKind::input);
    const std::size_t n = q.size();
    if (n == 0) return {{}, "there are no coordinates"};
    if (symbols.positions() != n) return {{}, "an attitude has no coordinates of its own"};
    for (const ConstraintEquation& constraint : system.constraints)
        if (constraint.holds) return {{}, fmt::format("constraint '{}' holds", constraint.name)};
    for (std::size_t i = 0; i < n; ++i)
        for (const Variable& z : symbols.all(SymbolKind::state))
            if (left_over(system, i).has(z.symbol))
                return {{}, fmt::format("the force on '{}' depends on the state '{}'", q[i].name, z.name)};

    const auto size = static_cast<unsigned>(n);
    LinearSystem result{GiNaC::matrix(size, size),
                        GiNaC::matrix(size, size),
                        GiNaC::matrix(size, size),
                        GiNaC::matrix(size, static_cast<unsigned>(inputs.size())),
                        {}};
    Constants constant(system);
    GiNaC::exmap rest;
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::input})
        for (const Variable& variable : symbols.all(kind)) rest[variable.symbol] = 0;
    for (unsigned i = 0; i < size; ++i) {
        for (unsigned j = 0; j < size; ++j) {
            const std::string place = fmt::format("[{}, {}]", q[i].name, q[j].name);
            result.M(i, j) = constant(system.mass(i, j), "mass_matrix" + place);
            result.D(i, j) = constant(damping_entry(system, i, j), "damping_matrix" + place);
            result.C(i, j) = constant(stiffness_entry(system, i, j), "stiffness_matrix" + place);
        }
        for (unsigned j = 0; j < inputs.size(); ++j)
            result.B(i, j) = constant(-partial(left_over(system, i), inputs[j].symbol),
                                      fmt::format("the effect of '{}' on '{}'", inputs[j].name, q[i].name));
        if (!constant.reason().empty()) return {{}, constant.reason()};
        result.k.push_back(-left_over(system, i).subs(rest, GiNaC::subs_options::no_pattern));
    }
    return {std::move(result), ""};
}

}  // namespace dalembert
