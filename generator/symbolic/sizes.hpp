// SPDX-License-Identifier: GPL-3.0-or-later
// How large the terms of a sum that is multiplied out are together.
#pragma once

#include <ginac/ginac.h>

namespace dalembert {

GiNaC::ex size_of_terms(const GiNaC::ex& sum);
/// With sines and cosines of one: the size of a length also where a crank is at its dead centre.
GiNaC::ex size_at_any_angle(const GiNaC::ex& sum);
/// What counts as zero for the square of a sum: that of a millionth of its size at any angle.
GiNaC::ex least_square(const GiNaC::ex& sum);

}  // namespace dalembert
