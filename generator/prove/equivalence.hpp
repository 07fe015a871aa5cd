// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two expressions are the same function: proven, numerically equal, or not.
#pragma once

#include <functional>

#include "elements/verdict.hpp"
#include "form/random_points.hpp"
#include "symbolic/ranges.hpp"

namespace dalembert {

struct Comparison {
    Verdict verdict;
    std::string reason = {};                   ///< why not checkable, or what is assumed
    std::optional<Point> counterexample = {};  ///< where the two differ
};

/// Proofs are by normal form, first with definitions as letters, then written out. Where that decides nothing the two are compared
/// at 30 random points with at least 60 digits. A difference is reported only when it was seen at a point.
class Prover {
public:
    using Evaluation = std::function<std::optional<cln::cl_R>(const GiNaC::ex&, const Point&, int digits)>;

    explicit Prover(const System& system);

    Comparison equal(const GiNaC::ex& a, const GiNaC::ex& b);
    /// True only when proven without assumptions on what moves: what is emitted must be right outside of declared ranges too.
    bool proven_equal(const GiNaC::ex& a, const GiNaC::ex& b);
    /// Whether the normal forms are the same with definitions as letters: the first attempt at that. The caller's own letters may occur.
    bool have_same_form(const GiNaC::ex& a, const GiNaC::ex& b);
    /// The comparison by numbers alone, with an evaluation of the caller's.
    Comparison compare_at_points(const Evaluation& evaluate, const GiNaC::ex& a, const GiNaC::ex& b) const;

private:
    bool proven_equal(const GiNaC::ex& a, const GiNaC::ex& b, const std::set<std::string>& positive, bool joins_roots = false);
    bool proven_for_unit_quaternions(const GiNaC::ex& difference);
    Comparison equal_under_waves(const GiNaC::ex& a, const GiNaC::ex& b);

    const System& system_;
    ZeroAtPoints seems_zero_;
    PositiveByRange ranged_;  ///< what is positive by ranges
};

}  // namespace dalembert
