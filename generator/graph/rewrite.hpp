// SPDX-License-Identifier: GPL-3.0-or-later
// Forms that lose digits get other ones before code is made of them. A rule is applied where it helps, and nowhere else: what a sum loses
// at random and edge points of the declared ranges is measured with every operation rounded to double, before and after.
#pragma once

#include "form/edge_points.hpp"
#include "graph/rewrite_rules.hpp"
#include "graph/rounded_polynomial.hpp"
#include "prove/equivalence.hpp"

namespace dalembert {

/// What was written in another form.
struct Rewriting {
    std::string rule, where;      ///< "1 - cos(x)", "outputs"
    int places = 0;
    double before = 0, after = 0; ///< the largest error of the sum, in ulp beyond its condition
};

class Rewriter {
public:
    /// Definitions and guards as they are lowered; they are referred to.
    Rewriter(const System& system, Atoms& atoms, const std::vector<Polynomial>& definitions, const std::vector<Polynomial>& guards);

    /// The best form of a sum.
    Polynomial operator()(const Polynomial& p, const char* where);
    const std::vector<Rewriting>& log() const { return log_; }
    /// What a sum loses in another form of it, in ulp beyond its condition.
    double largest_error(const Polynomial& exact, const Polynomial& computed) { return loss(exact, computed).largest(); }

private:
    /// What a form of a sum loses.
    struct Loss {
        std::size_t without_value = 0;  ///< points where the sum has a value and the form has none, as where an exponential overflows
        double error = 0;               ///< the largest at the others, in ulp beyond the condition
        double largest() const;
        bool is_less_than(const Loss& other) const {
            return without_value < other.without_value || (without_value == other.without_value && error < other.error);
        }
    };
    /// With `better_than` it ends where the form is seen to lose no less than that.
    Loss loss(const Polynomial& exact, const Polynomial& computed, const Loss* better_than = nullptr);
    bool is_good(const Polynomial& exact, const Polynomial& computed);
    static double unit_of(const ExactNumber& number, const std::vector<double>& values);
    void draw(const std::vector<Polynomial>& guards);
    bool seems_zero(const Polynomial& p);
    std::size_t points_with_value(const Polynomial& exact);
    void note(const Rewriting& one);
    /// What a sum is at a point, and how large an error is that its own rounding allows, and its inputs, too: that takes slopes, and is
    /// found out where it matters. Not a number where there are none.
    struct Expected {
        DoubleDouble value;
        double ulp;
        std::optional<double> unit = {};
    };
    std::vector<std::optional<Expected>>& expected(const Polynomial& exact);
    double unit_at(std::size_t point);

    const System& system_;
    Atoms& atoms_;
    const std::vector<Polynomial> definitions_, guards_;
    std::vector<std::pair<RoundedPolynomials, std::vector<double>>> points_;
    std::pair<Polynomial, std::vector<std::optional<Expected>>> expected_;  ///< of the sum that was asked for last
    std::map<Polynomial, Polynomial> known_;
    FormMemory forms_;
    Prover prover_;
    std::vector<Rewriting> log_;
    std::string machine_;  ///< a text of all that measurements depend on
};

}  // namespace dalembert
