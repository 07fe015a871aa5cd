// SPDX-License-Identifier: GPL-3.0-or-later
#include "cpp/header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cpp/helpers.hpp"
#include "cpp/print.hpp"
#include "cpp/tables.hpp"
#include "program/plant_tables.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

constexpr std::size_t indent_of_members = 4;

/// Comment lines, or a hint where they would drown the code.
std::string equations(const PlantFunction& f) {
    if (f.is_large) return "    /// (Too long to be printed here; `dalembert derive` prints the equations.)\n";
    std::string text;
    for (const std::string& one : f.equations) text += cpp_comment("    " + one, indent_of_members);
    return text;
}

std::string function_text(const PlantFunction& f) {
    static constexpr const char* results[]{"void", "Scalar", "bool"};
    std::string text;
    for (const std::string& line : f.doc) text += "    /// " + line + "\n";
    if (f.operations) text += "    /// Operations: " + *f.operations + "\n";
    return text + equations(f) +
           fmt::format("    {} {}({}) const noexcept {{\n", results[static_cast<std::size_t>(f.result)], f.name,
                       cpp_text(f.body.arguments)) +
           cpp_body(f.body.statements) + "    }\n";
}

std::string functions(const Plant& plant) {
    std::string text;
    for (const PlantFunction& f : plant.functions) {
        if (f.name == "together") text += "\n    struct Energies {\n        Scalar kinetic, potential, internal;  ///< J\n    };\n";
        if (f.name == "hessian") {
            const std::size_t size = plant.states.size() + plant.inputs.size();
            text += fmt::format("\n    using Hessian = std::array<Scalar, {}>;  ///< {} x {}\n", size * size, size, size);
        }
        if (f.name == "time_switches") text += fmt::format("\n    using TimeSwitches = std::array<Scalar, {}>;\n", 2 * plant.time_switches);
        if (f.name == "output_jacobian_p") text += "\n    using OutputJacobianP = std::array<Scalar, output_count * parameter_count>;\n";
        if (f.name == "output_jacobian_t") text += "\n    using OutputJacobianT = std::array<Scalar, output_count>;\n";
        text += "\n" + function_text(f);
        if (f.name == "rhs" && plant.series)
            text += "\n" + fill_template(embedded_file("series.hpp.in"), {{"SERIES_ROWS", std::to_string(plant.series->rows)},
                                                                           {"SERIES_ARGUMENTS", cpp_text(plant.series->body.arguments)},
                                                                           {"SERIES", cpp_body(plant.series->body.statements)}});
    }
    return text;
}

std::string listed(const std::vector<bool>& flags) { return fmt::format("{}", fmt::join(flags, ", ")); }

/// Which constraints are solved for, see note [choice]; nothing where all are.
std::string choice(const PlantConstraints& constraints) {
    if (!constraints.choice) return {};
    const PlantChoice& c = *constraints.choice;
    std::string assignments;
    for (const auto& [member, constraint] : c.chosen)
        assignments += fmt::format("        c_.{} = chosen[{}] ? Scalar(1) : Scalar(0);\n", member, constraint);
    return fill_template(embedded_file("constraint_choice.hpp.in"), {{"RANK", std::to_string(c.rank)},
                                                                     {"CAN_BE_LEFT_OUT", listed(c.can_be_left_out)},
                                                                     {"SOLVED_FOR_AT_START", listed(c.at_start)},
                                                                     {"SOLVE_FOR", assignments}});
}

std::string constraint_functions(const Plant& plant) {
    if (!plant.constraints) return {};
    std::string text;
    for (const PlantFunction& f : plant.constraint_functions) {
        text += "\n";
        if (f.name == "move_back") text += choice(*plant.constraints);
        text += function_text(f);
    }
    const std::vector<bool>& found = plant.constraints->starts_to_find;
    if (found.empty()) return text;
    const std::optional<std::size_t>& mode = plant.constraints->start_mode;
    return text + fill_template(embedded_file("meet_constraints.hpp.in"),
                                {{"IS_FOUND", listed(found)}, {"MODE", mode ? fmt::format("Mode::{}, ", plant.modes->modes[*mode]) : ""}});
}

std::string parameter_members(const Plant& plant) {
    std::string text;
    for (const PlantParameter& p : plant.parameter_members) {
        std::vector<std::string> defaults;
        for (const Value& value : p.defaults) defaults.push_back(cpp_text(value));
        const std::string doc = fmt::format("  ///< {}{}{}", p.unit, p.doc.empty() ? "" : ", ", safe_line(p.doc));
        if (!p.is_array) text += fmt::format("    Scalar {} = {};{}\n", p.identifier, defaults[0], doc);
        else text += fmt::format("    std::array<Scalar, {}> {}{{{}}};{}\n", defaults.size(), p.identifier, fmt::join(defaults, ", "), doc);
    }
    return text;
}

std::string cached_members(const Plant& plant) {
    if (plant.cached.empty()) return {};
    std::string text = "    /// Constants computed from the parameters.\n    struct Cached {\n";
    for (const PlantCached& c : plant.cached)
        text += fmt::format("        {} {};  ///< {}\n", c.size == 0 ? "Scalar" : fmt::format("std::array<Scalar, {}>", c.size),
                            c.identifier, c.doc);
    return text + "    };\n    Cached c_{};\n";
}

}  // namespace

std::string cpp_plant(const Plant& plant, const std::string& name_space) {
    std::map<std::string, std::string> values = cpp_tables(plant, name_space);
    const bool meets = plant.constraints && !plant.constraints->starts_to_find.empty();
    values["NAMESPACE"] = name_space;
    values["API_VERSION"] = std::to_string(header_api_version);
    values["PARAMETER_MEMBERS"] = parameter_members(plant);
    values["COUNT_UPDATE"] = plant.update_operations;
    values["UPDATE"] = cpp_body(plant.update.statements);
    values["START_STATE"] = cpp_body(plant.start_state.statements) + (meets ? "        meet_constraints(x);\n" : "");
    values["FUNCTIONS"] = functions(plant);
    values["CONSTRAINT_FUNCTIONS"] = constraint_functions(plant);
    values["CACHED"] = cached_members(plant);
    values["HELPERS"] = helper_source(plant.helpers) + cpp_curves(plant.curves);
    fill_part("QUANTITIES", embedded_file("quantities.hpp.in"), values);
    if (!plant.sampling) return fill_template(embedded_file("system.hpp.in"), values);
    values.merge(sampling_texts(*plant.sampling));
    const std::string_view controller = embedded_file("controller.hpp.in");
    return fill_template(controller, values_for(controller, values));
}

}  // namespace dalembert
