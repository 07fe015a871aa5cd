// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivities of a run beside extrapolated differences of runs with parameters that are moved.
#pragma once

#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>

#include <dalembert/sensitivities/extrapolation.hpp>

#include "elements/runs.hpp"
#include "model_files.hpp"
#include "plant/sensitivities_together.hpp"
#include "run/run_preparation.hpp"
#include "run/simulation.hpp"

namespace dalembert {

inline const bool is_full = std::getenv("DALEMBERT_FULL") != nullptr;
inline const double tolerance = is_full ? 1e-12 : 1e-10;
/// What steep friction, or heat between close points, multiplies errors of runs by leaves differences fewer digits.
inline double tolerance_of(const std::string& stem) { return is_full && (stem == "stick_slip" || stem == "block") ? 1e-13 : tolerance; }
inline const bool prints = std::getenv("DALEMBERT_TABLE") != nullptr;

/// The same run with one that is varied moved by so much.
inline PlantRun moved(const PlantRun& run, const VariedOfRun& varied, double by) {
    PlantRun other = run;
    other.varied.clear();
    if (varied.what.of == Varied::Of::parameter) other.parameters[varied.what.number] += by;
    for (std::size_t i = 0; i < other.start.size(); ++i) other.start[i] += by * varied.start[i];
    for (std::size_t i = 0; i < other.kinks.size(); ++i) other.kinks[i] += by * varied.kinks[i];
    return other;
}

inline constexpr std::size_t parts = 7, points_of_part = 10;
inline constexpr std::size_t most_compared = 12;  ///< parameters of a run

/// The same run recorded at some times. Steps end at those that are compared: what lies within a step is not as accurate.
inline PlantRun recorded_where_steps_end(PlantRun run) {
    for (std::size_t k = 1; k < parts * points_of_part; ++k) {
        const double t = run.until * static_cast<double>(k) / (parts * points_of_part);
        run.output_times.push_back(t);
        if (k % points_of_part != 0) continue;
        const auto place = std::lower_bound(run.kinks.begin(), run.kinks.end(), t) - run.kinks.begin();
        run.kinks.insert(run.kinks.begin() + place, t);
        for (VariedOfRun& one : run.varied) one.kinks.insert(one.kinks.begin() + place, 0);
    }
    return run;
}

using Derivative = detail::Extrapolated<double>;

/// States and outputs by one that is varied, of each row that is compared.
inline std::vector<std::vector<Derivative>> by_differences(const dalembert_plant& plant, const PlantRun& run, const VariedOfRun& varied,
                                                    double size, std::size_t count) {
    constexpr std::size_t levels = detail::steps_of_extrapolation;
    const std::size_t rows = parts + 1;
    std::vector<std::vector<std::array<double, levels>>> differences(rows, std::vector<std::array<double, levels>>(count));
    double step = size * detail::longest_step_of_extrapolation;
    for (std::size_t level = 0; level < levels; ++level, step /= 2) {
        const PlantRunResult ahead = simulate_plant(plant, moved(run, varied, step)),
                             behind = simulate_plant(plant, moved(run, varied, -step));
        const auto at = [&](const PlantRunResult& result, std::size_t row, std::size_t i) {
            const std::size_t number = row * points_of_part;
            return number < result.recording.rows.size() ? result.recording.rows[number][i + 1] : NAN;
        };
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t i = 0; i < count; ++i) differences[r][i][level] = (at(ahead, r, i) - at(behind, r, i)) / (2 * step);
    }
    std::vector<std::vector<Derivative>> result(rows);
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t i = 0; i < count; ++i) result[r].push_back(detail::extrapolated(differences[r][i]));
    return result;
}

struct Row {
    std::string name, by, of;
    double expected = 0, found = 0, error = 0, noise = 0;
    std::size_t compared = 0, sharply = 0;  ///< those where differences have nine digits
};

/// The largest value of a column. One that is zero but for rounding is as large as a thousandth of others with its unit.
inline double size_of(const Recording& recording, std::size_t column) {
    double largest = 1e-6;
    for (std::size_t other = 1; other < recording.columns.size(); ++other) {
        if (recording.columns[other].unit != recording.columns[column].unit) continue;
        for (const auto& row : recording.rows) largest = std::max(largest, std::fabs(row[other]) * (other == column ? 1 : 1e-3));
    }
    return largest;
}

inline Row compare(const dalembert_plant& plant, const PlantRun& run, const PlantRunResult& result, std::size_t c) {
    const VariedOfRun& varied = run.varied[c];
    const std::size_t count = run.states.size() + plant.outputs;
    const double value = varied.what.of == Varied::Of::parameter ? run.parameters[varied.what.number] : 0;
    const double size = value != 0 ? std::fabs(value) : 1;
    const auto differences = by_differences(plant, run, varied, size, count);
    Row row;
    row.by = varied.name;
    for (std::size_t i = 0; i < count; ++i) {
        const double largest = size_of(result.recording, i + 1);
        double so_far = 0;  // what swings has no digits of its own where it passes zero
        for (std::size_t r = 1; r < differences.size(); ++r) {
            const auto& [expected, doubt] = differences[r][i];
            const std::vector<double>& all = result.sensitivities.rows[r * points_of_part];
            for (std::size_t k = (r - 1) * points_of_part; k <= r * points_of_part; ++k)
                so_far = std::max(so_far, std::fabs(result.sensitivities.rows[k][1 + c * count + i]));
            // On an event derivatives are those of one side, and differences the mean of both.
            const auto is_there = [&](const EventOfRun& event) { return std::fabs(event.t - all[0]) < 1e-9 * run.until; };
            if (std::any_of(result.events.begin(), result.events.end(), is_there)) continue;
            const double found = all[1 + c * count + i];
            double scale = std::max({std::fabs(expected), so_far, largest / size});
            for (std::size_t j = 0; j < count; ++j)  // as of a speed that stays, of velocities that do not
                if (result.recording.columns[j + 1].unit == result.recording.columns[i + 1].unit)
                    scale = std::max(scale, std::fabs(all[1 + c * count + j]));
            const double error = std::fabs(expected - found) / scale, noise = doubt / scale;
            if (!(noise < 1e-4)) continue;  // differences tell nothing, as next to an event
            ++row.compared;
            row.sharply += noise < 1e-9;
            if (row.of.empty() || error - 30 * noise > row.error - 30 * row.noise) {
                row.of = result.recording.columns[i + 1].name;
                row.expected = expected, row.found = found, row.error = error, row.noise = noise;
            }
        }
    }
    return row;
}

/// Both sides have the errors of runs. Differences tell how large theirs is.
inline double allowed(const Row& row) { return (is_full ? 1e-8 : 3e-8) + 30 * row.noise; }

/// Without parameters that have no derivative, as where a pulse more or less fits into the run: the program refuses them by name.
template <class Model>
PreparedSimulation prepare_for_all(const Model& model, Options& options) {
    while (true) {
        try {
            return prepare_simulation(model, "", options);
        } catch (const Failure& failure) {
            const std::string message = failure.what();
            const auto is_named = [&](const std::string& name) {
                return message.find("no derivative by '" + name + "'") != std::string::npos;
            };
            const auto found = std::find_if(options.sensitivities.begin(), options.sensitivities.end(), is_named);
            if (found == options.sensitivities.end()) throw;
            if (prints) std::cout << "without " << *found << "\n";
            options.sensitivities.erase(found);
        }
    }
}

/// A run of a model of the repository by one of its parameters, with derivatives where steps end.
struct RunOfOne {
    RunOfOne(const char* file, const char* by, const std::vector<std::string>& parameters = {}) {
        Diagnostics diagnostics;
        Options options;
        options.parameters = parameters;
        options.sensitivities = {by};
        options.tolerance = tolerance;
        const auto model = load(std::filesystem::path(SOURCE_DIR) / file, diagnostics);
        const PreparedSimulation prepared = prepare_simulation(model, "", options);
        const PlantLibrary library(prepared.plant, prepared.cache);
        run = recorded_where_steps_end(prepared.run);
        result = simulate_plant(library.table(), run);
        if (result.of_sensitivities.status == Status::success) row = compare(library.table(), run, result, 0);
    }

    PlantRun run;
    PlantRunResult result;
    Row row;  ///< compared with differences
};

/// Calls check(name, stem, plant, run) for each run of these models, or of all in the full tier, that is varied by all of its parameters.
template <class Check>
void for_each_run(const std::vector<std::string>& models, const Check& check) {
    // Levels that come to balance and stay: by some of their parameters it takes minutes until it is known that there is no derivative.
    const std::set<std::string> take_long{"three_tanks", "three_tanks_junction"};
    for (const std::filesystem::path& file : model_files(models, is_full)) {
        if (take_long.contains(file.stem().string())) continue;
        const auto model = loaded_if_good(file);
        if (model == nullptr) continue;
        for (const Run& wanted : model->model.runs) {
            Options options;
            options.run = wanted.name;
            options.tolerance = tolerance_of(file.stem().string());
            options.no_plot = true;
            const std::string name = fmt::format("{} {} {}", file.stem().string(), wanted.scene, wanted.name);
            CAPTURE(name);
            try {
                {
                    const Machine machine = derive_machine(model, RunPreparation(model->model, options).scene(""), {});
                    for (const Variable& p : machine.system->symbols.all(SymbolKind::parameter)) options.sensitivities.push_back(p.name);
                }
                const PreparedSimulation prepared = prepare_for_all(model, options);
                if (options.sensitivities.empty()) continue;
                const PlantLibrary library(prepared.plant, prepared.cache);
                check(name, file.stem().string(), library.table(), prepared.run);
            } catch (const Failure& failure) {
                if (prints) std::cout << name << ": " << failure.what() << "\n";  // runs that the program refuses
            }
        }
    }
}

}  // namespace dalembert
