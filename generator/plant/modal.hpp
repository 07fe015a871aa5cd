// SPDX-License-Identifier: GPL-3.0-or-later
// The modal form of a plant at a point.
#pragma once

#include <dalembert/plant.h>

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "plant/equilibrium.hpp"

namespace dalembert {

/// Numbers are in SI, in the order of the tables of the plant.
struct ModalPointOfPlant {
    std::vector<double> parameters, x, u;
    unsigned mode = 0;
    bool is_held = false;              ///< constraints leave fewer motions free
    bool takes_rows_of_plant = false;  ///< they are those that the plant projects to
    HeldRows rows = {};                ///< else these
};

struct PlantModalReduction {
    bool is_closed;
    std::vector<std::size_t> coordinates, apart, free;
    NumberRows N;
    std::vector<std::complex<double>> of_apart;
};

struct PlantModalBlock {
    std::size_t first, size;
    bool is_real;
};

struct PlantModalForm {
    using ComplexRows = std::vector<std::vector<std::complex<double>>>;
    std::string status;
    std::vector<double> rates;  ///< at the point
    std::optional<PlantModalReduction> reduction;
    NumberRows M, D, C, B;
    std::string of_M, of_D, of_C;  ///< which sign their quadratic forms have
    // Where there is a modal form.
    std::vector<std::complex<double>> eigenvalues, alpha;
    ComplexRows vectors, matrix, input;
    std::vector<PlantModalBlock> blocks;
};

PlantModalForm modes_of_plant(const dalembert_plant& plant, const ModalPointOfPlant& point);

}  // namespace dalembert
