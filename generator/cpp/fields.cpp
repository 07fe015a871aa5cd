// SPDX-License-Identifier: GPL-3.0-or-later
#include "cpp/fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "cpp/helpers.hpp"
#include "cpp/print.hpp"
#include "cpp/tables.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

using Texts = std::map<std::string, std::string>;

std::string cached_members(const PlantFields& fields) {
    std::string text;
    for (const PlantCached& member : fields.cached)
        text += member.size > 0 ? fmt::format("        std::array<Scalar, {}> {};\n", member.size, member.identifier)
                                : fmt::format("        Scalar {};\n", member.identifier);
    return text.empty() ? text
                        : "    /// Constants computed from the parameters, for each cell of a rod or block.\n    struct Cached {\n" + text +
                              "    };\n    Cached c_{};\n";
}

void functions(const PlantFields& fields, Texts& texts) {
    texts["UPDATE"] = cpp_body(fields.update);
    texts["START_STATE"] = cpp_body(fields.start_state);
    texts["CELL_RATES"] = cpp_body(fields.rates);
    texts["CELL_JACOBIAN"] = cpp_body(fields.jacobian);
    texts["CELL_JACOBIAN_U"] = cpp_body(fields.by_input);
    texts["CELL_JACOBIAN_P"] = cpp_body(fields.by_parameter);
    texts["CELL_JACOBIAN_T"] = cpp_body(fields.by_time);
    texts["CELL_ENERGY"] = cpp_body(fields.energy);
    texts["CELL_POWER"] = cpp_body(fields.power);
}

/// Outputs that contain sums over cells; nothing where there are none.
void sums(const PlantFields& fields, Texts& texts) {
    for (const char* name : {"OUTPUT_SUMS", "OUTPUT_SUMS_X", "OUTPUT_SUMS_U", "SUM_FUNCTIONS"}) texts[name];
    if (!fields.sums) return;
    const PlantSums& s = *fields.sums;
    texts["OUTPUT_SUMS"] = " output_of_sums(core_state(x), u, t, cell_sums(x, u, t), y);";
    texts["OUTPUT_SUMS_X"] = "        add_output_slopes(x, u, t, C);\n";
    texts["OUTPUT_SUMS_U"] = " add_output_slopes_by_inputs(x, u, t, D);";
    texts["SUM_FUNCTIONS"] = fill_template(embedded_file("field_sums.hpp.in"), {{"SUM_COUNT", std::to_string(s.count)},
                                                                                {"SUM_LOOPS", cpp_body(s.values)},
                                                                                {"SUM_SLOPES", cpp_body(s.slopes)},
                                                                                {"SUM_SLOPES_U", cpp_body(s.slopes_by_inputs)},
                                                                                {"OUTPUT_VALUES", cpp_body(s.outputs)},
                                                                                {"OUTPUT_BY_STATE", cpp_body(s.by_state)},
                                                                                {"OUTPUT_BY_INPUT", cpp_body(s.by_input)},
                                                                                {"OUTPUT_BY_SUM", cpp_body(s.by_sum)}});
}

/// ", low, high", where a range is declared.
std::string range_text(const PlantField& field) {
    const auto bound = [](const std::optional<double>& value, const char* otherwise) {
        return value ? fmt::format("{}", *value) : otherwise;
    };
    if (!field.has_range) return {};
    return fmt::format(", {}, {}", bound(field.states.low, "-std::numeric_limits<double>::infinity()"),
                       bound(field.states.high, "std::numeric_limits<double>::infinity()"));
}

void tables(const PlantFields& fields, Texts& texts) {
    std::string lists, names, quantities;
    std::vector<std::string> indices;
    for (const auto& [name, at] : fields.indices) indices.push_back(fmt::format("{} = {}", name, at));
    std::size_t longest = 0;
    for (const PlantField& field : fields.list) {
        const PlantQuantity& q = field.states;
        longest = std::max(longest, q.name.size() + std::to_string(static_cast<std::size_t>(field.first_number) + field.cells).size() + 3);
        lists += fmt::format("{}Cells{{{}, {}, {}}}", lists.empty() ? "" : ", ", field.first, field.cells, field.columns);
        names += fmt::format("inline constexpr CellNames<{}> {}_names({}, {});\n", field.cells, q.name, cpp_string(q.name),
                             field.first_number);
        quantities += fmt::format("    for (std::size_t k = 0; k < {}; ++k) table[{}] = Quantity{{{}_names.names[k].data(), {}, {}{}}};\n",
                                  field.cells, field.first == 0 ? "k" : fmt::format("{} + k", field.first), q.name, cpp_string(q.unit),
                                  cpp_string(q.doc), range_text(field));
    }
    texts["STATE_INDICES"] = fmt::format(" enum : std::size_t {{ {} }}; ", fmt::join(indices, ", "));
    texts["POSITIONS"] = fmt::format("{}", fmt::join(fields.positions, ", "));
    texts["FIELDS"] = lists;
    texts["FIELD_COUNT"] = std::to_string(fields.list.size());
    texts["NAME_SIZE"] = std::to_string(longest);
    texts["CELL_NAMES"] = names;
    texts["CELL_QUANTITIES"] = quantities;
    texts["STATES"] = std::to_string(fields.states);
    texts["PLAIN_STATES"] = std::to_string(fields.plain_states);
}

}  // namespace

std::string cpp_fields(const PlantFields& fields, const Plant& core, const std::string& name_space) {
    Texts texts;
    tables(fields, texts);
    functions(fields, texts);
    sums(fields, texts);
    for (const std::string& line : fields.equations) texts["FIELD_EQUATIONS"] += cpp_comment(line, 0);
    texts["CACHED"] = cached_members(fields);
    texts["TIME_SWITCHES"] =
        core.time_switches == 0 ? ""
                                : "    using TimeSwitches = typename Core::TimeSwitches;\n"
                                  "    void time_switches(const State& x, const Input& u, Scalar t, TimeSwitches& s) const noexcept { "
                                  "core_.time_switches(core_state(x), u, t, s); }\n";
    texts["HELPERS"] = fields.helpers.empty() ? "" : helper_source(fields.helpers) + "\n" + cpp_curves(fields.curves);
    texts["NAMESPACE"] = name_space;
    return fill_template(embedded_file("fields.hpp.in"), texts);
}

}  // namespace dalembert
