// SPDX-License-Identifier: GPL-3.0-or-later
// The entries of a catalogue, checked in a process of their own, so that one that crashes, or needs too much time or memory, takes nothing
// from the others: those behind it are checked in another process.
#pragma once

#include <functional>

#include "book/printed_verdicts.hpp"
#include "printed/catalogue.hpp"

namespace dalembert {

struct EntryOutcome {
    std::vector<PrintedRow> rows;
    std::vector<Diagnostic> errors = {};  ///< why it could not be read
    std::string stopped = {};             ///< why its check came to no end
};

/// Calls done(entry, outcome) for all entries, in order. The budgets of each are budget::entry_seconds and budget::entry_bytes.
void check_entries(const Catalogue& catalogue, bool for_pages, const std::function<void(const CatalogueEntry&, const EntryOutcome&)>& done);

}  // namespace dalembert
