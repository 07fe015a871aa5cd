// SPDX-License-Identifier: GPL-3.0-or-later
// The known units, prefixes and other spellings, for `dalembert help units`.
#pragma once

#include <string>
#include <vector>

#include "language/dimension.hpp"

namespace dalembert {

struct UnitRow {
    std::string name;
    bool takes_prefix = false;
    std::string doc;
    Unit unit = {};
};

std::vector<UnitRow> unit_rows();
/// "k" with "1e3".
std::vector<UnitRow> prefix_rows();
/// "ft" with "0.3048 m": units that the language does not have, and other spellings.
std::vector<UnitRow> other_unit_rows();

}  // namespace dalembert
