// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>

#include "reference/pages.hpp"

namespace dalembert {

namespace {

/// The rows with the name, each with its parts; of a part, the row that it belongs to stands before it.
std::vector<Row> rows_called(const std::vector<Row>& rows, const std::string& name) {
    std::vector<Row> found;
    const Row* above = nullptr;
    bool takes_parts = false;
    for (const Row& row : rows) {
        if (row.level == 0) above = &row;
        const bool is_called = row.name == name;
        if (is_called && row.level > 0 && !takes_parts) found.push_back(*above);
        if (row.level == 0) takes_parts = is_called;
        if (is_called || (row.level > 0 && takes_parts)) found.push_back(row);
    }
    return found;
}

bool mentions(const std::string& text, const std::string& word) {
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

}  // namespace

Pages pages_about(const Pages& pages, const std::string& word) {
    for (const Page& page : pages)
        if (page.name == word) return {page};
    const std::size_t point = word.find('.');
    Pages found;
    for (const Page& page : pages) {
        Page part{page.name, page.title, {}, {}};
        for (const Section& section : page.sections) {
            if (section.name == word) {
                part.sections.push_back(section);
                continue;
            }
            const bool has_section = point != std::string::npos && word.substr(0, point) == section.name;
            Section rest{section.name};
            rest.columns = section.columns;
            rest.rows_are = section.rows_are;
            rest.docs_are = section.docs_are;
            rest.rows = rows_called(section.rows, word);
            if (rest.rows.empty() && has_section) rest.rows = rows_called(section.rows, word.substr(point + 1));
            if (!rest.rows.empty() && section.link.empty()) part.sections.push_back(std::move(rest));
        }
        if (!part.sections.empty()) found.push_back(std::move(part));
    }
    return found;
}

Pages pages_mentioning(const Pages& pages, const std::string& word) {
    Pages found;
    for (const Page& page : pages) {
        Page part{page.name, page.title, {}, {}};
        for (const Section& section : page.sections) {
            if (!section.link.empty()) continue;  // its rows are sections of another page
            Section rest{section.name};
            rest.columns = section.columns;
            rest.rows_are = section.rows_are;
            rest.docs_are = section.docs_are;
            const bool is_about = mentions(section.name, word) || mentions(section.doc, word);
            if (is_about) rest.doc = section.doc;
            for (const Row& row : section.rows)
                if (mentions(row.name, word) || mentions(row.doc, word)) rest.rows.push_back(row);
            if (is_about || !rest.rows.empty()) part.sections.push_back(std::move(rest));
        }
        if (!part.sections.empty()) found.push_back(std::move(part));
    }
    return found;
}

std::vector<std::string> words_of(const Pages& pages) {
    std::vector<std::string> words;
    for (const Page& page : pages) {
        words.push_back(page.name);
        for (const Section& section : page.sections) {
            words.push_back(section.name);
            for (const Row& row : section.rows) words.push_back(row.name);
        }
    }
    return words;
}

}  // namespace dalembert
