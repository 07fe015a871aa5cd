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

#include "dalembert/plant.h"
#include "fmi_exchange.hpp"

namespace {

using namespace fmi_test;

int failures = 0;
std::string name_of_unit;

void fail(const std::string& what) {
    std::printf("%s: %s\n", name_of_unit.c_str(), what.c_str());
    ++failures;
}
void check(bool is_right, const std::string& what) {
    if (!is_right) fail(what);
}

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

struct Subject {
    const Unit& unit;
    const Description& d;
    double until;
    References inputs;
    Vector values;
    Vector event_times = {};  ///< of the fine run

    bool is_event(double t) const {
        return std::any_of(event_times.begin(), event_times.end(), [&](double e) { return std::abs(e - t) <= 1e-8 * std::max(1.0, t); });
    }
    void prepare(Instance& fmu, double tolerance) const {
        check(fmu.setup(tolerance, 0, until) == ok, "initialization mode is not entered");
        check(fmu.set(inputs, values) == ok, "inputs are not taken");
        if (fmu.end_setup() != ok) fail("initialization fails: " + (messages().empty() ? "" : messages().back()));
    }
    std::vector<std::string> state_names() const {
        std::vector<std::string> names;
        for (const Unknown& u : d.derivatives) names.push_back(d.variables[*d.variables[u.variable].derivative_of].name);
        return names;
    }
};

/// The largest deviation from the fine run, in parts of what is allowed: `tolerance` of the largest value, or so many times what the two
/// runs differ, where the motion itself magnifies differences.
double compare(const Subject& s, const Trajectory& run, const Table& fine, const Table& rough, double tolerance, double times, const char* what) {
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
                std::snprintf(text, sizeof text, "%s at t = %.9g is %.12g, not %.12g (allowed %.1e)", names[i].c_str(), run.t[f], run.x[f][i], expected, allowed);
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
        std::snprintf(text, sizeof text, "%s: ends at %.12g%s, not at %.12g", what, run.t.back(), run.is_over ? ", where the model ends" : "", end);
        fail(text);
    }
}

/// The largest deviation of the times of changes of mode, in parts of what is allowed. The end of infinitely many bounces is only as good as the last of
/// them that an importer sees: an FMU cannot go on in time by itself.
double compare_changes(const Trajectory& run, const Table& events) {
    struct Expected {
        double t, allowed;
    };
    std::vector<Expected> expected;
    for (std::size_t r = 0; r < events.rows && events.columns.contains("to"); ++r) {
        const std::string& to = events.columns.at("to")[r];
        if (to.empty() || events.columns.at("from")[r] == to) continue;  // the model ends there, or stays in its mode
        const double t = events.number("t", r);
        const bool is_end = r > 0 && events.columns.at("event")[r - 1] == events.columns.at("event")[r] && t - events.number("t", r - 1) < 1e-6;
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

// --- derivatives ---------------------------------------------------------------------------------------------------------------------

/// Values of all unknowns with derivatives: rates and outputs.
References unknowns_of(const Description& d) {
    References list = d.rates();
    for (const unsigned output : d.references("output")) list.push_back(output);
    return list;
}

/// In continuous time at the present point: against differences, the adjoint ones, the dependencies, and the plant's own table.
double check_derivatives(const Subject& s, Instance& fmu, double t, const Vector& x, long mode, const dalembert_plant* plant, void* self) {
    const Description& d = s.d;
    const References unknowns = unknowns_of(d), states = d.states();
    References knowns = states;
    knowns.insert(knowns.end(), s.inputs.begin(), s.inputs.end());
    const std::size_t n = states.size(), m = s.inputs.size(), rows = unknowns.size();
    std::vector<Vector> columns(knowns.size());
    for (std::size_t j = 0; j < knowns.size(); ++j)
        if (fmu.directional(unknowns, {knowns[j]}, {1}, columns[j]) != ok) return fail("there is no derivative"), 0;
    // Two directions at once, and the adjoint.
    Vector seed(knowns.size()), weights(rows), forward, backward;
    for (std::size_t j = 0; j < seed.size(); ++j) seed[j] = 1 + 0.1 * double(j);
    for (std::size_t i = 0; i < rows; ++i) weights[i] = 1 - 0.2 * double(i);
    check(fmu.directional(unknowns, knowns, seed, forward) == ok && fmu.adjoint(unknowns, knowns, weights, backward) == ok, "products of derivatives fail");
    for (std::size_t i = 0; i < rows; ++i) {
        double sum = 0, size = 0;
        for (std::size_t j = 0; j < knowns.size(); ++j) sum += columns[j][i] * seed[j], size += std::abs(columns[j][i] * seed[j]);
        check(std::abs(sum - forward[i]) <= 1e-14 * size, "a directional derivative is no sum of columns");
    }
    for (std::size_t j = 0; j < knowns.size(); ++j) {
        double sum = 0, size = 0;
        for (std::size_t i = 0; i < rows; ++i) sum += columns[j][i] * weights[i], size += std::abs(columns[j][i] * weights[i]);
        check(std::abs(sum - backward[j]) <= 1e-14 * size, "an adjoint derivative is no sum of rows");
    }
    // What is not zero is a dependency.
    std::map<unsigned, const Unknown*> described;
    for (const auto* list : {&d.outputs, &d.derivatives})
        for (const Unknown& u : *list) described[d.variables[u.variable].reference] = &u;
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < knowns.size(); ++j) {
            const auto& dependencies = described.at(unknowns[i])->dependencies;
            const auto is_it = [&](std::size_t v) { return d.variables[v].reference == knowns[j]; };
            if (columns[j][i] != 0 && dependencies && std::none_of(dependencies->begin(), dependencies->end(), is_it)) fail("a dependency is missing in modelDescription.xml");
        }
    double largest = 0;
    for (const Vector& column : columns)
        for (const double entry : column) largest = std::max(largest, std::abs(entry));
    // Differences; they fail where they cross a kink, or leave what the model holds for.
    const auto values_at = [&](std::size_t j, double change, Vector& values) {
        Vector at = x, u = s.values;
        (j < n ? at[j] : u[j - n]) += change;
        const bool is_taken = fmu.set_states(at) == ok && fmu.set(s.inputs, u) == ok;
        return is_taken && fmu.get(unknowns, values) == ok;
    };
    std::size_t wrong = 0;
    std::string where;
    for (std::size_t j = 0; j < knowns.size(); ++j) {
        const double value = j < n ? x[j] : s.values[j - n], h = 1e-4 * std::max(std::abs(value), 1e-2);
        Vector far_up, up, down, far_down;
        if (!values_at(j, 2 * h, far_up) || !values_at(j, h, up) || !values_at(j, -h, down) || !values_at(j, -2 * h, far_down)) continue;
        for (std::size_t i = 0; i < rows; ++i) {
            const double rough = (up[i] - down[i]) / (2 * h), difference = (8 * (up[i] - down[i]) - far_up[i] + far_down[i]) / (12 * h);
            // Terms that cancel leave their roundings: as large as what the row makes of the whole state.
            double size = std::max({std::abs(up[i]), std::abs(down[i]), 1.0});
            for (std::size_t l = 0; l < knowns.size(); ++l) size = std::max(size, 1e-4 * std::abs(columns[l][i] * (l < n ? x[l] : s.values[l - n])));
            const double doubt = std::abs(rough - difference) + 1e-10 * size / h;
            if (std::abs(difference - columns[j][i]) <= 1e-6 * std::abs(columns[j][i]) + doubt) continue;
            char text[200];
            std::snprintf(text, sizeof text, "the derivative of %u by %u is %.9g, differences say %.9g and %.9g", unknowns[i], knowns[j], columns[j][i], difference, rough);
            if (wrong++ == 0) where = text;
        }
    }
    fmu.set_states(x);
    fmu.set(s.inputs, s.values);
    check(wrong == 0, std::to_string(wrong) + " derivatives differ from differences at t = " + std::to_string(t) + ": " + where);
    if (plant == nullptr) return 0;
    // The plant's own Jacobians, from C++.
    const auto entries = [](const dalembert_pattern& pattern, std::size_t height, std::size_t width) {
        return pattern.column_starts != nullptr ? pattern.column_starts[width] : height * width;
    };
    const auto mode_number = static_cast<unsigned>(std::max(0L, mode));
    Vector f(n), J(entries(plant->pattern_x, n, n) + 1), Ju(entries(plant->pattern_u, n, m) + 1), C((rows - n) * n + 1), D((rows - n) * m + 1);
    plant->rhs_and_jacobian(self, mode_number, x.data(), s.values.data(), t, f.data(), J.data());
    if (m > 0) plant->jacobian_u(self, mode_number, x.data(), s.values.data(), t, Ju.data());
    if (rows > n && n > 0 && plant->output_jacobian_x != nullptr) plant->output_jacobian_x(self, mode_number, x.data(), s.values.data(), t, C.data());
    if (rows > n && m > 0 && plant->output_jacobian_u != nullptr) plant->output_jacobian_u(self, mode_number, x.data(), s.values.data(), t, D.data());
    double deviation = 0;
    for (std::size_t j = 0; j < knowns.size(); ++j) {
        const bool is_state = j < n;
        const std::size_t column = is_state ? j : j - n;
        const dalembert_pattern& pattern = is_state ? plant->pattern_x : plant->pattern_u;
        const Vector& values = is_state ? J : Ju;
        Vector expected(rows, 0);
        if (pattern.column_starts == nullptr)
            for (std::size_t i = 0; i < n; ++i) expected[i] = values[column * n + i];
        else
            for (std::size_t k = pattern.column_starts[column]; k < pattern.column_starts[column + 1]; ++k) expected[pattern.row_indices[k]] = values[k];
        for (std::size_t i = n; i < rows; ++i) expected[i] = (is_state ? C : D)[column * (rows - n) + i - n];
        double size = 0;
        for (const double one : expected) size = std::max(size, std::abs(one));
        for (std::size_t i = 0; i < rows; ++i)
            if (size > 0) deviation = std::max(deviation, std::abs(expected[i] - columns[j][i]) / size);
    }
    check(deviation <= 1e-14, "Jacobians differ from the plant's table by " + std::to_string(deviation));
    return deviation;
}

// --- states, reset, instances, wrong calls -----------------------------------------------------------------------------------------------

bool same(const Trajectory& a, const Trajectory& b) { return a.t == b.t && a.x == b.x && a.failure == b.failure; }

void check_states(const Subject& s) {
    const References states = s.d.states();
    const auto one = s.unit.instantiate(true, "one"), other = s.unit.instantiate(true, "other");
    if (!one || !other) return fail("two instances at once are not possible");
    s.prepare(*one, 1e-9);
    s.prepare(*other, 1e-9);
    const double part = s.until / 20;
    bool over = false;
    double reached = 0;
    Vector a, b, c;
    Status status = ok;
    for (int i = 0; i < 5 && status == ok; ++i) status = one->step(part * i, part, over, reached);
    if (status != ok) return;  // a model that ends so soon is compared above
    void *state = nullptr, *copy = nullptr;
    std::string bytes, again;
    check(one->save(state) == ok && one->serialise(state, bytes) == ok, "the state is not saved");
    const auto go_on = [&](Instance& fmu, Vector& x) {
        for (int i = 5; i < 10; ++i)
            if (fmu.step(part * i, part, over, reached) != ok) break;
        fmu.get(states, x);
    };
    go_on(*one, a);
    check(one->load(state) == ok, "the state is not restored");
    go_on(*one, b);
    check(a == b, "a restored state goes another way");
    check(other->deserialise(bytes, copy) == ok && other->load(copy) == ok, "the bytes of a state are not taken");
    go_on(*other, c);
    check(a == c, "another instance goes another way from the bytes of a state");
    check(other->serialise(copy, again) == ok && again == bytes, "the bytes of a state change");
    bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 64);
    void* damaged = nullptr;
    check(other->deserialise(bytes, damaged) == error, "damaged bytes are taken for a state");
    check(other->deserialise(bytes.substr(1), damaged) == error, "too few bytes are taken for a state");
    const auto exchange = s.unit.instantiate(false, "third");
    check(exchange->load(state) == error, "a state of co-simulation is taken in model exchange");
    one->forget(state);
    other->forget(copy);
    check(state == nullptr && copy == nullptr, "a state is not forgotten");
    // After a reset everything is as at the start.
    check(one->reset() == ok && other->reset() == ok, "reset fails");
    s.prepare(*one, 1e-9);
    s.prepare(*other, 1e-9);
    // In turns, both do what one does alone.
    RunWish wish{s.until / 2, 10};
    Trajectory first = run_steps(*one, s.d, wish);
    one->reset();
    s.prepare(*one, 1e-9);
    const Trajectory second = run_steps(*one, s.d, wish);
    check(same(first, second), "a run after a reset is another one");
    for (int i = 0; i < 4; ++i) {
        if (one->reset() != ok) fail("reset fails");
        s.prepare(*one, 1e-9);
        const double small = part / 2;
        if (one->step(0, small, over, reached) != ok || other->step(small * i, small, over, reached) != ok) break;
    }
}

void check_wrong_calls(const Subject& s) {
    const Description& d = s.d;
    check(s.unit.instantiate(false, "one", "{wrong}") == nullptr, "a wrong token is taken");
    check(s.unit.instantiate(false, "") == nullptr, "an instance without a name is made");
    const auto fmu = s.unit.instantiate(false);
    News news;
    bool a = false, b = false;
    double reached = 0;
    Vector x(d.derivatives.size()), one;
    const References nothing{1000000}, state = d.states().empty() ? References{} : References{d.states()[0]};
    const double nan = std::nan("");
    check(fmu->update(news) == error && fmu->enter_continuous() == error && fmu->set_time(0) == error && fmu->completed(a, b) == error &&
              fmu->end_setup() == error && fmu->enter_events() == error && fmu->terminate() == error,
          "a call before initialization is no error");
    check(fmu->step(0, 0.1, a, reached) == error, "a step in model exchange is no error");
    check(fmu->set(nothing, {1}) == error, "a wrong value reference is no error");
    if (!state.empty()) check(fmu->set(state, {nan}) == discard && fmu->set(state, {HUGE_VAL}) == discard, "NaN is taken for a start value");
    s.prepare(*fmu, 0);
    check(fmu->get(nothing, one) == error, "a wrong value reference is no error");
    if (d.mode()) check(fmu->get({*d.mode()}, one) == error, "a mode is read as a real number");
    if (!d.references("parameter").empty()) {
        const unsigned parameter = d.references("parameter")[0];
        check(fmu->mode(parameter) == -1, "a parameter is read as an integer");
        check(fmu->set({parameter}, {nan}) == discard, "NaN is taken for a parameter");
        fmu->update(news);
        fmu->enter_continuous();
        fmu->get({parameter}, one);
        check(fmu->set({parameter}, one) == error, "a parameter is set in continuous time");
    } else {
        fmu->update(news);
        fmu->enter_continuous();
    }
    if (!state.empty()) {
        check(fmu->set(state, {0}) == error, "a state is set as a variable in continuous time");
        Vector bad = x;
        bad[0] = nan;
        check(fmu->set_states(bad) == discard, "NaN is taken for a state");
        check(fmu->set_states(Vector(x.size() + 1, 0)) == error, "too many states are taken");
        Vector result;
        check(fmu->directional({d.states()[0]}, {d.states()[0]}, {1}, result) == error, "a state is taken for an unknown");
        check(fmu->directional({d.rates()[0]}, {d.rates()[0]}, {1}, result) == error, "a rate is taken for a known");
        check(fmu->get(d.rates(), result) != error, "rates cannot be read after wrong calls");
    }
    check(fmu->set_time(nan) == error, "NaN is taken for the time");
    check(fmu->setup(0, 0, 1) == error, "initialization mode is entered twice");
    check(fmu->terminate() == ok && fmu->enter_events() == error, "a call after the end is no error");
    check(fmu->reset() == ok, "reset fails after the end");
    const auto steps = s.unit.instantiate(true);
    s.prepare(*steps, 0);
    check(steps->enter_events() == error && steps->set_states(x) == error && steps->rates(x) == error, "model exchange in co-simulation is no error");
    check(steps->step(0, -1, a, reached) == error && steps->step(0, nan, a, reached) == error && steps->step(s.until, 0.1, a, reached) == error,
          "a step that cannot be is no error");
    check(steps->step(0, s.until * 1e-3, a, reached) != error, "no step is possible after wrong ones");
}

int whole(const std::string& path, const std::string& runs, const std::string& library) {
    const Unit unit(path);
    const Description& d = unit.description();
    Subject s{unit, d, end_of(d), d.references("input"), {}};
    for (const Variable& v : d.variables)
        if (v.causality == "input") s.values.push_back(held(v));
    const Table fine = read_table(runs + "/fine.csv"), rough = read_table(runs + "/rough.csv"), events = read_table(runs + "/fine_events.csv");
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
    if (!run.failure.empty()) fail("model exchange at t = " + std::to_string(run.t.back()) + ": " + run.failure);
    else {
        compare_ends(s, run, fine, 1e-8, "model exchange");
        by_exchange = compare(s, run, fine, rough, 1e-8, 30, "model exchange");
        in_time = compare_changes(run, events);
        if (!run.is_over) jacobians = check_derivatives(s, *exchange, s.until, run.x.back(), d.mode() ? exchange->mode(*d.mode()) : 0, plant, self);
    }
    const auto steps = unit.instantiate(true);
    s.prepare(*steps, 1e-9);
    const Trajectory stepped = run_steps(*steps, d, wish);
    if (!stepped.failure.empty()) fail("co-simulation at t = " + std::to_string(stepped.t.back()) + ": " + stepped.failure);
    else {
        compare_ends(s, stepped, fine, 1e-6, "co-simulation");
        by_steps = compare(s, stepped, fine, rough, 1e-7, 300, "co-simulation");
    }
    check_states(s);
    check_wrong_calls(s);
    plant->destroy(self);
    std::printf("%s: FMI %d, %zu states, %zu steps%s, %zu events, %zu changes of mode (%.1e s), ME %.2g, CS %.2g, Jacobians %.1e%s\n", name_of_unit.c_str(), d.version,
                d.derivatives.size(), run.steps, run.is_stiff ? " (stiff)" : "", run.events, run.changes.size(), in_time, by_exchange, by_steps, jacobians,
                failures > 0 ? " FAILED" : "");
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
