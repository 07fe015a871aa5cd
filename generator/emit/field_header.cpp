// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/field_header.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/banner.hpp"
#include "emit/cpp_bodies.hpp"
#include "emit/cpp_function.hpp"
#include "cpp/helpers.hpp"
#include "emit/notation.hpp"
#include "text/safe_text.hpp"
#include "text/template.hpp"
#include "form/state_places.hpp"

namespace dalembert {

namespace {

const std::set<std::string> names_in_loops{"x", "u", "t", "k", "i", "J", "dxdt", "energy", "power", "heat", "p_", "c_", "core_", "detail", "Scalar", "State", "place",
                                           "T_here", "T_next", "left", "here", "right", "beyond", "index", "number"};

/// Further ones around sums.
const std::set<std::string> names_in_sums{"sums", "by_sums", "of_core", "slope", "y", "C", "D"};

/// Whether a name occurs as a whole word.
bool mentions(const std::string& text, const std::string& name) {
    const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const bool begins = at == 0 || (!in_word(text[at - 1]) && text[at - 1] != '.');
        const std::size_t end = at + name.size();
        if (begins && (end == text.size() || !in_word(text[end]))) return true;
    }
    return false;
}

class FieldWriter {
public:
    explicit FieldWriter(const FieldCode& code) : code_(code), system_(code.code.system), places_(place_states(system_)) { name_cached(); }

    std::string run(const std::string& name_space) {
        std::map<std::string, std::string> values;
        tables(values);
        for (std::size_t r = 0; r < code_.fields.size(); ++r) functions(r, values);
        const bool p_needs_rates = values["CELL_JACOBIAN_P"].find("dxdt[") != std::string::npos;
        if (p_needs_rates) values["CELL_JACOBIAN_P"] = "        State dxdt;\n        cell_rates(x, u, t, dxdt);\n" + values["CELL_JACOBIAN_P"];
        sums(values);
        values["CACHED"] = cached_members();
        values["FIELD_EQUATIONS"] = equations();
        values["HELPERS"] = helpers_.empty() ? "" : helper_source(helpers_) + "\n";
        values["NAMESPACE"] = name_space;
        return fill_template(embedded_file("fields.hpp.in"), values);
    }

private:
    /// The index of what belongs to cell k.
    static std::string at(std::size_t first) { return first == 0 ? "k" : fmt::format("{} + k", first); }

    const RodField& field(std::size_t r) const { return *code_.fields[r].field; }

    /// Cached values: numbers, and arrays over the cells of a rod where they depend on the place on the grid.
    void name_cached() {
        for (std::size_t r = 0; r < code_.fields.size(); ++r) {
            const FieldFunctions& f = code_.fields[r];
            note_cached(f.link, r, links_);
            note_cached(f.link_slopes, r, links_);
            for (const FunctionCode* one : {&f.cell, &f.cell_slopes, &f.source, &f.energy}) note_cached(*one, r, cells_);
            for (const FieldColumn& column : f.columns) {
                note_cached(column.link, r, links_);
                note_cached(column.cell, r, cells_);
            }
        }
        for (std::size_t i = 0; i < code_.sums.size(); ++i) {
            const std::size_t r = system_.cell_sums[i].field;
            note_cached(code_.sums[i].term, r, cells_);
            note_cached(code_.sums[i].slope, r, cells_);
            for (const auto& [input, function] : code_.sums[i].by_input) note_cached(function, r, cells_);
        }
        for (const FunctionCode* one : {&code_.outputs.values, &code_.outputs.by_state, &code_.outputs.by_input, &code_.outputs.by_sum}) note_cached(*one, 0, cells_);
        std::set<std::uint32_t> all;
        for (const auto* used : {&links_, &cells_})
            for (const auto& [index, r] : *used) all.insert(index);
        std::size_t number = 0;
        for (const std::uint32_t index : all) {
            numbers_[index] = number;
            const Value member = Value::member(Value::Object::cached, fmt::format("k{}", number++));
            cached_[index] = code_.depends_on_grid(index) ? Value::element(member, Value::name("k")) : member;
        }
    }

    static void note_cached(const FunctionCode& f, std::size_t r, std::map<std::uint32_t, std::size_t>& used) {
        for (const NodeId id : f.program.in_order(f.results))
            if (f.program[id].kind == Node::Kind::cached) used.emplace(f.program[id].index, r);
    }

    std::string cached_members() const {
        if (numbers_.empty()) return {};
        std::string text = "    /// What depends on parameters alone; of the cells of a rod one by one.\n    struct Cached {\n";
        for (const auto& [index, number] : numbers_) {
            const auto link = links_.find(index);
            const std::size_t r = link != links_.end() ? link->second : cells_.at(index);
            text += code_.depends_on_grid(index) ? fmt::format("        std::array<Scalar, {}> k{};\n", field(r).geometry.cells(), number) : fmt::format("        Scalar k{};\n", number);
        }
        return text + "    };\n    Cached c_{};\n";
    }

    /// Statements of a function inside of a loop over the cells k, and what is done with its results.
    template <class Use>
    std::string in_loop(const FunctionCode& f, Use use) {
        std::set<std::string> names = names_in_loops;
        if (!code_.sums.empty()) names.insert(names_in_sums.begin(), names_in_sums.end());
        for (std::size_t i = 0; i < code_.sums.size(); ++i) names.insert(sum_name(i));
        CppFunction cpp(code_.code, f, cached_, names);
        Statements computed = cpp.compute(f.results);
        std::vector<std::string> results;
        for (const NodeId id : f.results) results.push_back(cpp_text(cpp.value(id, computed)));
        std::string statements = cpp_text(computed);
        std::string scope;
        for (const std::string& name : cpp.called()) {
            if (is_helper(name)) helpers_.insert(name);
            else scope += fmt::format("        using std::{};\n", name);
        }
        for (const auto& line : use(results)) statements += wrapped(line, 8);
        return scope + statements;
    }

    /// The numbers on the grid that a loop mentions.
    std::string grid_numbers(std::size_t r, const std::string& statements) const {
        const RodGeometry& g = field(r).geometry;
        std::string text;
        const auto declare = [&](const char* name, const std::string& value) {
            if (mentions(statements, name)) text += fmt::format("        const Scalar {} = Scalar(static_cast<int>({}));\n", name, value);
        };
        if (g.has_points()) {
            const std::string here = g.skipped() == 0 ? "k" : "k + 1";
            declare("left", g.skipped() == 0 ? "k == 0 ? 0 : k - 1" : "k");
            declare("here", here);
            declare("right", fmt::format("k + {0} > {1} ? {1} : k + {0}", g.skipped() + 1, g.intervals()));
        } else {
            declare("left", "k");
            declare("right", "k + 1");
            declare("beyond", "k + 2");
        }
        const int from = field(r).first_index;
        declare("index", from == 0 ? "k" : from > 0 ? fmt::format("k + {}", from) : fmt::format("k) - static_cast<int>({}", -from));
        return text;
    }

    std::string temperatures(std::size_t r, const std::string& statements) const {
        std::string text;
        if (mentions(statements, "T_here")) text += fmt::format("        const Scalar T_here = x[{}];\n", at(places_.firsts[r]));
        if (mentions(statements, "T_next")) text += fmt::format("        const Scalar T_next = x[{}];\n", at(places_.firsts[r] + 1));
        return text;
    }

    /// Over cells, or over the faces between them.
    std::string loop(std::size_t r, bool over_links, const std::string& statements) const {
        const std::size_t count = field(r).geometry.cells() - (over_links ? 1 : 0);
        return fmt::format("        for (std::size_t k = 0; k < {}; ++k) {{\n", count) + shifted(grid_numbers(r, statements) + temperatures(r, statements) + statements) + "        }\n";
    }

    /// Over the cells that a sum adds up.
    std::string sum_loop(std::size_t i, const std::string& statements) const {
        const CellSum& sum = system_.cell_sums[i];
        return fmt::format("        for (std::size_t k = {}; k < {}; ++k) {{\n", sum.first, sum.last + 1) + shifted(grid_numbers(sum.field, statements) + temperatures(sum.field, statements) + statements) + "        }\n";
    }

    static std::string sum_name(std::size_t i) { return fmt::format("sum_{}", i + 1); }

    using Lines = std::vector<std::string>;
    using Results = const std::vector<std::string>&;

    void functions(std::size_t r, std::map<std::string, std::string>& values) {
        const FieldFunctions& f = code_.fields[r];
        const std::size_t first = places_.firsts[r];
        const std::string here = at(first);
        const std::string next = at(first + 1);
        values["UPDATE"] += update(r);
        values["START_STATE"] += loop(r, false, in_loop(f.start, [&](Results v) { return Lines{fmt::format("x[{}] = {};", here, v[0])}; }));
        values["CELL_RATES"] += loop(r, true, in_loop(f.link, [&](Results v) {
            return Lines{fmt::format("const Scalar heat = {};", v[0]), fmt::format("dxdt[{}] -= heat;", here), fmt::format("dxdt[{}] += heat;", next)};
        }));
        values["CELL_RATES"] += loop(r, false, in_loop(f.cell, [&](Results v) {
            return Lines{v[0] == "Scalar(0)" ? fmt::format("dxdt[{}] *= {};", here, v[1]) : fmt::format("dxdt[{0}] = (dxdt[{0}] + {1}) * ({2});", here, v[0], v[1])};
        }));
        values["CELL_JACOBIAN"] += jacobian(r);
        values["CELL_ENERGY"] += loop(r, false, in_loop(f.energy, [&](Results v) { return Lines{fmt::format("energy += {};", v[0])}; }));
        values["CELL_POWER"] += loop(r, false, in_loop(f.source, [&](Results v) { return Lines{fmt::format("power += {};", v[0])}; }));
        for (const char* name : {"CELL_JACOBIAN_U", "CELL_JACOBIAN_P", "CELL_JACOBIAN_T"}) values[name];
        for (const FieldColumn& column : f.columns) {
            const char* name = column.by == By::input ? "CELL_JACOBIAN_U" : column.by == By::parameter ? "CELL_JACOBIAN_P" : "CELL_JACOBIAN_T";
            values[name] += column_loops(r, column);
        }
    }

    /// Outputs that contain sums over cells; nothing where there are none.
    void sums(std::map<std::string, std::string>& values) {
        for (const char* name : {"OUTPUT_SUMS", "OUTPUT_SUMS_X", "OUTPUT_SUMS_U", "SUM_FUNCTIONS"}) values[name];
        if (code_.sums.empty()) return;
        std::string loops, slopes, by_inputs;
        const std::size_t outputs = system_.outputs.size();
        for (std::size_t i = 0; i < code_.sums.size(); ++i) {
            const CellSum& sum = system_.cell_sums[i];
            const auto add = [&](const FunctionCode& f, const std::string& to) {
                if (f.is_zero(f.results[0])) return std::string();
                return sum_loop(i, in_loop(f, [&](Results v) {
                    Lines lines{fmt::format("const Scalar slope = {};", v[0])};
                    for (std::size_t o = 0; o < code_.outputs.outputs.size(); ++o)
                        if (const NodeId by = code_.outputs.by_sum.results[i * code_.outputs.outputs.size() + o]; !code_.outputs.by_sum.is_zero(by))
                            lines.push_back(fmt::format("{} += by_sums[{}] * slope;", fmt::format(fmt::runtime(to), code_.outputs.outputs[o]), i * outputs + code_.outputs.outputs[o]));
                    return lines;
                }));
            };
            loops += sum_loop(i, in_loop(code_.sums[i].term, [&](Results v) { return Lines{fmt::format("sums[{}] += {};", i, v[0])}; }));
            slopes += add(code_.sums[i].slope, fmt::format("C[{} * ({}) + {{}}]", outputs, at(places_.firsts[sum.field])));
            for (const auto& [input, function] : code_.sums[i].by_input) by_inputs += add(function, fmt::format("D[{} + {{}}]", outputs * input));
        }
        values["OUTPUT_SUMS"] = " output_of_sums(core_state(x), u, t, cell_sums(x, u, t), y);";
        values["OUTPUT_SUMS_X"] = "        add_output_slopes(x, u, t, C);\n";
        values["OUTPUT_SUMS_U"] = " add_output_slopes_by_inputs(x, u, t, D);";
        const auto of_outputs = [&](const FunctionCode& f, const auto& target) {
            std::string statements = in_loop(f, [&](Results v) {
                Lines lines;
                for (std::size_t n = 0; n < v.size(); ++n)
                    if (!f.is_zero(f.results[n])) lines.push_back(fmt::format("{} = {};", target(n / code_.outputs.outputs.size(), code_.outputs.outputs[n % code_.outputs.outputs.size()]), v[n]));
                return lines;
            });
            std::string named;
            for (std::size_t i = 0; i < code_.sums.size(); ++i)
                if (mentions(statements, sum_name(i))) named += fmt::format("        const Scalar {} = sums[{}];\n", sum_name(i), i);
            return named + statements;
        };
        const auto column = [&](const std::string& array) { return [array, outputs](std::size_t c, std::size_t r) { return fmt::format("{}[{}]", array, outputs * c + r); }; };
        const auto state = [&](std::size_t c, std::size_t r) { return fmt::format("C[{}]", outputs * places_.positions[c] + r); };
        values["SUM_FUNCTIONS"] = fill_template(embedded_file("field_sums.hpp.in"),
                                                {{"SUM_COUNT", std::to_string(code_.sums.size())},
                                                 {"SUM_LOOPS", loops},
                                                 {"SUM_SLOPES", slopes},
                                                 {"SUM_SLOPES_U", by_inputs},
                                                 {"OUTPUT_VALUES", of_outputs(code_.outputs.values, [](std::size_t, std::size_t r) { return fmt::format("y[{}]", r); })},
                                                 {"OUTPUT_BY_STATE", of_outputs(code_.outputs.by_state, state)},
                                                 {"OUTPUT_BY_INPUT", of_outputs(code_.outputs.by_input, column("D"))},
                                                 {"OUTPUT_BY_SUM", of_outputs(code_.outputs.by_sum, column("by_sums"))}});
    }

    std::string update(std::size_t r) {
        const auto fill = [&](bool over_links, const std::vector<std::uint32_t>& wanted) {
            FunctionCode f = code_.update;
            f.results.clear();
            for (const std::uint32_t index : wanted) f.results.push_back(code_.update.results[index]);
            const std::string statements = in_loop(f, [&](Results v) {
                Lines lines;
                for (std::size_t i = 0; i < wanted.size(); ++i) lines.push_back(fmt::format("{} = {};", cpp_text(cached_.at(wanted[i])), v[i]));
                return lines;
            });
            return code_.depends_on_grid(wanted[0]) ? loop(r, over_links, statements) : statements;
        };
        std::vector<std::uint32_t> once_for_all, by_link, by_cell;
        for (const auto& [index, number] : numbers_) {
            const auto cell = cells_.find(index);
            const auto link = links_.find(index);
            const std::size_t owner = cell != cells_.end() ? cell->second : link->second;
            if (owner != r) continue;
            (!code_.depends_on_grid(index) ? once_for_all : cell != cells_.end() ? by_cell : by_link).push_back(index);
        }
        std::string text;
        if (!once_for_all.empty()) text += "        {\n" + shifted(fill(false, once_for_all)) + "        }\n";
        if (!by_link.empty()) text += fill(true, by_link);
        if (!by_cell.empty()) text += fill(false, by_cell);
        return text;
    }

    std::string jacobian(std::size_t r) {
        const FieldFunctions& f = code_.fields[r];
        const std::size_t first = places_.firsts[r];
        FunctionCode slopes = f.link_slopes;
        slopes.results.erase(slopes.results.begin());
        std::string text = loop(r, true, in_loop(slopes, [&](Results v) {
            return Lines{fmt::format("const Scalar by_here = {};", v[0]),
                         fmt::format("const Scalar by_next = {};", v[1]),
                         fmt::format("J[place({0}, {0})] -= by_here;", at(first)),
                         fmt::format("J[place({1}, {0})] += by_here;", at(first), at(first + 1)),
                         fmt::format("J[place({0}, {1})] -= by_next;", at(first), at(first + 1)),
                         fmt::format("J[place({0}, {0})] += by_next;", at(first + 1))};
        }));
        FunctionCode cell = f.cell_slopes;
        cell.results.erase(cell.results.begin());
        text += loop(r, false, in_loop(cell, [&](Results v) {
            std::string diagonal = "J[place(i, i)]";
            if (v[1] != "Scalar(0)") diagonal += fmt::format(" + ({})", v[1]);
            if (v[2] != "Scalar(0)") diagonal += fmt::format(" - dxdt[i] * ({})", v[2]);
            return Lines{fmt::format("const Scalar inverse_capacity = {};", v[0]), fmt::format("const std::size_t i = {};", at(first)), "if (k > 0) J[place(i, i - 1)] *= inverse_capacity;",
                         fmt::format("J[place(i, i)] = ({}) * inverse_capacity;", diagonal), fmt::format("if (k + 1 < {}) J[place(i, i + 1)] *= inverse_capacity;", field(r).geometry.cells())};
        }));
        return text;
    }

    std::string column_loops(std::size_t r, const FieldColumn& column) {
        const std::size_t first = places_.firsts[r];
        const std::size_t offset = column.by == By::time ? 0 : column.column * places_.count;
        std::string text;
        if (!column.link.results.empty())
            text += loop(r, true, in_loop(column.link, [&](Results v) {
                return Lines{fmt::format("const Scalar heat = {};", v[0]), fmt::format("J[{}] -= heat;", at(offset + first)), fmt::format("J[{}] += heat;", at(offset + first + 1))};
            }));
        text += loop(r, false, in_loop(column.cell, [&](Results v) {
            std::string sum = fmt::format("J[{}]", at(offset + first));
            if (v[0] != "Scalar(0)") sum += fmt::format(" + ({})", v[0]);
            if (v[1] != "Scalar(0)") sum += fmt::format(" - dxdt[{}] * ({})", at(first), v[1]);
            return Lines{fmt::format("J[{}] = ({}) * ({});", at(offset + first), sum, v[2])};
        }));
        return text;
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
    std::map<std::uint32_t, std::size_t> links_, cells_;  ///< cached values that code of faces and cells uses, with the rod
    std::map<std::uint32_t, std::size_t> numbers_;
    CachedValues cached_;
    std::set<std::string> helpers_;
};

}  // namespace

std::string field_content(const FieldCode& code, const std::string& name_space) { return FieldWriter(code).run(name_space); }

}  // namespace dalembert
