// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of printed equations after one or more scenes of a model were checked.
#pragma once

#include "pipeline.hpp"
#include "prove/suggestion.hpp"

namespace dalembert {

/// The verdict on one printed equation over all scenes that contain it.
struct PrintedRow {
    std::string id;
    std::string source, doc;
    std::optional<Verdict> expected = {};
    std::optional<Verdict> found = {};   ///< nothing: no scene contains it
    std::vector<std::string> scenes = {};  ///< in which it was checked
    std::string equation = {};           ///< the one that the verdict is about
    std::string reason = {};
    std::string difference = {};
    std::optional<CounterExample> counterexample = {};
    std::optional<Suggestion> suggestion = {};
    std::vector<std::string> at = {};    ///< the point that the entry names, "phi = 0"
    std::vector<std::string> given = {}; ///< what the entry says of its letters, "r_S = position[bar]"
    std::string hint = {};               ///< of a wrong one: in which sense it holds all the same
    std::string formulas = {};           ///< the equations as they are printed, in MathML, where pages were asked for
    std::string meant = {};              ///< the suggestion likewise
    std::vector<std::string> derived = {};  ///< what the derivation has instead of first sides, where pages were asked for
    EntryParts parts = {};               ///< of an entry in LaTeX

    Verdict verdict() const { return found.value_or(Verdict::not_checkable); }
    bool as_expected() const;
    /// The verdict in words with the point where it holds, "proven at phi = 0"; if some equations could not be read, with their number:
    /// "proven; 3 of 4 equations are read".
    std::string verdict_text() const;
    /// A sentence for each equation that could not be read: "equation 2: ...".
    std::vector<std::string> not_read() const;
};

class PrintedVerdicts {
public:
    /// With `for_pages` rows also have what only pages show.
    explicit PrintedVerdicts(bool for_pages = false) : for_pages_(for_pages) {}

    /// Checks what the scene of a system contains of its model's printed equations.
    void add(const System& system);
    /// Checks one entry in a system. `text` says how one in LaTeX is printed.
    void add(const System& system, const PrintedEquation& entry, const LatexText* text = nullptr);
    /// An entry of which there is nothing to check.
    void add_unchecked(const PrintedEquation& entry, const std::string& reason);
    const std::vector<PrintedRow>& rows() const { return rows_; }

private:
    PrintedRow& row_of(const std::string& id, const PrintedEquation& entry);
    void show(PrintedRow& row, const System& system, const PrintedCheck& check, const LatexText* text) const;
    bool for_pages_;
    std::vector<PrintedRow> rows_;
};

}  // namespace dalembert
