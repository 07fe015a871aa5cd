// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/measured_functions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "program/identifiers.hpp"
#include "program/shared_members.hpp"
#include "text/template.hpp"
#include "prove/constraint_validity.hpp"

namespace dalembert {

namespace {

class FunctionList {
public:
    FunctionList(const std::vector<const Code*>& modes, std::size_t mode)
        : modes_(modes),
          code_(*modes[mode]),
          system_(code_.system),
          symbols_(system_.symbols),
          shared_(modes),
          switches_(shared_.has_modes()) {
        if (switches_) mode_ = fmt::format("System::Mode::{}, ", system_.scene.modes[mode].name);
        for (const Variable* variable : symbols_.state_variables()) states_.push_back(variable->name);
        first_state_ = symbols_.count(SymbolKind::parameter);
        first_input_ = first_state_ + symbols_.state_count();
        time_ = first_input_ + symbols_.count(SymbolKind::input);
    }

    std::vector<MeasuredFunction> run() {
        for (const HeaderFunction& row : header_functions())
            if (row.kind == Kind::start || shared_.has(row)) measure(row);
        return std::move(list_);
    }

private:
    using Kind = HeaderFunction::Kind;

    void measure(const HeaderFunction& row) {
        switch (row.kind) {
            case Kind::start: return start_state(row);
            case Kind::motion: return row.by ? jacobian(row, "jacobian_x") : rates(row);
            case Kind::jacobian: return jacobian(row, row.name);
            case Kind::output_jacobian: return output_jacobian(row);
            case Kind::symmetric: return symmetric(row);
            case Kind::matrix: return matrix(row);
            case Kind::number: return number(row);
            case Kind::values:
                if (row.function != Function::guards || !switches_) values(row, Function::rhs);
                return;
            case Kind::correction: return values(row, row.function);
            case Kind::event_values: return event_values(row);
            case Kind::resets: return resets(row);
            case Kind::update:
            case Kind::together:    // the same as others
            case Kind::hessian:     // only where it is asked for
            case Kind::conditions:  // no number
            case Kind::sample:      // of a controller, which is not measured
                return;
        }
    }

    static std::function<MaybeExact(ExactCode&)> node(Function function, NodeId id) {
        return [function, id](ExactCode& code) { return code.at(function, id); };
    }
    void add(std::string name, std::string statements, std::vector<MeasuredResult> results) {
        if (!results.empty()) list_.push_back({std::move(name), std::move(statements), std::move(results)});
    }
    static std::string arguments(const HeaderFunction& row) {
        return std::string(row.takes_input ? "x, u, t" : "x, t") + (row.kind == Kind::correction ? ", residual" : "");
    }
    std::string call(const HeaderFunction& row, const char* name) const {
        return fmt::format("typename System::{0} y{{}};\nsystem.{1}({2}{3}, y);\nput_all(y);\n", row.type, name, mode_, arguments(row));
    }
    void add(const HeaderFunction& row, std::vector<MeasuredResult> results) {
        add(row.header_name(), call(row, row.header_name()), std::move(results));
    }
    /// Where the columns of a derivative begin among the inputs of exact code.
    std::size_t first_column(By by) const {
        switch (by) {
            case By::state: return first_state_;
            case By::input: return first_input_;
            case By::parameter: return 0;
            case By::time: break;
        }
        return time_;
    }

    void start_state(const HeaderFunction& row) {
        if ((!mode_.empty() && &code_ != modes_.front()) || !starts_to_find(system_).empty()) return;  // what is found has no closed form
        std::vector<MeasuredResult> results;
        for (std::size_t i = 0; i < code_[row.function].results.size(); ++i)
            results.push_back({states_[i], node(row.function, code_[row.function].results[i])});
        add(row.name, fmt::format("put_all(system.{}());\n", row.name), std::move(results));
    }

    void rates(const HeaderFunction& row) {
        std::vector<MeasuredResult> results;
        for (std::size_t i = 0; i < states_.size(); ++i)
            results.push_back({fmt::format("d({})/dt", states_[i]), [i](ExactCode& code) { return code.rates()[i]; }});
        add(row, std::move(results));
    }

    void jacobian(const HeaderFunction& row, const char* name) {
        const JacobianLayout& layout = shared_.layout(*row.by);
        const std::size_t first = first_column(*row.by);
        const Function function = row.function;
        std::vector<MeasuredResult> results(layout.size());
        const std::vector<const Variable*> inputs = ExactCode::inputs(system_);
        for (std::size_t c = 0; c < layout.columns(); ++c)
            for (std::size_t r = 0; r < layout.rows(); ++r)
                if (const auto place = layout.place(r, c))
                    results[*place] = {fmt::format("d(d({})/dt)/d({})", states_[r], inputs[first + c]->name),
                                       [=](ExactCode& code) { return code.slope(function, r, c); },
                                       Function::rhs,
                                       function,
                                       c,
                                       r,
                                       first + c,
                                       true};
        add(name, call(row, name), std::move(results));
    }

    void symmetric(const HeaderFunction& row) {
        const std::vector<std::string> names = row.names(system_);
        const FunctionCode& f = code_[row.function];
        std::vector<MeasuredResult> results;
        for (std::size_t c = 0; c < names.size(); ++c)
            for (std::size_t r = 0; r < names.size(); ++r)
                results.push_back({fmt::format("{}[{}, {}]", row.letter, names[r], names[c]),
                                   node(row.function, f.results[lower_index(std::max(r, c), std::min(r, c))])});
        add(row, std::move(results));
    }

    void matrix(const HeaderFunction& row) {
        const std::vector<std::string> names = row.names(system_);
        const auto& coordinates = symbols_.all(SymbolKind::coordinate);
        const FunctionCode& f = code_[row.function];
        std::vector<MeasuredResult> results;
        for (std::size_t j = 0; !f.results.empty() && j < coordinates.size(); ++j)
            for (std::size_t i = 0; i < names.size(); ++i)
                results.push_back({fmt::format("{}[{}, {}]", row.letter, names[i], coordinates[j].name),
                                   node(row.function, f.results[i * coordinates.size() + j])});
        add(row, std::move(results));
    }

    void values(const HeaderFunction& row, Function solves) {
        const FunctionCode& f = code_[row.function];
        const std::vector<std::string> names = row.names(system_);
        std::vector<MeasuredResult> results;
        for (std::size_t i = 0; i < f.results.size(); ++i) results.push_back({names[i], node(row.function, f.results[i]), solves});
        add(row, std::move(results));
    }

    void output_jacobian(const HeaderFunction& row) {
        const std::vector<std::string> outputs = row.names(system_);
        const std::size_t first = first_column(*row.by);
        const Function function = row.function;
        std::vector<MeasuredResult> results;
        const std::vector<const Variable*> inputs = ExactCode::inputs(system_);
        const Function solved_in = code_[function].whole_output.entries.empty() ? jacobian_by(*row.by) : function;
        for (std::size_t c = 0; c < code_[function].by_output.columns; ++c)
            for (std::size_t r = 0; r < outputs.size(); ++r)
                results.push_back({fmt::format("d({})/d({})", outputs[r], inputs[first + c]->name),
                                   [=](ExactCode& code) { return code.output_slope(function, r, c); }, Function::rhs, solved_in, c, r,
                                   first + c});
        add(row, std::move(results));
    }

    void number(const HeaderFunction& row) {
        const NodeId id = code_[row.function].results[0];
        if (code_[row.function].is_zero(id)) return;
        add(row.name, fmt::format("put(system.{}({}{}));\n", row.name, mode_, arguments(row)), {{row.name, node(row.function, id)}});
    }

    /// Of those that are watched.
    void event_values(const HeaderFunction& row) {
        const FunctionCode& f = code_[row.function];
        const std::vector<std::string> names = row.names(system_);
        std::vector<MeasuredResult> results;
        for (std::size_t e = 0; e < names.size(); ++e) {
            MeasuredResult& result = results.emplace_back();
            result.name = row.function == Function::event_rates ? fmt::format("d({})/dt", names[e]) : names[e];
            if (system_.events[e].is_watched) result.exact = node(row.function, f.results[e]);
            if (!f.rates_solved_for.empty()) result.column_of = row.function;
            else if (f.uses_jerks) result.column_of = Function::jacobian_t;
        }
        add(row, std::move(results));
    }

    /// Of what an event changes the places that it sets.
    void resets(const HeaderFunction& row) {
        for (std::size_t e = 0; e < system_.events.size(); ++e) {
            reset(row, row.header_name(), e, code_.resets[e]);
            reset(row, "settle", e, code_.rests[e]);
        }
    }

    void reset(const HeaderFunction& row, const char* name, std::size_t event, const ResetCode& code) {
        if (code.places.empty()) return;
        std::vector<MeasuredResult> results(states_.size());
        for (std::size_t i = 0; i < states_.size(); ++i) results[i].name = states_[i];
        for (std::size_t i = 0; i < code.places.size(); ++i) {
            MeasuredResult& result = results[code.places[i]];
            result.exact = node(row.function, code_[row.function].results[code.first + i]);
            if (code.impact) result.column_of = row.function, result.column = *code.impact;
        }
        add(fmt::format("{} {}", name, system_.events[event].name),
            fmt::format("typename System::State y = x;\nsystem.{}({}, {}y, u, t);\nput_all(y);\n", name, event, mode_), std::move(results));
    }

    const std::vector<const Code*>& modes_;
    const Code& code_;
    const System& system_;
    const Symbols& symbols_;
    const SharedMembers shared_;
    bool switches_;
    std::string mode_;
    std::vector<std::string> states_;
    std::size_t first_state_, first_input_, time_;
    std::vector<MeasuredFunction> list_;
};

}  // namespace

std::vector<MeasuredFunction> measured_functions(const std::vector<const Code*>& modes, std::size_t mode) {
    return FunctionList(modes, mode).run();
}

std::string accuracy_source(const System& system, const Header& header, const std::vector<std::vector<MeasuredFunction>>& functions) {
    std::string bodies, calls, parameters;
    std::size_t number = 0;
    for (const auto& mode : functions)
        for (const MeasuredFunction& function : mode) {
            bodies += fmt::format("    void function_{}() const {{\n", number);
            std::size_t at = 0;
            while (at < function.statements.size()) {
                const std::size_t end = function.statements.find('\n', at);
                bodies += "        " + function.statements.substr(at, end - at) + "\n";
                at = end + 1;
            }
            bodies += "    }\n";
            calls += fmt::format("        values.function_{}();\n", number++);
        }
    std::map<std::string, std::size_t> position;
    for (const Variable& p : system.symbols.all(SymbolKind::parameter))
        parameters += fmt::format("        p_.{} = next();\n", p.is_member ? fmt::format("{}[{}]", p.base, position[p.base]++) : p.base);
    return fill_template(embedded_file("accuracy.cpp.in"), {{"NAMESPACE", header.name_space},
                                                            {"HEADER", header.file_name},
                                                            {"INPUTS", std::to_string(ExactCode::inputs(system).size())},
                                                            {"RESIDUALS", std::to_string(system.symbols.count(SymbolKind::residual))},
                                                            {"FUNCTIONS", bodies},
                                                            {"PARAMETERS", parameters},
                                                            {"CALLS", calls}});
}

}  // namespace dalembert
