// SPDX-License-Identifier: GPL-3.0-or-later
// What is compiled around a generated header: a plant with the inputs of a run, and programs that measure it.
#pragma once

#include "elements/runs.hpp"
#include "emit/header.hpp"

namespace dalembert {

struct SimulationSettings {
    double until = 0;      ///< s
    double tolerance = 1e-9;
    double step = 0;       ///< s; 0: chosen by the method
    std::string method = "automatic";
    int intervals = 500;
    std::vector<GiNaC::ex> inputs;  ///< expressions of time and state, one an input
    std::vector<std::pair<std::string, GiNaC::ex>> exact;  ///< closed forms of what is recorded, of time alone
    std::vector<double> kinks;      ///< s, at known times; see input_kinks
    bool series = false;            ///< of these, where the header has some of the motion
    std::vector<Plot> plots;        ///< names as the recording has them
    bool draw = true;
    bool declared_csv = false;      ///< in declared units, not in SI
    bool declared_plots = true;
    std::vector<std::string> formats;  ///< of result files besides CSV
};

/// What makes a plant of a header: the file that exports it, with the inputs of a run. Without inputs it is the plant alone.
std::string plant_source(Code& code, const Header& header, const SimulationSettings& settings);

/// What makes a library of the header of a controller that samples, in the numbers that its [sampling] names.
std::string controller_source(const System& controller, const Header& header);

/// The source of a program that measures one call of the right-hand side at the start, and the bytes of its code.
std::string cost_source(Code& code, const Header& header, const Values& values, const SimulationSettings& settings);

/// The source of a program that makes the run with any method, tolerance and step, in one of the arithmetics ("float", "double",
/// "long_double", "digits50"), and times it; see dalembert/work_precision.hpp.
std::string work_precision_source(Code& code, const Header& header, const Values& values, const SimulationSettings& settings,
                                  const std::vector<std::string>& arithmetics);
/// What its rows have behind the time: the outputs, or the states where the model has none.
std::vector<std::string> compared_columns(const System& system);

}  // namespace dalembert
