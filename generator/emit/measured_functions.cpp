// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/measured_functions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/cpp_names.hpp"
#include "emit/shared_members.hpp"
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
        start_state();
        rates();
        jacobian("jacobian_x", "JacobianX", Function::rhs_and_jacobian, By::state, first_state_);
        jacobian("jacobian_u", "JacobianU", Function::jacobian_u, By::input, first_input_);
        jacobian("jacobian_p", "JacobianP", Function::jacobian_p, By::parameter, 0);
        jacobian("jacobian_t", "JacobianT", Function::jacobian_t, By::time, time_);
        mass_matrix();
        values("bias", "Generalised", Function::bias, "x, u, t", coordinates());
        values("generalised_force", "Generalised", Function::generalised_force, "x, u, t", coordinates());
        std::vector<std::string> outputs;
        for (const OutputEquation& output : system_.outputs) outputs.push_back(output.name);
        values("output", "Output", Function::output, "x, u, t", outputs);
        output_jacobian("output_jacobian_x", "OutputJacobianX", Function::output_jacobian_x, outputs, first_state_);
        output_jacobian("output_jacobian_u", "OutputJacobianU", Function::output_jacobian_u, outputs, first_input_);
        for (const Function f : {Function::kinetic_energy, Function::potential_energy, Function::internal_energy}) scalar(f, "x, t");
        for (const Function f :
             {Function::supplied_power, Function::dissipated_power, Function::prescribed_power, Function::exchanged_power})
            scalar(f, "x, u, t");
        if (switches_) switching();
        else values("guards", "Guards", Function::guards, "x, u, t", guard_names());
        if (has_projection()) projection();
        return std::move(list_);
    }

private:
    static std::function<MaybeExact(ExactCode&)> node(Function function, NodeId id) {
        return [function, id](ExactCode& code) { return code.at(function, id); };
    }
    std::vector<std::string> coordinates() const {
        std::vector<std::string> names;
        for (const Variable& q : symbols_.all(SymbolKind::coordinate)) names.push_back(q.name);
        return names;
    }
    std::vector<std::string> guard_names() const {
        std::vector<std::string> names;
        for (const Guard& guard : system_.guards) names.push_back(guard.doc);
        return names;
    }
    void add(std::string name, std::string statements, std::vector<MeasuredResult> results) {
        if (!results.empty()) list_.push_back({std::move(name), std::move(statements), std::move(results)});
    }
    std::string call(const char* function, const char* type, const std::string& arguments) const {
        return fmt::format("typename System::{0} y{{}};\nsystem.{1}({2}{3}, y);\nput_all(y);\n", type, function, mode_, arguments);
    }

    void start_state() {
        if ((!mode_.empty() && &code_ != modes_.front()) || !starts_to_find(system_).empty()) return;  // what is found has no closed form
        const FunctionCode& f = code_[Function::start_state];
        std::vector<MeasuredResult> results;
        for (std::size_t i = 0; i < f.results.size(); ++i) results.push_back({states_[i], node(Function::start_state, f.results[i])});
        add("start_state", "put_all(system.start_state());\n", std::move(results));
    }

    void rates() {
        std::vector<MeasuredResult> results;
        for (std::size_t i = 0; i < states_.size(); ++i)
            results.push_back({fmt::format("d({})/dt", states_[i]), [i](ExactCode& code) { return code.rates()[i]; }});
        add("rhs", call("rhs", "State", "x, u, t"), std::move(results));
    }

    void jacobian(const char* name, const char* type, Function function, By by, std::size_t first) {
        const JacobianLayout& layout = shared_.layout(by);
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
        add(name, call(name, type, "x, u, t"), std::move(results));
    }

    void mass_matrix() {
        const std::vector<std::string> names = coordinates();
        const FunctionCode& f = code_[Function::mass_matrix];
        std::vector<MeasuredResult> results;
        for (std::size_t c = 0; c < names.size(); ++c)
            for (std::size_t r = 0; r < names.size(); ++r)
                results.push_back({fmt::format("M[{}, {}]", names[r], names[c]),
                                   node(Function::mass_matrix, f.results[lower_index(std::max(r, c), std::min(r, c))])});
        add("mass_matrix", call("mass_matrix", "MassMatrix", "x, t"), std::move(results));
    }

    void values(const char* name, const char* type, Function function, const char* arguments, const std::vector<std::string>& names) {
        const FunctionCode& f = code_[function];
        std::vector<MeasuredResult> results;
        for (std::size_t i = 0; i < f.results.size(); ++i)
            results.push_back({names[i], node(function, f.results[i]), function == Function::correction ? function : Function::rhs});
        add(name, call(name, type, arguments), std::move(results));
    }

    void output_jacobian(const char* name, const char* type, Function function, const std::vector<std::string>& outputs,
                         std::size_t first) {
        std::vector<MeasuredResult> results;
        const std::vector<const Variable*> inputs = ExactCode::inputs(system_);
        const Function solved_in = !code_[function].whole_output.entries.empty() ? function
                                   : function == Function::output_jacobian_x     ? Function::rhs_and_jacobian
                                                                                 : Function::jacobian_u;
        for (std::size_t c = 0; c < code_[function].by_output.columns; ++c)
            for (std::size_t r = 0; r < outputs.size(); ++r)
                results.push_back({fmt::format("d({})/d({})", outputs[r], inputs[first + c]->name),
                                   [=](ExactCode& code) { return code.output_slope(function, r, c); }, Function::rhs, solved_in, c, r,
                                   first + c});
        add(name, call(name, type, "x, u, t"), std::move(results));
    }

    void scalar(Function function, const char* arguments) {
        const char* name = name_of(function);
        const NodeId id = code_[function].results[0];
        if (code_[function].is_zero(id)) return;
        add(name, fmt::format("put(system.{}({}{}));\n", name, mode_, arguments), {{name, node(function, id)}});
    }

    /// Of guards those that are watched; of what an event changes the places that it sets.
    void switching() {
        std::vector<MeasuredResult> guards, rates;
        for (std::size_t e = 0; e < system_.events.size(); ++e) {
            const EventEquation& event = system_.events[e];
            guards.push_back({event.name, event.is_watched ? node(Function::events, code_[Function::events].results[e]) : nullptr});
            rates.push_back({fmt::format("d({})/dt", event.name),
                             event.is_watched ? node(Function::event_rates, code_[Function::event_rates].results[e]) : nullptr});
            if (!code_[Function::event_rates].rates_solved_for.empty()) rates.back().column_of = Function::event_rates;
            else if (code_[Function::event_rates].uses_jerks) rates.back().column_of = Function::jacobian_t;
        }
        add("guards", call("guards", "Events", "x, u, t"), std::move(guards));
        add("guard_rates", call("guard_rates", "Events", "x, u, t"), std::move(rates));
        for (std::size_t e = 0; e < system_.events.size(); ++e) {
            reset("reset", e, code_.resets[e]);
            reset("settle", e, code_.rests[e]);
        }
    }

    void reset(const char* name, std::size_t event, const ResetCode& code) {
        if (code.places.empty()) return;
        std::vector<MeasuredResult> results(states_.size());
        for (std::size_t i = 0; i < states_.size(); ++i) results[i].name = states_[i];
        for (std::size_t i = 0; i < code.places.size(); ++i) {
            MeasuredResult& result = results[code.places[i]];
            result.exact = node(Function::resets, code_[Function::resets].results[code.first + i]);
            if (code.impact) result.column_of = Function::resets, result.column = *code.impact;
        }
        add(fmt::format("{} {}", name, system_.events[event].name),
            fmt::format("typename System::State y = x;\nsystem.{}({}, {}y, u, t);\nput_all(y);\n", name, event, mode_), std::move(results));
    }

    bool has_projection() const {
        return !symbols_.attitudes().empty() ||
               std::any_of(modes_.begin(), modes_.end(), [](const Code* code) { return code->system.needs_projection(); });
    }

    void projection() {
        std::vector<std::string> names;
        for (const ConstraintEquation& c : system_.constraints) names.push_back(c.name);
        values("constraint_positions", "Constraints", Function::constraint_positions, "x, t", names);
        values("constraint_rates", "Constraints", Function::constraint_rates, "x, t", names);
        values("constraint_forces", "Constraints", Function::constraint_forces, "x, u, t", names);
        const std::vector<std::string> q = coordinates();
        const FunctionCode& f = code_[Function::constraint_jacobian];
        std::vector<MeasuredResult> results;
        for (std::size_t j = 0; !f.results.empty() && j < q.size(); ++j)
            for (std::size_t i = 0; i < names.size(); ++i)
                results.push_back(
                    {fmt::format("A[{}, {}]", names[i], q[j]), node(Function::constraint_jacobian, f.results[i * q.size() + j])});
        add("constraint_jacobian", call("constraint_jacobian", "ConstraintJacobian", "x, t"), std::move(results));
        values("correction", "Generalised", Function::correction, "x, t, residual", q);
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
