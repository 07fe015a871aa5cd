// SPDX-License-Identifier: GPL-3.0-or-later
// View factors that are given: completed by reciprocity A_i*F_ij = A_j*F_ji (4.45) and by the sum 1 of each row (4.47), and checked
// against both.
#pragma once

#include "elements/heat.hpp"
#include "symbolic/values.hpp"

namespace dalembert {

/// The name of a surface, with its number where another has the same; for messages.
std::string surface_name(const Enclosure& enclosure, std::size_t i);

/// The value of an expression at the defaults, exact where it can be; nothing where it depends on an input or has none.
class Defaults {
public:
    Defaults(const Scene& scene, const Translator& translate);
    std::optional<cln::cl_R> operator()(const GiNaC::ex& e) const;

private:
    const Symbols& symbols_;
    GiNaC::exmap values_;
};
/// -1, 0 or 1; what is within rounding of 60 digits is zero beside a size of the order of one.
int sign_of_value(const cln::cl_R& value);
/// For messages.
std::string shown(const cln::cl_R& value);

/// Two surfaces by their numbers.
using Pair = std::pair<std::size_t, std::size_t>;

/// The rows, sum over j of A_i*F_ij = A_i, solved for what is not known. `direct` is zero at those places.
struct SolvedRows {
    std::vector<GiNaC::ex> values;             ///< of what is not known
    std::vector<GiNaC::ex> left_over;          ///< of rows that were not needed: zero where the rows agree
    std::optional<Pair> undetermined = {};     ///< the first for which the rows do not suffice
};
SolvedRows solve_rows(const std::vector<GiNaC::ex>& areas, const std::vector<std::vector<GiNaC::ex>>& direct,
                      const std::vector<Pair>& unknown);

/// A_i*F_ij, symmetric. Throws Failure (wrong-enclosure, value-out-of-range, undetermined).
std::vector<std::vector<GiNaC::ex>> complete_view_factors(const Enclosure& enclosure, const std::vector<GiNaC::ex>& areas,
                                                          const std::vector<std::vector<std::optional<GiNaC::ex>>>& factors,
                                                          const Defaults& value);

}  // namespace dalembert
