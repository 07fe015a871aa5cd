// SPDX-License-Identifier: GPL-3.0-or-later
// A model to fit, with data that are exact.
#pragma once

#include <fmt/format.h>

#include <fstream>

#include "identify/fit_run.hpp"
#include "run/simulation.hpp"
#include "text/process.hpp"

namespace dalembert {

inline DataFile data(const std::string& text) { return parse_data(std::make_shared<const Source>("run.csv", text)); }

inline std::vector<DataFile> files_of(const std::string& text) { return {data(text)}; }

inline std::string problem_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::exception& failure) {
        return failure.what();
    }
    return "";
}
inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A mass on a spring, which an input drives.
inline const char* const oscillator = R"toml(
[model]
format = 1
name   = "oscillator"
[parameters]
m = { value = 2, unit = "kg", range = [0.1, 100] }
c = { value = 50, unit = "N/m", range = [0, 1000] }
d = { value = 1, unit = "N*s/m", range = [0, 100] }
x_0 = { value = 0.1, unit = "m" }
[coordinates]
x = { unit = "mm", start = "x_0" }
[inputs]
f = { unit = "N" }
[bodies.mass]
mass = "m"
position = ["x", 0, 0]
[springs.wall]
elongation = "x"
stiffness = "c"
[dampers.wall]
rate = "dot(x)"
coefficient = "d"
[forces.drive]
on = "mass"
force = ["f", 0, 0]
[outputs]
twice = { value = "2*x", unit = "m" }
[measurements.x]
column = "encoder 1"
unit = "cm"
noise = "0.1 mm"
[measurements.drive]
quantity = "f"
column = "current"
hold = true
[runs.reference]
until = 4
)toml";

inline std::shared_ptr<const LoadedModel> model_of(const ScratchFolder& folder, const std::string& text) {
    const std::string file = (std::filesystem::path(folder.path()) / "oscillator.toml").string();
    std::ofstream(file) << text;
    Diagnostics diagnostics;
    return load(file, diagnostics);
}

/// x of the oscillator for a step of the force at 0.5 s + delay, exactly sampled.
inline std::string data_of_step(const std::shared_ptr<const LoadedModel>& model, double delay, const std::string& parameters,
                         bool has_input = true) {
    Options options;
    options.no_plot = true;
    options.parameters = {parameters};
    options.inputs = {fmt::format("f=if(t - {} < 0, 0, 3)", 0.5 + delay)};
    options.samples = 200;
    options.tolerance = 1e-11;
    const PreparedSimulation prepared = prepare_simulation(model, "", options);
    const PlantRunResult made = simulate_plant(PlantLibrary(prepared.plant, PlantCache::used).table(), prepared.run);
    std::string text = has_input ? "t,encoder 1,current\n" : "t,encoder 1\n";
    for (const auto& row : made.recording.rows)
        text += fmt::format("{},{}{}\n", row[0], 100 * row[made.recording.find("x")], has_input ? row[0] < 0.5 ? ",0" : ",3" : "");
    return text;
}

}  // namespace dalembert
