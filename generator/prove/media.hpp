// SPDX-License-Identifier: GPL-3.0-or-later
// What every medium must satisfy, so that heat and work can be told apart: (3.11), (3.21) and (3.43).
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

/// An identity in the letters p and T of a medium.
struct MediumIdentity {
    std::string name;
    std::string left_name, right_name;
    GiNaC::ex left, right;
};

std::vector<MediumIdentity> medium_identities(const MediumModel& medium);

/// The identity in numbers, at three states with the default parameters. What is wrong is told with both sides.
Comparison compare_at_states(const System& system, const MediumModel& medium, const MediumIdentity& identity);

}  // namespace dalembert
