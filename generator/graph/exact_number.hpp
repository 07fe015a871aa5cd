// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of many digits with their slopes by what they were computed from, and the operations of programs on them: the reference
// that emitted code is measured against, and the condition of what it computes.
#pragma once

#include <cln/float.h>
#include <cln/real.h>

#include <functional>
#include <optional>
#include <vector>

#include "graph/program.hpp"

namespace dalembert {

/// A value and its slopes by the inputs. Slopes are doubles: they say how large an error may be, which needs no more. No slopes: all zero.
struct ExactNumber {
    cln::cl_R value = 0;
    std::vector<double> slopes = {};

    /// Adds factor times the slopes of another one.
    void add_slopes(const ExactNumber& other, double factor);
    void operator*=(const ExactNumber& factor);
};

/// Nothing where an expression has no value: at a pole, or where it is not real.
using MaybeExact = std::optional<ExactNumber>;

/// Operations with as many digits.
class ExactArithmetic {
public:
    explicit ExactArithmetic(int digits);

    MaybeExact constant(const Rational& value) const { return ExactNumber{cln::cl_float(value, format_), {}}; }
    MaybeExact pi() const { return ExactNumber{cln::pi(format_), {}}; }
    /// An input, which has slope one by itself.
    MaybeExact input(const Rational& value, std::size_t number, std::size_t count) const;
    static MaybeExact sum(const std::vector<const MaybeExact*>& terms, const std::vector<bool>& negative);
    static MaybeExact product(const std::vector<const MaybeExact*>& factors);
    static MaybeExact reciprocal(const MaybeExact& x);
    /// Slopes that the table of functions does not know are differences, at a distance of a third of their digits. Where a function
    /// jumps its slope is that of its pieces.
    MaybeExact function(Op op, const std::vector<const MaybeExact*>& arguments) const;
    /// Element k of an array that is made of these.
    MaybeExact element(Op array, const std::vector<const MaybeExact*>& arguments, std::size_t k) const;

private:
    using Values = std::vector<cln::cl_R>;
    using At = std::function<std::optional<cln::cl_R>(const Values&)>;
    std::optional<cln::cl_R> value(Op op, const Values& arguments) const;
    MaybeExact by_differences(const At& at, const std::vector<const MaybeExact*>& arguments, bool is_smooth = false) const;
    static ExactNumber extreme(bool is_smaller, const ExactNumber& x, const ExactNumber& y);
    MaybeExact by_exact_slopes(Op op, const std::vector<const MaybeExact*>& arguments) const;
    MaybeExact by_known_slopes(Op op, const std::vector<const MaybeExact*>& arguments) const;

    int digits_;
    cln::float_format_t format_;
};

}  // namespace dalembert
