// SPDX-License-Identifier: BSL-1.0
// Timed runs of one problem with any method in any arithmetic: a part of the programs that `dalembert cost` writes.
#pragma once

#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "dalembert/constraints.hpp"
#include "dalembert/scales.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// How one run is made. A step that is not zero is that of every step.
struct RunRequest {
    Method method = Method::dopri5;
    double tolerance = 1e-9;
    double step = 0;          ///< s
    std::size_t points = 50;  ///< the run is divided into so many parts
    double disturbance = 0;   ///< relative, of the start
    double limit = 10;        ///< s, after which the program gives up
    double enough = 0;        ///< s; runs are repeated until all together took so long
};

struct TimedRun {
    Outcome outcome;
    double energy_error = 0;
    double constraint_error = 0;                 ///< largest position that should be zero, in its own unit
    std::vector<double> seconds;                 ///< of each repetition
    std::vector<std::vector<long double>> rows;  ///< time and compared values, at the output points
};

/// Compared values of one run, at its output points.
template <class Scalar>
struct Rows {
    std::vector<std::vector<Scalar>> values;
    double constraint_error = 0;
};

template <class System, class Scalar>
void note_constraints([[maybe_unused]] const System& system, [[maybe_unused]] const typename System::State& x, [[maybe_unused]] Scalar t,
                      [[maybe_unused]] double& error) {
    if constexpr (needs_projection<System> && !is_switching<System>) {
        typename System::Constraints f{};
        system.constraint_positions(x, t, f);
        error = std::max(error, static_cast<double>(largest(f)));
    }
}

/// Where nothing switches and nothing comes from outside, steps may be longer than the distance of two output points.
template <class System>
constexpr bool has_jumps() {
    if constexpr (is_switching<System>)
        return true;
    else
        return std::tuple_size<typename System::Guards>::value > 0 || std::tuple_size<typename System::Input>::value > 0;
}

template <class Problem, class Options, class Scales>
void set_request(Options& options, const RunRequest& request, const Scales& scales) {
    using Scalar = typename Problem::System::scalar_type;
    options.method = request.method;
    options.tolerance = Scalar(request.tolerance);
    options.step = Scalar(request.step);
    options.is_fixed = request.step > 0;
    options.intervals = request.points;
    options.kinks = Problem::kinks();
    if (has_jumps<typename Problem::System>()) options.max_step = Scalar(Problem::until / static_cast<double>(request.points));
    std::copy(scales.begin(), scales.end(), options.scale.begin());
    options.scale.back() = std::numeric_limits<Scalar>::max() / Scalar(1e10);  // the work is looked at, and shortens no step
}

/// One run. A Problem has the types of its system, system(), start(), inputs(system) and `until`; row(sample) returns the compared values.
template <class Problem>
std::pair<Outcome, double> run_once(const RunRequest& request, const typename Problem::System::State& scales,
                                    Rows<typename Problem::System::scalar_type>& rows) {
    using System = typename Problem::System;
    using Scalar = typename System::scalar_type;
    const System system = Problem::system();
    typename System::State x = Problem::start(system);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += Scalar(i % 2 == 0 ? request.disturbance : -request.disturbance) * x[i];  // not all along the state
    const auto inputs = Problem::inputs(system);
    const auto observe = [&](const typename Running<System>::Sample& sample) {
        rows.values.push_back(Problem::row(sample));
        rows.values.back().insert(rows.values.back().begin(), sample.t);
        note_constraints(system, sample.x, sample.t, rows.constraint_error);
    };
    const auto end = static_cast<Scalar>(Problem::until);
    typename Running<System>::Options options;
    set_request<Problem>(options, request, scales);
    const auto result = Running<System>::run(system, inputs, x, end, options, observe);
    return {result.outcome, result.energy.relative_error()};
}

/// Found by the user of a method once, and not a part of its time.
template <class Problem>
typename Problem::System::State scales_of(std::size_t points) {
    const auto system = Problem::system();
    return state_scales(system, Problem::inputs(system), Problem::start(system),
                        static_cast<typename Problem::System::scalar_type>(Problem::until), points);
}

template <class Problem>
TimedRun timed_run(const RunRequest& request) {
    using Scalar = typename Problem::System::scalar_type;
    TimedRun result;
    double total = 0;
    const auto scales = scales_of<Problem>(request.points);
    do {
        Rows<Scalar> rows;
        rows.values.reserve(request.points + 2);
        const auto begin = std::chrono::steady_clock::now();
        std::tie(result.outcome, result.energy_error) = run_once<Problem>(request, scales, rows);
        result.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        total += result.seconds.back();
        if (result.rows.empty()) {
            result.constraint_error = rows.constraint_error;
            for (const auto& row : rows.values) {
                result.rows.emplace_back();
                for (const Scalar& value : row) result.rows.back().push_back(static_cast<long double>(value));
            }
        }
        // Three at least, so that one that was disturbed is seen; but of what takes long, one.
    } while (request.enough > 0 && result.seconds.size() < 1000 &&
             (total < request.enough || (result.seconds.size() < 3 && total < 50 * request.enough)));
    return result;
}

extern "C" inline void give_up(int) {
    constexpr char text[] = "status=too slow\n";
    const auto written = ::write(STDOUT_FILENO, text, sizeof text - 1);
    ::_exit(written > 0 ? 0 : 1);
}

/// Runs the program of one arithmetic, and writes its rows into a file. Returns the exit code.
template <class Problem>
int measure(const RunRequest& request, const char* path) {
    const TimedRun run = timed_run<Problem>(request);
    std::FILE* file = std::fopen(path, "w");
    if (file == nullptr) return 3;
    for (const auto& row : run.rows) {
        for (const long double value : row) std::fprintf(file, "%.21Lg ", value);
        std::fputs("\n", file);
    }
    if (std::fclose(file) != 0) return 3;
    std::string seconds;
    for (const double s : run.seconds) seconds += (seconds.empty() ? "" : " ") + std::to_string(s * 1e6);
    const Outcome& outcome = run.outcome;
    std::printf("status=%s\nt=%.17g\nsteps=%zu\nrejected=%zu\nrhs_calls=%zu\nenergy_error=%.3g\nconstraint_error=%.3g\nmicroseconds=%s\n",
                to_string(outcome.status), outcome.t, outcome.steps, outcome.rejected, outcome.rhs_calls, run.energy_error,
                run.constraint_error, seconds.c_str());
    return 0;
}

template <class Scalar>
constexpr const char* name_of_arithmetic() {
    switch (std::numeric_limits<Scalar>::digits) {
        case std::numeric_limits<float>::digits:
            return "float";
        case std::numeric_limits<double>::digits:
            return "double";
        case std::numeric_limits<long double>::digits:
            return "long_double";
        default:
            return "digits50";
    }
}

/// The arguments are arithmetic, method, tolerance, step, number of parts of the run, disturbance, limit and least time of measurement in
/// seconds, and a file for the rows.
template <template <class> class Problem, class... Scalars>
int measure_program(int argc, char** argv) {
    if (argc != 10) return 2;
    const auto number = [&](int i) { return std::strtod(argv[i], nullptr); };
    RunRequest request;
    for (const MethodSpec& named : methods_of_integration)
        if (std::string(argv[2]) == named.name) request.method = named.method;
    request.tolerance = number(3);
    request.step = number(4);
    request.points = static_cast<std::size_t>(number(5));
    request.disturbance = number(6);
    request.limit = number(7);
    request.enough = number(8);
    std::signal(SIGALRM, give_up);
    ::alarm(static_cast<unsigned>(std::ceil(request.limit)));
    int code = 2;
    (void)((std::string(argv[1]) == name_of_arithmetic<Scalars>() && (code = measure<Problem<Scalars>>(request, argv[9]), true)) || ...);
    return code;
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
