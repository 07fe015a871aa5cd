// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over cells that are computed in loops, and the rates of such cells: outputs may ask for them. A sum is a letter, which the
// header's loops compute; what stands around it is derived as all else is.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// While it is there, expressions may ask for what cells in loops add up to. What it hands out stands in system.cell_sums.
class OpenSums {
public:
    explicit OpenSums(System& system);
    ~OpenSums();
    OpenSums(const OpenSums&) = delete;

private:
    System& system_;
};

/// Adds to the rates of cells in an output what their neighbours and surroundings bring; what else does is in system.state_rates.
void add_rates_in_loops(const System& system, const Expression& place, GiNaC::ex& value);

/// Outputs with letters of sums are computed beside the others.
void separate_sums(System& system);

}  // namespace dalembert
