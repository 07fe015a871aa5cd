// SPDX-License-Identifier: GPL-3.0-or-later
// For reading only: products of sines and cosines of two angles as sine or cosine of their sum or difference. In code the products
// are cheaper, because every angle's sine and cosine are there already.
#pragma once

#include "graph/atoms.hpp"

namespace dalembert {

/// Replaces k*T*(cos a cos b + sin a sin b) by k*T*cos(a - b), and the three like it.
Polynomial with_angle_sums(Polynomial p, Atoms& atoms);

}  // namespace dalembert
