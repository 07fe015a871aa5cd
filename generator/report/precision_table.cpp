// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/precision_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "graph/separable.hpp"
#include "plant/methods.hpp"

namespace dalembert {

std::vector<std::string> measured_methods(const std::vector<std::string>& wanted, const PreparedRun& run) {
    std::vector<std::string> methods;
    for (const std::string& name : method_names())
        if (is_wanted(wanted, name) && (name != "symplectic" || is_separable(*run.machine.system)) &&
            (name != "taylor" || run.settings.series))
            methods.push_back(name);
    return methods;
}

bool is_wanted(const std::vector<std::string>& wanted, const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

std::string csv_titles() {
    return "scene,size,arithmetic,method,tolerance,step [s],status,end [s],steps,rejected,rhs_calls,time [us],time_lowest "
           "[us],time_highest [us],"
           "error_at_end,error_on_the_way,energy_error,constraint_error,good\n";
}

std::string csv_line(const std::string& scene, const std::string& size, const WorkPoint& p) {
    return fmt::format("{},{},{},{},{:g},{:.9g},{},{:.9g},{},{},{},{:.6g},{:.6g},{:.6g},{:.4g},{:.4g},{:.4g},{:.4g},{}\n", scene, size,
                       p.plan.arithmetic, p.plan.method, p.plan.tolerance, p.plan.step, p.status, p.t, p.steps, p.rejected, p.rhs_calls,
                       p.microseconds, p.fastest, p.slowest, p.error_at_end, p.error, p.energy_error, p.constraint_error,
                       p.is_good ? 1 : 0);
}

std::optional<WorkPoint> read_csv_line(const std::string& line) {
    std::istringstream text(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    constexpr std::size_t columns = 19;
    if (cells.size() != columns) return std::nullopt;
    const auto number = [&](std::size_t i) { return std::strtod(cells[i].c_str(), nullptr); };
    const auto whole = [&](std::size_t i) { return static_cast<std::size_t>(std::strtoull(cells[i].c_str(), nullptr, 10)); };
    return WorkPoint{{cells[2], cells[3], number(4), number(5)},
                     cells[6],
                     number(7),
                     whole(8),
                     whole(9),
                     whole(10),
                     number(11),
                     number(12),
                     number(13),
                     number(14),
                     number(15),
                     number(16),
                     number(17),
                     cells[18] == "1"};
}

const WorkPoint* cheapest(const std::vector<WorkPoint>& points, double error, const std::string& arithmetic, const std::string& method) {
    const WorkPoint* best = nullptr;
    for (const WorkPoint& p : points) {
        if (!p.is_good || !(p.error <= error) || (!arithmetic.empty() && p.plan.arithmetic != arithmetic) ||
            (!method.empty() && p.plan.method != method))
            continue;
        if (best == nullptr || p.fastest < best->fastest) best = &p;
    }
    return best;
}

const WorkPoint* most_accurate(const std::vector<WorkPoint>& points, const std::string& arithmetic) {
    const WorkPoint* best = nullptr;
    for (const WorkPoint& p : points)
        if (p.is_good && p.plan.arithmetic == arithmetic && (best == nullptr || p.error < best->error)) best = &p;
    return best;
}

std::string name_of(const RunPlan& plan) {
    const std::string arithmetic = plan.arithmetic == "long_double" ? "long double"
                                   : plan.arithmetic == "digits50"  ? "50 digits"
                                                                    : plan.arithmetic;
    return plan.step > 0 ? fmt::format("{}, {} with steps of {:.3g} s", arithmetic, plan.method, plan.step)
                         : fmt::format("{}, {} at {:.0e}", arithmetic, plan.method, plan.tolerance);
}

std::string error_text(const ReferenceRun& reference) {
    return reference.error > 1e-18 ? fmt::format("{:.1e}", reference.error) : "below 1e-18";
}

}  // namespace dalembert
