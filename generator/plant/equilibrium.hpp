// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibria of plants, and the linearisation there.
#pragma once

#include <dalembert/plant.h>

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace dalembert {

using NumberRows = std::vector<std::vector<double>>;

/// Constraints that hold near a point where the plant does not project itself: G dx = 0.
struct HeldRows {
    NumberRows of_positions;  ///< by the coordinates
    NumberRows of_rates;      ///< by the states
};

/// Numbers are in SI, in the order of the tables of the plant.
struct EquilibriumSearchOfPlant {
    std::vector<double> parameters;
    std::vector<double> x, u;  ///< where it begins
    std::vector<bool> free_states, free_inputs;
    std::vector<bool> moving;  ///< coordinates that go on at constant speed
    unsigned mode = 0;
    bool takes_rows_of_plant = false;  ///< the constraints are those that the plant projects to
    HeldRows rows = {};                ///< else these
};

struct PlantLinearisation {
    NumberRows A, B, C, D;
    std::vector<std::size_t> free, ignorable;  ///< states
    std::vector<std::complex<double>> eigenvalues;
};

struct PlantEquilibrium {
    std::string status, kind;
    std::size_t dimension = 0, iterations = 0;
    double residual = 0;
    std::vector<double> x, u, rates, y;
    std::optional<PlantLinearisation> linearisation;  ///< where there is an equilibrium
};

PlantEquilibrium find_equilibrium_of(const dalembert_plant& plant, const EquilibriumSearchOfPlant& search);

}  // namespace dalembert
