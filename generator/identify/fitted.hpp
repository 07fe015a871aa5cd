// SPDX-License-Identifier: GPL-3.0-or-later
// What is fitted to data, as --fit names it: "d_R, start(phi), offset(phi), delay(F)".
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "form/system.hpp"

namespace dalembert {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// A value with its unit, as results show it.
struct ShownNumber {
    std::string unit;                ///< in SI
    std::string declared_unit = {};  ///< empty where it is that of SI
    double of_declared = 1;          ///< SI over declared
    double offset = 0;
};

struct Fitted {
    enum class What { parameter, start, offset, delay };
    What what;
    const Variable* variable = nullptr;  ///< the parameter, state, or input; none of an offset
    std::string of;                      ///< of an offset: the column of the recording
    std::string name;                    ///< as it is written: "start(phi)"
    ShownNumber shown;
    double low, high;                  ///< bounds in SI; infinite where there are none
    std::optional<double> start = {};  ///< where the fit begins, in SI; none: where the run does
    Span place;
};

/// A family stands for all its members. Start values are fitted anew in each experiment, all others once for all.
/// Throws Failure (syntax, unknown-name, bad-option).
std::vector<Fitted> fitted_of(const std::string& list, const System& system);

/// A symbolic value as a number. Throws Failure (division-by-zero).
double double_of(const GiNaC::ex& value, const Span& place);
/// How values of a unit are shown.
ShownNumber shown_in(const Unit& unit);
/// Of a column of the recording.
ShownNumber shown_of_column(const std::string& name, const System& system);

}  // namespace dalembert
