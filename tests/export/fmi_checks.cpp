// SPDX-License-Identifier: GPL-3.0-or-later
#include "fmi_checks.hpp"

#include <cstdio>
#include <map>

namespace fmi_test {

int failures = 0;
std::string name_of_unit;

void fail(const std::string& what) {
    std::printf("%s: %s\n", name_of_unit.c_str(), what.c_str());
    ++failures;
}

// --- derivatives ---------------------------------------------------------------------------------------------------------------------

/// Values of all unknowns with derivatives: rates and outputs.
static References unknowns_of(const Description& d) {
    References list = d.rates();
    for (const unsigned output : d.references("output")) list.push_back(output);
    return list;
}

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
    check(fmu.directional(unknowns, knowns, seed, forward) == ok && fmu.adjoint(unknowns, knowns, weights, backward) == ok,
          "products of derivatives fail");
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
            if (columns[j][i] != 0 && dependencies && std::none_of(dependencies->begin(), dependencies->end(), is_it))
                fail("a dependency is missing in modelDescription.xml");
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
        Vector far_up, up, middle, down, far_down;
        if (!values_at(j, 2 * h, far_up) || !values_at(j, h, up) || !values_at(j, 0, middle) || !values_at(j, -h, down) ||
            !values_at(j, -2 * h, far_down))
            continue;
        for (std::size_t i = 0; i < rows; ++i) {
            const double rough = (up[i] - down[i]) / (2 * h), difference = (8 * (up[i] - down[i]) - far_up[i] + far_down[i]) / (12 * h);
            // Terms that cancel leave their roundings: as large as what the row makes of the whole state.
            double size = std::max({std::abs(up[i]), std::abs(down[i]), 1.0});
            for (std::size_t l = 0; l < knowns.size(); ++l)
                size = std::max(size, 1e-4 * std::abs(columns[l][i] * (l < n ? x[l] : s.values[l - n])));
            const double doubt = std::abs(rough - difference) + 1e-10 * size / h;
            if (std::abs(difference - columns[j][i]) <= 1e-6 * std::abs(columns[j][i]) + doubt) continue;
            // On a kink, as at rest on a point of a curve, the derivative is that of one side.
            const double ahead = (up[i] - middle[i]) / h, behind = (middle[i] - down[i]) / h;
            const double to_side = std::min(std::abs(ahead - columns[j][i]), std::abs(behind - columns[j][i]));
            if (to_side <= 1e-3 * std::abs(ahead - behind) + doubt) continue;
            char text[200];
            std::snprintf(text, sizeof text, "the derivative of %u by %u is %.9g, differences say %.9g and %.9g", unknowns[i], knowns[j],
                          columns[j][i], difference, rough);
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
    Vector f(n), J(entries(plant->pattern_x, n, n) + 1), Ju(entries(plant->pattern_u, n, m) + 1), C((rows - n) * n + 1),
        D((rows - n) * m + 1);
    plant->rhs_and_jacobian(self, mode_number, x.data(), s.values.data(), t, f.data(), J.data());
    if (m > 0) plant->jacobian_u(self, mode_number, x.data(), s.values.data(), t, Ju.data());
    if (rows > n && n > 0 && plant->output_jacobian_x != nullptr)
        plant->output_jacobian_x(self, mode_number, x.data(), s.values.data(), t, C.data());
    if (rows > n && m > 0 && plant->output_jacobian_u != nullptr)
        plant->output_jacobian_u(self, mode_number, x.data(), s.values.data(), t, D.data());
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
            for (std::size_t k = pattern.column_starts[column]; k < pattern.column_starts[column + 1]; ++k)
                expected[pattern.row_indices[k]] = values[k];
        for (std::size_t i = n; i < rows; ++i) expected[i] = (is_state ? C : D)[column * (rows - n) + i - n];
        double size = 0;
        for (const double one : expected) size = std::max(size, std::abs(one));
        for (std::size_t i = 0; i < rows; ++i)
            if (size > 0) deviation = std::max(deviation, std::abs(expected[i] - columns[j][i]) / size);
    }
    check(deviation <= 1e-14, "Jacobians differ from the plant's table by " + std::to_string(deviation));
    return deviation;
}

/// In event mode, where parameters may be set.
void check_derivatives_by_parameters(const Subject& s, Instance& fmu) {
    const References unknowns = unknowns_of(s.d), parameters = s.d.references("parameter");
    if (unknowns.empty() || fmu.enter_events() != ok) return;
    // Terms that cancel leave their roundings: a rate at rest may be nothing else.
    Vector x, terms(unknowns.size(), 0);
    const References states = s.d.states();
    check(states.empty() || fmu.get(states, x) == ok, "states are not read");
    for (std::size_t j = 0; j < states.size(); ++j)
        if (Vector column; fmu.directional(unknowns, {states[j]}, {1}, column) == ok)
            for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = std::max(terms[i], 1e-6 * std::abs(column[i] * x[j]));
    std::size_t wrong = 0;
    std::string where;
    for (std::size_t j = 0; j < parameters.size() && j < 12; ++j) {
        Vector value, column;
        check(fmu.get({parameters[j]}, value) == ok, "a parameter is not read");
        if (fmu.directional(unknowns, {parameters[j]}, {1}, column) != ok) continue;  // at a kink it is infinite
        const double h = 1e-4 * std::max(std::abs(value[0]), 1e-6);
        std::vector<Vector> at;
        for (const double steps : {-2.0, -1.0, 1.0, 2.0}) {
            Vector& values = at.emplace_back();
            if (fmu.set({parameters[j]}, {value[0] + steps * h}) != ok || fmu.get(unknowns, values) != ok) break;
        }
        check(fmu.set({parameters[j]}, value) == ok, "a parameter is not set back");
        if (at.back().size() != unknowns.size() || at.size() < 4) continue;
        for (std::size_t i = 0; i < unknowns.size(); ++i) {
            const double rough = (at[2][i] - at[1][i]) / (2 * h), fine = (8 * (at[2][i] - at[1][i]) - at[3][i] + at[0][i]) / (12 * h);
            const double size = std::max({std::abs(at[1][i]), std::abs(at[2][i]), terms[i], 1.0});
            const double doubt = 20 * std::abs(rough - fine) + 1e-10 * size / h;
            if (std::abs(fine - column[i]) <= 1e-6 * std::abs(column[i]) + doubt) continue;
            char text[200];
            std::snprintf(text, sizeof text, "that of %u by parameter %u is %.9g, differences say %.9g and %.9g", unknowns[i],
                          parameters[j], column[i], fine, rough);
            if (wrong++ == 0) where = text;
        }
    }
    check(wrong == 0, std::to_string(wrong) + " derivatives by parameters differ from differences: " + where);
}

// --- states, reset, instances, wrong calls -----------------------------------------------------------------------------------------------

static bool same(const Trajectory& a, const Trajectory& b) { return a.t == b.t && a.x == b.x && a.failure == b.failure; }

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
    if (!state.empty())
        check(fmu->set(state, {nan}) == discard && fmu->set(state, {HUGE_VAL}) == discard, "NaN is taken for a start value");
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
    check(steps->enter_events() == error && steps->set_states(x) == error && steps->rates(x) == error,
          "model exchange in co-simulation is no error");
    check(steps->step(0, -1, a, reached) == error && steps->step(0, nan, a, reached) == error &&
              steps->step(s.until, 0.1, a, reached) == error,
          "a step that cannot be is no error");
    check(steps->step(0, s.until * 1e-3, a, reached) != error, "no step is possible after wrong ones");
}

}  // namespace fmi_test
