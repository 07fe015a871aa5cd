// SPDX-License-Identifier: GPL-3.0-or-later
// Runs by the C99 integrators of runtime/export beside those of the program: the same plants, starts and inputs. The quick tier takes some machines, the full
// tier every run of every model. With DALEMBERT_TABLE=1 a table of all rows is printed; DALEMBERT_MODELS names other models.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "elements/runs.hpp"
#include "run/simulation.hpp"
#include "text/diagnostic.hpp"

#include "export/run_in_c.h"

using namespace dalembert;

namespace {

constexpr double tolerance = 1e-10;

std::vector<std::filesystem::path> models() {
    std::vector<std::string> wanted{"cart_pendulum", "stick_slip",   "bouncing_ball", "cylinder_stops", "switched_tank",
                                    "four_bar",      "rolling_disc", "heavy_top",     "heat_conduction", "hydraulic_cylinder"};
    if (const char* named = std::getenv("DALEMBERT_MODELS")) {
        std::istringstream words(named);
        wanted.assign(std::istream_iterator<std::string>(words), {});
    }
    const bool all = std::getenv("DALEMBERT_FULL") != nullptr;
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"mechanics", "hydraulics", "pneumatics", "heat"})
        for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SOURCE_DIR) / "systems" / folder))
            if (entry.path().extension() == ".toml" && (all || std::count(wanted.begin(), wanted.end(), entry.path().stem()) > 0))
                files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

struct Row {
    std::string name;
    std::size_t steps_in_c = 0, steps = 0;
    double difference = 0;  ///< of states at the end, beside the largest that they were
    double of_events = 0;   ///< of times of events, beside the length of the run
    std::string trouble;
};

/// How the program says it.
std::string status_in_c(int status) {
    static const char* const names[] = {"success",       "stopped",       "not finite", "step too small", "too many steps",    "event storm",       "event",
                                        "no start mode", "no mode",       "accumulation", "constraint broken", "singular position", "bad options", "no memory"};
    return names[status];
}

void compare_events(Row& row, const dalembert_plant& plant, const PlantRunResult& result, const made_run& made, double until) {
    std::vector<EventOfRun> events = result.events;
    std::vector<event_in_c> in_c(made.events, made.events + made.event_count);
    if (!events.empty() && !events.back().to) events.pop_back();  // the end is compared by its status
    if (events.size() != in_c.size()) row.trouble += fmt::format(" {} events, {} in C;", events.size(), in_c.size());
    for (std::size_t i = 0; i < std::min(events.size(), in_c.size()); ++i) {
        const double apart = std::fabs(events[i].t - in_c[i].t) / until;
        if (!(apart <= row.of_events)) row.of_events = apart;
        if (events[i].event != in_c[i].event || events[i].from != in_c[i].before || *events[i].to != in_c[i].after) {
            row.trouble += fmt::format(" event {} is '{}' to '{}', in C '{}' to '{}';", i, plant.event_names[events[i].event], plant.mode_names[*events[i].to],
                                       plant.event_names[in_c[i].event], plant.mode_names[in_c[i].after]);
            break;
        }
    }
}

double difference(const PreparedSimulation& prepared, const PlantRunResult& result, const std::vector<double>& x) {
    double largest = 0;
    for (std::size_t i = 0; i < prepared.run.states.size(); ++i) {
        double size = 1e-300;
        for (const auto& recorded : result.recording.rows) size = std::max(size, std::fabs(recorded[i + 1]));
        const RecordedState& state = prepared.run.states[i];
        const double here = state.is_root ? x[state.place] * x[state.place] : x[state.place];
        const double apart = std::fabs(here - result.recording.rows.back()[i + 1]) / std::max(size, 1e-9);
        if (!(apart <= largest)) largest = apart;
    }
    return largest;
}

Row compare(const std::string& name, PreparedSimulation& prepared) {
    Row row{name};
    const PlantLibrary library(prepared.plant, PlantCache::used);
    const dalembert_plant& plant = library.table();
    prepared.run.method = "automatic";
    prepared.run.tolerance = tolerance;
    const PlantRunResult result = simulate_plant(plant, prepared.run);

    void* self = plant.create();
    plant.set_parameters(self, prepared.run.parameters.data());
    std::vector<double> start(plant.states), x(plant.states);
    plant.start_state(self, start.data());
    plant.destroy(self);
    for (std::size_t i = 0; i < prepared.run.start.size(); ++i) start[prepared.run.places[i]] = prepared.run.start[i];
    wished_run wish{};
    wish.plant = &plant;
    wish.parameters = prepared.run.parameters.data();
    wish.start = start.data();
    wish.until = prepared.run.until;
    wish.tolerance = tolerance;
    wish.longest_step = prepared.run.steps_freely ? wish.until : wish.until / static_cast<double>(prepared.run.intervals);
    wish.stops = prepared.run.kinks.data();
    wish.stop_count = prepared.run.kinks.size();
    wish.parts = 1;
    const auto made = std::make_unique<made_run>();
    make_run(&wish, made.get(), x.data());

    row.steps = result.outcome.steps;
    row.steps_in_c = made->steps;
    if (const std::string status = status_in_c(made->status); status != to_string(result.outcome.status))
        row.trouble += fmt::format(" {}, in C {} ({});", to_string(result.outcome.status), status, made->message);
    if (!result.recording.rows.empty()) row.difference = difference(prepared, result, x);
    compare_events(row, plant, result, *made, wish.until);
    if (plant.modes > 0 && made->mode != result.mode) row.trouble += " another mode at the end;";
    if (std::fabs(made->t - result.outcome.t) > 1e-8 * wish.until) row.trouble += fmt::format(" ends at {}, in C at {};", result.outcome.t, made->t);

    // In parts, with its state carried to another run after each of them, bit by bit; and two at a time.
    std::vector<double> in_parts(plant.states), reloaded(plant.states);
    wish.parts = 7;
    make_run(&wish, made.get(), in_parts.data());
    const int status = made->status;
    wish.reloads = 1;
    make_run(&wish, made.get(), reloaded.data());
    if (in_parts != reloaded || status != made->status) row.trouble += " a saved run goes on in another way;";
    if (!make_two_runs(&wish, in_parts.data())) row.trouble += " two runs at a time disturb each other;";
    if (!result.recording.rows.empty()) row.difference = std::max(row.difference, difference(prepared, result, in_parts));
    return row;
}

void print(const std::vector<Row>& rows) {
    std::cout << fmt::format("{:44} {:>8} {:>8} {:>10} {:>10}\n", "model, scene, run", "steps", "in C++", "states", "events");
    for (const Row& row : rows)
        std::cout << fmt::format("{:44} {:8} {:8} {:10.1e} {:10.1e} {}\n", row.name, row.steps_in_c, row.steps, row.difference, row.of_events,
                                 row.trouble.empty() ? "" : row.trouble);
}

}  // namespace

TEST_CASE("runs in C are those of the program") {
    std::vector<Row> rows;
    for (const std::filesystem::path& file : models()) {
        Diagnostics diagnostics;
        const auto model = load(file, diagnostics);
        if (model == nullptr) continue;  // nothing to run, as a catalogue of statics
        for (const Run& run : model->model.runs) {
            Options options;
            options.run = run.name;
            const std::string name = fmt::format("{} {} {}", file.stem().string(), run.scene, run.name);
            try {
                PreparedSimulation prepared = prepare_simulation(model, "", options);
                rows.push_back(compare(name, prepared));
            } catch (const Failure& failure) {
                if (std::getenv("DALEMBERT_TABLE")) std::cout << name << ": " << failure.what() << "\n";
                continue;
            }
            const Row& row = rows.back();
            if (std::getenv("DALEMBERT_TABLE")) print({row});
            CAPTURE(row.name);
            CHECK(row.trouble == "");
            CHECK(row.difference <= 1e-8);
            CHECK(row.of_events <= 1e-8);
        }
    }
    CHECK(rows.size() >= 10);
    if (std::getenv("DALEMBERT_TABLE")) print(rows);
}
