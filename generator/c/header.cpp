// SPDX-License-Identifier: GPL-3.0-or-later
#include "c/header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

#include "c/print.hpp"
#include "c/tables.hpp"
#include "program/plant_tables.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

class HeaderPrinter {
public:
    HeaderPrinter(const Plant& plant, const std::string& name) : plant_(plant), name_(name), print_(plant, name) {}

    std::string run() {
        std::map<std::string, std::string> values = c_tables(plant_, name_);
        values["NAME"] = name_;
        values["MODEL"] = cpp_string(plant_.model);
        values["SCENE"] = cpp_string(plant_.scene);
        values["TITLE"] = cpp_string(plant_.title);
        values["COUNT_UPDATE"] = plant_.update_operations;
        parameters(values);
        values["UPDATE"] = print_.text(plant_.update.statements);
        values["FUNCTIONS"] = functions();
        start_state(values);
        const std::string tables = print_.curves(plant_.curves);
        values["HELPERS"] = c_helper_source(print_.called(), name_) + tables;  // of all that was printed so far
        fill_part("QUANTITIES", embedded_file("quantities.h.in"), values);
        values["NAME"] = name_;  // of both
        if (!plant_.sampling) return fill_template(embedded_file("plant.h.in"), values);
        values.merge(sampling_texts(*plant_.sampling));
        const std::string_view controller = embedded_file("controller.h.in");
        return fill_template(controller, values_for(controller, values));
    }

private:
    void parameters(std::map<std::string, std::string>& values) {
        std::string members, defaults, cached;
        for (const PlantParameter& p : plant_.parameter_members) {
            members +=
                fmt::format("    {}_real {}{};  ///< {}{}{}\n", name_, p.identifier,
                            p.is_array ? fmt::format("[{}]", p.defaults.size()) : "", p.unit, p.doc.empty() ? "" : ", ", safe_line(p.doc));
            for (std::size_t i = 0; i < p.defaults.size(); ++i)
                defaults +=
                    fmt::format("    p.{}{} = {};\n", p.identifier, p.is_array ? fmt::format("[{}]", i) : "", print_.text(p.defaults[i]));
        }
        // C has no structures without members.
        if (members.empty()) members = "    char none_;\n", defaults = "    p.none_ = 0;\n";
        for (const PlantCached& c : plant_.cached)
            cached +=
                fmt::format("        {}_real {}{};  ///< {}\n", name_, c.identifier, c.size == 0 ? "" : fmt::format("[{}]", c.size), c.doc);
        values["PARAMETER_MEMBERS"] = members;
        values["DEFAULTS"] = defaults;
        values["CACHED"] = cached.empty() ? "" : "    struct {\n" + cached + "    } c;  ///< depends on parameters alone\n";
    }

    /// Comment lines, or a hint where they would drown the code.
    static std::string equations(const PlantFunction& f) {
        if (f.is_large) return "/// (Too long to be printed here; `dalembert derive` prints the equations.)\n";
        std::string text;
        for (const std::string& one : f.equations) text += cpp_comment("    " + one, 0);
        return text;
    }

    std::string function(const PlantFunction& f) {
        std::string text;
        for (const std::string& line : f.doc) text += "/// " + line + "\n";
        if (f.operations) text += "/// Operations: " + *f.operations + "\n";
        const std::string result = f.result == PlantFunction::Result::none    ? "void"
                                   : f.result == PlantFunction::Result::truth ? "bool"
                                                                              : name_ + "_real";
        const std::string arguments = print_.text(f.body.arguments);
        const std::string head = fmt::format("static inline {} {}_{}(const {}* plant_{}{}) {{", result, name_, f.name, name_,
                                             arguments.empty() ? "" : ", ", arguments);
        return text + equations(f) + broken_at_commas(head) + print_.body(f.body) + "}\n\n";
    }

    static std::string broken_at_commas(std::string line) {
        constexpr std::size_t longest = 128;
        std::string text;
        while (line.size() > longest) {
            const std::size_t comma = line.rfind(", ", longest - 2);
            if (comma == std::string::npos) break;
            text += line.substr(0, comma + 1) + "\n";
            line = "    " + line.substr(comma + 2);
        }
        return text + line + "\n";
    }

    std::string functions() {
        std::string text;
        for (const PlantFunction& f : plant_.functions) {
            if (f.name == "together")
                text += fmt::format(
                    "typedef struct {0}_energies {{\n    {0}_real kinetic, potential, internal;  ///< J\n}} {0}_energies;\n\n", name_);
            text += function(f);
            if (f.name == "rhs") text += series();
        }
        for (const PlantFunction& f : plant_.constraint_functions) {
            if (f.name == "move_back") text += choice(*plant_.constraints);
            text += function(f);
        }
        return text + meet_constraints();
    }

    /// Nothing where none were asked for.
    std::string series() {
        if (!plant_.series) return {};
        const FunctionBody& body = plant_.series->body;
        return fill_template(embedded_file("series.h.in"),
                             {{"NAME", name_},
                              {"STATES_AND_WORK", std::to_string(plant_.states.size() + 1)},
                              {"ARGUMENTS", fmt::format("const {}* plant_, {}", name_, print_.text(body.arguments))},
                              {"SERIES", print_.body(body)}});
    }

    std::string choice(const PlantConstraints& constraints) const {
        if (!constraints.choice) return {};
        std::string assignments;
        for (const auto& [member, constraint] : constraints.choice->chosen)
            assignments += fmt::format("    plant_->c.{0} = chosen[{1}] ? {2}_R(1) : {2}_R(0);\n", member, constraint, name_);
        return fmt::format(
            "/// Chooses the constraints to solve for, until the next call: {0}_constraint_rank of them, independent at the present "
            "state.\n"
            "/// {0}_update() takes those of the start.\n"
            "static inline void {0}_solve_for({0}* plant_, const bool chosen[{1}]) {{\n{2}}}\n\n",
            name_, constraints.list.size(), assignments);
    }

    bool has_starts_to_find() const { return plant_.constraints && !plant_.constraints->starts_to_find.empty(); }

    std::string meet_constraints() {
        if (!has_starts_to_find()) return {};
        print_.call(CHelper{"sqrt"});
        const std::size_t places = plant_.states.size() - plant_.plain_states - plant_.degrees;
        const std::optional<std::size_t>& mode = plant_.constraints->start_mode;
        return fill_template(embedded_file("meet_constraints.h.in"),
                             {{"NAME", name_},
                              {"STATES", std::to_string(plant_.states.size())},
                              {"DEGREES", std::to_string(plant_.degrees)},
                              {"CONSTRAINTS", std::to_string(plant_.constraints->list.size())},
                              {"VELOCITY_PLACE", std::to_string(places)},
                              {"MODE", mode ? fmt::format("{}_m_{}, ", name_, plant_.modes->modes[*mode]) : ""},
                              {"IS_FOUND", fmt::format("{}", fmt::join(plant_.constraints->starts_to_find, ", "))}});
    }

    void start_state(std::map<std::string, std::string>& values) {
        values["START_ARGUMENTS"] = fmt::format("const {0}* plant_, {0}_real x[{1}]", name_, plant_.states.size());
        const bool meets = has_starts_to_find();
        const std::string unused = meets || uses_plant(plant_.start_state.statements) ? "" : "    (void)plant_;\n";
        values["START_STATE"] = unused + print_.text(plant_.start_state.statements) +
                                (meets ? fmt::format("    {}_meet_constraints(plant_, x);\n", name_) : "");
    }

    const Plant& plant_;
    const std::string name_;
    CPrinter print_;
};

}  // namespace

std::string c_plant(const Plant& plant, const std::string& name) { return HeaderPrinter(plant, name).run(); }

std::string c_file(const std::string& content, const std::string& name, const std::string& banner) {
    std::string guard = name + "_h";
    for (char& c : guard) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return fill_template(embedded_file("header.h.in"), {{"BANNER", banner}, {"GUARD", guard}, {"CONTENT", content}});
}

}  // namespace dalembert
