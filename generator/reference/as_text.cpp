// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "reference/pages.hpp"

namespace dalembert {

namespace {

constexpr std::size_t width = 120;

/// The sentence in lines of the terminal, all but the first after so many blanks.
std::string flowing(const std::string& sentence, std::size_t indent) {
    std::istringstream words(sentence);
    std::string text;
    std::size_t column = indent;
    for (std::string word; words >> word;) {
        if (column > indent && column + 1 + word.size() > width) {
            text += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (column > indent) {
            text += ' ';
            ++column;
        }
        text += word;
        column += word.size();
    }
    return text;
}

/// "Unit" as "unit".
std::string in_sentence(std::string name) {
    name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    return name;
}

std::string facts_of(const Section& section, const Row& row) {
    std::string text;
    for (std::size_t i = 0; i < row.facts.size(); ++i) {
        if (row.facts[i].empty()) continue;
        // "required" says itself what it is; "kg" does not.
        const std::string name = section.columns[i] == "Value" || section.columns[i] == "Needed" ? "" : in_sentence(section.columns[i]) + ": ";
        text += (text.empty() ? "" : "; ") + name + row.facts[i];
    }
    return text;
}

std::string row_text(const Section& section, const Row& row, std::size_t names) {
    const std::size_t indent = 2 + 2 * static_cast<std::size_t>(row.level);
    const std::string& name = shown(row);
    const std::size_t column = std::max(names + 4, indent + 2);
    std::string text = std::string(indent, ' ') + name;
    text += name.size() + indent + 1 > column ? "\n" + std::string(column, ' ') : std::string(column - indent - name.size(), ' ');
    bool is_first = true;
    const auto add = [&](const std::string& sentence, std::size_t further) {
        if (sentence.empty()) return;
        if (!is_first) text += std::string(column + further, ' ');
        text += flowing(sentence, column + further) + "\n";
        is_first = false;
    };
    const std::string facts = facts_of(section, row);
    if (section.columns.size() > 1) {
        add(facts, 0);
        add(row.doc, 0);
    } else {
        add(row.doc + (facts.empty() ? "" : "; " + facts), 0);
    }
    for (const std::string& line : row.lines) add(line, 2);
    if (is_first) text += "\n";
    return text;
}

}  // namespace

std::string as_text(const Page& page) {
    std::string text = page.title + "\n";
    if (!page.doc.empty()) text += "\n" + flowing(page.doc, 0) + "\n";
    for (const Section& section : page.sections) {
        text += "\n" + section.name + "\n";
        if (!section.doc.empty()) text += "  " + flowing(section.doc, 2) + "\n";
        std::istringstream example(section.example);
        if (!section.example.empty()) text += "\n";
        for (std::string line; std::getline(example, line);) text += line.empty() ? "\n" : "    " + line + "\n";
        if (!section.example.empty() && !section.rows.empty()) text += "\n";
        std::size_t names = 10;
        for (const Row& row : section.rows)
            if (shown(row).size() <= 32) names = std::max(names, shown(row).size() + 2 * static_cast<std::size_t>(row.level));
        for (const Row& row : section.rows) text += row_text(section, row, names);
        for (const std::string& note : section.notes) text += "  " + flowing(note, 2) + "\n";
    }
    return text;
}

}  // namespace dalembert
