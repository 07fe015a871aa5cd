// SPDX-License-Identifier: GPL-3.0-or-later
#include "js/module.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "js/print.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"
#include "text/wrap.hpp"

namespace dalembert {

namespace {

constexpr int js_api_version = 1;

class ModulePrinter {
public:
    ModulePrinter(const Plant& plant, const std::string& name) : plant_(plant), name_(name), print_(plant) {}

    std::string run(const std::string& banner) {
        std::map<std::string, std::string> values{{"BANNER", banner}, {"NAME", name_}};
        parameters(values);
        values["COUNT_UPDATE"] = plant_.update_operations;
        values["UPDATE"] = print_.text(plant_.update.statements);
        values["FUNCTIONS"] = functions();
        values["STATES"] = std::to_string(plant_.states.size());
        values["START_STATE"] =
            print_.text(plant_.start_state.statements) + (has_starts_to_find() ? "        $meet_constraints(x);\n" : "");
        values["CONSTRAINTS"] = constraints();
        values["INTERFACE"] = interface();
        values["HELPERS"] = shifted(js_helper_source(print_.called())) + print_.curves(plant_.curves);  // of all that was printed so far
        return fill_template(embedded_file("module.js.in"), values);
    }

private:
    static std::string comment(const std::string& unit, const std::string& doc) {
        return fmt::format("  // {}{}{}", unit, doc.empty() ? "" : ", ", safe_line(doc));
    }

    void parameters(std::map<std::string, std::string>& values) {
        std::string members, cached, setters;
        std::size_t next = 0;
        for (const PlantParameter& p : plant_.parameter_members) {
            std::vector<std::string> defaults;
            for (const Value& value : p.defaults) defaults.push_back(print_.text(value));
            const std::string all = fmt::format("{}", fmt::join(defaults, ", "));
            members +=
                fmt::format("        {}: {},{}\n", p.identifier, p.is_array ? "Float64Array.of(" + all + ")" : all, comment(p.unit, p.doc));
            for (std::size_t i = 0; i < p.defaults.size(); ++i)
                setters += fmt::format("        $p.{}{} = numbers[{}];\n", p.identifier, p.is_array ? fmt::format("[{}]", i) : "", next++);
        }
        for (const PlantCached& c : plant_.cached)
            cached += fmt::format("        {}: {},{}\n", c.identifier, c.size == 0 ? "0" : fmt::format("new Float64Array({})", c.size),
                                  comment("depends on parameters alone", c.doc));
        values["PARAMETERS"] = members;
        values["CACHED"] = cached;
        values["SETTERS"] = setters;
    }

    static std::string equations(const PlantFunction& f) {
        if (f.is_large) return "    /// (Too long to be printed here; `dalembert derive` prints the equations.)\n";
        std::string text;
        for (const std::string& one : f.equations) text += cpp_comment("    " + one, 4);
        return text;
    }

    std::string function(const PlantFunction& f) {
        std::string text;
        for (const std::string& line : f.doc) text += "    /// " + line + "\n";
        if (f.operations) text += "    /// Operations: " + *f.operations + "\n";
        functions_.push_back(f.name);
        return text + equations(f) + fmt::format("    function ${}({}) {{\n", f.name, JsPrinter::text(f.body.arguments)) +
               print_.text(f.body.statements) + "    }\n\n";
    }

    std::string functions() {
        std::string text;
        for (const PlantFunction& f : plant_.functions) text += function(f);
        for (const PlantFunction& f : plant_.constraint_functions) {
            if (f.name == "move_back") text += choice();
            text += function(f);
        }
        return text + meet_constraints();
    }

    /// Chooses the constraints to solve for.
    std::string choice() {
        if (!plant_.constraints->choice) return {};
        std::string assignments;
        for (const auto& [member, constraint] : plant_.constraints->choice->chosen)
            assignments += fmt::format("        $c.{} = chosen[{}] ? 1 : 0;\n", member, constraint);
        functions_.push_back("solve_for");
        return "    /// Chooses the constraints to solve for, until the next call. update() takes those of the start.\n"
               "    function $solve_for(chosen) {\n" +
               assignments + "    }\n\n";
    }

    bool has_starts_to_find() const { return plant_.constraints && !plant_.constraints->starts_to_find.empty(); }

    std::string meet_constraints() const {
        if (!has_starts_to_find()) return {};
        const std::optional<std::size_t>& mode = plant_.constraints->start_mode;
        const std::string in_c =
            fill_template(embedded_file("meet_constraints.h.in"),
                          {{"NAME", "NAME"},
                           {"STATES", std::to_string(plant_.states.size())},
                           {"DEGREES", std::to_string(plant_.degrees)},
                           {"CONSTRAINTS", std::to_string(plant_.constraints->list.size())},
                           {"VELOCITY_PLACE", std::to_string(plant_.states.size() - plant_.plain_states - plant_.degrees)},
                           {"MODE", mode ? fmt::format("{}, ", *mode) : ""},
                           {"IS_FOUND", fmt::format("{}", fmt::join(plant_.constraints->starts_to_find, ", "))}});
        return "    function $constraint_table() { return $constraints; }\n\n" + shifted(js_from_functions(in_c));
    }

    static std::string range(const std::optional<double>& bound, const char* without) { return bound ? js_number(*bound) : without; }

    static std::string quantities(const std::vector<PlantQuantity>& list) {
        std::string text;
        for (const PlantQuantity& q : list)
            text += fmt::format("            {{ name: {}, identifier: {}, unit: {}, description: {}, low: {}, high: {} }},\n",
                                js_string(q.name), js_string(q.identifier), js_string(q.unit), js_string(q.doc), range(q.low, "-Infinity"),
                                range(q.high, "Infinity"));
        return text.empty() ? "[]" : "[\n" + text + "        ]";
    }

    static std::string pattern(const PlantPattern& p) {
        if (!p.is_sparse) return "null";
        return fmt::format("{{ column_starts: [{}], row_indices: [{}] }}", fmt::join(p.column_starts, ", "),
                           fmt::join(p.row_indices, ", "));
    }

    std::string modes() const {
        if (!plant_.modes) return "        modes: [],\n        events: [],\n        transitions: [],\n";
        std::vector<std::string> names, events, rows;
        for (const std::string& mode : plant_.modes->modes) names.push_back(js_string(mode));
        for (const PlantEvent& e : plant_.modes->events)
            events.push_back(fmt::format("{{ name: {}, identifier: {}, at_once: {}, at_start: {} }}", js_string(e.name),
                                         js_string(e.identifier), e.at_once, e.at_start));
        for (const std::vector<PlantTransition>& of_event : plant_.modes->transitions) {
            std::vector<std::string> all;
            for (const PlantTransition& to : of_event)
                all.push_back(fmt::format("{{ is_watched: {}, next: [{}], beside: [{}], rest: [{}] }}", to.is_watched,
                                          fmt::join(to.next, ", "), fmt::join(to.beside, ", "), fmt::join(to.rest, ", ")));
            rows.push_back(fmt::format("[{}]", fmt::join(all, ", ")));
        }
        return fmt::format("        modes: [{}],\n        events: [{}],\n        transitions: [\n            {},\n        ],\n",
                           fmt::join(names, ", "), fmt::join(events, ", "), fmt::join(rows, ",\n            "));
    }

    std::string constraints() const {
        if (!plant_.constraints) return "null";
        std::string text;
        const PlantConstraints& c = *plant_.constraints;
        for (std::size_t i = 0; i < c.list.size(); ++i)
            text += fmt::format(
                "            {{ name: {}, unit: {}, description: {}, has_position: {}, can_be_left_out: {}, solved_for_at_start: {} }},\n",
                js_string(c.list[i].name), js_string(c.list[i].unit), js_string(c.list[i].doc), c.list[i].has_position,
                c.choice && c.choice->can_be_left_out[i], !c.choice || c.choice->at_start[i]);
        return text.empty() ? "[]" : "[\n" + text + "        ]";
    }

    std::string interface() const {
        std::string guards;
        for (const PlantGuard& g : plant_.guards)
            guards += fmt::format("            {{ name: {}, doc: {}, ends: {} }},\n", js_string(g.name), js_string(g.doc), g.ends);
        std::string text = fmt::format("        api_version: {},\n        model: {},\n        scene: {},\n        title: {},\n",
                                       js_api_version, js_string(plant_.model), js_string(plant_.scene), js_string(plant_.title));
        text += fmt::format("        degrees: {},\n        plain_states: {},\n        is_separable: {},\n", plant_.degrees,
                            plant_.plain_states, plant_.is_separable);
        for (const auto& [name, list] : {std::pair{"states", &plant_.states}, std::pair{"inputs", &plant_.inputs},
                                         std::pair{"outputs", &plant_.outputs}, std::pair{"parameters", &plant_.parameters}})
            text += fmt::format("        {}: {},\n", name, quantities(*list));
        text += fmt::format("        guard_table: {},\n", guards.empty() ? "[]" : "[\n" + guards + "        ]") + modes();
        if (plant_.time_switches > 0) text += fmt::format("        time_switch_count: {},\n", plant_.time_switches);
        text +=
            "        // Constraints that hold; null where no state needs to be brought back to anything.\n        constraints: "
            "$constraints,\n";
        text += fmt::format("        constraint_rank: {},\n",
                            plant_.constraints && plant_.constraints->choice ? plant_.constraints->choice->rank : 0);
        text += "        // Stored entries of Jacobians in compressed columns; null: all, column by column.\n";
        for (const auto& [letter, p] :
             {std::pair{'x', &plant_.by_state}, std::pair{'u', &plant_.by_input}, std::pair{'p', &plant_.by_parameter}})
            text += fmt::format("        pattern_{}: {},\n", letter, pattern(*p));
        text +=
            "        parameter_values: $p,\n        set_parameters: $set_parameters,\n        update: $update,\n        start_state: "
            "$start_state,\n";
        for (const std::string& one : functions_) text += fmt::format("        {0}: ${0},\n", one);
        return text;
    }

    const Plant& plant_;
    const std::string& name_;
    JsPrinter print_;
    std::vector<std::string> functions_;
};

}  // namespace

std::string js_module(const Plant& plant, const std::string& name, const std::string& banner) {
    return ModulePrinter(plant, name).run(banner);
}

}  // namespace dalembert
