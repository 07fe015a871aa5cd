// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of a machine in writing: as text, LaTeX or JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "graph/notation.hpp"
#include "form/system.hpp"

namespace dalembert {

/// Left and right sides: M*ddot(q) + bias = Q, or what constraints leave of it, and accelerations that they determine.
std::vector<std::pair<GiNaC::ex, GiNaC::ex>> motion_equations(const System& system);

std::string equations_as_text(const System& system);
std::string equations_as_latex(const System& system);
nlohmann::ordered_json equations_as_json(const System& system);
/// Of a machine that switches what its modes do not share: motion, constraints, events.
nlohmann::ordered_json mode_as_json(const System& system);

}  // namespace dalembert
