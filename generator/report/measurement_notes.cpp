// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/measurement_notes.hpp"

#include <fmt/format.h>

#include <fstream>

#include "report/precision_table.hpp"

namespace dalembert {

namespace {

/// As precise as lines are.
bool is_same(const RunPlan& a, const RunPlan& b) {
    const auto numbers = [](const RunPlan& plan) { return fmt::format("{:g} {:.9g}", plan.tolerance, plan.step); };
    return a.arithmetic == b.arithmetic && a.method == b.method && numbers(a) == numbers(b);
}

}  // namespace

MeasurementNotes::MeasurementNotes(std::filesystem::path path, std::uint64_t fingerprint)
    : path_(std::move(path)), title_(fmt::format("{:016x}", fingerprint)) {
    std::ifstream file(path_);
    std::string line;
    if (!std::getline(file, line) || line != title_) return;
    while (std::getline(file, line)) {
        // Of a line that is not whole nothing is taken.
        const auto point = read_csv_line(line);
        if (!point || file.eof()) break;
        known_.push_back(*point);
    }
}

const WorkPoint* MeasurementNotes::find(const RunPlan& plan) const {
    for (const WorkPoint& p : known_)
        if (is_same(p.plan, plan)) return &p;
    return nullptr;
}

void MeasurementNotes::write(const std::vector<WorkPoint>& points) const {
    std::string text = title_ + "\n";
    for (const WorkPoint& p : points) text += csv_line("", "", p);
    write_files({{path_, text}});
}

}  // namespace dalembert
