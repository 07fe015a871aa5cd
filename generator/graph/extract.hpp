// SPDX-License-Identifier: GPL-3.0-or-later
// Common factors and common sums of many polynomials at once, chosen greedily by the operations they save. This is the fast
// extraction of two-term divisors known from logic synthesis (Rajski and Vasudevamurthi 1992), for polynomials as in
// Hosangadi, Fallah and Kastner 2006.
#pragma once

#include <cstdint>
#include <vector>

#include "language/rational.hpp"

namespace dalembert {

/// coefficient * product of letters; sorted, with repetition for powers.
struct Cube {
    Rational coefficient;
    std::vector<std::uint32_t> letters;
};

/// A sum of cubes.
using CubeSum = std::vector<Cube>;

/// Functions of letters. Function i defines letter first_letter + i and may be used by the others.
struct Network {
    std::uint32_t first_letter;
    std::vector<CubeSum> functions;
};

/// Adds functions to the network for what is worth computing once, and uses them. The result depends on the order of functions and
/// the numbers of letters only.
void extract(Network& network);

}  // namespace dalembert
