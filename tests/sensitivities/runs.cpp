// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivities of runs beside differences of runs with parameters that are moved. The quick tier takes some machines, the full tier every
// run of every model. With DALEMBERT_TABLE=1 a table is printed; DALEMBERT_MODELS names other models.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "elements/runs.hpp"
#include "model_files.hpp"
#include "run/run_preparation.hpp"
#include "run/simulation.hpp"

using namespace dalembert;

namespace {

constexpr double tolerance = 1e-11;
const bool is_full = std::getenv("DALEMBERT_FULL") != nullptr;
const bool prints = std::getenv("DALEMBERT_TABLE") != nullptr;

/// The same run with one that is varied moved by so much.
PlantRun moved(const PlantRun& run, const VariedOfRun& varied, double by) {
    PlantRun other = run;
    other.varied.clear();
    if (varied.what.of == Varied::Of::parameter) other.parameters[varied.what.number] += by;
    for (std::size_t i = 0; i < other.start.size(); ++i) other.start[i] += by * varied.start[i];
    for (std::size_t i = 0; i < other.kinks.size(); ++i) other.kinks[i] += by * varied.kinks[i];
    return other;
}

/// Which rows of a recording are compared.
std::vector<std::size_t> compared_rows(std::size_t count) {
    constexpr std::size_t parts = 7;
    std::vector<std::size_t> rows;
    for (std::size_t k = 1; k <= parts; ++k) rows.push_back((count - 1) * k / parts);
    return rows;
}

/// Differences of order four: states and outputs, of each row that is compared.
std::vector<std::vector<double>> by_differences(const dalembert_plant& plant, const PlantRun& run, const VariedOfRun& varied, double step,
                                                std::size_t count) {
    const std::vector<std::size_t> rows = compared_rows(run.intervals + 1);
    std::vector<std::vector<double>> sum(rows.size(), std::vector<double>(count, 0));
    for (const auto& [steps, weight] : {std::pair(1, 8), std::pair(2, -1)})
        for (const int sign : {1, -1}) {
            const PlantRunResult result = simulate_plant(plant, moved(run, varied, sign * steps * step));
            const bool is_whole = result.recording.rows.size() == run.intervals + 1;
            for (std::size_t r = 0; r < rows.size(); ++r)
                for (std::size_t i = 0; i < count; ++i)
                    sum[r][i] += is_whole ? sign * weight * result.recording.rows[rows[r]][i + 1] / (12 * step) : NAN;
        }
    return sum;
}

struct Row {
    std::string name, by, of;
    double expected = 0, found = 0, error = 0, noise = 0;
    std::size_t compared = 0;
};

Row compare(const dalembert_plant& plant, const PlantRun& run, const PlantRunResult& result, std::size_t c) {
    const VariedOfRun& varied = run.varied[c];
    const std::size_t count = run.states.size() + plant.outputs;
    const double value = varied.what.of == Varied::Of::parameter ? run.parameters[varied.what.number] : 0;
    const double size = value != 0 ? std::fabs(value) : 1;
    const auto coarse = by_differences(plant, run, varied, 2e-4 * size, count),
               fine = by_differences(plant, run, varied, 1e-4 * size, count);
    const std::vector<std::size_t> rows = compared_rows(run.intervals + 1);
    Row row;
    row.by = varied.name;
    for (std::size_t i = 0; i < count; ++i) {
        double largest = 1e-7;  // what is zero but for rounding
        for (const auto& point : result.recording.rows) largest = std::max(largest, std::fabs(point[i + 1]));
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const double found = result.sensitivities.rows[rows[r]][1 + c * count + i];
            const double scale = std::max(std::fabs(fine[r][i]), largest / size);
            const double error = std::fabs(fine[r][i] - found) / scale, noise = std::fabs(fine[r][i] - coarse[r][i]) / scale;
            if (!(noise < 1e-4)) continue;  // differences tell nothing, as next to an event
            ++row.compared;
            if (row.of.empty() || error > row.error)
                row = {"", varied.name, result.recording.columns[i + 1].name, fine[r][i], found, error, noise, row.compared};
        }
    }
    return row;
}

}  // namespace

TEST_CASE("sensitivities of runs are those of differences") {
    std::size_t compared = 0;
    for (const std::filesystem::path& file : model_files({"bouncing_ball", "cylinder_stops", "switched_tank"}, is_full)) {
        const auto model = loaded_if_good(file);
        if (model == nullptr) continue;
        for (const Run& wanted : model->model.runs) {
            Options options;
            options.run = wanted.name;
            options.tolerance = tolerance;
            options.no_plot = true;
            const std::string name = fmt::format("{} {} {}", file.stem().string(), wanted.scene, wanted.name);
            CAPTURE(name);
            try {
                {
                    const Machine machine = derive_machine(model, RunPreparation(model->model, options).scene(""), {});
                    for (const Variable& p : machine.system->symbols.all(SymbolKind::parameter)) options.sensitivities.push_back(p.name);
                }
                if (options.sensitivities.empty()) continue;
                const PreparedSimulation prepared = prepare_simulation(model, "", options);
                const PlantLibrary library(prepared.plant, prepared.cache);
                if (library.table().constraint_rank > 0) continue;
                const PlantRunResult result = simulate_plant(library.table(), prepared.run);
                if (result.outcome.status != Status::success) continue;
                const Outcome& outcome = result.of_sensitivities;
                if (prints && outcome.status != Status::success)
                    std::cout << fmt::format("{}: {} at {} s, guard {}\n", name, to_string(outcome.status), outcome.t, outcome.guard);
                // A flow like a root has no derivative at equal pressures, where it may begin or stay; and S does not step over
                // singular positions.
                const bool is_known = (outcome.status == Status::not_finite && outcome.t == 0) ||
                                      (outcome.status == Status::step_too_small && library.table().constraints > 0) ||
                                      outcome.status == Status::too_many_steps;
                CHECK((outcome.status == Status::success || is_known));
                if (outcome.status != Status::success) continue;
                for (std::size_t c = 0; c < prepared.run.varied.size(); c += is_full ? 2 : 3) {
                    const Row row = compare(library.table(), prepared.run, result, c);
                    CAPTURE(row.by);
                    CAPTURE(row.of);
                    CAPTURE(row.expected);
                    CAPTURE(row.found);
                    CAPTURE(row.noise);
                    if (prints)
                        std::cout << fmt::format("{:40} d({})/d({}): {:.9g}, differences {:.9g}; {:.1e}, of these {:.1e}\n", name, row.of,
                                                 row.by, row.found, row.expected, row.error, row.noise);
                    CHECK(row.error <= 1e-6 + 30 * row.noise);
                    compared += row.compared;
                }
            } catch (const Failure& failure) {
                if (prints) std::cout << name << ": " << failure.what() << "\n";  // runs that the program refuses
            }
        }
    }
    CHECK(compared >= 100);
}

TEST_CASE("what has no derivative is refused") {
    const auto refusal = [](const char* file, const char* scene, const char* name) -> std::string {
        Diagnostics diagnostics;
        Options options;
        options.sensitivities = {name};
        try {
            prepare_simulation(load(std::filesystem::path(SOURCE_DIR) / file, diagnostics), scene, options);
            return "";
        } catch (const Failure& failure) {
            return failure.diagnostics().front().message;
        }
    };
    CHECK(refusal("systems/mechanics/four_bar.toml", "", "alpha") == "");
    CHECK(refusal("systems/mechanics/four_bar.toml", "", "beta") == "the start of 'beta' cannot be varied: constraints determine it");
    CHECK(refusal("systems/mechanics/heavy_top.toml", "attitude", "e_1").find("a part of a quaternion") != std::string::npos);
    // A jump of `ons` and a pulse of `blows` fall together at 1.5 s; tau moves the one, T and width the other.
    CHECK(refusal("tests/regressions/kinks_of_functions.toml", "", "tau").find("some fall together") != std::string::npos);
    CHECK(refusal("tests/regressions/kinks_of_functions.toml", "", "width") == "");
}

TEST_CASE("rates that jump where the state and the time say so, at once") {
    Diagnostics diagnostics;
    Options options;
    options.parameters = {"tau=1.013"};  // at 1 the pulses come in between
    options.sensitivities = {"tau"};
    options.tolerance = tolerance;
    options.samples = 50;
    const auto model = load(std::filesystem::path(SOURCE_DIR) / "tests/regressions/kinks_of_functions.toml", diagnostics);
    const PreparedSimulation prepared = prepare_simulation(model, "", options);
    const PlantLibrary library(prepared.plant, prepared.cache);
    const PlantRunResult result = simulate_plant(library.table(), prepared.run);
    CHECK(result.of_sensitivities.status == Status::success);
    const Row row = compare(library.table(), prepared.run, result, 0);
    CAPTURE(row.of);
    CHECK(row.compared >= 30);
    CHECK(row.error <= 1e-6 + 30 * row.noise);
    const double tau = 1.013;
    const std::vector<double>& end = result.sensitivities.rows.back();
    CHECK(end[1] == doctest::Approx(-1 / (tau * tau)));  // x = 3/4 + t/(2 tau)
    CHECK(end[6] == doctest::Approx(-2 / (tau * tau)));  // late = t/tau - 3/2
}
