// SPDX-License-Identifier: GPL-3.0-or-later
// Seeded points in the declared ranges, values of expressions there with as many digits as wanted, and whether they are zero.
#pragma once

#include <cln/real.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "form/system.hpp"
#include "symbolic/map_functions.hpp"

namespace dalembert {

/// The next number of a sequence that is the same on every machine (splitmix64).
std::uint64_t next_word(std::uint64_t& state);

/// An exact value for every letter of the system but the definitions, which follow from the parameters.
using Point = std::vector<std::pair<GiNaC::ex, Rational>>;

class RandomPoints {
public:
    explicit RandomPoints(const System& system);
    /// The next point. The sequence is the same on every run and machine.
    Point next();
    /// The same with letters of any size, from a thousandth to a thousand, where nothing says how large they are.
    Point next_wide();

    /// Where a letter is taken from: its declared range, or what goes for one.
    struct Interval {
        GiNaC::ex letter;
        Rational low;
        Rational high;
        bool is_free = false;  ///< nothing says how large it is; negative where `low` is
        bool has_range = true; ///< a declared one, or that of a curve
    };
    const std::vector<Interval>& intervals() const { return intervals_; }

private:
    static Rational fraction(std::uint64_t& state);
    /// Letters without a range are taken from where a curve of them has its points, and a little beyond.
    void look_at_curves(const System& system, const GiNaC::exmap& at_start);
    void look_at_points(const PointsOfCall& points, const GiNaC::exmap& at_start);
    void add_factors(Point& point);
    void make_unit_quaternions(Point& point) const;

    std::vector<Interval> intervals_;
    std::vector<GiNaC::ex> factors_;  ///< of second derivatives
    std::vector<std::array<std::size_t, 4>> quaternions_;  ///< places of their parts
    std::uint64_t state_ = 0x9E3779B97F4A7C15ULL, state_of_factors_ = 0xD1B54A32D192ED03ULL;
};

/// The value computed with so many digits; nothing where it does not exist or is not real.
std::optional<cln::cl_R> value_at(const GiNaC::ex& e, const Symbols& symbols, const Point& point, int digits);

/// Of several expressions: what they have in common is computed once.
class ValuesAtPoint {
public:
    ValuesAtPoint(const Symbols& symbols, const Point& point, int digits);
    std::optional<cln::cl_R> operator()(const GiNaC::ex& e);

private:
    const Symbols& symbols_;
    GiNaC::exmap constants_;
    int digits_;
    std::optional<FloatPoint> at_;
};

enum class Sign { none, zero, not_zero };

/// A value computed with so many digits.
using ValueAt = std::function<std::optional<cln::cl_R>(int)>;

/// Whether a value is zero; none where it does not exist. Computed with 60, 120 and 180 digits.
Sign sign_at(const ValueAt& value);

/// Whether an expression is zero wherever it has a value, as far as a few points tell: what is not zero at one of them is proven not to be,
/// what seems zero is to be proven otherwise. Without a value anywhere nothing seems zero.
class ZeroAtPoints {
public:
    explicit ZeroAtPoints(const System& system) : system_(system) {}
    /// Zero wherever it has a value, and it has one.
    bool operator()(const GiNaC::ex& e) { return sign(e) == Sign::zero; }
    /// Not zero at a point; without a value at any it may be either.
    bool differs(const GiNaC::ex& e) { return sign(e) == Sign::not_zero; }

private:
    Sign sign(const GiNaC::ex& e);

    const System& system_;
    std::vector<std::map<int, ValuesAtPoint>> points_;  ///< by digits
    std::map<GiNaC::ex, Sign, GiNaC::ex_is_less> known_;
};

}  // namespace dalembert
