// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/field_header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/banner.hpp"
#include "emit/field_bodies.hpp"
#include "cpp/helpers.hpp"
#include "emit/notation.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"
#include "form/state_places.hpp"

namespace dalembert {

namespace {

class FieldWriter {
public:
    explicit FieldWriter(const FieldCode& code) : code_(code), system_(code.code.system), places_(place_states(system_)), bodies_(code) {}

    std::string run(const std::string& name_space) {
        std::map<std::string, std::string> values;
        tables(values);
        functions(values);
        sums(values);
        values["CACHED"] = cached_members();
        values["FIELD_EQUATIONS"] = equations();
        values["HELPERS"] = bodies_.helpers().empty() ? "" : helper_source(bodies_.helpers()) + "\n";
        values["NAMESPACE"] = name_space;
        return fill_template(embedded_file("fields.hpp.in"), values);
    }

private:
    /// The index of what belongs to cell k.
    static std::string at(std::size_t first) { return first == 0 ? "k" : fmt::format("{} + k", first); }

    const RodField& field(std::size_t r) const { return *code_.fields[r].field; }

    std::string cached_members() const {
        std::string text;
        for (const FieldBodies::CachedMember& member : bodies_.cached_members())
            text += member.cells ? fmt::format("        std::array<Scalar, {}> {};\n", *member.cells, member.name) : fmt::format("        Scalar {};\n", member.name);
        return text.empty() ? text : "    /// What depends on parameters alone; of the cells of a rod one by one.\n    struct Cached {\n" + text + "    };\n    Cached c_{};\n";
    }

    void functions(std::map<std::string, std::string>& values) {
        values["UPDATE"] = cpp_body(bodies_.update());
        values["START_STATE"] = cpp_body(bodies_.start_state());
        values["CELL_RATES"] = cpp_body(bodies_.rates());
        values["CELL_JACOBIAN"] = cpp_body(bodies_.jacobian());
        values["CELL_JACOBIAN_U"] = cpp_body(bodies_.jacobian(By::input));
        values["CELL_JACOBIAN_P"] = cpp_body(bodies_.jacobian(By::parameter));
        values["CELL_JACOBIAN_T"] = cpp_body(bodies_.jacobian(By::time));
        values["CELL_ENERGY"] = cpp_body(bodies_.energy());
        values["CELL_POWER"] = cpp_body(bodies_.power());
    }

    /// Outputs that contain sums over cells; nothing where there are none.
    void sums(std::map<std::string, std::string>& values) {
        for (const char* name : {"OUTPUT_SUMS", "OUTPUT_SUMS_X", "OUTPUT_SUMS_U", "SUM_FUNCTIONS"}) values[name];
        if (code_.sums.empty()) return;
        values["OUTPUT_SUMS"] = " output_of_sums(core_state(x), u, t, cell_sums(x, u, t), y);";
        values["OUTPUT_SUMS_X"] = "        add_output_slopes(x, u, t, C);\n";
        values["OUTPUT_SUMS_U"] = " add_output_slopes_by_inputs(x, u, t, D);";
        values["SUM_FUNCTIONS"] = fill_template(embedded_file("field_sums.hpp.in"), {{"SUM_COUNT", std::to_string(code_.sums.size())},
                                                                                     {"SUM_LOOPS", cpp_body(bodies_.sums())},
                                                                                     {"SUM_SLOPES", cpp_body(bodies_.sum_slopes())},
                                                                                     {"SUM_SLOPES_U", cpp_body(bodies_.sum_slopes_by_inputs())},
                                                                                     {"OUTPUT_VALUES", cpp_body(bodies_.output_values())},
                                                                                     {"OUTPUT_BY_STATE", cpp_body(bodies_.output_by_state())},
                                                                                     {"OUTPUT_BY_INPUT", cpp_body(bodies_.output_by_input())},
                                                                                     {"OUTPUT_BY_SUM", cpp_body(bodies_.output_by_sum())}});
    }

    void tables(std::map<std::string, std::string>& values) const {
        std::string indices, rods, names, quantities;
        std::set<std::string> seen;
        const auto index = [&](const std::string& name, std::size_t at) {
            if (seen.insert(name).second) indices += fmt::format("{}{} = {}", indices.empty() ? "" : ", ", name, at);
        };
        std::size_t i = 0;
        for (const Variable* each : system_.symbols.state_variables()) {
                const Variable& variable = *each;
                const std::size_t at = places_.positions[i++];
                const auto r = std::find_if(code_.fields.begin(), code_.fields.end(), [&](const FieldFunctions& f) { return variable.kind == SymbolKind::state && f.field->states->name == variable.base; });
                if (r == code_.fields.end()) index(cpp_name(variable), at);
                else index(variable.base, places_.firsts[static_cast<std::size_t>(r - code_.fields.begin())]);
            }
        std::size_t longest = 0;
        for (std::size_t r = 0; r < code_.fields.size(); ++r) {
            const State& states = *field(r).states;
            const std::size_t cells = field(r).geometry.cells();
            longest = std::max(longest, states.name.size() + std::to_string(static_cast<std::size_t>(field(r).first_index) + cells).size() + 3);
            rods += fmt::format("{}Cells{{{}, {}}}", r == 0 ? "" : ", ", places_.firsts[r], cells);
            names += fmt::format("inline constexpr CellNames<{}> {}_names({}, {});\n", cells, states.name, cpp_string(states.name), field(r).first_index);
            std::string range;
            const auto bound = [&](const ExpressionPtr& e, const char* otherwise) { return e ? double_text(system_.translate(*e, {})) : std::string(otherwise); };
            if (states.range) range = fmt::format(", {}, {}", bound(states.range->low, "-std::numeric_limits<double>::infinity()"), bound(states.range->high, "std::numeric_limits<double>::infinity()"));
            quantities += fmt::format("    for (std::size_t k = 0; k < {}; ++k) table[{}] = Quantity{{{}_names.names[k].data(), {}, {}{}}};\n", cells, at(places_.firsts[r]), states.name, cpp_string(states.unit.si()),
                                      cpp_string(states.doc), range);
        }
        values["STATE_INDICES"] = " enum : std::size_t { " + indices + " }; ";
        values["POSITIONS"] = fmt::format("{}", fmt::join(places_.positions, ", "));
        values["RODS"] = rods;
        values["ROD_COUNT"] = std::to_string(code_.fields.size());
        values["NAME_SIZE"] = std::to_string(longest);
        values["CELL_NAMES"] = names;
        values["CELL_QUANTITIES"] = quantities;
        values["STATES"] = std::to_string(places_.count);
        values["PLAIN_STATES"] = std::to_string(places_.count - system_.symbols.positions() - system_.symbols.degrees());
    }

    std::string equations() const {
        const Notation write(system_.symbols, Style::text);
        std::string text;
        for (std::size_t r = 0; r < code_.fields.size(); ++r) {
            const RodField& f = field(r);
            const std::vector<std::string> lines{fmt::format("Rod {}: capacity*dot(T_here) = heat from the cell before - heat to the next + source, with", f.rod->name),
                                                 fmt::format("  heat to the next = {}", write(f.link)), fmt::format("  source = {}", write(f.source)), fmt::format("  capacity = {}", write(f.capacity)),
                                                 "  left, here, right, beyond: numbers of points or faces on the grid."};
            for (const std::string& line : lines) text += cpp_comment(line, 0);
        }
        for (const CellSum& sum : system_.cell_sums)
            text += cpp_comment(fmt::format("{} = sum over cells {} to {} of {}", write(sum.letter), sum.first + 1, sum.last + 1, write(sum.term)), 0);
        return text;
    }

    const FieldCode& code_;
    const System& system_;
    const StatePlaces places_;
    FieldBodies bodies_;
};

}  // namespace

std::string field_content(const FieldCode& code, const std::string& name_space) { return FieldWriter(code).run(name_space); }

}  // namespace dalembert
