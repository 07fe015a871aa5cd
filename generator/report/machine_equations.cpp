// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/machine_equations.hpp"

#include <fmt/format.h>

#include "emit/equations.hpp"
#include "emit/mathml.hpp"

namespace dalembert {

namespace {

/// Longer ones are no help on a page, and browsers take seconds for them.
constexpr std::size_t longest_formula = 3000;

class EquationLines {
public:
    explicit EquationLines(const System& system) : system_(system), write_(system.symbols, Style::text) {}

    std::string run() {
        definitions();
        begin("Equations of motion");
        for (const auto& [left, right] : motion_equations(system_)) add(write_(left) + " = " + write_(right));
        begin("Constraints");
        for (const ConstraintEquation& c : system_.constraints)
            if (c.holds) add(write_(c.position ? *c.position : c.whole_rate) + " = 0", c.name);
        begin("Flows and media");
        for (const auto& [letter, value] : system_.named.names) add(write_(letter) + " = " + write_(value));
        begin("What follows from balances");
        for (const auto* balances : {&system_.named.balanced, &system_.named.junctions})
            for (const auto& [letter, sum] : *balances) add("0 = " + write_(sum), write_(letter));
        begin("Rates of states");
        for (std::size_t i = 0; i < system_.state_rates.size(); ++i)
            add(fmt::format("{} = {}", rate_of_state(system_, i), write_(system_.named.state_rates[i])));
        for (const CellField& field : system_.heat.fields) cells(field);
        begin("Energies");
        energy("kinetic_energy", system_.kinetic_energy);
        energy("potential_energy", system_.potential_energy);
        energy("internal_energy", system_.named.internal_energy, system_.heat.fields.empty() ? "" : "without cells in loops");
        begin("Events: where this falls through zero");
        for (const EventEquation& event : system_.events)
            if (event.is_watched) add(write_(event.guard), event.name);
        begin("Outputs");
        for (const OutputEquation& output : system_.outputs) add(output.name + " = " + write_(system_.named.shortened(output.shown())));
        return std::move(text_);
    }

private:
    void begin(std::string title) { title_ = std::move(title); }

    void definitions() {
        begin("With");
        const std::vector<Variable>& definitions = system_.symbols.all(SymbolKind::definition);
        for (std::size_t i = 0; i < definitions.size(); ++i)
            add(definitions[i].name + " = " + write_(system_.symbols.definition_values()[i]));
    }

    /// What a loop adds to the rates of the cells.
    void cells(const CellField& field) {
        begin(fmt::format("{} cells of {} in a loop: this is added to the rates above", field.cells, field.written()));
        for (const FieldPart& part : field.parts()) add(part.key + " = " + write_(part.value), field.title(part));
    }

    void energy(const char* name, const GiNaC::ex& value, const char* label = "") {
        if (!value.is_zero()) add(std::string(name) + " = " + write_(value), label);
    }

    void add(const std::string& equation, const std::string& name = "") {
        if (!title_.empty()) text_ += "<h3 class=\"part\">" + html_text(title_) + "</h3>\n";
        title_.clear();
        const std::string label = name.empty() ? "" : fmt::format("<span class=\"label\">{}</span>", html_text(name));
        if (equation.size() > longest_formula)
            text_ +=
                fmt::format("<p>{}An equation of {} characters, which <code>dalembert derive</code> prints.</p>\n", label, equation.size());
        else
            text_ += fmt::format("<div class=\"formula\" tabindex=\"0\">{}{}</div>\n", label, math_element(mathml_of_text(equation)));
    }

    const System& system_;
    const Notation write_;
    std::string title_, text_;
};

}  // namespace

std::string equations_as_html(const System& system) { return EquationLines(system).run(); }

}  // namespace dalembert
