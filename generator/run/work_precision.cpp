// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <sstream>

#include "run/closed_forms.hpp"
#include "run/run_header.hpp"
#include "plant/methods.hpp"
#include "text/digest.hpp"

namespace dalembert {

namespace {

constexpr int points = 50;  ///< output points of a run
constexpr double tried_disturbance = 1e-12;

Rows read_rows(const std::string& text) {
    Rows rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; cells >> cell;) rows.back().push_back(std::strtold(cell.c_str(), nullptr));
    }
    return rows;
}

bool is_end(const std::string& status) { return status == "success" || status == "event"; }

std::size_t count(const std::map<std::string, std::string>& said, const char* key) {
    return said.contains(key) ? std::stoul(said.at(key)) : 0;
}
double number(const std::map<std::string, std::string>& said, const char* key) {
    return said.contains(key) ? std::strtod(said.at(key).c_str(), nullptr) : 0;
}

double largest(const std::vector<double>& values, std::size_t count) {
    double result = 0;
    for (std::size_t i = 0; i < std::min(count, values.size()); ++i)
        if (!(values[i] <= result)) result = values[i];
    return result;
}

}  // namespace

std::vector<double> differences(const Rows& a, const Rows& b, const std::vector<double>& scales) {
    std::vector<double> result;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        const long double span = b.back()[0];
        long double worst = span > 0 ? std::fabs(a[i][0] - b[i][0]) / span : 0;
        for (std::size_t c = 0; c < scales.size(); ++c) {
            if (!(scales[c] > 0)) continue;
            const long double difference = std::fabs(a[i][c + 1] - b[i][c + 1]) / scales[c];
            if (!(difference <= worst)) worst = difference;
        }
        result.push_back(static_cast<double>(worst));
    }
    return result;
}

std::vector<double> scales_of(const Rows& rows, const Rows& worse) {
    std::vector<double> scales;
    for (std::size_t c = 1; !rows.empty() && c < rows[0].size(); ++c) {
        long double magnitude = 0;
        long double error = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            magnitude = std::max(magnitude, std::fabs(rows[i][c]));
            if (i < worse.size()) error = std::max(error, std::fabs(rows[i][c] - worse[i][c]));
        }
        constexpr double beyond_errors = 1000;
        scales.push_back(magnitude > beyond_errors * error ? static_cast<double>(magnitude) : 0);
    }
    return scales;
}

WorkPrecision::WorkPrecision(PreparedRun run, const Limits& limits, const std::vector<std::string>& measured)
    : run_(std::move(run)), limits_(limits) {
    Code& code = *run_.machine.code;
    source_ = work_precision_source(code, run_.header, run_.values, run_.settings, measured);
    reference_source_ = work_precision_source(code, run_.header, run_.values, run_.settings, {"double", "long_double", "digits50"});
    program_ = std::make_unique<ScratchFolder>();
    reference_program_ = std::make_unique<ScratchFolder>();
    auto other =
        std::async(std::launch::async, [this] { compile_with_header(*reference_program_, run_.header, reference_source_, "-O1"); });
    compile_with_header(*program_, run_.header, source_, "-O2");
    other.get();
}

std::uint64_t WorkPrecision::fingerprint() const {
    std::uint64_t result = 14695981039346656037ULL;
    for (const std::string& text : {run_.header.text, source_, reference_source_, fmt::format("{} {}", limits_.run, limits_.repeat)})
        result = digest(text, result);
    return result;
}

WorkPrecision::Made WorkPrecision::make(const ScratchFolder& program, const RunPlan& plan, double disturbance, double limit,
                                        double repeat) const {
    const std::string file = program.path() + "/rows";
    const auto text = [](double value) { return fmt::format("{}", value); };
    Made made;
    made.said = run_compiled(program, {plan.arithmetic, plan.method, text(plan.tolerance > 0 ? plan.tolerance : 1), text(plan.step),
                                       std::to_string(points), text(disturbance), text(limit), text(repeat), file});
    if (made.said.at("status") != "too slow") made.rows = read_rows(read_file(file));
    return made;
}

bool WorkPrecision::try_reference(const RunPlan& plan, double coarser) {
    RunPlan other = plan;
    other.tolerance *= coarser;
    const Made worse = make(*reference_program_, other, 0, limits_.reference, 0);
    if (!is_end(worse.said.at("status"))) return false;
    const Made best = make(*reference_program_, plan, 0, limits_.reference, 0);
    if (best.said.at("status") != worse.said.at("status") || best.rows.empty()) return false;
    const std::vector<double> scales = scales_of(best.rows, worse.rows);
    reference_ = {plan, best.rows, best.said.at("status"), 0, scales, {}, {}, best.rows.size()};
    find_growth();
    reference_.error = largest(differences(worse.rows, best.rows, scales), reference_.counted);
    return std::isfinite(reference_.error);
}

/// A start that is a little different shows how much of an error is left to the method: a double that is rounded at the start is off by as
/// much at the end.
void WorkPrecision::find_growth() {
    RunPlan plan{"long_double", reference_.plan.method, std::max(reference_.plan.tolerance, 1e-16), 0};
    const Made plain = make(*reference_program_, plan, 0, limits_.reference, 0);
    const Made disturbed = make(*reference_program_, plan, tried_disturbance, limits_.reference, 0);
    if (plain.rows.empty() || disturbed.rows.empty()) return;
    constexpr double too_much = 1e8, still_good = 1e5;
    const std::vector<double> growth = differences(disturbed.rows, plain.rows, reference_.scales);
    reference_.growth = largest(growth, growth.size()) / tried_disturbance;
    if (!(*reference_.growth > too_much)) return;
    reference_.counted = 1;
    while (reference_.counted < growth.size() && growth[reference_.counted] < still_good * tried_disturbance) ++reference_.counted;
}

void WorkPrecision::find_reference() {
    integrate_reference();
    use_closed_forms(run_, reference_);
}

void WorkPrecision::integrate_reference() {
    // What 50 digits cost is known from a run in double: steps grow like the root of the order, and operations are so much slower.
    constexpr double slower = 400;
    const Made quick = make(*reference_program_, {"double", "dop853", 1e-9, 0}, 0, limits_.run, 0);
    const bool is_explicit = is_end(quick.said.at("status"));
    const double seconds = number(quick.said, "microseconds") * 1e-6;
    const auto work = [&](double tolerance) { return seconds * std::pow(1e-9 / tolerance, 1.0 / 8); };
    if (is_explicit && work(1e-22) * slower < limits_.reference && try_reference({"digits50", "dop853", 1e-22, 0}, 100)) return;
    if (is_explicit && work(1e-17) * 8 < limits_.reference && try_reference({"long_double", "dop853", 1e-17, 0}, 100)) return;
    if (try_reference({"long_double", "rodas5p", 1e-14, 0}, 100)) return;
    if (try_reference({"double", "rodas5p", 1e-12, 0}, 100)) return;
    if (try_reference({"double", "dop853", 1e-13, 0}, 100)) return;
    throw RunStopped(
        fmt::format("{}: no method computes a reference of the run to t = {} s within {} s; the run may stop, or is too long: see "
                    "`dalembert simulate`, --until and --limit",
                    run_.name, run_.settings.until, limits_.reference));
}

WorkPoint WorkPrecision::measure(const RunPlan& plan) const {
    const Made made = make(*program_, plan, 0, limits_.run, limits_.repeat);
    const auto& said = made.said;
    WorkPoint point{plan, said.at("status")};
    point.t = number(said, "t");
    point.steps = count(said, "steps");
    point.rejected = count(said, "rejected");
    point.rhs_calls = count(said, "rhs_calls");
    point.energy_error = number(said, "energy_error");
    point.constraint_error = number(said, "constraint_error");
    point.is_good = point.status == reference_.status && made.rows.size() == reference_.rows.size();
    if (!said.contains("microseconds")) return point;
    std::istringstream texts(said.at("microseconds"));
    std::vector<double> times;
    for (double time = 0; texts >> time;) times.push_back(time);
    std::sort(times.begin(), times.end());
    point.microseconds = times[times.size() / 2];
    point.fastest = times.front();
    point.slowest = times[(times.size() * 9) / 10];
    const std::vector<double> errors = differences(made.rows, reference_.rows, reference_.scales);
    point.error = largest(errors, reference_.counted);
    point.error_at_end = errors.empty() ? 0 : errors[std::min(errors.size(), reference_.counted) - 1];
    point.is_good = point.is_good && std::isfinite(point.error);
    return point;
}

std::optional<RunPlan> WorkPrecision::next(const std::string& arithmetic, const std::string& method,
                                           const std::vector<WorkPoint>& before) const {
    if (!before.empty() && (before.back().status == "too slow" || before.back().status == "bad options")) return std::nullopt;
    const double coarsest = 1e-2, finest = arithmetic == "float" ? 1e-7 : 1e-13;
    if (!needs_step(method)) {
        const double tolerance = coarsest * std::pow(10.0, -static_cast<double>(before.size()));
        // Two that could not be met: those behind cannot either.
        if (before.size() > 1 && !before.back().is_good && !before[before.size() - 2].is_good && before.front().is_good)
            return std::nullopt;
        if (tolerance < finest / 2) return std::nullopt;
        return RunPlan{arithmetic, method, std::strtod(fmt::format("{:.0e}", tolerance).c_str(), nullptr), 0};
    }
    // Half the step as long as that makes the result better; roundings end it.
    constexpr std::size_t most = 20;
    if (before.size() == most) return std::nullopt;
    if (before.size() > 1) {
        const WorkPoint& last = before.back();
        const WorkPoint& other = before[before.size() - 2];
        if (last.is_good && (last.error < finest || (other.is_good && other.error < 1e-2 && last.error > other.error))) return std::nullopt;
    }
    return RunPlan{arithmetic, method, 0, run_.settings.until / points / std::pow(2.0, static_cast<double>(before.size()))};
}

}  // namespace dalembert
