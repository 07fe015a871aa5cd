// SPDX-License-Identifier: GPL-3.0-or-later
// The error of a computed number beside the condition of what it is computed from.
#pragma once

#include "emit/measured_functions.hpp"
#include "form/edge_points.hpp"

namespace dalembert {

inline constexpr int reference_digits = 100;

/// The largest error that was seen, and where.
struct WorstInput {
    std::string result;
    const char* kind = "";       ///< of the point
    std::vector<double> inputs;
    double computed = 0;
    cln::cl_R exact = 0;
    double error = 0;            ///< in ulp beyond the condition
};

/// Of one function in one mode. Errors in ulp: plain, and beyond the condition of the problem. With a ulp(f) of the exact value and the
/// slopes of the exact function, |computed - exact|/(ulp(f) + sum |df/dx_i| ulp(x_i)/2): what rounding the result, and inputs that are
/// known to half an ulp, do not explain.
struct FunctionAccuracy {
    std::string mode, name;
    std::size_t results = 0;
    std::size_t measured = 0;    ///< numbers that were compared
    double largest_plain = 0, typical_plain = 0, typical = 0;
    std::optional<WorstInput> worst = {};
    double largest() const { return worst ? worst->error : 0; }
};

std::vector<Rational> all_exact(const std::vector<double>& values);

/// What roundings on the way to systems that are solved do, at one point.
class Roundings {
public:
    Roundings(ExactCode& at, const std::vector<double>& inputs, const Arithmetic& arithmetic)
        : at_(at), inputs_(inputs), arithmetic_(arithmetic) {}

    /// What half an ulp of the inputs does to a number.
    double by_inputs(const ExactNumber& number) const;

    /// What roundings do to it where it is made of what is solved for.
    double operator()(const MeasuredResult& result, const ExactNumber& number);

private:
    const std::vector<double>& of(Function function, std::optional<std::size_t> column);
    double by_motion(Function solves, const ExactNumber& number);
    std::size_t unknowns() const { return (at_.slope_count() - inputs_.size()) / 2; }

    ExactCode& at_;
    const std::vector<double>& inputs_;
    const Arithmetic& arithmetic_;
    std::map<std::pair<Function, std::optional<std::size_t>>, std::vector<double>> known_;
};

/// What entries of Jacobians are to be seen beside, for each result; zero where it is seen alone. Jacobians are compared norm-wise: entries
/// of a row multiply changes of inputs, which count with the sizes of their ranges, and are differences of what makes the rate.
std::vector<double> row_norms(const std::vector<MeasuredResult>& results, const std::vector<MaybeExact>& values, ExactCode& at,
                              const std::vector<double>& input_sizes);

/// The errors of the numbers of one function.
class ErrorsSeen {
public:
    ErrorsSeen(const Code& code, const Arithmetic& arithmetic, FunctionAccuracy& total)
        : arithmetic_(arithmetic), total_(total), finer_(code, 2 * reference_digits) {}
    void operator()(const MeasuredResult& result, const ExactNumber& expected, double computed, double norm, const EdgePoint& point,
                    Roundings& roundings);
    void finish();

private:
    /// What is known of a number that was compared.
    struct Seen {
        double computed, norm, by_condition, by_roundings;
    };
    void consider(const MeasuredResult& result, const Seen& seen, const EdgePoint& point);

    const Arithmetic& arithmetic_;
    FunctionAccuracy& total_;
    ExactCode finer_;
    std::vector<double> plain_, beyond_;
};

}  // namespace dalembert
