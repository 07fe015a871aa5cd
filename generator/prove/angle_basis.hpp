// SPDX-License-Identifier: GPL-3.0-or-later
// Other angles for a proof: where bodies are turned against each other, sines and cosines of long sums of angles occur, whose addition
// theorems double their terms with each angle. With the sums themselves as letters all of them are sums of a few.
#pragma once

#include <ginac/ginac.h>

namespace dalembert {

/// The expression after a change of variables, one to one and linear, that makes the arguments of its sines and cosines shorter; as it
/// is, where none was found. So it is zero where the given one is.
struct ShortAngles {
    GiNaC::ex expression;
    GiNaC::exmap meaning;  ///< of the new letters
};
ShortAngles with_short_angles(const GiNaC::ex& e);

}  // namespace dalembert
