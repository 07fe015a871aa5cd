// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/second_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "prove/constraint_validity.hpp"
#include "run/in_parallel.hpp"
#include "run/plant_run.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

using RowsOfRun = std::vector<std::vector<double>>;
constexpr std::size_t steps_of_moved = detail::steps_of_extrapolation;

/// First derivatives of the moved runs: for each value that is moved and each step, those of the run behind and of the one ahead.
std::vector<std::array<std::array<RowsOfRun, 2>, steps_of_moved>> rows_of_moved(const dalembert_plant& plant,
                                                                                const std::vector<MovedRuns>& moved) {
    std::vector<std::array<std::array<RowsOfRun, 2>, steps_of_moved>> rows(moved.size());
    const auto work = [&](std::size_t k) -> RowsOfRun {
        const MovedRuns::Pair& pair = moved[k / (2 * steps_of_moved)].pairs[k / 2 % steps_of_moved];
        const std::optional<PlantRun>& run = k % 2 == 0 ? pair.behind : pair.ahead;
        if (!run) return {};
        PlantRunResult result = simulate_plant(plant, *run);
        return result.of_sensitivities.status == Status::success ? std::move(result.sensitivities.rows) : RowsOfRun{};
    };
    in_parallel(2 * steps_of_moved * moved.size(), work,
                [&](std::size_t k, RowsOfRun found) { rows[k / (2 * steps_of_moved)][k / 2 % steps_of_moved][k % 2] = std::move(found); });
    return rows;
}

/// The derivative of one first derivative by a value that is moved, in the row of this time. A run that an event ended has its last row at
/// another time: that row does not count.
detail::Extrapolated<double> second_by_differences(const std::array<std::array<RowsOfRun, 2>, steps_of_moved>& rows, const MovedRuns& moved,
                                                   std::size_t row, double time, std::size_t entry) {
    std::array<double, steps_of_moved> differences{};
    for (std::size_t k = 0; k < steps_of_moved; ++k) {
        const auto& [behind, ahead] = rows[k];
        const bool is_there = row < behind.size() && row < ahead.size() && behind[row][0] == time && ahead[row][0] == time;
        differences[k] =
            is_there ? (ahead[row][entry] - behind[row][entry]) / moved.pairs[k].distance : std::numeric_limits<double>::quiet_NaN();
    }
    return detail::extrapolated(differences);
}

/// Replaces each number by NaN whose doubt is above a thousandth of the largest number of its column. A column that is small beside its
/// natural size counts as a thousandth of that: what is zero but for rounding is certain too.
void leave_out_doubtful(SecondOrder& second, const RowsOfRun& doubts, const std::vector<double>& sizes) {
    constexpr double worst = 1e-3, nothing = 1e-3;
    RowsOfRun& rows = second.recording.rows;
    for (std::size_t column = 1; column < second.recording.columns.size(); ++column) {
        const double small = nothing * sizes[column];
        double largest = small;
        for (std::size_t r = 0; r < rows.size(); ++r)
            if (doubts[r][column] <= worst * std::fabs(rows[r][column])) largest = std::max(largest, std::fabs(rows[r][column]));
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const double doubt = doubts[r][column];
            if (doubt <= worst * largest) {
                ++second.numbers;
                if (largest > small) second.doubt = std::max(second.doubt, doubt / largest);
            } else {
                ++second.left_out;
                rows[r][column] = std::numeric_limits<double>::quiet_NaN();
            }
        }
    }
}

}  // namespace

std::vector<MovedRuns> moved_runs(const std::vector<NamedVariable>& named, const System& system, const Values& values,
                                  const SimulationSettings& settings, const KinksOfRun& kinks) {
    SimulationSettings tight = settings;
    tight.tolerance = std::max(1e-12, settings.tolerance / 1000);  // differences lose digits
    const auto run_with = [&](const NamedVariable& one, const ex& value) -> std::optional<PlantRun> {
        try {
            Values there = values;
            set_varied(*one.variable, there, value);
            const KinksOfRun kinks_there = [&](const auto& change) {
                return kinks([&](const System& mode, Values& of_mode) {
                    set_varied(*one.variable, of_mode, value);
                    change(mode, of_mode);
                });
            };
            std::vector<VariedOfRun> varied = varied_of_run(named, system, there, kinks_there);
            tight.kinks = kinks_there([](const System&, Values&) {});
            meet_constraints(system, there);
            PlantRun run = run_of_plant(system, there, tight);
            run.varied = std::move(varied);
            return run;
        } catch (const Failure&) {
            return std::nullopt;  // as where a tank would be larger than its room
        }
    };
    std::vector<MovedRuns> moved(named.size());
    for (std::size_t d = 0; d < named.size(); ++d) {
        const ex value = varied_value(*named[d].variable, values, system);
        const auto number = value_at(value, values.substitution(), 40);
        const ex size = number && !cln::zerop(*number) ? ex(GiNaC::numeric(cln::rationalize(cln::abs(*number)))) : ex(1);
        ex step = size * GiNaC::numeric(1, static_cast<long>(1 / detail::longest_step_of_extrapolation));
        for (MovedRuns::Pair& pair : moved[d].pairs) {
            pair = {2 * cln::double_approx(*value_at(step, {}, 40)), run_with(named[d], value - step), run_with(named[d], value + step)};
            step /= 2;
        }
    }
    return moved;
}

SecondOrder second_order_of(const dalembert_plant& plant, const std::vector<VariedOfRun>& varied, const PlantRunResult& result,
                            const std::vector<MovedRuns>& moved) {
    const Recording& first = result.sensitivities;
    const std::size_t count = (first.columns.size() - 1) / varied.size();
    SecondOrder second;
    second.recording.columns = {first.columns[0]};
    for (std::size_t c = 0; c < varied.size(); ++c)
        for (std::size_t d = c; d < varied.size(); ++d)
            for (std::size_t i = 0; i < count; ++i) {
                const Column& of = first.columns[1 + c * count + i];
                const std::string name = of.name.substr(0, of.name.rfind("/d("));
                second.recording.columns.push_back({fmt::format("d2{}/(d({})d({}))", name.substr(1), varied[c].name, varied[d].name),
                                                    quotient_of_units(of.unit, varied[d].unit)});
            }
    const auto rows = rows_of_moved(plant, moved);
    // The natural size of a column: the largest value of the state or output, divided by the sizes of both that are varied.
    std::vector<double> sizes{0};
    const auto largest = [&](std::size_t i) {
        double value = 0;
        for (const auto& row : result.recording.rows) value = std::max(value, std::fabs(row[1 + i]));
        return value;
    };
    const auto size_of_moved = [&](std::size_t c) { return moved[c].pairs[0].distance / 2 / detail::longest_step_of_extrapolation; };
    for (std::size_t c = 0; c < varied.size(); ++c)
        for (std::size_t d = c; d < varied.size(); ++d)
            for (std::size_t i = 0; i < count; ++i) sizes.push_back(largest(i) / size_of_moved(c) / size_of_moved(d));
    RowsOfRun doubts;
    for (std::size_t r = 0; r < first.rows.size(); ++r) {
        std::vector<double> row{first.rows[r][0]}, doubt{0};
        for (std::size_t c = 0; c < varied.size(); ++c)
            for (std::size_t d = c; d < varied.size(); ++d)
                for (std::size_t i = 0; i < count; ++i) {
                    auto found = second_by_differences(rows[d], moved[d], r, first.rows[r][0], 1 + c * count + i);
                    if (c != d) {
                        const auto other = second_by_differences(rows[c], moved[c], r, first.rows[r][0], 1 + d * count + i);
                        if (other.doubt < found.doubt) found = other;
                    }
                    row.push_back(found.value);
                    doubt.push_back(found.doubt);
                }
        second.recording.rows.push_back(std::move(row));
        doubts.push_back(std::move(doubt));
    }
    leave_out_doubtful(second, doubts, sizes);
    return second;
}

}  // namespace dalembert
