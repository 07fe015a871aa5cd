// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that were measured are noted at once, so that a measurement that was stopped goes on where it was.
#pragma once

#include <filesystem>

#include "run/work_precision.hpp"

namespace dalembert {

class MeasurementNotes {
public:
    /// Reads what is there; nothing is taken from notes of something else.
    MeasurementNotes(std::filesystem::path path, std::uint64_t fingerprint);

    std::size_t count() const { return known_.size(); }
    const WorkPoint* find(const RunPlan& plan) const;
    /// All lines up to now; written whole, since a folder may be read by others.
    void write(const std::vector<WorkPoint>& points) const;
    void remove() const { std::filesystem::remove(path_); }

private:
    std::filesystem::path path_;
    std::string title_;
    std::vector<WorkPoint> known_;
};

}  // namespace dalembert
