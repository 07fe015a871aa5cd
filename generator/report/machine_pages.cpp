// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/machine_pages.hpp"

#include <fmt/format.h>

#include "emit/mathml.hpp"
#include "report/json_output.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// "3 scenes run", "2 of 3 scenes run", "no scene runs"
std::string runs_text(const ReportedPage& page) {
    const std::size_t all = page.scenes.size(), runs = page.running_scenes();
    if (runs == 0) return "no scene runs";
    const char* rest = all == 1 ? "scene runs" : runs == 1 && runs < all ? "scenes runs" : "scenes run";
    return runs == all ? fmt::format("{} {}", all, rest) : fmt::format("{} of {} {}", runs, all, rest);
}

std::string card(const ReportResult::Page& page) {
    const std::string link = html_text(page.page.filename().string());
    std::string text = "<article>\n";
    if (!page.picture.empty())
        text += fmt::format("<a href=\"{}\" class=\"picture\" aria-hidden=\"true\" tabindex=\"-1\">{}</a>\n", link, page.picture);
    text += fmt::format("<h2><a href=\"{}\">{}</a></h2>\n", link, html_text(page.title));
    if (!page.doc.empty()) text += "<p>" + html_text(page.doc) + "</p>\n";
    text += "<p class=\"small\">" + html_text(runs_text(page)) + "; " + html_text(page.proofs().line("proofs"));
    if (page.printed.entries > 0) text += "; " + html_text(page.printed.line());
    return text + fmt::format("; {} kB</p>\n</article>\n", (page.bytes + 500) / 1000);
}

}  // namespace

std::string index_page(const ReportResult& result) {
    std::string cards;
    VerdictCounts proofs, printed;
    for (const ReportResult::Page& page : result.pages) {
        cards += card(page);
        proofs.add(page.proofs());
        printed.add(page.printed);
    }
    std::string lead = fmt::format("{} machines. {}.", result.pages.size(), proofs.line("proofs"));
    if (printed.entries > 0) lead += " " + printed.line() + ".";
    return fill_template(embedded_file("report_index.html.in"),
                         {{"STYLE", std::string(embedded_file("report.css"))}, {"LEAD", html_text(lead)}, {"CARDS", cards}});
}

std::string as_text(const ReportResult& result) {
    if (!result.index.empty()) {
        std::string text;
        for (const ReportResult::Page& page : result.pages)
            text += fmt::format("{}: {} bytes; {}; {}\n", page.page.string(), page.bytes, runs_text(page), page.proofs().line("proofs"));
        return text + fmt::format("{}: {} pages\n", result.index.string(), result.pages.size());
    }
    const ReportedPage& page = result.pages.front();
    std::string text = fmt::format("{}: {} bytes\n", page.page.string(), page.bytes);
    for (const ReportedPage::Scene& scene : page.scenes) {
        const std::string how =
            scene.runs ? "runs in the page" : "does not run in the page: " + scene.reason.substr(0, scene.reason.find_last_not_of('.') + 1);
        text += fmt::format("  scene {}: {}; {}{}\n", scene.name, scene.proofs.line("proofs"), how,
                            scene.drawn == 0 ? "" : fmt::format(", {} {} drawn", scene.drawn, scene.drawn == 1 ? "body" : "bodies"));
    }
    if (page.printed.entries > 0) text += "  " + page.printed.line() + "\n";
    return text;
}

nlohmann::ordered_json as_json(const ReportResult& result) {
    if (!result.index.empty()) {
        nlohmann::ordered_json json = json_result("report");
        json["index"] = result.index.string();
        json["pages"] = nlohmann::ordered_json::array();
        for (const ReportResult::Page& page : result.pages)
            json["pages"].push_back({{"model", page.model},
                                     {"page", page.page.string()},
                                     {"bytes", page.bytes},
                                     {"scenes", page.scenes.size()},
                                     {"scenes_that_run", page.running_scenes()}});
        return json;
    }
    const ReportedPage& page = result.pages.front();
    nlohmann::ordered_json json = json_result("report", page.model);
    json["page"] = page.page.string();
    json["bytes"] = page.bytes;
    json["scenes"] = nlohmann::ordered_json::array();
    for (const ReportedPage::Scene& scene : page.scenes) {
        nlohmann::ordered_json one{
            {"scene", scene.name}, {"runs", scene.runs}, {"bodies_drawn", scene.drawn}, {"proofs", scene.proofs.json()}};
        if (!scene.runs) one["reason"] = scene.reason;
        json["scenes"].push_back(std::move(one));
    }
    json["printed"] = page.printed.json();
    return json;
}

}  // namespace dalembert
