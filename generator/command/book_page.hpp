// SPDX-License-Identifier: GPL-3.0-or-later
// The record of a text as a page that needs nothing else: every entry with its verdict, and the errata by themselves.
#pragma once

#include "command/printed_report.hpp"
#include "text/files.hpp"

namespace dalembert {

/// What was found of one model or catalogue.
struct BookPart {
    std::string title;    ///< of the text
    std::string about;    ///< edition, or which part
    std::vector<PrintedRow> rows;
    VerdictCounts counts;
};

/// book.html and errata.html in a folder.
FileContents book_pages(const std::vector<BookPart>& parts, const std::filesystem::path& folder);

}  // namespace dalembert
