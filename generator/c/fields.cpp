// SPDX-License-Identifier: GPL-3.0-or-later
#include "c/fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "c/header.hpp"
#include "c/print.hpp"
#include "c/tables.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// C has no arrays without entries.
std::size_t room(std::size_t size) { return std::max<std::size_t>(size, 1); }

class FieldPrinter {
public:
    FieldPrinter(const Plant& core, const PlantFields& fields, const std::string& name)
        : core_(core),
          fields_(fields),
          name_(name),
          whole_(whole_plant(core, fields)),
          print_(whole_, name),
          arguments_(fmt::format("const {0}* plant_, const {0}_real* x, const {0}_real* u, {0}_real t", name)) {}

    std::string run() {
        sizes();
        tables();
        const auto statements = [&](const char* key, const Statements& body) { texts_[key] = print_.text(body); };
        statements("UPDATE", fields_.update);
        statements("START_STATE", fields_.start_state);
        statements("CELL_RATES", fields_.rates);
        statements("CELL_JACOBIAN", fields_.jacobian);
        statements("CELL_JACOBIAN_U", fields_.by_input);
        statements("CELL_JACOBIAN_P", fields_.by_parameter);
        statements("CELL_JACOBIAN_T", fields_.by_time);
        statements("CELL_ENERGY", fields_.energy);
        statements("CELL_POWER", fields_.power);
        texts_["CORE_FUNCTIONS"] = core_functions();
        sums();
        texts_["NAME"] = name_;
        texts_["ARGUMENTS"] = arguments_;
        texts_["CORE"] = c_plant(core_, name_ + "_core");
        const std::string tables = print_.curves(fields_.curves);
        texts_["HELPERS"] = c_helper_source(print_.called(), name_) + tables;  // of all that was printed so far
        return fill_template(embedded_file("fields.h.in"), texts_);
    }

private:
    void sizes() {
        const auto number = [&](const char* key, std::size_t value) { texts_[key] = std::to_string(value); };
        number("SIZE_C", whole_.outputs.size() * whole_.states.size());
        number("CORE_STATES", core_.states.size());
        number("CORE_ROOM", room(core_.states.size()));
        number("CORE_SIZE_X", room(core_.by_state.size()));
        number("CORE_SIZE_U", room(core_.by_input.size()));
        number("CORE_SIZE_P", room(core_.by_parameter.size()));
        number("CORE_SIZE_C", room(core_.outputs.size() * core_.states.size()));
    }

    void tables() {
        std::map<std::string, std::string> all = c_tables(whole_, name_, fields_.indices);
        for (const char* key : {"API_VERSION", "DEGREES", "PLAIN_STATES", "STATES", "INPUTS", "OUTPUTS", "PARAMETERS", "GUARD_COUNT",
                                "SIZE_X", "SIZE_U", "SIZE_P", "INDICES", "STATE_TABLE"})
            texts_[key] = all.at(key);
        texts_["PATTERN"] = all.at("PATTERN_X");
        texts_["POSITIONS"] = fields_.positions.empty() ? "0" : fmt::format("{}", fmt::join(fields_.positions, ", "));
        for (const std::string& line : fields_.equations) texts_["FIELD_EQUATIONS"] += cpp_comment(line, 0);
        std::string cached;
        for (const PlantCached& member : fields_.cached)
            cached +=
                fmt::format("        {}_real {}{};\n", name_, member.identifier, member.size > 0 ? fmt::format("[{}]", member.size) : "");
        texts_["CACHED"] =
            cached.empty() ? ""
                           : "    struct {\n" + cached + "    } c;  ///< depends on parameters alone; of cells one by one\n";
    }

    /// Those that cells do not change.
    std::string core_functions() const {
        std::string text;
        const auto add = [&](const char* function, const char* result) {
            const bool is_number = *result == '\0',
                       of_state = std::string(function) == "kinetic_energy" || std::string(function) == "potential_energy";
            const std::string arguments = of_state ? fmt::format("const {0}* plant_, const {0}_real* x, {0}_real t", name_) : arguments_;
            text += fmt::format(
                "static inline {0} {1}_{2}({3}{4}) {{\n    {1}_real state_[{5}];\n    {1}_core_state(x, state_);\n    "
                "{6}{1}_core_{2}(&plant_->core, state_, {7}t{8});\n}}\n",
                is_number ? name_ + "_real" : "void", name_, function, arguments,
                is_number ? "" : fmt::format(", {}_real* {}", name_, result), room(core_.states.size()), is_number ? "return " : "",
                of_state ? "" : "u, ", is_number ? "" : fmt::format(", {}", result));
        };
        add("bias", "b");
        add("generalised_force", "Q");
        add("guards", "g");
        if (core_.time_switches > 0) add("time_switches", "s");
        for (const char* number : {"kinetic_energy", "potential_energy", "supplied_power", "dissipated_power", "prescribed_power"})
            add(number, "");
        return text;
    }

    /// Outputs that contain sums over cells; nothing where there are none.
    void sums() {
        for (const char* key : {"OUTPUT_SUMS", "OUTPUT_SUMS_X", "OUTPUT_SUMS_U", "SUM_FUNCTIONS"}) texts_[key];
        if (!fields_.sums) return;
        const PlantSums& s = *fields_.sums;
        texts_["OUTPUT_SUMS"] = fmt::format(
            "    {{\n        {0}_real sums[{1}];\n        {0}_cell_sums(plant_, x, u, t, sums);\n        {0}_output_of_sums(plant_, "
            "state_, u, t, sums, y);\n    }}\n",
            name_, s.count);
        texts_["OUTPUT_SUMS_X"] = fmt::format("    {}_add_output_slopes(plant_, x, u, t, state_, C);\n", name_);
        texts_["OUTPUT_SUMS_U"] = fmt::format("    {}_add_output_slopes_by_inputs(plant_, x, u, t, state_, D);\n", name_);
        texts_["SUM_FUNCTIONS"] = fill_template(embedded_file("field_sums.h.in"), {{"NAME", name_},
                                                                                  {"ARGUMENTS", arguments_},
                                                                                  {"OUTPUTS", std::to_string(whole_.outputs.size())},
                                                                                  {"SUM_COUNT", std::to_string(s.count)},
                                                                                  {"SUM_LOOPS", print_.text(s.values)},
                                                                                  {"SUM_SLOPES", print_.text(s.slopes)},
                                                                                  {"SUM_SLOPES_U", print_.text(s.slopes_by_inputs)},
                                                                                  {"OUTPUT_VALUES", print_.text(s.outputs)},
                                                                                  {"OUTPUT_BY_STATE", print_.text(s.by_state)},
                                                                                  {"OUTPUT_BY_INPUT", print_.text(s.by_input)},
                                                                                  {"OUTPUT_BY_SUM", print_.text(s.by_sum)}});
    }

    const Plant& core_;
    const PlantFields& fields_;
    const std::string name_;
    const Plant whole_;
    CPrinter print_;
    const std::string arguments_;
    std::map<std::string, std::string> texts_;
};

}  // namespace

std::string c_fields(const Plant& core, const PlantFields& fields, const std::string& name) {
    return FieldPrinter(core, fields, name).run();
}

}  // namespace dalembert
