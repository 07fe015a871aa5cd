// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "reference/pages.hpp"

namespace dalembert {

namespace {

/// The anchor that GitHub gives a heading.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        if (c == ' ') anchor += '-';
        else if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_')
            anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return anchor;
}

/// Plain text, of which only `code` is markup. In a table '|' ends a cell, also inside code.
std::string plain(const std::string& text, bool in_table) {
    const auto is_letter = [&](std::size_t i) { return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0; };
    std::string result;
    bool is_code = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '`') is_code = !is_code;
        // Inside a word '_' is no markup, and brackets are only before '('.
        const bool is_emphasis = c == '_' && !(i > 0 && is_letter(i - 1) && is_letter(i + 1));
        const bool is_link = c == ']' && i + 1 < text.size() && text[i + 1] == '(';
        const bool is_markup = c == '*' || c == '<' || c == '\\' || c == '~' || is_emphasis || is_link;
        if ((c == '|' && in_table) || (!is_code && is_markup)) result += '\\';
        result += c == '\n' ? ' ' : c;
    }
    return result;
}

std::string code(const std::string& text) {
    const std::string mark = text.find('`') == std::string::npos ? "`" : "``";
    std::string inside;
    for (const char c : text) inside += c == '|' ? std::string("\\|") : std::string(1, c);
    return text.empty() ? "" : mark + inside + mark;
}

bool has_fact(const Section& section, std::size_t column) {
    return std::any_of(section.rows.begin(), section.rows.end(),
                       [&](const Row& row) { return column < row.facts.size() && !row.facts[column].empty(); });
}

std::string table(const Section& section) {
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < section.columns.size(); ++i)
        if (has_fact(section, i)) columns.push_back(i);
    std::string head = fmt::format("| {} |", section.rows_are), rule = "| --- |";
    for (const std::size_t column : columns) {
        head += fmt::format(" {} |", section.columns[column]);
        rule += " --- |";
    }
    std::string text = fmt::format("{} {} |\n{} --- |\n", head, section.docs_are, rule);
    for (const Row& row : section.rows) {
        std::string name = code(shown(row));
        if (!section.link.empty()) name = fmt::format("[{}]({}.md#{})", name, section.link, anchor_of(row.name));
        if (section.rows_are_pages) name = fmt::format("[{0}]({0}.md)", row.name);
        text += fmt::format("| {}{} |", row.level > 0 ? "&nbsp;&nbsp;" : "", name);
        for (const std::size_t column : columns) text += fmt::format(" {} |", plain(row.facts[column], true));
        text += " " + plain(row.doc, true);
        for (std::size_t i = 0; i < row.lines.size(); ++i)
            text += (i > 0 || !row.doc.empty() ? "<br>" : "") + plain(row.lines[i], true);
        text += " |\n";
    }
    return text;
}

}  // namespace

std::string as_markdown(const Page& page) {
    std::string text = fmt::format("# {}\n", page.title);
    if (!page.doc.empty()) text += "\n" + plain(page.doc, false) + "\n";
    for (const Section& section : page.sections) {
        text += fmt::format("\n## {}\n", section.name);
        if (!section.doc.empty()) text += "\n" + plain(section.doc, false) + "\n";
        if (!section.example.empty()) {
            const char* kind = section.rows.empty() ? "text" : "toml";
            text += fmt::format("```{}\n{}{}```\n", kind, section.example, section.example.ends_with('\n') ? "" : "\n");
        }
        if (!section.rows.empty()) text += "\n" + table(section);
        for (const std::string& note : section.notes) text += "\n" + plain(note, false) + "\n";
    }
    return text;
}

}  // namespace dalembert
