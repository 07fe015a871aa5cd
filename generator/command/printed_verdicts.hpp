// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of the printed equations of a model after one or more of its scenes were checked.
#pragma once

#include "command/command_line.hpp"

namespace dalembert {

/// The verdict on one printed equation over all scenes that contain it.
struct PrintedRow {
    std::string id;
    const PrintedEquation* entry;
    std::optional<Verdict> found = {};   ///< nothing: no scene contains it
    std::vector<std::string> scenes = {};  ///< in which it was checked
    std::string equation = {};           ///< the one that the verdict is about
    std::string reason = {};
    std::string difference = {};
    std::optional<CounterExample> counterexample = {};

    Verdict verdict() const { return found.value_or(Verdict::not_checkable); }
    bool as_expected() const;
};

class PrintedVerdicts {
public:
    /// Checks what the scene of a system contains.
    void add(const System& system);
    const std::vector<PrintedRow>& rows() const { return rows_; }

private:
    PrintedRow& row_of(const Member<PrintedEquation>& member);
    std::vector<PrintedRow> rows_;
};

}  // namespace dalembert
