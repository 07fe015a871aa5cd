// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/plant_in_c.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "text/safe_text.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// A function that goes into the table as it is.
struct Row {
    const char* member;    ///< of the table
    const char* function;  ///< of the header
    bool takes_input;
    const char* result;    ///< its array; null: it returns a number
    bool is_optional = false;  ///< headers have it where it was asked for
};
constexpr Row rows[]{
    {"rhs", "rhs", true, "dxdt"},
    {"jacobian_t", "jacobian_t", true, "dfdt"},
    {"output", "output", true, "y"},
    {"output_jacobian_x", "output_jacobian_x", true, "C"},
    {"output_jacobian_u", "output_jacobian_u", true, "D"},
    {"output_jacobian_p", "output_jacobian_p", true, "C_p", true},
    {"output_jacobian_t", "output_jacobian_t", true, "C_t", true},
    {"mass_matrix", "mass_matrix", false, "M"},
    {"kinetic_energy", "kinetic_energy", false, nullptr},
    {"potential_energy", "potential_energy", false, nullptr},
    {"internal_energy", "internal_energy", false, nullptr},
    {"supplied_power", "supplied_power", true, nullptr},
    {"dissipated_power", "dissipated_power", true, nullptr},
    {"prescribed_power", "prescribed_power", true, nullptr},
    {"exchanged_power", "exchanged_power", true, nullptr},
};
constexpr Row guards{"guard_values", "guards", true, "g"};
constexpr Row time_switches{"time_switch_values", "time_switches", true, "s", true};
constexpr Row mode_rows[]{{"guard_rates", "guard_rates", true, "rates"}, {"kink_values", "kinks", true, "k"}};
constexpr Row constraint_rows[]{
    {"constraint_positions", "constraint_positions", false, "f"},
    {"constraint_rates", "constraint_rates", false, "w"},
    {"constraint_jacobian", "constraint_jacobian", false, "A"},
};

/// Shortest text that is read as the same number.
std::string number(double value) {
    if (std::isinf(value)) return value > 0 ? "HUGE_VAL" : "-HUGE_VAL";  // INFINITY is a float: clang warns
    const std::string text = fmt::format("{}", value);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string guard_of(std::string name) {
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return name + "_PLANT_H";
}

class TablePrinter {
public:
    TablePrinter(const Plant& plant, const std::string& name) : plant_(plant), name_(name) {}

    std::string run(const std::vector<double>& start_values, const std::vector<double>& parameter_defaults) {
        member("version", "DALEMBERT_PLANT_VERSION");
        member("size", "sizeof(dalembert_plant)");
        member("name", cpp_string(plant_.model));
        member("scene", cpp_string(plant_.scene));
        member("title", cpp_string(plant_.title));
        quantities("state", plant_.states);
        quantities("input", plant_.inputs);
        quantities("output", plant_.outputs);
        quantities("parameter", plant_.parameters);
        member("degrees", plant_.degrees);
        member("velocity_place", plant_.states.size() - plant_.plain_states - plant_.degrees);
        numbers("defaults", "parameter_defaults", parameter_defaults);
        numbers("start", "start_values", start_values);
        member("is_separable", plant_.is_separable ? 1 : 0);
        for (const char* function : {"create", "destroy", "set_parameters", "start_state"})
            member(function, fmt::format("{}_plant_{}", name_, function));
        for (const Row& row : rows) add(row);
        jacobian("pattern_x", "rhs_and_jacobian", "rhs_and_jacobian", "dxdt, ", plant_.by_state);
        jacobian("pattern_u", "jacobian_u", "jacobian_u", "", plant_.by_input);
        jacobian("pattern_p", "jacobian_p", "jacobian_p", "", plant_.by_parameter);
        add(guards);
        add(time_switches);
        if (plant_.time_switches > 0) member("time_switches", plant_.time_switches);
        if (plant_.modes) modes(*plant_.modes);
        else guard_table();
        if (plant_.constraints) constraints(*plant_.constraints);
        return fill_template(embedded_file("plant_table.h.in"), {{"NAME", name_},
                                                                 {"GUARD", guard_of(name_)},
                                                                 {"TABLES", tables_},
                                                                 {"SET_PARAMETERS", set_parameters()},
                                                                 {"FUNCTIONS", functions_},
                                                                 {"MEMBERS", members_}});
    }

private:
    void member(const char* member, const std::string& value) { members_ += fmt::format("    .{} = {},\n", member, value); }
    void member(const char* name, std::size_t value) { member(name, std::to_string(value)); }

    /// A constant array, unless it is empty: C has none of these. Returns what points to it.
    std::string array(const char* type, const std::string& own_name, const std::vector<std::string>& entries, const char* between) {
        if (entries.empty()) return "NULL";
        const std::string whole = fmt::format("{}_plant_{}", name_, own_name);
        tables_ += fmt::format("static const {} {}[{}] = {{\n    {}\n}};\n\n", type, whole, entries.size(), fmt::join(entries, between));
        return whole;
    }
    static constexpr const char* lines = ",\n    ";

    void quantities(const std::string& vector, const std::vector<PlantQuantity>& list) {
        std::vector<std::string> entries;
        for (const PlantQuantity& q : list)
            entries.push_back(fmt::format("{{{}, {}, {}, {}, {}}}", cpp_string(q.name), cpp_string(q.unit), cpp_string(q.doc),
                                          number(q.low.value_or(-INFINITY)), number(q.high.value_or(INFINITY))));
        member((vector + "s").c_str(), list.size());
        member((vector + "_table").c_str(), array("dalembert_quantity", vector + "s", entries, lines));
    }

    void numbers(const char* own_name, const char* member_name, const std::vector<double>& list) {
        std::vector<std::string> entries;
        for (const double value : list) entries.push_back(number(value));
        // A plant always has both; without entries nothing reads them.
        const std::string place = array("double", own_name, entries.empty() ? std::vector<std::string>{"0.0"} : entries, lines);
        member(member_name, place);
    }

    static std::vector<std::string> texts(const std::vector<std::size_t>& list) {
        std::vector<std::string> result;
        for (const std::size_t value : list) result.push_back(std::to_string(value));
        return result;
    }

    void guard_table() {
        std::vector<std::string> entries;
        for (const PlantGuard& g : plant_.guards)
            entries.push_back(fmt::format("{{{}, {}, {}}}", cpp_string(g.name), cpp_string(g.doc), g.ends ? 1 : 0));
        member("guards", plant_.guards.size());
        member("guard_table", array("dalembert_guard", "guards", entries, lines));
    }

    std::string set_parameters() const {
        std::string text;
        std::size_t next = 0;
        for (const PlantParameter& p : plant_.parameter_members)
            for (std::size_t i = 0; i < p.defaults.size(); ++i)
                text += fmt::format("    p_.{}{} = numbers[{}];\n", p.identifier, p.is_array ? fmt::format("[{}]", i) : "", next++);
        return text;
    }

    std::string self() const { return fmt::format("(const {}*)self", name_); }
    std::string mode() const { return plant_.modes ? fmt::format("({}_mode)mode, ", name_) : ""; }
    std::string unused_mode() const { return plant_.modes ? "" : "    (void)mode;\n"; }

    void add(const Row& row) {
        const auto is_it = [&](const PlantFunction& f) { return std::string_view(row.function) == f.name; };
        if (row.is_optional && std::none_of(plant_.functions.begin(), plant_.functions.end(), is_it)) return;
        const bool is_number = row.result == nullptr;
        functions_ += fmt::format("static {} {}_plant_{}(const void* self, unsigned mode, const double* x, {}double t{}) {{\n",
                                  is_number ? "double" : "void", name_, row.member, row.takes_input ? "const double* u, " : "",
                                  is_number ? "" : fmt::format(", double* {}", row.result)) +
                      unused_mode() +
                      fmt::format("    {}{}_{}({}, {}x, {}t{});\n}}\n\n", is_number ? "return " : "", name_, row.function, self(), mode(),
                                  row.takes_input ? "u, " : "", is_number ? "" : fmt::format(", {}", row.result));
        member(row.member, fmt::format("{}_plant_{}", name_, row.member));
    }

    /// Where the header stores all entries, those that are zero for every motion are left out.
    void jacobian(const char* pattern, const char* member_name, const char* function, const std::string& before, const PlantPattern& p) {
        const bool is_masked = !p.is_sparse && !p.column_starts.empty() && p.row_indices.size() < p.rows * p.columns;
        if (p.is_sparse || is_masked) {
            const std::string starts = array("size_t", std::string(pattern) + "_starts", texts(p.column_starts), ", ");
            const std::vector<std::string> indices = p.row_indices.empty() ? std::vector<std::string>{"0"} : texts(p.row_indices);
            const std::string row_indices = array("size_t", std::string(pattern) + "_rows", indices, ", ");
            member(pattern, fmt::format("{{{}, {}}}", starts, row_indices));
        }
        const std::string head = fmt::format(
            "static void {}_plant_{}(const void* self, unsigned mode, const double* x, const double* u, double t, {}double* J) "
            "{{\n",
            name_, member_name, before.empty() ? "" : "double* dxdt, ");
        const auto call = [&](const char* to) {
            return fmt::format("    {}_{}({}, {}x, u, t, {}{});\n", name_, function, self(), mode(), before, to);
        };
        if (is_masked && p.row_indices.empty())
            // Nothing to write; dx/dt may be.
            functions_ += head + fmt::format("    double all_[{}];\n", std::max<std::size_t>(1, p.rows * p.columns)) + unused_mode() +
                          "    (void)J;\n" + call("all_") + "}\n\n";
        else if (is_masked)
            functions_ += head + fmt::format("    double all_[{}];\n", p.rows * p.columns) + unused_mode() + call("all_") +
                          fmt::format("    for (size_t c = 0; c < {2}; ++c)\n"
                                      "        for (size_t i = {0}_plant_{1}_starts[c]; i < {0}_plant_{1}_starts[c + 1]; ++i)\n"
                                      "            J[i] = all_[{3} * c + {0}_plant_{1}_rows[i]];\n}}\n\n",
                                      name_, pattern, p.columns, p.rows);
        else functions_ += head + unused_mode() + call("J") + "}\n\n";
        member(member_name, fmt::format("{}_plant_{}", name_, member_name));
    }

    void modes(const PlantModes& m) {
        std::vector<std::string> modes, events;
        for (const std::string& one : m.modes) modes.push_back(cpp_string(one));
        for (const PlantEvent& one : m.events) events.push_back(cpp_string(one.name));
        member("modes", m.modes.size());
        member("events", m.events.size());
        member("kinks", plant_.guards.size());
        member("mode_names", array("char* const", "modes", modes, lines));
        member("event_names", array("char* const", "events", events, lines));
        member("most_transitions", m.most_modes());
        for (const Row& row : mode_rows) add(row);
        const bool at_once = std::any_of(m.events.begin(), m.events.end(), [](const PlantEvent& e) { return e.at_once; });
        functions_ += fill_template(embedded_file("plant_table_modes.h.in"), {{"NAME", name_}});
        for (const char* one : {"is_watched", "reset", "settle", "transitions"}) member(one, fmt::format("{}_plant_{}", name_, one));
        const auto is_holds = [](const PlantFunction& f) { return f.name == "holds"; };
        if (std::any_of(plant_.functions.begin(), plant_.functions.end(), is_holds)) {
            functions_ += fmt::format(
                "static int {0}_plant_holds(const void* self, unsigned mode, const double* x, const double* u, double t) {{\n"
                "    return {0}_holds((const {0}*)self, ({0}_mode)mode, x, u, t);\n}}\n\n", name_);
            member("holds", name_ + "_plant_holds");
        }
        if (!at_once) return;
        for (const char* when : {"at_once", "at_start"}) {
            functions_ += fmt::format("static int {0}_plant_happens_{1}(size_t event) {{ return {0}_{1}()[event]; }}\n\n", name_, when);
            member(fmt::format("happens_{}", when).c_str(), fmt::format("{}_plant_happens_{}", name_, when));
        }
    }

    void constraints(const PlantConstraints& c) {
        member("is_projected", std::size_t{1});
        functions_ += fmt::format(
            "static void {0}_plant_move_back(const void* self, double* x, const double* step) {{\n    {0}_move_back((const {0}*)self, x, "
            "step);\n}}\n\n", name_);
        member("move_back", name_ + "_plant_move_back");
        if (c.list.empty()) return;
        std::vector<std::string> entries;
        for (std::size_t i = 0; i < c.list.size(); ++i)
            entries.push_back(fmt::format("{{{}, {}, {}, {}, {}, {}}}", cpp_string(c.list[i].name), cpp_string(c.list[i].unit),
                                          cpp_string(c.list[i].doc), c.list[i].has_position ? 1 : 0,
                                          c.choice && c.choice->can_be_left_out[i] ? 1 : 0, !c.choice || c.choice->at_start[i] ? 1 : 0));
        member("constraints", c.list.size());
        member("constraint_table", array("dalembert_constraint", "constraints", entries, lines));
        for (const Row& row : constraint_rows) add(row);
        functions_ += fmt::format(
            "static void {0}_plant_correction(const void* self, unsigned mode, const double* x, double t, const double* residual, double* "
            "step) {{\n{1}    {0}_correction((const {0}*)self, {2}x, t, residual, step);\n}}\n\n", name_, unused_mode(), mode());
        member("correction", name_ + "_plant_correction");
        if (!c.choice) return;
        member("constraint_rank", c.choice->rank);
        functions_ += fmt::format(
            "static void {0}_plant_solve_for(void* self, const int* chosen) {{\n    bool flags[{1}];\n    for (size_t i = 0; i < {1}; ++i) "
            "flags[i] = chosen[i] != 0;\n    {0}_solve_for(({0}*)self, flags);\n}}\n\n", name_, c.list.size());
        member("solve_for", name_ + "_plant_solve_for");
    }

    const Plant& plant_;
    const std::string& name_;
    std::string tables_, functions_, members_;
};

}  // namespace

std::string plant_in_c(const Plant& plant, const std::string& name, const std::vector<double>& start_values,
                       const std::vector<double>& parameter_defaults) {
    return TablePrinter(plant, name).run(start_values, parameter_defaults);
}

}  // namespace dalembert
