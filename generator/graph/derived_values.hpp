// SPDX-License-Identifier: GPL-3.0-or-later
// Values of functions of a header as they are derived, where they are no member of the system.
#pragma once

#include <optional>

#include "form/system.hpp"

namespace dalembert {

/// M, row by row up to the diagonal.
std::vector<GiNaC::ex> lower_triangle(const GiNaC::matrix& matrix);
std::vector<GiNaC::ex> lower_triangle_of_mass(const System& system);
/// With the rates of states replaced by what they are.
std::vector<GiNaC::ex> output_values(const System& system);

/// What the model gives as start of x = [q; v; z].
std::vector<GiNaC::ex> start_values(const System& system);

/// What a mode asks for that holds constraints or cuts off inductors: entries of x, by place, that these determine, and their values; and
/// what is to be zero itself. That a rate is zero is not enough where its force may be without effect: then it must stay zero, too.
struct ModeCondition {
    std::optional<std::size_t> place;
    GiNaC::ex value;
    enum class Of { position, rate, kept_rate, acceleration, current } of;  ///< no change of mode makes a kept rate zero
};
std::vector<ModeCondition> conditions(const System& system);
/// The values, and behind them the sums of the magnitudes of their terms, against which roundings are measured.
std::vector<GiNaC::ex> condition_values(const System& system);

/// Positions, rates and forces of all constraints of the scene, and d(rate)/d(velocity) row by row; zero for those that do not hold.
std::vector<GiNaC::ex> constraint_positions(const System& system);
std::vector<GiNaC::ex> constraint_rates(const System& system);
std::vector<GiNaC::ex> constraint_forces(const System& system);
std::vector<GiNaC::ex> constraint_jacobian(const System& system);

/// Right-hand sides for the rates of the unknowns: matrix*d(unknowns)/dt = motion_rates; and the rates of the accelerations that
/// constraints determine, which may contain those of the free ones.
std::vector<GiNaC::ex> motion_rates(const System& system);
std::vector<GiNaC::ex> held_jerks(const System& system);

}  // namespace dalembert
