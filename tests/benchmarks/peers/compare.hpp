// SPDX-License-Identifier: GPL-3.0-or-later
// One machine, integrated by our methods and by those of SUNDIALS: the same generated right-hand side and Jacobian, the same scales, the same
// fifty outputs. Neither side looks at guards; runs that pass an event are left out.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "benchmarks/peers/measure.hpp"
#include "dalembert/sundials.hpp"
#include "dalembert/work_precision.hpp"

namespace peers {

using dalembert::Method;
using dalembert::Outcome;
using dalembert::Status;
using dalembert::SundialsMethod;

inline constexpr std::size_t points = 50;
inline constexpr std::size_t most_steps = 300000;

struct Peer {
    const char* name;
    SundialsMethod method;
};
inline constexpr Peer sundials_methods[] = {{"cvode bdf", SundialsMethod::bdf},    {"cvode adams", SundialsMethod::adams}, {"arkode erk5", SundialsMethod::erk5}, {"arkode erk6", SundialsMethod::erk6},
                                            {"arkode erk8", SundialsMethod::erk8}, {"arkode dirk4", SundialsMethod::dirk4}, {"arkode dirk5", SundialsMethod::dirk5}};

/// The states at the output points, of which a run writes.
template <class Scalar, std::size_t n>
struct Track {
    std::array<std::array<Scalar, n>, points + 1> rows{};
    std::size_t count = 0;
};

template <class Problem>
class Machine {
public:
    using System = typename Problem::System;
    using Scalar = typename Problem::Scalar;
    using State = typename System::State;
    static constexpr std::size_t n = std::tuple_size<State>::value;
    using Rows = Track<Scalar, n>;

    Machine() : inputs_(Problem::inputs(system_)), start_(Problem::start(system_)) {}

    void set_scale(const std::vector<double>& scale) {
        for (std::size_t i = 0; i < n; ++i) scale_[i] = Scalar(scale[i]);
    }

    Outcome ours(Method method, double tolerance, Rows& rows, std::size_t limit = most_steps) const {
        const auto options = options_for(tolerance, limit);
        auto chosen = options;
        chosen.method = method;
        dalembert::detail::SystemDerivatives<System, Inputs> derivatives(system_, inputs_, options.scale);
        State x = start_;
        rows.count = 0;
        const auto rhs = [this](const State& at, Scalar t, State& dxdt) { system_.rhs(at, inputs_(at, t), t, dxdt); };
        const auto observe = observer(rows);
        if constexpr (has_taylor)
            if (method == Method::taylor) {
                const dalembert::detail::SystemSeries<System, Inputs> series(system_, inputs_);
                dalembert::detail::NoGuards none;
                dalembert::detail::Integration<State, decltype(rhs), decltype(observe), dalembert::detail::NoGuards, 0> run(rhs, x, Scalar(0), Scalar(Problem::until), chosen, observe, none, {});
                return dalembert::detail::run_taylor(run, series);
            }
        return dalembert::integrate(rhs, derivatives, x, Scalar(0), Scalar(Problem::until), chosen, observe);
    }

    Outcome theirs(SundialsMethod method, double tolerance, Rows& rows, double until = Problem::until) const {
        State x = start_;
        rows.count = 0;
        return dalembert::simulate_with_sundials(method, system_, inputs_, x, 0.0, until, options_for(tolerance, most_steps), observer(rows));
    }

    /// As `simulate` has it, with what guards find.
    Outcome with_guards(Method method, double tolerance) const {
        State x = start_;
        auto options = options_for(tolerance, 10 * most_steps);
        options.method = method;
        std::array<bool, std::tuple_size<typename System::Guards>::value> ends{};
        for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = System::guard_table()[i].ends;
        dalembert::detail::SystemDerivatives<System, Inputs> derivatives(system_, inputs_, options.scale);
        return dalembert::integrate([this](const State& at, Scalar t, State& dxdt) { system_.rhs(at, inputs_(at, t), t, dxdt); }, derivatives, x, Scalar(0), Scalar(Problem::until), options, [](Scalar, const State&) {},
                                    [this](const State& at, Scalar t, typename System::Guards& g) { system_.guards(at, inputs_(at, t), t, g); }, ends);
    }

private:
    using Inputs = decltype(Problem::inputs(std::declval<const System&>()));
    static constexpr bool has_taylor = dalembert::detail::can_make_series<System, Inputs>();

    dalembert::IntegrationOptions<State> options_for(double tolerance, std::size_t limit) const {
        dalembert::IntegrationOptions<State> options;
        options.tolerance = Scalar(tolerance);
        options.scale = scale_;
        options.intervals = points;
        options.kinks = Problem::kinks();
        options.max_steps = limit;
        return options;
    }
    static auto observer(Rows& rows) {
        return [&rows](Scalar, const State& x) { rows.rows[rows.count++] = x; };
    }

    System system_ = Problem::system();
    Inputs inputs_;
    State start_;
    State scale_ = dalembert::IntegrationOptions<State>::filled(Scalar(1));
};

/// The best that is known, its own error (from a second run to a hundredfold tolerance), and how far each state reaches.
struct Reference {
    std::vector<std::vector<long double>> rows;
    std::vector<double> reach;    ///< 0: nothing but errors is seen
    double error = 0;
    std::string by;
};

template <class Machine>
bool find_reference(Machine& machine, Method method, double tolerance, const char* by, Reference& reference) {
    static typename Machine::Rows worse, best;
    if (machine.ours(method, 100 * tolerance, worse, 3000000).status != Status::success || machine.ours(method, tolerance, best, 10000000).status != Status::success) return false;
    reference.by = by;
    reference.error = 0;
    reference.reach.assign(Machine::n, 0);
    for (std::size_t i = 0; i < Machine::n; ++i) {
        long double reach = 0, error = 0;
        for (std::size_t k = 0; k <= points; ++k) {
            reach = std::max<long double>(reach, std::fabs(best.rows[k][i]));
            error = std::max<long double>(error, std::fabs(best.rows[k][i] - worse.rows[k][i]));
        }
        if (!(reach > 1000 * error)) continue;
        reference.reach[i] = static_cast<double>(reach);
        reference.error = std::max(reference.error, static_cast<double>(error / reach));
    }
    reference.rows.clear();
    for (const auto& row : best.rows) reference.rows.emplace_back(row.begin(), row.end());
    return true;
}

template <class Rows>
double error_of(const Rows& rows, const Reference& reference) {
    if (rows.count != points + 1) return INFINITY;
    long double worst = 0;
    for (std::size_t k = 0; k <= points; ++k)
        for (std::size_t i = 0; i < reference.reach.size(); ++i) {
            if (!(reference.reach[i] > 0)) continue;
            const long double error = std::fabs(rows.rows[k][i] - reference.rows[k][i]) / reference.reach[i];
            if (!(error <= worst)) worst = error;
        }
    return std::isnan(worst) ? INFINITY : static_cast<double>(worst);
}

/// The arguments are the name of the machine, that of the build of SUNDIALS, and files for the cheapest and for all runs.
template <template <class> class Problem>
int compare(int argc, char** argv) {
    if (argc != 5) return 2;
    const std::string name = argv[1], build = argv[2];
    static Machine<Problem<double>> machine;
    static Machine<Problem<long double>> precise;
    static typename Machine<Problem<double>>::Rows rows;
    const auto leave_out = [&](const std::string& why) {
        std::printf("%s is left out: %s\n", name.c_str(), why.c_str());
        return write_text(argv[3], "") && write_text(argv[4], "") ? 0 : 3;
    };

    std::array<char, 32> version{};
    SUNDIALSGetVersion(version.data(), static_cast<int>(version.size()));
    if (std::string(version.data()) != SUNDIALS_VERSION) return std::fprintf(stderr, "compiled for SUNDIALS %s, linked with %s\n", SUNDIALS_VERSION, version.data()), 3;

    Reference reference;
    constexpr double explicit_best = 1e-17, implicit_best = 1e-14;
    if (!find_reference(precise, Method::dop853, explicit_best, "dop853", reference) && !find_reference(precise, Method::rodas5p, implicit_best, "rodas5p", reference)) return leave_out("no reference is found");
    std::vector<double> scale = reference.reach;
    for (double& s : scale)
        if (!(s > 0)) s = 1;
    machine.set_scale(scale);
    precise.set_scale(scale);
    const Method usual = reference.by == "dop853" ? Method::dopri5 : Method::rodas5p;
    const Outcome watched = machine.with_guards(usual, 1e-9);
    if (watched.events > 0) return leave_out("it passes " + std::to_string(watched.events) + " events");
    if (watched.status != Status::success) return leave_out(std::string("it ends with '") + to_string(watched.status) + "' at t = " + std::to_string(watched.t) + " s");
    // Once more with the scales; those above were 1.
    if (!find_reference(precise, usual == Method::dopri5 ? Method::dop853 : Method::rodas5p, usual == Method::dopri5 ? explicit_best : implicit_best, reference.by.c_str(), reference)) return leave_out("no reference is found");

    std::vector<Candidate> candidates;
    for (const auto& named : dalembert::detail::named_methods) {
        dalembert::IntegrationOptions<typename Machine<Problem<double>>::State> options;
        options.method = named.method;
        if (options.has_fixed_steps()) continue;
        sweep(candidates, true, named.name, [&, method = named.method](double tolerance) { return machine.ours(method, tolerance, rows).status == Status::success; }, [&] { return error_of(rows, reference); });
    }
    for (const Peer& peer : sundials_methods)
        sweep(candidates, false, peer.name, [&, method = peer.method](double tolerance) { return machine.theirs(method, tolerance, rows).status == Status::success; }, [&] { return error_of(rows, reference); });

    std::string cheapest, all;
    for (const Candidate& c : candidates) all += name + "," + build + "," + c.line() + "\n";
    for (const double target : {1e-6, 1e-9}) {
        const Pair pair = time_in_turns(candidates, target);
        double setup = 0;
        for (const Peer& peer : sundials_methods)
            if (pair.theirs != nullptr && pair.theirs->method == peer.name) setup = shortest([&, method = peer.method] { (void)machine.theirs(method, 1e-6, rows, 0.0); });
        cheapest += name + "," + build + "," + std::to_string(Machine<Problem<double>>::n) + "," + text_of(target) + "," + (pair.ours != nullptr ? pair.ours->line() : Candidate::no_line()) + "," +
                    (pair.theirs != nullptr ? pair.theirs->line() : Candidate::no_line()) + "," + text_of(setup * 1e6) + "," + reference.by + "," + text_of(reference.error) + "\n";
    }
    std::printf("%s", cheapest.c_str());
    return write_text(argv[3], cheapest) && write_text(argv[4], all) ? 0 : 3;
}

}  // namespace peers
