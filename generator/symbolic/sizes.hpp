// SPDX-License-Identifier: GPL-3.0-or-later
// How large a sum is at most.
#pragma once

#include <ginac/ginac.h>

namespace dalembert {

/// What counts as zero for the square of a sum that is multiplied out: the square of a millionth of its terms, with sines and cosines of one.
GiNaC::ex least_square(const GiNaC::ex& sum);

}  // namespace dalembert
