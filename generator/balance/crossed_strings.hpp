// SPDX-License-Identifier: GPL-3.0-or-later
// View factors in a prism by crossed strings: A_i*F_ij is half of what the strings between the ends of two sides are longer crossed
// than uncrossed, times the height. It is the integral (4.56) in closed form, for plane sides of any simple polygon.
#pragma once

#include "balance/polygon.hpp"
#include "balance/steps.hpp"

namespace dalembert {

struct Corner {
    GiNaC::ex x, y;
};

struct PrismAreas {
    std::vector<GiNaC::ex> areas;                ///< A_i
    std::vector<std::vector<GiNaC::ex>> direct;  ///< A_i*F_ij, symmetric
};

/// `polygon` holds the same corners in numbers; the course of the strings is decided by them, and so is which of two equal forms
/// loses no digits.
PrismAreas crossed_strings(const std::vector<Corner>& corners, const Polygon& polygon, const std::vector<PlanePoint>& numbers,
                           const GiNaC::ex& height, Steps& steps);

}  // namespace dalembert
