// SPDX-License-Identifier: GPL-3.0-or-later
// The record of a text as a page that needs nothing else: every entry with its verdict, and the errata by themselves.
#pragma once

#include "report/printed_report.hpp"
#include "text/files.hpp"

namespace dalembert {

/// An entry, or a whole file, that has no verdict.
struct BookProblem {
    std::string id;
    std::string verdict;  ///< "not read", "not checked"
    std::string reason;
    std::size_t rows_before = 0;  ///< rows of the part that stand before it
};

/// What was found of one model or catalogue.
struct BookPart {
    std::string title;    ///< of the text
    std::string about;    ///< edition, or which part
    std::vector<PrintedRow> rows;
    VerdictCounts counts;
    std::vector<BookProblem> problems = {};
};

/// book.html and errata.html in a folder.
FileContents book_pages(const std::vector<BookPart>& parts, const std::filesystem::path& folder);

}  // namespace dalembert
