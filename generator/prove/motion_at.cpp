// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/motion_at.hpp"

#include <fmt/format.h>

#include "elements/model.hpp"
#include "form/constrained_motion.hpp"
#include "text/budgets.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

MotionAt::MotionAt(const System& system, GiNaC::exmap values, int digits)
    : system_(system), digits_(digits), point_(std::move(values)) {
    const Symbols& symbols = system.symbols;
    add_steps(point_, symbols, digits + 20);
    const Motion& motion = system.motion;
    const SolvedMotion solved = system.solved_motion();
    const std::vector<ex> unknowns = system.unknowns();
    const std::size_t n = unknowns.size(), free = motion.free.size();
    std::vector<std::vector<cln::cl_R>> m(n, std::vector<cln::cl_R>(n + 1));
    const auto entry = [&](const ex& e) {
        const auto v = value_at(e, point_, digits);
        if (!v)
            throw Failure(Diagnostic{
                Id::division_by_zero, system.scene.model->name_span,
                fmt::format("the equations of motion have no value at this point, or one of more than {} binary digits", budget::bits)});
        return *v;
    };
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t l = 0; l < n; ++l) m[j][l] = entry(solved.matrix(static_cast<unsigned>(j), static_cast<unsigned>(l)));
        m[j][n] = entry(solved.force[j]);
    }
    // A constraint of which nothing is left when those before it are taken out follows from them, and bears nothing.
    const cln::cl_RA nothing = cln::expt(cln::cl_RA(10), -digits / 2);
    std::vector<cln::cl_R> sizes(n, 0);
    std::vector<bool> dropped(n, false);
    for (std::size_t k = 0; k < n; ++k) {
        if (k == free)
            for (std::size_t j = k; j < n; ++j) sizes[j] = cln::abs(m[j][j]);
        dropped[k] = k + left_out_at_start(system) >= n || (k >= free && cln::abs(m[k][k]) <= nothing * sizes[k]);
        if (dropped[k]) continue;
        if (cln::zerop(m[k][k]))
            throw Failure(Diagnostic{Id::singular_mass, symbols.all(SymbolKind::coordinate)[motion.free[k]].declared->span,
                                     fmt::format("the mass matrix is singular at this point: the acceleration of '{}' is not determined",
                                                 symbols.all(SymbolKind::coordinate)[motion.free[k]].name)});
        for (std::size_t j = 0; j < n; ++j) {
            if (j == k) continue;
            const cln::cl_R factor = m[j][k] / m[k][k];
            for (std::size_t l = k; l <= n; ++l) m[j][l] = m[j][l] - factor * m[k][l];
        }
    }
    for (std::size_t j = 0; j < n; ++j) point_[unknowns[j]] = dropped[j] ? GiNaC::numeric(0) : GiNaC::numeric(m[j][n] / m[j][j]);
    for (const auto& [coordinate, acceleration] : motion.accelerations)
        point_[symbols.get(SymbolKind::acceleration, coordinate)] = GiNaC::numeric(entry(acceleration));
    for (std::size_t i = 0; i < system.state_rates.size(); ++i)
        point_[symbols.get(SymbolKind::state_rate, i)] = GiNaC::numeric(entry(system.state_rates[i]));
}

cln::cl_R MotionAt::operator()(const ex& e) const {
    const auto v = value_at(e, point_, digits_);
    if (!v)
        throw Failure(
            Diagnostic{Id::division_by_zero, system_.scene.model->name_span,
                       fmt::format("an expression has no value at this point, or one of more than {} binary digits", budget::bits)});
    return *v;
}

}  // namespace dalembert
