// SPDX-License-Identifier: GPL-3.0-or-later
// Imports an FMU as another tool would, and compares what it finds with runs and functions of the same model that did not come through
// FMI. Prints one line; exit code 1 where something is wrong.
//
//     fmi_importer FILE.fmu                          prints "until INPUT=VALUE,...", what a reference run needs
//     fmi_importer FILE.fmu RUNS PLANT.so            RUNS: fine.csv and rough.csv, runs at two tolerances, and fine_events.csv
#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "fmi_checks.hpp"

namespace {

using namespace fmi_test;

/// A result of `dalembert simulate`: the columns of a CSV file by their names, without units.
struct Table {
    std::map<std::string, std::vector<std::string>> columns;
    std::size_t rows = 0;
    double number(const std::string& name, std::size_t row) const { return std::stod(columns.at(name).at(row)); }
};

Table read_table(const std::string& path) {
    std::ifstream in(path);
    Table table;
    std::vector<std::string> names;
    const auto cells = [](const std::string& line) {
        std::vector<std::string> list;
        std::string cell;
        std::istringstream stream(line);
        while (std::getline(stream, cell, ',')) list.push_back(cell);
        return list;
    };
    std::string line;
    if (!std::getline(in, line)) return table;
    for (std::string name : cells(line)) names.push_back(name.substr(0, name.find(" [")));
    for (; std::getline(in, line); ++table.rows) {
        const auto list = cells(line);
        // The last cell of a line may be empty.
        for (std::size_t i = 0; i < names.size(); ++i) table.columns[names[i]].push_back(i < list.size() ? list[i] : "");
    }
    return table;
}

/// Inputs are held a little away from where they start, so that they do something.
double held(const Variable& input) {
    return input.low && input.high ? std::clamp(*input.start + 0.03 * (*input.high - *input.low), *input.low, *input.high) : *input.start;
}

double end_of(const Description& d) { return d.stop ? std::min(*d.stop, 20.0) : 1.0; }

/// The largest deviation from the fine run, divided by its limit. The limit is `tolerance` of the largest value or, where the motion itself
/// magnifies errors, `times` the difference of the fine and the rough run.
double compare(const Subject& s, const Trajectory& run, const Table& fine, const Table& rough, double tolerance, double times,
               const char* what) {
    const auto names = s.state_names();
    double worst = 0;
    std::string where;
    for (std::size_t i = 0; i < names.size(); ++i) {
        double size = 0, doubt = 0;
        for (std::size_t r = 0; r < fine.rows; ++r) size = std::max(size, std::abs(fine.number(names[i], r)));
        for (std::size_t r = 0, f = 0; f < run.t.size(); ++f) {
            while (r < fine.rows && fine.number("t", r) < run.t[f] - 1e-9 * s.until) ++r;
            if (r == fine.rows || std::abs(fine.number("t", r) - run.t[f]) > 1e-9 * s.until) continue;
            if (s.is_event(run.t[f])) continue;  // before it or behind it
            const double expected = fine.number(names[i], r);
            if (r < rough.rows) doubt = std::max(doubt, std::abs(rough.number(names[i], r) - expected));
            const double allowed = std::max({tolerance * size, times * doubt, 1e-12});
            const double part = std::abs(run.x[f][i] - expected) / allowed;
            if (!(part <= worst)) {
                worst = part;
                char text[200];
                std::snprintf(text, sizeof text, "%s at t = %.9g is %.12g, not %.12g (allowed %.1e)", names[i].c_str(), run.t[f],
                              run.x[f][i], expected, allowed);
                where = text;
            }
        }
    }
    if (!(worst <= 1)) fail(std::string(what) + ": " + where);
    return worst;
}

void compare_ends(const Subject& s, const Trajectory& run, const Table& fine, double tolerance, const char* what) {
    const double end = fine.number("t", fine.rows - 1);
    if (run.t.empty()) return fail(std::string(what) + ": no time was reached");
    const bool ended = end < s.until * (1 - 1e-12);
    // An end of the model at the end of the run may be seen or not.
    const bool is_same = ended == run.is_over || std::abs(end - s.until) <= tolerance * std::max(1.0, end);
    if (!is_same || std::abs(run.t.back() - end) > tolerance * std::max(1.0, end)) {
        char text[200];
        std::snprintf(text, sizeof text, "%s: ends at %.12g%s, not at %.12g", what, run.t.back(),
                      run.is_over ? ", where the model ends" : "", end);
        fail(text);
    }
}

/// The largest deviation of the times of changes of mode, divided by its limit. The end of infinitely many bounces is only as good
/// as the last of them that an importer sees: an FMU cannot go on in time by itself.
double compare_changes(const Trajectory& run, const Table& events) {
    struct Expected {
        double t, allowed;
    };
    std::vector<Expected> expected;
    for (std::size_t r = 0; r < events.rows && events.columns.contains("to"); ++r) {
        const std::string& to = events.columns.at("to")[r];
        if (to.empty() || events.columns.at("from")[r] == to) continue;  // the model ends there, or stays in its mode
        const double t = events.number("t", r);
        const bool is_end =
            r > 0 && events.columns.at("event")[r - 1] == events.columns.at("event")[r] && t - events.number("t", r - 1) < 1e-6;
        expected.push_back({t, is_end ? 1e-6 : 1e-8 * std::max(1.0, t)});
    }
    // Several changes at one time are one for an importer, and those at the start are none.
    const auto tidy = [](auto& list) {
        std::erase_if(list, [](const auto& e) { return e.t == 0; });
        for (std::size_t i = 0; i + 1 < list.size();)
            if (std::abs(list[i + 1].t - list[i].t) < 1e-9) list.erase(list.begin() + long(i));
            else ++i;
    };
    std::vector<ModeChange> found = run.changes;
    tidy(expected);
    tidy(found);
    if (found.size() != expected.size()) {
        fail("the mode changes " + std::to_string(found.size()) + " times, not " + std::to_string(expected.size()));
        return 0;
    }
    double worst = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double late = std::abs(found[i].t - expected[i].t);
        worst = std::max(worst, late);
        char text[200];
        std::snprintf(text, sizeof text, "a change of mode at %.12g s, not at %.12g s", found[i].t, expected[i].t);
        check(late <= expected[i].allowed, text);
    }
    return worst;
}

int whole(const std::string& path, const std::string& runs, const std::string& library) {
    const Unit unit(path);
    const Description& d = unit.description();
    Subject s{unit, d, end_of(d), d.references("input"), {}};
    for (const Variable& v : d.variables)
        if (v.causality == "input") s.values.push_back(held(v));
    const Table fine = read_table(runs + "/fine.csv"), rough = read_table(runs + "/rough.csv"),
                events = read_table(runs + "/fine_events.csv");
    for (std::size_t r = 0; r < events.rows; ++r) s.event_times.push_back(events.number("t", r));
    if (fine.rows > 0 && fine.number("t", fine.rows - 1) < s.until * (1 - 1e-12)) s.event_times.push_back(fine.number("t", fine.rows - 1));
    const dalembert_plant* plant = nullptr;
    if (void* const loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL))
        plant = reinterpret_cast<dalembert_plant_function>(dlsym(loaded, DALEMBERT_PLANT_FUNCTION))();
    if (plant == nullptr || fine.rows == 0) throw std::runtime_error("the plant or its runs are missing");
    void* const self = plant->create();

    const auto exchange = unit.instantiate(false);
    if (!exchange) throw std::runtime_error("there is no instance");
    const RunWish wish{s.until, 50, 2e-11};
    const Trajectory run = run_exchange(*exchange, d, wish, [&](Instance& fmu) { s.prepare(fmu, 1e-10); });
    double by_exchange = 0, by_steps = 0, in_time = 0, jacobians = 0;
    // As a vehicle at rest whose wheels are driven: no step can be made.
    const bool ends_at_start = fine.number("t", fine.rows - 1) == 0;
    const auto is_made = [&](const Trajectory& one, const char* what) {
        if (one.failure.empty()) return true;
        if (!ends_at_start || one.t.back() != 0) fail(std::string(what) + " at t = " + std::to_string(one.t.back()) + ": " + one.failure);
        return false;
    };
    if (is_made(run, "model exchange")) {
        compare_ends(s, run, fine, 1e-8, "model exchange");
        by_exchange = compare(s, run, fine, rough, 1e-8, 30, "model exchange");
        in_time = compare_changes(run, events);
        if (!run.is_over) {
            jacobians = check_derivatives(s, *exchange, s.until, run.x.back(), d.mode() ? exchange->mode(*d.mode()) : 0, plant, self);
            check_derivatives_by_parameters(s, *exchange);
        }
    }
    const auto steps = unit.instantiate(true);
    s.prepare(*steps, 1e-9);
    const Trajectory stepped = run_steps(*steps, d, wish);
    if (is_made(stepped, "co-simulation")) {
        compare_ends(s, stepped, fine, 1e-6, "co-simulation");
        by_steps = compare(s, stepped, fine, rough, 1e-7, 300, "co-simulation");
    }
    check_states(s);
    check_wrong_calls(s);
    plant->destroy(self);
    std::printf("%s: FMI %d, %zu states, %zu steps%s, %zu events, %zu changes of mode (%.1e s), ME %.2g, CS %.2g, Jacobians %.1e%s\n",
                name_of_unit.c_str(), d.version, d.derivatives.size(), run.steps, run.is_stiff ? " (stiff)" : "", run.events,
                run.changes.size(), in_time, by_exchange, by_steps, jacobians, failures > 0 ? " FAILED" : "");
    return failures > 0 ? 1 : 0;
}

}  // namespace

int main(int count, char** arguments) {
    try {
        if (count != 2 && count != 4) throw std::runtime_error("usage: fmi_importer FILE.fmu [RUNS PLANT.so]");
        const std::string path = arguments[1];
        name_of_unit = path.substr(path.rfind('/') + 1);
        if (count == 4) return whole(path, arguments[2], arguments[3]);
        const Unit unit(path);
        std::string inputs;
        for (const Variable& v : unit.description().variables)
            if (v.causality == "input") {
                char text[100];
                std::snprintf(text, sizeof text, "=%.17g", held(v));
                inputs += (inputs.empty() ? "" : ",") + v.name + text;
            }
        std::printf("%.17g %s\n", end_of(unit.description()), inputs.c_str());
        return 0;
    } catch (const std::exception& problem) {
        std::printf("%s: %s\n", name_of_unit.c_str(), problem.what());
        return 1;
    }
}
