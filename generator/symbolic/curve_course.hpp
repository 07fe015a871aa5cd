// SPDX-License-Identifier: GPL-3.0-or-later
// The course of a measured characteristic between and beyond places where its values are known, as exact polynomials.
//
// note [curves]: The slopes of the monotone shape are the weighted harmonic means of Fritsch and Butland (1984), as Brodlie wrote them, and
// at the ends the formula of three points, limited: all of them rational, unlike those of Fritsch and Carlson (1980), which need a root
// where they are too steep. The curve rises where its points rise, as with those. The spline is natural; its equations are solved exactly.
// A piece counts from its place nearest to zero. So x and what it is counted from never cancel worse than x itself is known, and a curve
// through zero keeps its digits there.
#pragma once

#include <array>
#include <vector>

#include "elements/curves.hpp"

namespace dalembert {

class CurveCourse {
public:
    using Numbers = std::vector<Rational>;
    using Coefficients = std::array<Rational, 4>;

    /// `knots` rise, and are two or more.
    CurveCourse(const Numbers& knots, Curve::Shape shape, Curve::Outside outside) : knots_(knots), shape_(shape), outside_(outside) {}

    /// At the knots; empty for straight lines, which have none of their own.
    Numbers slopes(const Numbers& values) const;
    /// From where the piece above knot i - 1 and below knot i is counted; i is up to the number of knots.
    Rational origin(std::size_t i) const;
    /// Of the powers of x - origin(i). It is linear in values and slopes.
    Coefficients piece(std::size_t i, const Numbers& values, const Numbers& slopes) const;

private:
    const Numbers& knots_;
    Curve::Shape shape_;
    Curve::Outside outside_;
};

/// Whether they are equally far from each other.
bool are_even(const std::vector<Rational>& knots);

}  // namespace dalembert
