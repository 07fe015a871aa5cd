// SPDX-License-Identifier: GPL-3.0-or-later
// A page of the reference as a value: sections of rows, made from the tables that the program works with. `help` prints pages as text,
// Markdown or HTML. Sentences may hold `code` between backticks; everything else in them is plain text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

struct Row {
    std::string name;                     ///< "mass", "atan2", "--scene"
    std::string shown = {};               ///< "atan2(y, x)"; the name, if empty
    std::vector<std::string> facts = {};  ///< one for each column of the section, perhaps empty
    std::string doc = {};
    std::vector<std::string> lines = {};  ///< further sentences
    int level = 0;                        ///< 1: a part of the row above it
};

struct Section {
    std::string name;                      ///< the heading and its anchor, as "bodies"
    std::string doc = {};
    std::string example = {};              ///< lines of a file, or of the program's output
    std::string rows_are = {};             ///< "Key", "Function"
    std::vector<std::string> columns = {}; ///< names of the facts
    std::string docs_are = "Meaning";
    std::vector<Row> rows = {};
    std::vector<std::string> notes = {};   ///< sentences below the rows
    std::string link = {};                 ///< the page whose sections the rows are
    bool rows_are_pages = false;
};

struct Page {
    std::string name;  ///< "errors": of the topic and, with an ending, of the file
    std::string title;
    std::string doc;
    std::vector<Section> sections;
};

using Pages = std::vector<Page>;

inline const std::string& shown(const Row& row) { return row.shown.empty() ? row.name : row.shown; }

}  // namespace dalembert
