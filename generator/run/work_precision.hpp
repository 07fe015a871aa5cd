// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy costs: one run of a machine with many methods, tolerances and arithmetics, against a reference that is far better.
#pragma once

#include <functional>

#include "run/simulation.hpp"

namespace dalembert {

/// How a run is made: to a tolerance, or with a fixed step.
struct RunPlan {
    std::string arithmetic;  ///< "float", "double", "long_double"; "digits50" of references
    std::string method;
    double tolerance = 0;    ///< 0 where the step is fixed
    double step = 0;         ///< s, of all steps; 0 where it is chosen
};

/// What is compared, at the output points of a run: first the time, then columns.
using Rows = std::vector<std::vector<long double>>;

/// A run that was made. Errors are relative to the largest magnitude that a column has in the reference.
struct WorkPoint {
    RunPlan plan;
    std::string status;       ///< "success", "event", or why there is no result
    double t = 0;             ///< s, where it ended
    std::size_t steps = 0, rejected = 0, rhs_calls = 0;
    double microseconds = 0, fastest = 0,
           slowest = 0;       ///< of the whole run: the median of its repetitions, and the range of nine in ten of them
    double error_at_end = 0;  ///< largest of all columns
    double error = 0;         ///< the same, on the way
    double energy_error = 0;  ///< max |E - E(0) - work| / max energy, on the way
    double constraint_error = 0;
    bool is_good = false;     ///< it came to the end that the reference has
};

/// The best that is known of a run.
struct ReferenceRun {
    RunPlan plan;
    Rows rows;
    std::string status;
    double error = 0;            ///< its own, from a second run with a hundredfold tolerance
    std::vector<double> scales;  ///< of the columns; 0: not compared, as it is zero but for errors
    std::optional<double> growth = {};  ///< of a small disturbance of the start, up to the end; nothing where a run of it takes too long
    std::vector<std::string> closed_forms = {};  ///< columns that are not integrated, but from closed forms of the run
    std::size_t counted = 0;     ///< rows in which errors are counted: before a disturbance has grown too much
    bool is_sensitive() const { return counted < rows.size(); }
    double until() const { return rows.empty() ? 0 : static_cast<double>(rows[counted - 1][0]); }
};

/// What differs between two runs at the same output points, up to `counted` rows: the largest of all columns relative to their scales, at
/// each row. An end at another time counts with its share of the run.
std::vector<double> differences(const Rows& a, const Rows& b, const std::vector<double>& scales);

/// The largest magnitude in each column; 0 where nothing but errors is seen.
std::vector<double> scales_of(const Rows& rows, const Rows& worse);

/// One machine, compiled for all arithmetics.
class WorkPrecision {
public:
    struct Limits {
        double run = 5;         ///< s of one run
        double reference = 60;  ///< s of the reference
        double repeat = 0.02;   ///< s that repetitions of one run take together
    };
    /// Compiles for the arithmetics that are to be measured; throws Failure (tool-failed).
    WorkPrecision(PreparedRun run, const Limits& limits, const std::vector<std::string>& measured);

    const PreparedRun& run() const { return run_; }
    const ReferenceRun& reference() const { return reference_; }
    /// Looks for a reference. Throws RunStopped where no method comes to an end; Failure (wrong-closed-form).
    void find_reference();
    WorkPoint measure(const RunPlan& plan) const;
    /// Those that are measured in one arithmetic, from coarse to fine: the next one, given those before; nothing at the end.
    std::optional<RunPlan> next(const std::string& arithmetic, const std::string& method, const std::vector<WorkPoint>& before) const;

    /// All that decides what is measured, as a number.
    std::uint64_t fingerprint() const;

private:
    struct Made {
        std::map<std::string, std::string> said;
        Rows rows;
    };
    Made make(const ScratchFolder& program, const RunPlan& plan, double disturbance, double limit, double repeat) const;
    void integrate_reference();
    bool try_reference(const RunPlan& plan, double coarser);
    void find_growth();

    PreparedRun run_;
    Limits limits_;
    std::string source_, reference_source_;
    std::unique_ptr<ScratchFolder> program_, reference_program_;
    ReferenceRun reference_;
};

inline constexpr std::array arithmetics{"float", "double", "long_double"};

}  // namespace dalembert
