// SPDX-License-Identifier: GPL-3.0-or-later
// Constraints whose rates repeat those of others: what holds together, what cannot be, and what is left out.
#pragma once

#include "form/rate_row.hpp"

namespace dalembert {

/// Throws Failure (undetermined, doubly-determined) where nothing is left of a rate behind the elimination of these rows.
void check_rate(const System& system, const RateRow& row, const std::vector<RateRow>& eliminated, const std::vector<RateRow>& kept);

/// Sets the repetitions of the system, takes what repeats others out of the kept rows, and marks what follows from others. Throws Failure
/// (doubly-determined, too-large).
void settle_repeated_rates(System& system, const std::vector<RateRow>& eliminated, std::vector<RateRow>& kept);

}  // namespace dalembert
