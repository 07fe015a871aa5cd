// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <set>

#include "reference/pages.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '>') result += "&gt;";
        else if (c == '"') result += "&quot;";
        else result += c;
    }
    return result;
}

/// Plain text, of which only `code` is markup.
std::string marked(const std::string& text) {
    std::string result;
    bool is_code = false;
    for (const char c : escaped(text)) {
        if (c != '`') {
            result += c;
            continue;
        }
        result += is_code ? "</code>" : "<code>";
        is_code = !is_code;
    }
    return result;
}

std::string as_id(const std::string& text) {
    std::string id;
    for (const char c : text) id += c == ' ' ? '-' : c;
    return escaped(id);
}

/// "bodies", "errors.unit-mismatch": those of the model language need no page.
std::string id_of(const Page& page, const Section& section) {
    const bool is_domain = page.name.starts_with("language_");
    return as_id(is_domain ? section.name : page.name + "." + section.name);
}

std::string facts_as_html(const Section& section, const Row& row) {
    std::string text;
    for (std::size_t i = 0; i < row.facts.size(); ++i) {
        if (row.facts[i].empty()) continue;
        const bool is_plain = section.columns[i] == "Value" || section.columns[i] == "Needed";
        const std::string name = is_plain ? "" : escaped(section.columns[i]) + ": ";
        text += (text.empty() ? "" : " · ") + name + "<b>" + escaped(row.facts[i]) + "</b>";
    }
    return text.empty() ? "" : "<small>" + text + "</small>";
}

class Writer {
public:
    std::string contents(const Page& page) const {
        std::string links;
        for (const Section& section : page.sections)
            links += fmt::format("<a href=\"#{}\">{}</a> ", id_of(page, section), escaped(section.name));
        return fmt::format("<details><summary><a href=\"#{}\">{}</a></summary>\n<p>{}</p></details>\n", page.name, escaped(page.title),
                           links);
    }

    std::string page(const Page& page) {
        std::string text = fmt::format("<h2 id=\"{}\">{}</h2>\n", page.name, escaped(page.title));
        if (!page.doc.empty()) text += "<p>" + marked(page.doc) + "</p>\n";
        for (const Section& one : page.sections) text += section(one, id_of(page, one));
        return text;
    }

private:
    std::string section(const Section& section, const std::string& id) {
        std::string text = fmt::format("<h3 id=\"{}\">{}</h3>\n", id, escaped(section.name));
        if (!section.doc.empty()) text += "<p>" + marked(section.doc) + "</p>\n";
        if (!section.example.empty()) text += "<pre>" + escaped(section.example) + "</pre>\n";
        if (!section.rows.empty()) text += "<dl>\n";
        std::string above;
        for (const Row& row : section.rows) {
            if (row.level == 0) above = id;
            text += row_as_html(section, row, above);
            if (row.level == 0) above = id + "." + as_id(row.name);
        }
        if (!section.rows.empty()) text += "</dl>\n";
        for (const std::string& note : section.notes) text += "<p>" + marked(note) + "</p>\n";
        return text;
    }

    std::string row_as_html(const Section& section, const Row& row, const std::string& above) {
        std::string name = fmt::format("<code>{}</code>", escaped(shown(row)));
        std::string id = fmt::format("{}.{}", above, as_id(row.name));
        if (!section.link.empty()) name = fmt::format("<a href=\"#{}\">{}</a>", as_id(row.name), name);
        std::string text = fmt::format("<dt{}{}>{}</dt><dd>", ids_.insert(id).second && section.link.empty() ? " id=\"" + id + "\"" : "",
                                       row.level > 0 ? " class=\"part\"" : "", name);
        text += facts_as_html(section, row) + marked(row.doc);
        for (const std::string& line : row.lines) text += "<span>" + marked(line) + "</span>";
        return text + "</dd>\n";
    }

    std::set<std::string> ids_;
};

}  // namespace

std::string as_html(const Pages& pages) {
    Writer writer;
    std::string contents, body;
    for (const Page& page : pages) {
        contents += writer.contents(page);
        body += writer.page(page);
    }
    const bool is_all = pages.size() > 1;
    return fill_template(embedded_file("reference.html.in"),
                         {{"TITLE", is_all ? "dalembert: reference" : "dalembert: " + escaped(pages.front().title)},
                          {"LEAD", "Written by <code>dalembert help --format html</code>."},
                          {"CONTENTS", contents},
                          {"BODY", body}});
}

}  // namespace dalembert
