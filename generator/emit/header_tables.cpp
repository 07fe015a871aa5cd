// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/header_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/cpp_constant.hpp"
#include "emit/cpp_function.hpp"
#include "emit/cpp_names.hpp"
#include "emit/safe_text.hpp"
#include "graph/separable.hpp"
#include "check/units.hpp"
#include "prove/constraint_validity.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class Tables {
public:
    explicit Tables(const System& system) : system_(system), symbols_(system.symbols) {}

    std::map<std::string, std::string> run(const std::vector<Guard>& listed) {
        const auto pointers = [&](std::initializer_list<SymbolKind> kinds) {
            std::vector<const Variable*> result;
            for (const SymbolKind kind : kinds)
                for (const Variable& variable : symbols_.all(kind)) result.push_back(&variable);
            return result;
        };
        const auto states = symbols_.state_variables();
        table("STATE", states);
        table("INPUT", pointers({SymbolKind::input}));
        table("PARAMETER", pointers({SymbolKind::parameter}));
        std::string indices;
        std::string rows;
        for (std::size_t i = 0; i < system_.outputs.size(); ++i) {
            const OutputEquation& output = system_.outputs[i];
            indices += fmt::format("{}{} = {}", i == 0 ? "" : ", ", cpp_name(output.base, output.index, output.is_member), i);
            rows += quantity_row(output.name, output.unit, output.doc);
        }
        add_table("OUTPUT", indices, rows);
        std::string guards;
        for (const Guard& guard : listed) guards += fmt::format("    Guard{{{}, {}, {}}},\n", cpp_string(guard.name), cpp_string(guard.doc), guard.ends);
        values("GUARD_TABLE", guards.empty() ? "" : "\n" + guards);
        values("GUARDS_COUNT", std::to_string(listed.size()));

        values("SEPARABLE", is_separable(system_) ? "    static constexpr bool is_separable = true;  // accelerations depend on coordinates alone\n" : "");
        values("DEGREES", std::to_string(symbols_.degrees()));
        values("PLAIN_STATES", std::to_string(symbols_.states()));
        values("STATES", std::to_string(states.size()));
        values("INPUTS", std::to_string(symbols_.count(SymbolKind::input)));
        values("OUTPUTS", std::to_string(system_.outputs.size()));
        values("PARAMETERS", std::to_string(symbols_.count(SymbolKind::parameter)));
        std::vector<std::string> starts;
        Values defaults(system_.scene, system_.translate);
        meet_constraints(system_, defaults);
        for (const ex& value : defaults.state()) starts.push_back(double_text(value));
        values("START_VALUES", fmt::format("{}", fmt::join(starts, ", ")));
        return std::move(result_);
    }

    std::map<std::string, std::string> of_constraints() {
        std::string indices, rows;
        Diagnostics diagnostics;
        Units units(system_.names, diagnostics);
        for (const ConstraintEquation& c : system_.constraints) {
            const Constraint& item = *c.item;
            indices += fmt::format("{}{} = {}", indices.empty() ? "" : ", ", cpp_name(item.name, c.index, item.family.has_value()), indices.empty() ? 0 : std::count(indices.begin(), indices.end(), '='));
            const std::string unit = units.of(item.position ? *item.position : *item.rate, {}).dimension.in_base_units();
            rows += fmt::format("    Constraint{{{}, {}, {}, {}}},\n", cpp_string(c.name), cpp_string(unit), cpp_string(item.doc), item.position != nullptr);
        }
        add_table("CONSTRAINT", indices, rows);
        values("CONSTRAINTS", std::to_string(system_.constraints.size()));
        return std::move(result_);
    }

private:
    void values(const std::string& name, std::string text) { result_[name] = std::move(text); }

    static std::string quantity_row(const std::string& name, const std::string& unit, const std::string& doc, const std::string& range = "") {
        return fmt::format("    Quantity{{{}, {}, {}{}}},\n", cpp_string(name), cpp_string(unit), cpp_string(doc), range);
    }

    /// ", low, high", as far as they are declared.
    std::string range_text(const Variable& variable) const {
        if (variable.declared == nullptr || !variable.declared->range || variable.kind == SymbolKind::velocity) return {};
        const auto bound = [&](const ExpressionPtr& e) {
            const ex value = system_.translate(*e, {});
            return double_text(variable.is_root ? ex(GiNaC::sqrt(value)) : value);
        };
        const Range& range = *variable.declared->range;
        std::string text = range.low ? ", " + bound(range.low) : ", -std::numeric_limits<double>::infinity()";
        if (range.high) text += ", " + bound(range.high);
        return text;
    }

    void table(const char* name, const std::vector<const Variable*>& variables) {
        std::string indices;
        std::string rows;
        for (std::size_t i = 0; i < variables.size(); ++i) {
            indices += fmt::format("{}{} = {}", i == 0 ? "" : ", ", cpp_name(*variables[i]), i);
            rows += quantity_row(variables[i]->name, variables[i]->unit, variables[i]->doc, range_text(*variables[i]));
        }
        add_table(name, indices, rows);
    }

    void add_table(const std::string& name, const std::string& indices, const std::string& rows) {
        std::string text = wrapped("enum : std::size_t { " + indices + " };", 0);
        text.pop_back();
        // A long list of indices is broken at its commas.
        for (std::size_t at = 100, last = 0; at < text.size(); at = last + 110) {
            const std::size_t comma = text.find(", ", at);
            if (comma == std::string::npos) break;
            text.replace(comma, 2, ",\n    ");
            last = comma;
        }
        values(name + "_INDICES", indices.empty() ? "" : " " + text + " ");
        values(name + "_TABLE", rows.empty() ? "" : "\n" + rows);
    }

    const System& system_;
    const Symbols& symbols_;
    std::map<std::string, std::string> result_;
};

}  // namespace

std::map<std::string, std::string> header_tables(const System& system, const std::vector<Guard>& guards) { return Tables(system).run(guards); }

std::map<std::string, std::string> constraint_tables(const System& system) { return Tables(system).of_constraints(); }

}  // namespace dalembert
