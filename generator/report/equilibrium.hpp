// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert equilibrium`.
#pragma once

#include <optional>

#include "report/matrix_text.hpp"

namespace dalembert {

/// Where nothing came to rest: the state that changes fastest.
struct Restless {
    std::string name, unit;  ///< unit is "1" without one
    double rate, value;      ///< in the unit per second, and in the unit; the rate may not be finite
};

/// Of xdot = A x + B u, y = C x + D u at an equilibrium.
struct EquilibriumLinearisation {
    MatrixRows A, B, C, D;
    std::vector<std::string> free_states;  ///< that constraints leave to be chosen
    std::vector<std::string> ignorable;    ///< of which nothing depends
    std::vector<Complex> eigenvalues;      ///< 1/s
};

struct EquilibriumResult {
    Subject subject;
    std::string status, kind;         ///< words of the solver: "success", "family"
    std::size_t dimension = 0;        ///< of the family
    double residual = 0;              ///< largest |dx/dt|
    std::size_t iterations = 0;
    bool is_motion = false;           ///< coordinates go on at constant speed
    std::vector<ResultValue> states = {}, inputs = {};
    std::vector<ResultValue> outputs = {};  ///< at the equilibrium; empty where none was found
    std::optional<Restless> restless = {}; ///< where none was found; empty if a constraint is not met
    std::optional<EquilibriumLinearisation> linearisation = {};  ///< at the equilibrium
    bool found() const { return linearisation.has_value(); }
};

std::string as_text(const EquilibriumResult& result);
nlohmann::ordered_json as_json(const EquilibriumResult& result);

}  // namespace dalembert
