// SPDX-License-Identifier: GPL-3.0-or-later
// A run of a plant, by the integrators that are compiled into the program.
#pragma once

#include <dalembert/controller.h>
#include <dalembert/plant.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <dalembert/recording.hpp>
#include <dalembert/sampled_input.hpp>
#include <dalembert/sensitivities/varied.hpp>
#include <dalembert/status.hpp>

namespace dalembert {

/// "m/kg", "rad/(kg*m^2)", "1/s"
inline std::string quotient_of_units(const std::string& unit, const std::string& by) {
    const bool is_compound = by.find_first_of("*/ ") != std::string::npos;
    const std::string below = is_compound ? "(" + by + ")" : by;
    if (by.empty() || by == "1") return unit;
    return (unit.empty() ? "1" : unit) + "/" + below;
}

/// A state as the model calls it; what is integrated as its root is recorded as itself.
struct RecordedState {
    std::string name, unit;
    std::size_t place;  ///< in x
    bool is_root;
};

/// What a run is differentiated by.
struct VariedOfRun {
    Varied what;
    std::string name, unit;
    std::vector<double> start;   ///< the derivatives of PlantRun::start by it
    std::vector<double> kinks;   ///< and of PlantRun::kinks
};

/// A controller in a run.
struct ControllerOfRun {
    const dalembert_controller* table = nullptr;  ///< of a loaded library
    std::string name;                        ///< of its sampler
    std::vector<double> parameters;          ///< in SI, in the order of its table
    double period, first, delay;             ///< s
    std::vector<std::size_t> measures;       ///< for each of its inputs, the output of the plant that it is
    std::vector<std::size_t> outputs, sets;  ///< its output, and the input of the plant that it sets
};

/// What is to be run. Numbers are in SI; parameters and inputs in the order of the tables of the plant.
struct PlantRun {
    std::vector<double> parameters;        ///< behind them, where inputs were measured, the delay of each input
    std::vector<double> start = {};        ///< of the states at `places` in x; all others begin as the plant says
    std::vector<std::size_t> places = {};
    std::vector<double> held_inputs = {};  ///< of a plant that was compiled without inputs; empty: zero
    std::vector<RecordedState> states = {};
    std::string method = "automatic";
    double tolerance = 1e-9;
    double step = 0;   ///< s; 0: chosen by the method
    double until = 0;  ///< s
    std::size_t intervals = 500;
    std::vector<double> output_times = {};  ///< s, rising, within the run; where there are any, `intervals` is for the longest step alone
    std::vector<SampledInput> sampled = {};
    std::vector<double> kinks = {};  ///< s, at known times
    std::size_t max_steps = 100000000;  ///< as IntegrationOptions says
    double seen_step = 0;            ///< s, within which nothing comes and goes; may be infinite
    bool keeps_all = true;           ///< else only the last row
    std::function<void(const Recording&)> see_row = {};  ///< the last of the recording, as each comes, also where they are not kept
    bool asks_outputs = true, asks_energies = true;  ///< else both are NaN in the recording, and energy_error, too
    std::vector<VariedOfRun> varied = {};  ///< derivatives are recorded of plants that have those by parameters
    bool inputs_of_time_alone = false;  ///< they follow neither the state nor what is varied
    std::vector<ControllerOfRun> controllers = {};  ///< that sample, in the order in which they do where instants agree
    bool is_for_fit = false;         ///< energies and the error of derivatives are not asked for: as fast as it can be
    bool is_of_heat = false;         ///< the largest step of the explicit Euler method is asked for
};

struct EventOfRun {
    double t;  ///< s
    std::size_t event, from;
    std::optional<std::size_t> to;  ///< nothing where it ended the run
};

struct PlantRunResult {
    Outcome outcome;
    Recording recording;          ///< in SI: time, states, outputs, inputs, energies; where it switches the mode, a number
    std::vector<EventOfRun> events;
    double energy_error = 0;      ///< max |E - E(0) - work| / max(T + |V| + |internal energy|)
    double euler_step = 0;        ///< s
    Recording sensitivities;      ///< time, and d(state or output)/d(varied), in SI; up to where they exist
    Outcome of_sensitivities;     ///< with Status::not_finite and an event or kink as the guard, that one only touches zero
    // Of what switches.
    double lost = 0;              ///< J, at events
    std::size_t mode = 0;         ///< in which it ended
    std::string message;          ///< how it ended, for people
};

/// Makes the run. A method that does not exist is Status::bad_options.
PlantRunResult simulate_plant(const dalembert_plant& plant, const PlantRun& run);

}  // namespace dalembert
