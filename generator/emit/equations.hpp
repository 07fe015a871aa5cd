// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of a machine in writing: as text, LaTeX or JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "graph/notation.hpp"
#include "form/system.hpp"

namespace dalembert {

/// Left and right sides: M*ddot(q) + bias = Q, or what constraints leave of it, and accelerations that they determine.
std::vector<std::pair<GiNaC::ex, GiNaC::ex>> motion_equations(const System& system);

/// The left side of the equation of a state: "dot(z)", or "next(z)" of a controller that samples.
std::string rate_of_state(const System& system, std::size_t state);

std::string equations_as_text(const System& system);
std::string equations_as_latex(const System& system);
nlohmann::ordered_json equations_as_json(const System& system);
/// Of a machine that switches what its modes do not share: motion, constraints, events.
nlohmann::ordered_json mode_as_json(const System& system);

}  // namespace dalembert
