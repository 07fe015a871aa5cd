// SPDX-License-Identifier: GPL-3.0-or-later
// Points at which numerical code is tried: random ones, and those where digits are lost. Every number is one of the arithmetic that is
// tried, and lies in its declared range, or in what goes for one.
#pragma once

#include "form/random_points.hpp"

namespace dalembert {

/// What a double is exactly, also where CLN has no such number.
Rational exact(double value);

/// A binary arithmetic.
struct Arithmetic {
    const char* name;
    int digits;        ///< binary ones of a number
    int least;         ///< the exponent of its smallest number above zero
    double largest;
    int halvings;      ///< how far below the ends of ranges is tried: products of a few such numbers are still numbers

    double nearest(const Rational& value) const;
    double next(double value, double towards) const;
    /// The distance of numbers at a value.
    double ulp(double value) const;
};
const Arithmetic& float_arithmetic();
const Arithmetic& double_arithmetic();

struct EdgePoint {
    const char* kind;            ///< "near zero", ...
    std::vector<double> values;  ///< of the variables
};

class EdgePoints {
public:
    EdgePoints(const System& system, std::vector<const Variable*> variables, const Arithmetic& arithmetic, std::uint64_t seed);
    /// The next point. The sequence is the same on every run and machine. In every other point parameters have their default values.
    EdgePoint next();
    /// Of each variable the largest magnitude in its range.
    std::vector<double> sizes() const;

private:
    struct Range {
        double low, high;
        double usual;  ///< of a parameter
        double scale() const;
        bool holds(double value) const { return low <= value && value <= high; }
        bool may_be_zero() const { return holds(0); }
    };

    double fraction();           ///< in (0, 1)
    bool chance() { return fraction() < 0.5; }
    double rounded(double value) const;
    double within(const Range& range, double value) const;
    double uniform(const Range& range);
    double tiny_to_huge(const Range& range);
    double small(double scale);  ///< of either sign
    void make_equal(std::vector<double>& values);

    std::vector<const Variable*> variables_;
    std::vector<Range> ranges_;
    const Arithmetic& arithmetic_;
    std::uint64_t state_;
    std::size_t count_ = 0;
};

}  // namespace dalembert
