// SPDX-License-Identifier: GPL-3.0-or-later
// Straight-line code as recurrences of Taylor series: with the coefficients of all values up to one order those of the next follow.
// Griewank, Walther: Evaluating Derivatives, 2nd edition (2008), chapter 13.
//
// note [series]: Sums, and products with what does not move, are linear. The others need sums over all orders between:
//     z = a*b      z_k = sum of a_j*b_(k-j), j = 0..k
//     z = a/b      z_k = (a_k - sum of b_j*z_(k-j), j = 1..k)/b_0
// and every function is the solution of w*z' = sum of factor*v*a', whose v and w are values of the program themselves:
//     k*z_k*w_0 = sum of factor*(sum of j*a_j*v_(k-j), j = 1..k) - (sum of j*z_j*w_(k-j), j = 1..k-1)
// In a product of two that move, a reciprocal as its second factor means the quotient. What only changes by jumps, as a sign, does not
// move here.
#pragma once

#include "graph/code.hpp"
#include "symbolic/series_rules.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// A function that has no series, and what needs it.
struct NoSeries {
    bool in_motion;  ///< an acceleration, or a multiplier behind them; else a result
    std::size_t index;
    Op op;
};

/// Values of a header's function as series. The program differs from that of the right-hand side: its products have two factors.
struct SeriesCode {
    FunctionCode function = {};
    std::map<NodeId, SeriesRule> rules = {};
    std::vector<bool> moves = {};          ///< by node
    /// Accelerations and multipliers that follow order by order from M*x = b, with M of the start: none where the program itself solves.
    std::vector<NodeId> unknowns = {};
    std::vector<NodeId> before = {}, after = {};  ///< what is computed order by order, before and after these are solved for
    std::optional<NoSeries> missing = {};

    /// z = a/b; else a product of two that move.
    bool is_quotient(const Node& product) const;
    /// A product of what does not move and what does.
    bool is_scaled(const Node& product) const { return !moves[product.arguments[0]]; }
};

/// Why the motion has no series, if that is so.
std::optional<Diagnostic> missing_series(const Code& code);

/// Rewrites a function. `places`: where what is solved for stands among all accelerations and multipliers.
SeriesCode make_series(const Atoms& atoms, const FunctionCode& given, const std::vector<std::size_t>& places);

}  // namespace dalembert
