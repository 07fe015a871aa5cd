// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivities of runs beside extrapolated differences of runs with parameters that are moved. The quick tier takes some machines, the
// full tier every run of every model. With DALEMBERT_TABLE=1 a table is printed; DALEMBERT_MODELS names other models.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include <dalembert/sensitivities/extrapolation.hpp>

#include "elements/runs.hpp"
#include "model_files.hpp"
#include "plant/sensitivities_together.hpp"
#include "run/run_preparation.hpp"
#include "run/simulation.hpp"

using namespace dalembert;

namespace {

const bool is_full = std::getenv("DALEMBERT_FULL") != nullptr;
const double tolerance = is_full ? 1e-12 : 1e-10;
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

constexpr std::size_t parts = 7, points_of_part = 10;
constexpr std::size_t most_compared = 12;  ///< parameters of a run

/// The same run recorded at some times. Steps end at those that are compared: what lies within a step is not as accurate.
PlantRun recorded_where_steps_end(PlantRun run) {
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
std::vector<std::vector<Derivative>> by_differences(const dalembert_plant& plant, const PlantRun& run, const VariedOfRun& varied,
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
double size_of(const Recording& recording, std::size_t column) {
    double largest = 1e-6;
    for (std::size_t other = 1; other < recording.columns.size(); ++other) {
        if (recording.columns[other].unit != recording.columns[column].unit) continue;
        for (const auto& row : recording.rows) largest = std::max(largest, std::fabs(row[other]) * (other == column ? 1 : 1e-3));
    }
    return largest;
}

Row compare(const dalembert_plant& plant, const PlantRun& run, const PlantRunResult& result, std::size_t c) {
    const VariedOfRun& varied = run.varied[c];
    const std::size_t count = run.states.size() + plant.outputs;
    const double value = varied.what.of == Varied::Of::parameter ? run.parameters[varied.what.number] : 0;
    const double size = value != 0 ? std::fabs(value) : 1;
    const auto differences = by_differences(plant, run, varied, size, count);
    Row row;
    row.by = varied.name;
    for (std::size_t i = 0; i < count; ++i) {
        const double largest = size_of(result.recording, i + 1);
        for (std::size_t r = 1; r < differences.size(); ++r) {
            const auto& [expected, doubt] = differences[r][i];
            const std::vector<double>& all = result.sensitivities.rows[r * points_of_part];
            // On an event derivatives are those of one side, and differences the mean of both.
            const auto is_there = [&](const EventOfRun& event) { return std::fabs(event.t - all[0]) < 1e-9 * run.until; };
            if (std::any_of(result.events.begin(), result.events.end(), is_there)) continue;
            const double found = all[1 + c * count + i];
            double scale = std::max(std::fabs(expected), largest / size);
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

/// Both are errors of runs; that of differences is told by themselves.
constexpr double allowed(const Row& row) { return 3e-8 + 30 * row.noise; }

/// Calls check(name, stem, plant, run) for each run of these models, or of all in the full tier, that is varied by all of its parameters.
template <class Check>
void for_each_run(const std::vector<std::string>& models, const Check& check) {
    for (const std::filesystem::path& file : model_files(models, is_full)) {
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
                check(name, file.stem().string(), library.table(), prepared.run);
            } catch (const Failure& failure) {
                if (prints) std::cout << name << ": " << failure.what() << "\n";  // runs that the program refuses
            }
        }
    }
}

}  // namespace

TEST_CASE("sensitivities of runs are those of differences") {
    std::size_t compared = 0, sharply = 0;
    for_each_run({"bouncing_ball", "cylinder_stops", "switched_tank"}, [&](const std::string& name, const std::string& stem,
                                                                           const dalembert_plant& plant, const PlantRun& given) {
        const PlantRun run = recorded_where_steps_end(given);
        const PlantRunResult result = simulate_plant(plant, run);
        if (result.outcome.status != Status::success) return;
        const Outcome& outcome = result.of_sensitivities;
        if (prints && outcome.status != Status::success)
            std::cout << fmt::format("{}: {} at {} s, guard {}\n", name, to_string(outcome.status), outcome.t, outcome.guard);
        // A flow like a root has no derivative at equal pressures, where it may begin or stay, or which it may pass often. What
        // moves a singular position away has none behind it.
        const bool is_known = (outcome.status == Status::not_finite && outcome.t == 0) || outcome.status == Status::singular_position ||
                              outcome.status == Status::too_many_steps || outcome.status == Status::event_storm;
        CHECK((outcome.status == Status::success || is_known));
        if (outcome.status != Status::success) return;
        // Every second of few; of many, which differences take hours for, a few.
        const std::size_t every = std::max<std::size_t>(is_full ? 2 : 3, (run.varied.size() + most_compared - 1) / most_compared);
        for (std::size_t c = 0; c < run.varied.size(); c += every) {
            const Row row = compare(plant, run, result, c);
            CAPTURE(row.by);
            CAPTURE(row.of);
            CAPTURE(row.expected);
            CAPTURE(row.found);
            CAPTURE(row.noise);
            if (prints)
                std::cout << fmt::format("{:40} d({})/d({}): {:.9g}, differences {:.9g}; {:.1e}, of these {:.1e}\n", name, row.of, row.by,
                                         row.found, row.expected, row.error, row.noise);
            // Its momentum stays, while the derivatives of attitude and spin that it is made of grow.
            // The other one goes through singular positions, which cost digits.
            const double cancels = stem == "free_body" ? 100 : stem == "four_bars_2" ? 10 : 1;
            CHECK(row.error <= cancels * allowed(row));
            compared += row.compared;
            sharply += row.sharply;
        }
    });
    if (prints) std::cout << fmt::format("{} compared, {} of them with nine digits\n", compared, sharply);
    CHECK(sharply >= 100);
}

TEST_CASE("what a fit integrates is the run with its derivatives") {
    std::size_t compared = 0;
    for_each_run({"valve_cylinder", "torricelli"}, [&](const std::string& name, const std::string&, const dalembert_plant& plant,
                                                       const PlantRun& given) {
        PlantRun run = given;
        run.output_times.clear();
        for (int k = 1; k < 50; ++k) run.output_times.push_back(run.until * k / 50);
        if (!can_simulate_together(plant, run)) return;
        const PlantRunResult beside = simulate_plant(plant, run);
        if (beside.outcome.status != Status::success || beside.of_sensitivities.status != Status::success) return;
        run.is_for_fit = true;
        const PlantRunResult together = simulate_together(plant, run);
        CHECK(together.outcome.status == Status::success);
        const auto check_same = [&](const Recording& a, const Recording& b, const auto& least_size, double allowed) {
            REQUIRE(a.rows.size() == b.rows.size());
            for (std::size_t i = 0; i < a.columns.size(); ++i) {
                double error = 0, size = least_size(i);
                for (std::size_t r = 0; r < a.rows.size(); ++r) {
                    error = std::max(error, std::fabs(a.rows[r][i] - b.rows[r][i]));
                    size = std::max(size, std::fabs(b.rows[r][i]));
                }
                CAPTURE(a.columns[i].name);
                CHECK(error <= allowed * size);
                if (prints && error > allowed / 100 * size)
                    std::cout << fmt::format("{:40} {}: {:.1e} of {:.1e}\n", name, a.columns[i].name, error, size);
                ++compared;
            }
        };
        check_same(together.recording, beside.recording, [&](std::size_t i) { return size_of(beside.recording, i); }, 1e-6);
        // One that is zero but for rounding counts as a state does by its parameter.
        const std::size_t count = run.states.size() + plant.outputs;
        const auto size_by = [&](std::size_t i) {
            if (i == 0) return run.until;
            const Varied& what = run.varied[(i - 1) / count].what;
            const double value = what.of == Varied::Of::parameter ? run.parameters[what.number] : 0;
            return size_of(beside.recording, (i - 1) % count + 1) / (value != 0 ? std::fabs(value) : 1);
        };
        // Errors of S do not limit the steps of a fit.
        check_same(together.sensitivities, beside.sensitivities, size_by, is_full ? 1e-4 : 1e-6);
    });
    CHECK(compared > 50);
}

TEST_CASE("a plant knows how the inputs of its run follow the state and the parameters") {
    std::size_t compared = 0;
    for_each_run({"inputs_at_large_angles", "kinks_of_functions", "curve_of_time"}, [&](const std::string&, const std::string&,
                                                                                       const dalembert_plant& plant, const PlantRun& run) {
        if (plant.inputs_of_run == nullptr) return;
        const bool knows_slopes = plant.input_slopes != nullptr;
        REQUIRE(knows_slopes);
        const std::unique_ptr<void, void (*)(void*)> self(plant.create(), plant.destroy);
        const std::size_t n = plant.states, m = plant.inputs;
        std::vector<double> x = run.start, p = run.parameters, columns((n + plant.parameters) * m);
        const double t = 0.37 * run.until;
        for (std::size_t i = 0; i < n; ++i) x[i] += 0.01 * std::sin(1.0 + static_cast<double>(i));
        plant.set_parameters(self.get(), p.data());
        plant.input_slopes(self.get(), x.data(), t, columns.data());
        for (std::size_t c = 0; c < n + plant.parameters; ++c) {
            double& moved = c < n ? x[c] : p[c - n];
            const double now = moved, step = 1e-4 * (now == 0 ? 1 : std::fabs(now));
            std::vector<std::vector<double>> sides;
            for (const int times : {-2, -1, 1, 2}) {
                moved = now + times * step;
                plant.set_parameters(self.get(), p.data());
                sides.emplace_back(m);
                plant.inputs_of_run(self.get(), x.data(), t, sides.back().data());
            }
            moved = now;
            for (std::size_t j = 0; j < m; ++j) {
                const double found = columns[c * m + j], near = (sides[2][j] - sides[1][j]) / (2 * step),
                             far = (sides[3][j] - sides[0][j]) / (4 * step), expected = (4 * near - far) / 3;
                double size = 1e-3 * std::fabs(expected);
                for (const auto& side : sides) size = std::max(size, std::fabs(side[j]) / std::max(1.0, std::fabs(now)));
                CAPTURE(c);
                CAPTURE(found);
                CAPTURE(expected);
                CHECK(std::fabs(found - expected) <= 1e-6 * size + 10 * std::fabs(near - far));
                compared += found != 0;
            }
        }
    });
    CHECK(compared >= 5);
}

TEST_CASE("derivatives after many turns are those after none") {
    const double turn = 2 * 3.14159265358979323846;
    const auto ends = [](double start) {
        Diagnostics diagnostics;
        Options options;
        options.sensitivities = {"J", "M", "w_0"};
        options.tolerance = tolerance;
        options.parameters = {fmt::format("phi_0={:.17g}", start)};
        const auto model = load(std::filesystem::path(SOURCE_DIR) / "tests/regressions/inputs_at_large_angles.toml", diagnostics);
        const PreparedSimulation prepared = prepare_simulation(model, "", options);
        const PlantLibrary library(prepared.plant, prepared.cache);
        return simulate_plant(library.table(), prepared.run).sensitivities.rows.back();
    };
    const std::vector<double> few = ends(0.7), many = ends(0.7 + 20000 * turn);
    for (std::size_t i = 1; i < few.size(); ++i) CHECK(many[i] == doctest::Approx(few[i]).epsilon(1e-7));
}

TEST_CASE("the header that a run leaves behind has derivatives by all parameters") {
    const auto text = [](const char* by) {
        Diagnostics diagnostics;
        Options options;
        options.sensitivities = {by};
        const auto model = load(std::filesystem::path(SOURCE_DIR) / "systems/mechanics/cart_pendulum.toml", diagnostics);
        return prepare_simulation(model, "", options).plant.header;
    };
    const std::string header = text("d_R");
    CHECK(header == text("m_W"));
    CHECK(header == text("phi"));
}

TEST_CASE("a fit does not run on beyond the end of the model") {
    Diagnostics diagnostics;
    Options options;
    options.sensitivities = {"d_k"};
    options.run = "step";
    const auto model = load(std::filesystem::path(SOURCE_DIR) / "systems/hydraulics/valve_cylinder.toml", diagnostics);
    const PreparedSimulation prepared = prepare_simulation(model, "", options);
    const PlantLibrary library(prepared.plant, prepared.cache);
    PlantRun run = prepared.run;
    run.until *= 40;  // the piston reaches the end of the cylinder
    run.output_times = {run.until / 2};
    const PlantRunResult beside = simulate_plant(library.table(), run);
    REQUIRE(beside.outcome.status == Status::event);
    run.is_for_fit = true;
    REQUIRE(can_simulate_together(library.table(), run));
    CHECK(simulate_together(library.table(), run).outcome.status == Status::event);
    const PlantRunResult fitted = simulate_plant(library.table(), run);
    CHECK(fitted.outcome.status == Status::event);
    CHECK(std::fabs(fitted.outcome.t - beside.outcome.t) < 1e-6 * beside.outcome.t);
}

TEST_CASE("a later blow moves a block as far: slopes of its times have all digits") {
    Diagnostics diagnostics;
    Options options;
    options.sensitivities = {"t_p"};
    options.tolerance = tolerance;
    const auto model = load(std::filesystem::path(SOURCE_DIR) / "tests/regressions/kinks_blow_and_friction.toml", diagnostics);
    const PreparedSimulation prepared = prepare_simulation(model, "", options);
    for (const double slope : prepared.run.varied.front().kinks) CHECK(std::fabs(slope - 1) < 1e-11);
    const PlantLibrary library(prepared.plant, prepared.cache);
    const PlantRunResult result = simulate_plant(library.table(), prepared.run);
    CHECK(std::fabs(result.sensitivities.rows.back()[1]) < 3e-9);  // of 0.999 m/s while it slides
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
    const auto model = load(std::filesystem::path(SOURCE_DIR) / "tests/regressions/kinks_of_functions.toml", diagnostics);
    const PreparedSimulation prepared = prepare_simulation(model, "", options);
    const PlantLibrary library(prepared.plant, prepared.cache);
    const PlantRun run = recorded_where_steps_end(prepared.run);
    const PlantRunResult result = simulate_plant(library.table(), run);
    REQUIRE(result.of_sensitivities.status == Status::success);
    const Row row = compare(library.table(), run, result, 0);
    CAPTURE(row.of);
    CHECK(row.compared >= 30);
    CHECK(row.error <= allowed(row));
    const double tau = 1.013;
    const std::vector<double>& end = result.sensitivities.rows.back();
    CHECK(end[1] == doctest::Approx(-1 / (tau * tau)));  // x = 3/4 + t/(2 tau)
    CHECK(end[6] == doctest::Approx(-2 / (tau * tau)));  // late = t/tau - 3/2
}

TEST_CASE("constraints that follow from others, that depend on each other at some positions, or that have kinks") {
    using Names = std::vector<std::string>;
    const std::pair<const char*, Names> models[] = {
        {"three_uprights", {"g", "l", "m"}}, {"flat_parallelogram", {"g", "l", "m"}}, {"cam_follower", {"J", "c"}}};
    for (const auto& [name, by] : models) {
        CAPTURE(name);
        Diagnostics diagnostics;
        Options options;
        options.sensitivities = by;
        options.tolerance = tolerance;
        const auto model = load(std::filesystem::path(SOURCE_DIR) / "tests/regressions" / (std::string(name) + ".toml"), diagnostics);
        const PreparedSimulation prepared = prepare_simulation(model, "", options);
        const PlantLibrary library(prepared.plant, prepared.cache);
        const PlantRun run = recorded_where_steps_end(prepared.run);
        const PlantRunResult result = simulate_plant(library.table(), run);
        REQUIRE(result.of_sensitivities.status == Status::success);
        for (std::size_t c = 0; c < run.varied.size(); ++c) {
            const Row row = compare(library.table(), run, result, c);
            CAPTURE(row.by);
            CAPTURE(row.of);
            CAPTURE(row.expected);
            CAPTURE(row.found);
            CAPTURE(row.noise);
            CHECK(row.compared >= 10);
            CHECK(row.error <= allowed(row));
        }
    }
}

TEST_CASE("second derivatives of a ball along its run") {
    Diagnostics diagnostics;
    Options options;
    options.sensitivities = {"g", "h_0"};
    options.second_order = true;
    options.until = "1.5";
    options.samples = 30;
    const auto model = load(std::filesystem::path(SOURCE_DIR) / "systems/mechanics/bouncing_ball.toml", diagnostics);
    const PreparedSimulation prepared = prepare_simulation(model, "", options);
    const PlantLibrary library(prepared.plant, prepared.cache);
    const PlantRunResult result = simulate_plant(library.table(), prepared.run);
    const SecondOrder second = second_order_of(library.table(), prepared.run.varied, result, prepared.moved);
    CHECK(second.recording.columns[1].name == "d2(h)/(d(g)d(g))");
    CHECK(second.numbers > 9 * second.left_out);
    CHECK(second.doubt <= 1e-6);
    const double e = 0.8, g = 9.81, h = 1.8, impact = std::sqrt(2 * h / g), fall = std::sqrt(2 * g * h);
    const std::size_t count = (second.recording.columns.size() - 1) / 3;
    for (const std::vector<double>& row : second.recording.rows) {
        const double t = row[0];
        const double behind[] = {-(1 + e) * t * fall / (4 * g * g), (1 + e) * t / (2 * fall), -(1 + e) * t * fall / (4 * h * h)};
        for (std::size_t pair = 0; pair < 3; ++pair) {
            const double found = row[1 + pair * count], expected = t < impact ? 0 : behind[pair];
            if (!std::isnan(found)) CHECK(std::fabs(found - expected) <= 1e-7);
        }
    }
}
