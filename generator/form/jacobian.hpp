// SPDX-License-Identifier: GPL-3.0-or-later
// Partial derivatives by implicit differentiation: from R(q, qd, qdd, z, u, t, p) = 0 follows M d(qdd)/dx = -dR/dx at fixed qdd.
// The solve with M is left to the numbers; M is never inverted symbolically.
#pragma once

#include <map>

#include "form/system.hpp"

namespace dalembert {

enum class By { state, input, parameter, time };

/// Derivatives at fixed accelerations; R is what constraints leave of the equations of motion. One column for each variable: states in the
/// order q, qd, z.
struct Partials {
    std::vector<std::vector<GiNaC::ex>> residual;    ///< [column][row]: dR_row/d(column)
    std::vector<std::vector<GiNaC::ex>> state_rate;  ///< [column][row]: d(zd_row)/d(column)
    std::vector<std::vector<GiNaC::ex>> output;      ///< [column][row]
    std::vector<std::vector<GiNaC::ex>> held;        ///< [column][row]: of accelerations that constraints determine, at fixed free ones
};

std::size_t column_count(const Symbols& symbols, By by);
/// The variables of the columns.
std::vector<const Variable*> column_variables(const Symbols& symbols, By by);
/// The derivative of an emitted expression by one of these variables, through definitions. It is zero for a parameter that
/// System::slopes_by does not name.
GiNaC::ex by_column(const System& system, const GiNaC::ex& e, const Variable& column);
/// Without the residual where it is not asked for: of many bodies its derivatives are long.
Partials partials(const System& system, By by, bool with_residual = true);

/// Partials of one system, each taken once: code is made of them, and compared with them.
class KnownPartials {
public:
    explicit KnownPartials(const System& system) : system_(system) {}
    /// Those without the residual may have one.
    const Partials& operator()(By by, bool with_residual = true);

private:
    struct Known {
        Partials partials;
        bool has_residual;
    };
    const System& system_;
    std::map<By, Known> known_;
};

/// d(output)/d(qdd), and by the multipliers behind them: [coordinate][output]; not zero for outputs such as a measured acceleration.
std::vector<std::vector<GiNaC::ex>> output_by_acceleration(const System& system);

}  // namespace dalembert
