// SPDX-License-Identifier: GPL-3.0-or-later
// Points that constraints hold, found with many digits: whether the start values can be one, and which constraints follow from others.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// A point with numbers for everything, and how the constraints fare there.
struct ConstrainedPoint {
    GiNaC::exmap values;                    ///< of coordinates and velocities, and of what was given
    std::vector<std::size_t> broken;        ///< constraints whose position is not met
    std::vector<std::size_t> broken_rates;
    std::vector<std::size_t> dependent;     ///< those whose rate is a sum of the rates of those before them
};

class ConstraintPoints {
public:
    /// Of the constraints in this order.
    ConstraintPoints(const System& system, std::vector<std::size_t> order, const Values& values);

    /// Near the values. With `keeps_written` those that are given stay as they are.
    ConstrainedPoint near_start(bool keeps_written) const;
    /// Constraints that follow from those before them wherever they hold, as far as points near the start tell; none where no point is
    /// found.
    std::vector<std::size_t> redundant() const;

    /// What is left of a position or rate at a point.
    cln::cl_R value(const GiNaC::ex& e, const GiNaC::exmap& point) const;

private:
    using Row = std::vector<cln::cl_R>;
    using Slopes = std::vector<std::pair<std::size_t, GiNaC::ex>>;  ///< with their columns
    struct Rows {
        std::vector<Row> factors;
        std::vector<cln::cl_R> rest;
    };
    ConstrainedPoint find(GiNaC::exmap point, const std::vector<bool>& free_positions, const std::vector<bool>& free_velocities) const;
    void meet_positions(GiNaC::exmap& point, const std::vector<bool>& is_free) const;
    void meet_rates(GiNaC::exmap& point, const std::vector<bool>& is_free) const;
    std::optional<Rows> rows(const GiNaC::exmap& point, bool of_rates) const;
    void displace(GiNaC::exmap& point, std::size_t coordinate, const cln::cl_R& step) const;
    bool is_met(const GiNaC::ex& e, const FloatPoint& at) const;
    const Slopes& slopes(std::size_t constraint, bool of_rates) const;

    const System& system_;
    std::vector<std::size_t> order_;
    const Values& values_;
    GiNaC::exmap start_;
    mutable std::map<std::pair<std::size_t, bool>, Slopes> slopes_;
};

/// Whether a mode of the scene, or each of them, holds a constraint. That of friction with a state in place of modes is held by none.
bool holds_in(const Scene& scene, const ConstraintEquation& constraint, std::size_t mode);
bool holds_in_all_modes(const Scene& scene, const ConstraintEquation& constraint);

}  // namespace dalembert
