// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/bodies.hpp"
#include "form/constrained_motion.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// The first n rows of a matrix that are zero in its first n columns.
std::vector<unsigned> zero_rows(const GiNaC::matrix& matrix, std::size_t n) {
    std::vector<unsigned> rows;
    for (unsigned i = 0; i < n; ++i) {
        bool is_zero = true;
        for (unsigned j = 0; j < n && is_zero; ++j) is_zero = matrix(i, j).is_zero() || matrix(i, j).expand().is_zero();
        if (is_zero) rows.push_back(i);
    }
    return rows;
}

/// The bodies that a velocity moves or turns, for people.
std::string bodies_moved(const System& system, const ex& velocity) {
    std::string names;
    for (const BodyMotion& body : system.bodies) {
        const SpaceVector turning = body.frame ? body.frame->angular_velocity : SpaceVector{0, 0, body.angular_velocity};
        const auto moves = [&](const ex& e) { return e.has(velocity); };
        if (std::any_of(turning.begin(), turning.end(), moves) || std::any_of(body.velocity.begin(), body.velocity.end(), moves))
            names += fmt::format("{}'{}'", names.empty() ? "" : ", ", body.member.name());
    }
    return names;
}

[[noreturn]] void refuse(const System& system, std::size_t coordinate) {
    const Variable& q = system.symbols.all(SymbolKind::coordinate)[coordinate];
    const std::string bodies = bodies_moved(system, system.symbols.get(SymbolKind::velocity, coordinate));
    throw Failure(Diagnostic{
        Id::singular_mass, q.declared->span,
        bodies.empty() ? fmt::format("no body moves or turns with coordinate '{}', so nothing determines its acceleration; give the parts "
                                     "that move with it mass or inertia, or add constraints that determine it",
                                     q.name)
                       : fmt::format("coordinate '{}' moves or turns {}, but this moves no mass or inertia, so nothing determines its "
                                     "acceleration; give {} mass or inertia, or add constraints that determine the coordinate",
                                     q.name, bodies, bodies)});
}

/// The power of ten next to inertia by the square of a constraint's factors, at the start.
GiNaC::numeric weight_at_start(const System& system) {
    constexpr int digits_at_start = 20;
    const GiNaC::exmap at = Values(system.scene, system.translate).substitution();
    const auto size = [&](const ex& e) {
        const auto value = value_at(system.symbols.without_definitions(e), at, digits_at_start);
        return value ? std::fabs(cln::double_approx(*value)) : 0.0;
    };
    double inertia = 0, factors = 0;
    for (unsigned j = 0; j < system.symbols.degrees(); ++j) inertia = std::max(inertia, size(system.mass(j, j)));
    for (const ConstraintEquation& c : system.constraints)
        for (const ex& factor : c.rate.jacobian)
            if (c.holds) factors = std::max(factors, size(factor));
    if (!(inertia > 0 && factors > 0)) return 1;
    return GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(std::lround(std::log10(inertia) - 2 * std::log10(factors))));
}

}  // namespace

void weigh_constraints(System& system) {
    if (zero_rows(system.mass, system.symbols.degrees()).empty()) return;
    Motion& motion = system.motion;
    const std::size_t n = motion.free.size();
    for (const unsigned i : zero_rows(motion.matrix, n)) {
        bool is_held = false;
        for (auto c = static_cast<unsigned>(n); c < motion.unknowns(); ++c) is_held = is_held || !motion.matrix(c, i).is_zero();
        if (!is_held) refuse(system, motion.free[i]);
    }
    motion.weight = weight_at_start(system);
}

SolvedMotion System::solved_motion() const {
    SolvedMotion solved{motion.matrix, motion.force, motion.residual};
    const std::size_t n = motion.free.size();
    if (motion.weight.is_zero()) return solved;
    const std::vector<unsigned> idle = zero_rows(motion.matrix, n);
    for (auto c = static_cast<unsigned>(n); c < motion.unknowns(); ++c) {
        if (std::none_of(idle.begin(), idle.end(), [&](unsigned i) { return !motion.matrix(c, i).is_zero(); })) continue;
        for (unsigned i = 0; i < n; ++i) {
            const ex factor = -motion.weight * motion.matrix(c, i);
            if (factor.is_zero()) continue;
            for (unsigned j = 0; j < n; ++j) solved.matrix(i, j) -= factor * motion.matrix(c, j);
            solved.force[i] -= factor * motion.force[c];
            solved.residual[i] -= factor * motion.residual[c];
        }
    }
    return solved;
}

GiNaC::matrix System::metric() const {
    GiNaC::matrix result = mass;
    if (motion.weight.is_zero()) return result;
    const std::vector<unsigned> idle = zero_rows(mass, symbols.degrees());
    for (const ConstraintEquation& c : constraints) {
        const std::vector<ex>& factors = c.rate.jacobian;
        if (!c.holds || std::none_of(idle.begin(), idle.end(), [&](unsigned i) { return !factors[i].is_zero(); })) continue;
        for (unsigned i = 0; i < factors.size(); ++i)
            for (unsigned j = 0; j < factors.size(); ++j) result(i, j) += motion.weight * factors[i] * factors[j];
    }
    return result;
}

}  // namespace dalembert
