// SPDX-License-Identifier: GPL-3.0-or-later
// What is left of a polynomial over atoms when it is computed in double: its value with every operation rounded, beside the exact one.
#pragma once

#include <functional>

#include <optional>
#include <vector>

#include "graph/atoms.hpp"
#include "graph/double_double.hpp"
#include "graph/exact_number.hpp"

namespace dalembert {

class RoundedPolynomials {
public:
    RoundedPolynomials(const Atoms& atoms, int digits, std::size_t slope_count)
        : atoms_(atoms), arithmetic_(digits), slope_count_(slope_count) {}

    /// A point: values of symbols, each with the number of its slope, below `slope_count`; nothing for those that have none there.
    struct Input {
        double value;
        std::size_t number;
    };
    void set(std::map<Letter, Input> inputs);

    MaybeExact exact(const Polynomial& p) { return sum_of(p, with_slopes_); }
    /// The same number without slopes, which take most of the time where functions are differentiated by differences.
    MaybeExact value(const Polynomial& p) { return sum_of(p, values_); }
    /// Whether there is one: whether all of these letters have values, and those below a fraction are not zero.
    bool has_value(const std::vector<Letter>& above, const std::vector<Letter>& below);
    /// The same with a relative error below 1e-21: by two doubles where that many digits are left, which is much faster.
    std::optional<DoubleDouble> short_value(const Polynomial& p);
    /// With every product, sum and function rounded to double, in the order of terms. Not a number where there is no value.
    double rounded(const Polynomial& p);

private:
    struct Known {
        bool has_slopes;
        std::map<Letter, MaybeExact> letters = {};
    };
    MaybeExact sum_of(const Polynomial& p, Known& known);
    const MaybeExact& exact_letter(Letter letter, Known& known);
    double rounded_letter(Letter letter);
    std::optional<DoubleDouble> by_two_doubles(const Polynomial& p);
    const std::optional<DoubleDouble>& short_letter(Letter letter);

    const Atoms& atoms_;
    ExactArithmetic arithmetic_;
    std::size_t slope_count_;
    std::map<Letter, Input> inputs_;
    Known with_slopes_{true}, values_{false};
    std::map<Letter, double> rounded_;
    std::vector<std::optional<std::optional<DoubleDouble>>> short_;  ///< by letter, of those that were asked for
};

}  // namespace dalembert
