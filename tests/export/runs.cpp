// SPDX-License-Identifier: GPL-3.0-or-later
// Runs by the C99 integrators of runtime/export beside those of the program: the same plants, starts and inputs. The quick tier takes some
// machines, the full tier every run of every model. With DALEMBERT_TABLE=1 a table is printed; DALEMBERT_MODELS names other models.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>

#include <dalembert/methods/dop853_coefficients.hpp>
#include <dalembert/methods/rodas5p_coefficients.hpp>

#include "elements/runs.hpp"
#include "run/simulation.hpp"

#include "export/run_in_c.h"
#include "model_files.hpp"

using namespace dalembert;

namespace {

constexpr double tolerance = 1e-10;
const bool is_full = std::getenv("DALEMBERT_FULL") != nullptr;
const bool prints = std::getenv("DALEMBERT_TABLE") != nullptr;

std::vector<std::filesystem::path> models() {
    return model_files({"cart_pendulum", "stick_slip", "bouncing_ball", "cylinder_stops", "switched_tank", "four_bar", "rolling_disc",
                        "heavy_top", "heat_conduction", "hydraulic_cylinder", "half_bridge", "normal_force_ends_with_phase"},
                       is_full);
}

struct Row {
    std::string name;
    std::size_t steps_in_c = 0, steps = 0, events = 0;
    double states = 0;  ///< largest difference at the end, beside the largest values of the states
    double allowed = 1e-8;
    double times = 0;            ///< of events, beside the length of the run
    double methods = 0;          ///< as `states`, of each method alone
    double dense = 0;            ///< of states within steps
    double exchange_states = 0;  ///< as `states` and `times`, of an importer with simple steps
    double exchange_times = 0;
    std::string trouble, exchange_trouble;
};

/// How the program says it.
std::string status_in_c(int status) {
    static const char* const names[] = {
        "success",       "stopped", "not finite",   "step too small",    "too many steps",    "event storm", "event",
        "no start mode", "no mode", "accumulation", "constraint broken", "singular position", "bad options", "no memory"};
    return names[status];
}

class RunComparison {
public:
    RunComparison(const std::string& name, PreparedSimulation& prepared)
        : prepared_(prepared), library_(prepared.plant, prepared.cache), plant_(library_.table()), row_() {
        row_.name = name;
        prepared.run.method = "automatic";
        prepared.run.tolerance = tolerance;
    }

    Row operator()() {
        result_ = simulate_plant(plant_, prepared_.run);
        const std::vector<double> start = start_state();
        wished_run wish{};
        wish.plant = &plant_;
        wish.parameters = prepared_.run.parameters.data();
        wish.start = start.data();
        wish.until = prepared_.run.until;
        wish.tolerance = tolerance;
        const double part = wish.until / static_cast<double>(prepared_.run.intervals);
        wish.longest_step = std::min(wish.until, std::max(prepared_.run.seen_step, part));
        // A plant that has functions of time finds their changes of sign itself.
        wish.stops = prepared_.run.kinks.data();
        wish.stop_count = plant_.time_switches > 0 ? 0 : prepared_.run.kinks.size();
        wish.parts = 1;
        std::vector<double> x = run(wish);
        row_.steps = result_.outcome.steps;
        row_.events = result_.events.size();
        row_.steps_in_c = made_->steps;
        const bool is_stiff = made_->implicit_steps > 0;  // too much for simple steps
        if (const std::string status = status_in_c(made_->status); status != to_string(result_.outcome.status))
            row_.trouble += fmt::format(" {}, in C {} ({});", to_string(result_.outcome.status), status, made_->message);
        // Where a run uses its steps up is chance: it may stay at a jump.
        if (result_.outcome.status != Status::too_many_steps && std::fabs(made_->t - result_.outcome.t) > 1e-8 * wish.until)
            row_.trouble += fmt::format(" ends at {}, in C at {};", result_.outcome.t, made_->t);
        const bool comes_to_end = result_.outcome.status == Status::success || result_.outcome.status == Status::event;
        if (!comes_to_end) return row_;  // nothing is recorded at its last time
        note(row_.states, difference(x));
        compare_events(row_.times, row_.trouble, wish.until);
        carry(wish);
        if (row_.states > row_.allowed) allow_for_magnified_errors();
        if (!is_full) look_closer(wish);
        if (plant_.modes > 0 && !is_stiff) exchange(wish);
        return row_;
    }

private:
    static void note(double& largest, double value) {
        if (!(value <= largest)) largest = value;
    }

    std::vector<double> start_state() const {
        void* self = plant_.create();
        plant_.set_parameters(self, prepared_.run.parameters.data());
        std::vector<double> start(plant_.states);
        plant_.start_state(self, start.data());
        plant_.destroy(self);
        for (std::size_t i = 0; i < prepared_.run.start.size(); ++i) start[prepared_.run.places[i]] = prepared_.run.start[i];
        return start;
    }

    std::vector<double> run(const wished_run& wish) {
        std::vector<double> x(plant_.states);
        make_run(&wish, made_.get(), x.data());
        return x;
    }

    /// Of the states at the end, as the program recorded them.
    double difference(const std::vector<double>& x) const {
        double largest = 0;
        for (std::size_t i = 0; i < prepared_.run.states.size(); ++i) {
            double size = 1e-9;
            for (const auto& recorded : result_.recording.rows) size = std::max(size, std::fabs(recorded[i + 1]));
            const RecordedState& state = prepared_.run.states[i];
            const double here = state.is_root ? x[state.place] * x[state.place] : x[state.place];
            note(largest, std::fabs(here - result_.recording.rows.back()[i + 1]) / size);
        }
        return largest;
    }

    void compare_events(double& times, std::string& trouble, double until) const {
        std::vector<EventOfRun> events = result_.events;
        if (!events.empty() && !events.back().to) events.pop_back();  // the end is compared by its status
        // One at the end itself is on either side by rounding.
        const auto is_at_end = [&](double t) { return t > until * (1 - 1e-14); };
        std::size_t count = made_->event_count;
        const bool compares_modes =
            (count == 0 || !is_at_end(made_->events[count - 1].t)) && (events.empty() || !is_at_end(events.back().t));
        while (count > 0 && is_at_end(made_->events[count - 1].t)) --count;
        while (!events.empty() && is_at_end(events.back().t)) events.pop_back();
        if (plant_.modes > 0 && compares_modes && made_->mode != result_.mode) trouble += " another mode at the end;";
        std::vector<Change> changes, in_c;
        for (const EventOfRun& e : events) add(changes, {e.t, e.event, e.from, *e.to}, until);
        for (std::size_t i = 0; i < count; ++i) {
            const event_in_c& e = made_->events[i];
            add(in_c, {e.t, e.event, e.before, e.after}, until);
        }
        if (changes.size() != in_c.size()) trouble += fmt::format(" {} events, {} in C;", changes.size(), in_c.size());
        for (std::size_t i = 0; i < std::min(changes.size(), in_c.size()); ++i) {
            const Change &one = changes[i], &other = in_c[i];
            note(times, std::fabs(one.t - other.t) / until);
            // Frictions of one loop stop together: which of them is named is a matter of roundings.
            const bool is_of_loop = row_.name.find("frictions_in_one_loop") != std::string::npos;
            const bool has_order = one.is_alone && other.is_alone && !is_of_loop;
            if ((!has_order || one.event == other.event) && one.from == other.from && one.to == other.to) continue;
            trouble += fmt::format(" event {} is '{}' to '{}', in C '{}' to '{}';", i, plant_.event_names[one.event],
                                   plant_.mode_names[one.to], plant_.event_names[other.event], plant_.mode_names[other.to]);
            return;
        }
    }

    /// Events at one time, whose order is that of roundings, are one change.
    struct Change {
        double t;
        std::size_t event;
        unsigned from, to;
        bool is_alone = true;
    };
    static void add(std::vector<Change>& changes, const Change& next, double until) {
        if (changes.empty() || next.t - changes.back().t > 1e-12 * until) {
            changes.push_back(next);
            return;
        }
        changes.back().to = next.to;
        changes.back().is_alone = false;
    }

    /// In parts, with the state carried to another run after each of them, bit by bit; and two runs at a time.
    void carry(wished_run wish) {
        wish.parts = 7;
        const std::vector<double> in_parts = run(wish);
        const int status = made_->status;
        note(row_.states, difference(in_parts));
        wish.reloads = 1;
        if (in_parts != run(wish) || status != made_->status) row_.trouble += " a saved run goes on in another way;";
        if (make_two_runs(&wish, in_parts.data()) == 0) row_.trouble += " two runs at a time disturb each other;";
    }

    /// Motions that magnify errors, as a chain over a singular position: what another tolerance changes in the run of the program itself.
    void allow_for_magnified_errors() {
        PlantRun finer = prepared_.run;
        finer.tolerance = tolerance / 10;
        const PlantRunResult other = simulate_plant(plant_, finer);
        std::vector<double> x(plant_.states);
        for (std::size_t i = 0; i < finer.states.size(); ++i) {
            const double value = other.recording.rows.back()[i + 1];
            x[finer.states[i].place] = finer.states[i].is_root ? std::sqrt(value) : value;
        }
        row_.allowed = 3 * difference(x);
    }

    /// Each of the methods alone, and their dense output.
    void look_closer(wished_run wish) {
        for (const int method : {1, 2}) {
            wish.method = method;
            note(row_.methods, difference(run(wish)));
            note(row_.dense, difference_within(&wish));
        }
    }

    void exchange(const wished_run& wish) {
        std::vector<double> x(plant_.states);
        make_exchange(&wish, 20000, made_.get(), x.data());
        note(row_.exchange_states, difference(x));
        compare_events(row_.exchange_times, row_.exchange_trouble, wish.until);
        // Of infinitely many events the last ones that are still told apart may be others.
        const auto apart = static_cast<double>(made_->event_count) - static_cast<double>(result_.events.size());
        if (made_->mode == result_.mode && row_.exchange_states <= 1e-9 && std::fabs(apart) <= 2) row_.exchange_trouble.clear();
        if (const std::string status = status_in_c(made_->status); status != to_string(result_.outcome.status))
            row_.exchange_trouble += fmt::format(" {}, exchanged {};", to_string(result_.outcome.status), status);
    }

    PreparedSimulation& prepared_;
    const PlantLibrary library_;
    const dalembert_plant& plant_;
    PlantRunResult result_;
    std::unique_ptr<made_run> made_ = std::make_unique<made_run>();
    Row row_;
};

void print(const std::vector<Row>& rows) {
    std::cout << fmt::format("{:40} {:>7} {:>7} {:>6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "model, scene, run", "steps", "in C++",
                             "events", "states", "times", "methods", "dense", "FMI", "times");
    for (const Row& row : rows)
        std::cout << fmt::format("{:40} {:7} {:7} {:6} {:8.1e} {:8.1e} {:8.1e} {:8.1e} {:8.1e} {:8.1e}{}{}\n", row.name, row.steps_in_c,
                                 row.steps, row.events, row.states, row.times, row.methods, row.dense, row.exchange_states,
                                 row.exchange_times, row.trouble, row.exchange_trouble);
}

}  // namespace

TEST_CASE("runs in C are those of the program") {
    std::vector<Row> rows;
    for (const std::filesystem::path& file : models()) {
        const auto model = loaded_if_good(file);
        if (model == nullptr) continue;
        for (const Run& run : model->model.runs) {
            Options options;
            options.run = run.name;
            const std::string name = fmt::format("{} {} {}", file.stem().string(), run.scene, run.name);
            try {
                PreparedSimulation prepared = prepare_simulation(model, "", options);
                rows.push_back(RunComparison(name, prepared)());
            } catch (const Failure& failure) {
                if (prints) std::cout << name << ": " << failure.what() << "\n";  // runs that the program refuses
                continue;
            }
            const Row& row = rows.back();
            if (prints) print({row});
            CAPTURE(row.name);
            CHECK(row.trouble == "");
            CHECK(row.states <= row.allowed);
            CHECK(row.times <= 1e-8);
            CHECK(row.methods <= 1e-7);
            CHECK(row.dense <= 1e-6);
            CHECK(row.exchange_trouble == "");
            CHECK(row.exchange_states <= 1e-3);
        }
    }
    CHECK(rows.size() >= 1);
    if (prints) print(rows);
}

TEST_CASE("the methods in C have the coefficients of those of the runtime") {
    std::size_t i = 0;
    const detail::Dop853Table<double> table;
    for (const double factor : table.factors) CHECK(dop853_coefficient(i++) == factor);
    for (const double time : table.times) CHECK(dop853_coefficient(i++) == time);
    CHECK(std::isnan(dop853_coefficient(i)));
    using Rodas = detail::Rodas5pCoefficients;
    i = 0;
    const auto compare = [&](const double* numbers, std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) CHECK(rodas5p_coefficient(i++) == numbers[k]);
    };
    compare(&Rodas::gamma, 1);
    compare(Rodas::a[0], 30);
    compare(Rodas::c[0], 56);
    compare(Rodas::time, 8);
    compare(Rodas::gradient, 8);
    compare(Rodas::dense[0], 24);
    CHECK(std::isnan(rodas5p_coefficient(i)));
}
