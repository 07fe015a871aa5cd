// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/machine_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/item.hpp"
#include "elements/model.hpp"
#include "elements/verdict.hpp"
#include "emit/mathml.hpp"
#include "js/print.hpp"
#include "js/runtime.hpp"
#include "report/machine_equations.hpp"
#include "report/machine_script.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

std::string text_paragraph(const std::string& text) { return text.empty() ? "" : "<p>" + html_text(text) + "</p>\n"; }

std::string folded(const std::string& title, const std::string& inside, bool is_open) {
    return inside.empty()
               ? ""
               : fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", is_open ? " open" : "", html_text(title), inside);
}

const char* verdict_class(Verdict verdict) {
    return verdict == Verdict::wrong || verdict == Verdict::dimensionally_wrong ? "verdict wrong" : "verdict";
}

std::string proofs_of_scene(const CheckedScene& scene) {
    std::string text;
    for (const CheckedScene::Group& group : scene.groups) {
        VerdictCounts counts;
        std::string list;
        for (const CheckedScene::Proof& proof : group.proofs) {
            counts.add(proof.verdict);
            list += fmt::format("<li>{}: <strong class=\"{}\">{}</strong></li>\n", html_text(proof.name), verdict_class(proof.verdict),
                                html_text(to_string(proof.verdict)));
        }
        text += folded(fmt::format("{}: {}", group.title, counts.line(group.proofs.size() == 1 ? "identity" : "identities")),
                       "<ul>\n" + list + "</ul>\n", false);
    }
    return text;
}

std::string operations_of(const Machine& machine) {
    std::string rows;
    for (std::size_t i = 0; i < function_count; ++i) {
        const auto function = static_cast<Function>(i);
        const OperationCount c = operations(machine, function);
        if (c.total() > 0)
            rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                                html_text(name_of(function)), c.additions, c.multiplications, c.divisions, c.trigonometric, c.other);
    }
    return "<div class=\"wide\" tabindex=\"0\"><table>\n<tr><th scope=\"col\">function</th><th scope=\"col\">+, &minus;</th><th "
           "scope=\"col\">&times;</th><th scope=\"col\">/</th>"
           "<th scope=\"col\">sin, cos</th><th scope=\"col\">other</th></tr>\n" +
           rows + "</table></div>\n";
}

std::string effects_of(const Scene& scene) {
    std::string text;
    for (const Effect* effect : scene.effects_in)
        text += fmt::format("<li><strong>{}</strong>: {}</li>\n", html_text(effect->name), html_text(effect->doc));
    for (const Effect* effect : scene.effects_out)
        text += fmt::format("<li>without <strong>{}</strong>: {}</li>\n", html_text(effect->name), html_text(effect->doc));
    return text.empty() ? "" : "<ul>\n" + text + "</ul>\n";
}

/// A number in SI in the unit that the model declares.
std::string in_declared_unit(double value, const Unit& unit) {
    const double factor = cln::double_approx(unit.factor) * std::pow(std::numbers::pi, unit.pi_power);
    return fmt::format("{:.6g}", value / factor - cln::double_approx(unit.offset));
}

std::string quantity_row(const std::string& name, const std::string& unit, const std::string& value, const std::string& range,
                         const std::string& doc) {
    return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", html_text(name), value,
                       html_text(unit), range, html_text(doc));
}

std::string range_text(const PlantQuantity& q, const Unit& unit) {
    if (!q.low && !q.high) return "";
    return fmt::format("{} ... {}", q.low ? in_declared_unit(*q.low, unit) : "&minus;&infin;",
                       q.high ? in_declared_unit(*q.high, unit) : "&infin;");
}

std::string quantities_of(const ScenePage& scene) {
    if (!scene.run) return {};
    const System& system = *scene.run->machine.system;
    const Plant& plant = scene.run->header.plant;
    std::string rows;
    const std::vector<double> values = parameter_numbers(system, scene.run->values);
    const auto add = [&](SymbolKind kind, const std::vector<PlantQuantity>& table, bool has_values) {
        const std::vector<Variable>& all = system.symbols.all(kind);
        for (std::size_t i = 0; i < all.size() && i < table.size(); ++i) {
            const Unit unit = all[i].declared != nullptr ? all[i].declared->unit : Unit{};
            rows += quantity_row(table[i].name, unit.written == "1" ? table[i].unit : unit.written,
                                 has_values ? in_declared_unit(values[i], unit) : "input", range_text(table[i], unit), table[i].doc);
        }
    };
    add(SymbolKind::parameter, plant.parameters, true);
    add(SymbolKind::input, plant.inputs, false);
    return rows.empty() ? ""
                        : "<div class=\"wide\" tabindex=\"0\"><table>\n<tr><th scope=\"col\">name</th><th scope=\"col\">value</th><th "
                          "scope=\"col\">unit</th><th scope=\"col\">range</th>"
                          "<th scope=\"col\">meaning</th></tr>\n" +
                              rows + "</table></div>\n";
}

std::string scene_section(const ScenePage& scene, const MachineDrawing& drawing) {
    const Machine& machine = scene.derived();
    const Scene& s = machine.system->scene;
    std::string text = fmt::format("<section class=\"scene\" id=\"scene-{0}\">\n<h2>Scene {0}</h2>\n", html_text(s.name)) +
                       text_paragraph(s.doc) + effects_of(s);
    if (!scene.run) text += "<p><strong>This page does not run the scene:</strong> " + html_text(scene.reason) + "</p>\n";
    if (!drawing.not_drawn.empty()) {
        std::string list;
        for (const std::string& one : drawing.not_drawn) list += (list.empty() ? "" : "; ") + one;
        text += "<p>Not drawn: " + html_text(list) + ".</p>\n";
    }
    std::string equations = equations_as_html(*machine.system);
    std::string title = "Equations";
    if (machine.system->scene.mode) title += ", mode " + s.modes[*machine.system->scene.mode].name;
    text += folded(title, equations, true);
    for (const Machine& other : machine.other_modes)
        text +=
            folded("Equations, mode " + other.system->scene.modes[*other.system->scene.mode].name, equations_as_html(*other.system), false);
    text += folded("Parameters and inputs", quantities_of(scene), true);
    text += "<h3>Proofs</h3>\n" + proofs_of_scene(scene.proofs);
    return text + folded("Operations of the generated code", operations_of(machine), false) + "</section>\n";
}

std::string printed_section(const std::vector<PrintedRow>& rows) {
    if (rows.empty()) return {};
    std::string text = "<section id=\"printed\">\n<h2>Printed equations</h2>\n";
    for (const PrintedRow& row : rows) {
        text += fmt::format("<h3>{} <span class=\"{}\">{}</span></h3>\n", html_text(row.id), verdict_class(row.verdict()),
                            html_text(row.verdict_text()));
        text += text_paragraph(row.doc);
        if (!row.formulas.empty()) text += "<div class=\"formula\" tabindex=\"0\">" + row.formulas + "</div>\n";
        text += text_paragraph(row.reason);
        if (!row.difference.empty()) text += text_paragraph("difference: " + row.difference);
        if (!row.meant.empty()) text += "<p>Perhaps meant:</p>\n<div class=\"formula\" tabindex=\"0\">" + row.meant + "</div>\n";
    }
    return text + "</section>\n";
}

/// Neither a string nor a comment of a script ends the element that it stands in.
std::string in_script(std::string text) {
    for (const char* mark : {"</", "<!--"})
        for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 3)) text.insert(at + 1, "\\");
    return text;
}

}  // namespace

std::size_t ReportedPage::running_scenes() const {
    return static_cast<std::size_t>(std::count_if(scenes.begin(), scenes.end(), [](const Scene& scene) { return scene.runs; }));
}

VerdictCounts ReportedPage::proofs() const {
    VerdictCounts counts;
    for (const Scene& scene : scenes) counts.add(scene.proofs);
    return counts;
}

std::string machine_page(const Model& model, const std::string& file, std::vector<ScenePage>& scenes,
                         const std::vector<PrintedRow>& printed, ReportedPage& result, const std::string& watching) {
    std::string modules, objects, sections, links;
    for (ScenePage& scene : scenes) {
        const Scene& s = scene.derived().system->scene;
        const MachineDrawing drawing = drawing_of(scene.derived());
        ReportedPage::Scene told{s.name, scene.run.has_value(), scene.reason, drawing.bodies.size(), {}};
        for (const CheckedScene::Group& group : scene.proofs.groups)
            for (const CheckedScene::Proof& proof : group.proofs) told.proofs.add(proof.verdict);
        if (scene.run) {
            try {
                const SceneScript script = scene_script(scene, drawing, file);
                modules += script.module + "\n";
                objects += "    " + script.object + ",\n";
            } catch (const std::exception& error) {  // such as a formula of too many terms: the page goes without a player
                told.reason = scene.reason = fmt::format("its formulas cannot be written as JavaScript ({}).", error.what());
                told.runs = false;
                scene.machine = std::move(scene.run->machine);
                scene.run.reset();
            }
        }
        sections += scene_section(scene, drawing);
        links += fmt::format("<a href=\"#scene-{0}\">{0}</a> ", html_text(s.name));
        result.scenes.push_back(std::move(told));
    }
    for (const PrintedRow& row : printed) result.printed.add(row.verdict());
    if (!printed.empty()) links += "<a href=\"#printed\">printed equations</a>";
    const std::string title = model.title.empty() ? model.name : model.title;
    result.title = title;
    result.doc = model.doc;
    std::string script;
    if (!objects.empty()) {
        script = javascript_runtime() + modules + "const scenes = [\n" + objects +
                 "];\nconst first_scene = " + js_string(result.first_scene) + ";\n";
        for (const char* part :
             {"numbers", "plot", "shapes", "drawing", "network_parts", "network", "field", "start", "times", "runs", "player"})
            script += embedded_file(fmt::format("report_{}.js", part));
        script = "<script type=\"module\">\n" + in_script(script) + "</script>\n";
    }
    script += "<script>\n" + std::string(embedded_file("report_print.js")) + "</script>\n" + watching;
    std::string page =
        fill_template(embedded_file("report.html.in"),
                      {{"STYLE", std::string(embedded_file("report.css"))},
                       {"TITLE", html_text(title)},
                       {"NAME", html_text(model.name)},
                       {"DOC", text_paragraph(model.doc) + (model.reference.empty() ? "" : text_paragraph("Source: " + model.reference))},
                       {"LINKS", links},
                       {"PLAYER", objects.empty() ? "" : std::string(embedded_file("report_player.html"))},
                       {"BODY", sections + printed_section(printed)},
                       {"CONNECT", watching.empty() ? "" : "; connect-src 'self'"},
                       {"SCRIPT", script}});
    result.bytes = page.size();
    return page;
}

}  // namespace dalembert
