// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <set>

#include "text/template.hpp"
#include "emit/mathml.hpp"

namespace dalembert {

namespace {

std::string counted(std::size_t count, const char* one, const char* many) { return fmt::format("{} {}", count, count == 1 ? one : many); }

/// Text in a cell of a table.
std::string cell(const std::string& text) {
    std::string safe;
    for (const char c : text) safe += c == '|' ? std::string("\\|") : c == '\n' ? " " : std::string(1, c);
    return safe;
}

std::string shows_text(const GalleryEntry& entry) {
    std::string text;
    for (const Trait* trait : entry.shows) text += (text.empty() ? "" : ", ") + std::string(trait->name);
    return text;
}

/// "44 proofs: 44 proven", and of printed equations likewise with their numbers.
std::vector<std::string> verdict_lines(const GalleryEntry& entry) {
    std::vector<std::string> lines{entry.proofs.line("proofs")};
    if (entry.printed.entries == 0) return lines;
    const std::string numbers = entry.numbers.empty() ? "" : " (" + entry.numbers + ")";
    const std::string what = (entry.printed.entries == 1 ? "printed equation" : "printed equations") + numbers;
    lines.push_back(entry.printed.line(what.c_str()));
    return lines;
}

std::string scenes_text(const GalleryEntry& entry) {
    return entry.scenes == 1 ? "" : fmt::format("scene {}, one of {}", entry.scene, entry.scenes);
}

std::string tags(const GalleryEntry& entry) {
    std::string text;
    for (const Trait* trait : entry.shows) text += fmt::format("<li title=\"{}\">{}</li>", html_text(trait->doc), html_text(trait->name));
    return text.empty() ? "" : "<ul class=\"tags\">" + text + "</ul>\n";
}

std::string card(const GalleryEntry& e) {
    std::string names = "|";
    for (const Trait* trait : e.shows) names += std::string(trait->name) + "|";
    std::string text = fmt::format(
        "<article id=\"{}\" data-domain=\"{}\" data-freedom=\"{}\" data-states=\"{}\" data-operations=\"{}\" data-shows=\"{}\">\n", e.name,
        html_text(e.domain), e.degrees, e.states, e.operations, html_text(names));
    text += fmt::format("<a href=\"{0}\"><img src=\"{0}\" alt=\"Plot of the run of {1}\" width=\"320\" height=\"180\" loading=\"lazy\"></a>\n",
                        html_text(e.picture), html_text(e.name));
    text += fmt::format("<h3><a href=\"{}\">{}</a></h3>\n", html_text(e.model), html_text(e.title));
    if (!e.doc.empty()) text += "<p>" + html_text(e.doc) + "</p>\n";
    text += fmt::format("<p class=\"numbers\">{}, {}, {}</p>\n", degrees_text(e), counted(e.states, "state", "states"),
                        counted(static_cast<std::size_t>(e.operations), "operation", "operations"));
    text += tags(e) + "<p class=\"small\">";
    for (const std::string& line : verdict_lines(e)) text += html_text(line) + "<br>";
    if (!e.source.empty()) text += html_text(e.source) + "<br>";
    text += fmt::format("<a href=\"{}\">{}</a>", html_text(e.model), html_text(e.model.substr(e.model.rfind('/') + 1)));
    if (!e.header.empty()) text += fmt::format(" &middot; <a href=\"{}\">header</a>", html_text(e.header));
    text += fmt::format(" &middot; <a href=\"{}\">plot</a>", html_text(e.picture));
    if (!scenes_text(e).empty()) text += " &middot; " + html_text(scenes_text(e));
    return text + "</p>\n</article>\n";
}

}  // namespace

std::vector<std::pair<std::string, std::vector<const GalleryEntry*>>> GalleryResult::domains() const {
    std::vector<std::pair<std::string, std::vector<const GalleryEntry*>>> domains;
    for (const GalleryEntry& entry : entries) {
        auto found = std::find_if(domains.begin(), domains.end(), [&](const auto& domain) { return domain.first == entry.domain; });
        if (found == domains.end()) found = domains.insert(found, {entry.domain, {}});
        found->second.push_back(&entry);
    }
    return domains;
}

std::string number_ranges(const std::vector<PrintedRow>& rows) {
    constexpr int near = 10;
    std::set<std::pair<int, int>> numbers;  // chapter and number
    for (const PrintedRow& row : rows) {
        int chapter = 0, number = 0;
        if (std::sscanf(row.id.c_str(), "%3d.%4d", &chapter, &number) == 2) numbers.emplace(chapter, number);
    }
    std::string text;
    for (auto first = numbers.begin(); first != numbers.end();) {
        auto last = first;
        auto next = std::next(last);
        while (next != numbers.end() && next->first == last->first && next->second <= last->second + near) last = next++;
        text += fmt::format("{}{}.{}", text.empty() ? "" : ", ", first->first, first->second);
        if (last != first) text += fmt::format("-{}.{}", last->first, last->second);
        first = next;
    }
    return text;
}

std::string degrees_text(const GalleryEntry& entry) {
    const std::string text = counted(entry.degrees, "degree of freedom", "degrees of freedom");
    return entry.coordinates == entry.degrees ? text : text + ", " + counted(entry.coordinates, "coordinate", "coordinates");
}

std::string domain_title(const std::string& domain) {
    std::string title = domain;
    if (!title.empty()) title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
    return title;
}

std::string gallery_lead(const GalleryResult& result) {
    VerdictCounts proofs, printed;
    for (const GalleryEntry& entry : result.entries) {
        proofs.add(entry.proofs);
        printed.add(entry.printed);
    }
    return fmt::format("{}, all derived, proven, checked and run by one command. {}. {}.",
                       counted(result.entries.size(), "system", "systems"), proofs.line("proofs"), printed.line());
}

std::string gallery_page(const GalleryResult& result) {
    std::string links, body, explained, choices, domains;
    for (const auto& [domain, entries] : result.domains()) {
        const std::string id = html_text(domain), title = html_text(domain_title(domain));
        links += fmt::format("<a href=\"#{}\">{} ({})</a>\n", id, title, entries.size());
        domains += fmt::format("<option value=\"{}\">{}</option>\n", id, title);
        body += fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n<div class=\"cards\">\n", id, title);
        for (const GalleryEntry* entry : entries) body += card(*entry);
        body += "</div>\n</section>\n";
    }
    for (const Trait& trait : traits()) {
        const auto shows = [&](const GalleryEntry& e) { return std::find(e.shows.begin(), e.shows.end(), &trait) != e.shows.end(); };
        const auto count = std::count_if(result.entries.begin(), result.entries.end(), shows);
        if (count == 0) continue;
        choices += fmt::format("<option value=\"{0}\">{0} ({1})</option>\n", html_text(trait.name), count);
        explained += fmt::format("<dt>{}</dt><dd>{}; {}</dd>\n", html_text(trait.name), html_text(trait.doc),
                                 counted(static_cast<std::size_t>(count), "system", "systems"));
    }
    return fill_template(embedded_file("gallery.html.in"), {{"LEAD", html_text(gallery_lead(result))},
                                                            {"LINKS", links},
                                                            {"DOMAINS", domains},
                                                            {"CHOICES", choices},
                                                            {"BODY", body},
                                                            {"EXPLAINED", explained}});
}

std::string gallery_markdown(const GalleryResult& result) {
    std::string text = "# Gallery of systems\n\n" + gallery_lead(result) +
                       "\n\nA plot shows the reference run. Operations are those of one right-hand side. A printed equation that is wrong is a misprint of its text. The same as a page that can be sorted and "
                       "filtered: [gallery.html](gallery.html).\n";
    for (const auto& [domain, entries] : result.domains()) {
        text += fmt::format("\n## {}\n\n| plot | system | degrees of freedom | states | operations | shows | checked |\n|---|---|---|---|---|---|---|\n",
                            domain_title(domain));
        for (const GalleryEntry* e : entries) {
            std::string verdicts;
            for (const std::string& line : verdict_lines(*e)) verdicts += (verdicts.empty() ? "" : "<br>") + line;
            text += fmt::format("| <img src=\"{}\" width=\"160\" alt=\"{}\"> | [{}]({})", e->picture, e->name, cell(e->title), e->model);
            if (!e->doc.empty()) text += "<br>" + cell(e->doc);
            if (!e->source.empty()) text += "<br>" + cell(e->source);
            if (!e->header.empty()) text += fmt::format("<br>[header]({})", e->header);
            text += fmt::format(" | {} | {} | {} | {} | {} |\n",
                                e->coordinates == e->degrees ? std::to_string(e->degrees) : fmt::format("{} of {}", e->degrees, e->coordinates),
                                e->states, e->operations, shows_text(*e), cell(verdicts));
        }
    }
    return text;
}

std::string as_text(const GalleryResult& result) {
    std::string text = fmt::format("{}\n{}\n", (result.folder / "gallery.html").string(), (result.folder / "GALLERY.md").string());
    if (!result.pictures.empty())
        text += fmt::format("{} in {}\n", counted(result.pictures.size(), "picture", "pictures"),
                            result.pictures.front().first.parent_path().string());
    return text;
}

}  // namespace dalembert
