// SPDX-License-Identifier: GPL-3.0-or-later
// What is checked of every FMU besides its runs: derivatives, saved states, instances beside each other, wrong calls.
#pragma once

#include <algorithm>
#include <string>

#include "dalembert/plant.h"
#include "fmi_exchange.hpp"

namespace fmi_test {

extern int failures;
extern std::string name_of_unit;

/// Prints what is wrong.
void fail(const std::string& what);
inline void check(bool is_right, const std::string& what) {
    if (!is_right) fail(what);
}

/// An FMU with the inputs that are held.
struct Subject {
    const Unit& unit;
    const Description& d;
    double until;
    References inputs;
    Vector values;
    Vector event_times = {};  ///< of the fine run

    bool is_event(double t) const {
        return std::any_of(event_times.begin(), event_times.end(), [&](double e) { return std::abs(e - t) <= 1e-8 * std::max(1.0, t); });
    }
    void prepare(Instance& fmu, double tolerance) const {
        check(fmu.setup(tolerance, 0, until) == ok, "initialization mode is not entered");
        check(fmu.set(inputs, values) == ok, "inputs are not taken");
        if (fmu.end_setup() != ok) fail("initialization fails: " + (messages().empty() ? "" : messages().back()));
    }
    std::vector<std::string> state_names() const {
        std::vector<std::string> names;
        for (const Unknown& u : d.derivatives) names.push_back(d.variables[*d.variables[u.variable].derivative_of].name);
        return names;
    }
};

/// In continuous time at the present point: against differences, the adjoint ones, the dependencies, and the plant's own table. Returns the
/// largest deviation from that, beside the largest entry of a column.
double check_derivatives(const Subject& s, Instance& fmu, double t, const Vector& x, long mode, const dalembert_plant* plant, void* self);
/// By parameters; of an instance that is not used any more.
void check_derivatives_by_parameters(const Subject& s, Instance& fmu);
void check_states(const Subject& s);
void check_wrong_calls(const Subject& s);

}  // namespace fmi_test
