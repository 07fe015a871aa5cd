// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of rates that are held at zero: factors*(velocities) + drift = 0.
#pragma once

#include "form/system.hpp"

namespace dalembert {

struct RateRow {
    std::vector<GiNaC::ex> factors;  ///< by coordinate
    GiNaC::ex drift;
    std::vector<GiNaC::ex> made_of;  ///< factors of the constraints
    std::size_t pivot = 0;
    std::size_t constraint = 0;
    const Constraint* item = nullptr;
};

/// Of a constraint that holds, or would.
RateRow row_of(const System& system, std::size_t constraint);
/// from - factor*row
void take(RateRow& from, const GiNaC::ex& factor, const RateRow& row);
/// What is left of it behind the elimination of the pivot of a row.
inline void subtract(RateRow& from, const RateRow& row) { take(from, from.factors[row.pivot], row); }
bool is_zero(const RateRow& row);
/// Also where cosines and sines cancel.
bool vanishes(const GiNaC::ex& e);
/// row = factor*other, with a factor of parameters.
std::optional<GiNaC::ex> multiple_of(const RateRow& row, const RateRow& other, const Symbols& symbols);
/// What is left of a row that is a sum of others, which do not follow from each other: no factors. Nothing where it is none, or where more
/// than three have to be solved for. Factors of the sum may change with the motion.
std::optional<RateRow> what_follows(const RateRow& row, const std::vector<RateRow>& others);

}  // namespace dalembert
