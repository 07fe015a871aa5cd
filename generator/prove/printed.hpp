// SPDX-License-Identifier: GPL-3.0-or-later
// Is this what the book prints? Printed equations against the derivation.
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

/// Values at which the two sides of an equation differ, short enough for a pocket calculator. Accelerations are those of the motion.
struct CounterExample {
    std::vector<std::pair<std::string, std::string>> values;  ///< name and value, in SI
    std::string left;
    std::string right;
};

/// The verdict on one equation. Of several sides "a = b = c" the first pair that is worst.
struct PrintedResult {
    std::string written;                        ///< the equation as in the model file
    Comparison comparison;                      ///< verdict also dimensionally_wrong
    std::optional<GiNaC::ex> difference = {};   ///< printed left minus right on the motion, where it is wrong and can be shown
    std::optional<CounterExample> counterexample = {};
    std::optional<GiNaC::ex> derived =
        {};  ///< what the derivation has for the left side; with is_motion an equation of motion that is zero
    bool is_motion = false;
    std::string entry = {};     ///< of an equation of matrices: which entry this is, "row 1, column 2"
    bool is_left_out = false;   ///< a third row that the text does not print
    std::string hint = {};      ///< of a wrong one: "holds to first order about phi = 0"
};

struct PrintedCheck {
    Member<PrintedEquation> entry;
    std::vector<PrintedResult> equations;

    Verdict verdict() const;  ///< the worst of its equations
};

/// Whether accelerations occur or not, an equation is right when it holds on every motion of the derived system.
PrintedCheck check_printed(const System& system, const Member<PrintedEquation>& entry);

/// Whether an entry holds at a few random points, units and all: quick, and true of all that is right.
bool may_hold(const System& system, const Member<PrintedEquation>& entry);

/// Whether an entry that holds says no more than 0 = 0.
bool is_trivial(const System& system, const Member<PrintedEquation>& entry);

}  // namespace dalembert
