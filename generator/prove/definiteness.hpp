// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a matrix of parameters is positive definite, as (2.117) says of mass, damping and stiffness matrices.
#pragma once

#include "form/system.hpp"

namespace dalembert {

struct DefinitenessVerdict {
    std::string kind;                     ///< "positive definite", "positive semidefinite", "zero", "indefinite", "not symmetric", ...
    bool is_proven;                       ///< for all parameters in their ranges; else at their values
    std::vector<std::string> where =
        {};  ///< proven semidefinite, and definite where these parameters, whose ranges begin at zero, are not zero
    /// "positive definite for all parameters in their ranges"
    std::string sentence() const;
};

/// By the pivots of L D L' whose signs follow from the ranges; else exactly at the values of the model. Entries are of parameters.
/// Throws Failure when a value of the model is outside its range.
DefinitenessVerdict definiteness(const GiNaC::matrix& A, const System& system);

}  // namespace dalembert
