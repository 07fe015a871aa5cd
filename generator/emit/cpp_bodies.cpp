// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/cpp_bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/helpers.hpp"

namespace dalembert {

namespace {

constexpr std::size_t most_held = 16;  ///< values that registers hold

const std::set<std::string> argument_names{"x", "u", "t", "J", "M", "y", "dxdt", "b", "Q", "p", "energies", "starts", "start", "p_", "c_", "mass", "detail", "Scalar", "State", "c", "solved", "unit"};
const std::set<std::string> names_of_modes{"mode", "event", "event_number", "g", "rates", "by_time", "k"};

}  // namespace

CppBodies::CppBodies(const Code& code, const SharedMembers& shared)
    : code_(code), shared_(shared), n_(code.system.symbols.degrees()), velocities_(code.system.symbols.positions()), states_(velocities_ + n_), m_(code.system.symbols.states()), cached_(shared.cached(code)), mode_(shared.has_modes() ? "mode, " : ""), arguments_(argument_names) {
    for (const auto& [index, number] : cached_) cached_texts_.emplace(index, "c_." + cached_name(code.system.symbols, number));
    if (shared.has_modes()) arguments_.insert(names_of_modes.begin(), names_of_modes.end());
}

std::string CppBodies::assigned(CppFunction& cpp, const std::string& target, NodeId value) {
    std::string statements;
    const std::string text = cpp.value(value, statements);
    return statements + wrapped(fmt::format("{} = {};", target, text), 8);
}

/// Puts the functions that are called into scope.
std::string CppBodies::scope(const std::set<std::string>& called) {
    std::string text;
    for (const std::string& name : called) {
        if (is_helper(name)) helpers_.insert(name);
        else text += fmt::format("{}using std::{};\n", indent, name);
    }
    return text;
}

/// The name of one that is not used is commented out.
std::string CppBodies::argument(const char* type, const char* name, bool is_used) {
    return is_used ? fmt::format("{} {}", type, name) : fmt::format("{} /*{}*/", type, name);
}

CppBody CppBodies::finish(const CppFunction& cpp, std::string statements, const std::string& result, Uses uses) {
    CppBody body;
    body.arguments = argument("const State&", "x", cpp.uses_state() || uses.state || uses.everything);
    if (uses.has_input) body.arguments += ", " + argument("const Input&", "u", cpp.uses_input() || uses.everything);
    body.arguments += ", " + argument("Scalar", "t", cpp.uses_time() || uses.everything);
    if (!result.empty()) body.arguments += ", " + result;
    body.statements = scope(cpp.called()) + std::move(statements);
    return body;
}

/// The definitions that are computed, in order: members, and the steps on the way to them and to what is cached.
std::vector<std::size_t> CppBodies::needed_definitions() const {
    const FunctionCode& f = code_[Function::update];
    const std::vector<std::size_t>& order = code_.definition_order;
    std::set<std::size_t> needed;
    const auto need_parts = [&](NodeId root) {
        for (const NodeId id : f.program.in_order({root})) {
            const Node& node = f.program[id];
            const Variable* variable = node.kind == Node::Kind::symbol ? code_.atoms[node.index].variable : nullptr;
            if (variable != nullptr && variable->kind == SymbolKind::definition) needed.insert(variable->position);
        }
    };
    for (const auto& [index, number] : cached_) need_parts(f.results[order.size() + index]);
    for (const NodeId mass : f.mass) need_parts(mass);
    for (std::size_t i = order.size(); i-- > 0;) {
        if (!is_kept(order[i]) && !needed.contains(order[i])) continue;
        needed.insert(order[i]);
        if (!shared_.only_in_update().empty()) need_parts(f.results[i]);
    }
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < order.size(); ++i)
        if (needed.contains(order[i])) result.push_back(i);
    return result;
}

CppBody CppBodies::update(std::set<std::string>& done) {
    const FunctionCode& all = code_[Function::update];
    // Only what some function uses is computed.
    FunctionCode f = all;
    f.results.clear();
    std::vector<std::string> targets;
    const auto& definitions = code_.system.symbols.all(SymbolKind::definition);
    const auto add = [&](const std::string& target, NodeId result) {
        if (target.starts_with("c_.") && !done.insert(target).second) return;
        targets.push_back(target);
        f.results.push_back(result);
    };
    for (const std::size_t i : needed_definitions()) {
        const std::size_t definition = code_.definition_order[i];
        add((is_kept(definition) ? "c_." : "const Scalar ") + cpp_name(definitions[definition]), all.results[i]);
    }
    for (const auto& [index, number] : cached_) add(cached_texts_.at(index), all.results[code_.definition_order.size() + index]);
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    cpp.bind_locals(shared_.only_in_update());
    std::string statements;
    for (std::size_t i = 0; i < f.results.size(); ++i) {
        statements += cpp.compute({f.results[i]});
        statements += assigned(cpp, targets[i], f.results[i]);
    }
    if (f.by_loops && code_.solve.is_constant) {
        helpers_.insert("ldlt");
        statements += cpp.compute(f.mass);
        for (std::size_t i = 0; i < f.mass.size(); ++i) statements += assigned(cpp, fmt::format("c_.mass_factors[{}]", i), f.mass[i]);
        statements += fmt::format("{}detail::ldlt_factor<Scalar, {}>(c_.mass_factors);\n", indent, n_);
    }
    return finish(cpp, std::move(statements), "", {});
}

CppBody CppBodies::start_state() {
    const FunctionCode& f = code_[Function::start_state];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements = cpp.compute(f.results);
    for (std::size_t i = 0; i < f.results.size(); ++i)
        if (!f.is_zero(f.results[i])) statements += assigned(cpp, fmt::format("x[{}]", i), f.results[i]);
    return finish(cpp, std::move(statements), "", {});
}

std::string CppBodies::mass_name() const { return code_.solve.is_constant ? "c_.mass_factors" : "mass"; }

/// By loops: M of this motion, factored. A constant one was factored in update().
std::string CppBodies::factored_mass(CppFunction& cpp, const FunctionCode& f) {
    if (code_.solve.is_constant) return {};
    helpers_.insert("ldlt");
    std::string statements = cpp.compute(f.mass);
    statements += fmt::format("{}std::array<Scalar, {}> mass;\n", indent, f.mass.size());
    for (std::size_t i = 0; i < f.mass.size(); ++i) statements += assigned(cpp, fmt::format("mass[{}]", i), f.mass[i]);
    return statements + fmt::format("{}detail::ldlt_factor<Scalar, {}>(mass);\n", indent, n_);
}

/// dxdt, in the names of the function's program.
std::string CppBodies::motion(CppFunction& cpp, const FunctionCode& f) {
    cpp.bind_accelerations("dxdt", velocities_);
    std::string statements;
    if (f.by_loops) {
        std::vector<NodeId> first = code_.solve.is_constant ? std::vector<NodeId>() : f.mass;
        first.insert(first.end(), f.force.begin(), f.force.end());
        statements += cpp.compute(first);
        statements += factored_mass(cpp, f);
        for (std::size_t j = 0; j < n_; ++j) statements += assigned(cpp, fmt::format("dxdt[{}]", velocities_ + j), f.force[j]);
        helpers_.insert("ldlt");
        statements += fmt::format("{}detail::ldlt_solve<Scalar, {}>({}, dxdt.data() + {});\n", indent, n_, mass_name(), velocities_);
    } else {
        for (std::size_t j = 0; j < n_; ++j) cpp.name_node(f.accelerations[j], cpp_name(code_.system.symbols.all(SymbolKind::acceleration)[j]));
        name_multipliers(cpp, f.accelerations);
        statements += cpp.compute(f.accelerations);
    }
    return statements + cpp.compute(f.results);
}

/// What motion() computed, put into dxdt.
std::string CppBodies::stored_motion(CppFunction& cpp, const FunctionCode& f) {
    std::string statements;
    const Symbols& symbols = code_.system.symbols;
    for (std::size_t j = 0; j < n_; ++j)
        if (symbols.has_value(j)) statements += fmt::format("{}dxdt[{}] = x[{}];\n", indent, symbols.place(SymbolKind::coordinate, j), velocities_ + j);
    for (std::size_t j = 0; !f.by_loops && j < n_; ++j) statements += assigned(cpp, fmt::format("dxdt[{}]", velocities_ + j), f.accelerations[j]);
    for (std::size_t i = 0; i < m_; ++i) statements += assigned(cpp, fmt::format("dxdt[{}]", states_ + i), f.results[i]);
    return statements;
}

CppBody CppBodies::rhs() {
    const FunctionCode& f = code_[Function::rhs];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements = motion(cpp, f);
    statements += stored_motion(cpp, f);
    return finish(cpp, std::move(statements), n_ + m_ > 0 ? "State& dxdt" : "State& /*dxdt*/", {.state = n_ > 0});
}

/// What is computed for J and for the rates of plain states, if that fits into registers: nothing is stored before all is computed then. For all that
/// a compiler knows, what is stored may change a member, which it then loads anew.
std::string CppBodies::entries_if_few(CppFunction& cpp, const FunctionCode& f) {
    const JacobianLayout places = layout(By::state);
    std::vector<NodeId> entries;
    const auto add = [&](NodeId id) {
        const Node::Kind kind = f.program[id].kind;
        if (kind != Node::Kind::constant && kind != Node::Kind::symbol && std::find(entries.begin(), entries.end(), id) == entries.end()) entries.push_back(id);
    };
    const auto take = [&](std::size_t row, std::size_t c, NodeId id) {
        if (places.place(row, c)) add(id);
    };
    for (const NodeId id : f.results) add(id);
    for (std::size_t c = 0; c < places.columns(); ++c) {
        for (std::size_t j = 0; j < n_; ++j) take(velocities_ + j, c, f.solved.at(j, c));
        for (std::size_t i = 0; i < m_; ++i) take(states_ + i, c, f.below.at(i, c));
    }
    if (entries.size() > most_held) return {};
    for (const NodeId id : entries) cpp.keep(id);
    return cpp.compute(entries);
}

std::string CppBodies::motion_and_jacobian(CppFunction& cpp, const FunctionCode& f) {
    std::string statements = motion(cpp, f);
    if (!f.by_loops && !f.loop) statements += entries_if_few(cpp, f);
    statements += stored_motion(cpp, f);
    return statements + filled_jacobian(cpp, f, layout(By::state), By::state, true);
}

CppBody CppBodies::rhs_and_jacobian() {
    const FunctionCode& f = code_[Function::rhs_and_jacobian];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements = motion_and_jacobian(cpp, f);
    return finish(cpp, std::move(statements), n_ + m_ > 0 ? "State& dxdt, JacobianX& J" : "State& /*dxdt*/, JacobianX& /*J*/", {.state = n_ > 0});
}

CppBody CppBodies::together() {
    const FunctionCode& f = code_[Function::together];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements = motion_and_jacobian(cpp, f);
    const std::size_t outputs = code_.system.outputs.size();
    for (std::size_t i = 0; i < outputs; ++i) statements += assigned(cpp, fmt::format("y[{}]", i), f.results[m_ + i]);
    std::size_t next = m_ + outputs;
    for (const char* energy : {"kinetic", "potential", "internal"}) statements += assigned(cpp, fmt::format("energies.{}", energy), f.results[next++]);
    return finish(cpp, std::move(statements), fmt::format("{}, Output& {}, Energies& energies", n_ + m_ > 0 ? "State& dxdt, JacobianX& J" : "State& /*dxdt*/, JacobianX& /*J*/", outputs > 0 ? "y" : "/*y*/"), {.state = n_ > 0});
}

/// d(qdd)/d(column), all columns by the same statements: side by side where the machine can do that. What does not depend on the column
/// comes before.
std::string CppBodies::column_loop(CppFunction& cpp, const FunctionCode& f, const JacobianLayout& layout) {
    if (f.loop->columns.empty()) return {};
    const std::vector<bool> varies = f.varying();
    std::vector<NodeId> same;
    for (const NodeId id : f.program.in_order(f.loop->results))
        for (const NodeId argument : f.program[id].arguments)
            if (varies[id] && !varies[argument] && f.program[id].op != Op::in_column) same.push_back(argument);
    for (const NodeId id : same) cpp.keep(id);
    std::string statements = cpp.compute(same);
    const std::vector<std::size_t>& columns = f.loop->columns;
    cpp.bind_columns(columns);
    std::string body = cpp.compute(f.loop->results);
    for (std::size_t j = 0; j < n_; ++j) body += assigned(cpp, fmt::format("solved[{}][c]", j), f.loop->results[j]);
    std::vector<std::size_t> starts;
    for (const std::size_t c : columns) starts.push_back(*layout.place(velocities_, c));
    // Loaded and not compared: a compiler makes many ways through the statements out of a condition in them.
    statements += fmt::format("{0}Scalar unit[{1}]{{}};  // one in its middle\n{0}unit[{2}] = Scalar(1);\n", indent, 2 * columns.size() - 1, columns.size() - 1);
    statements += fmt::format("{}Scalar solved[{}][{}];\n", indent, n_, columns.size());
    statements += fmt::format("{0}for (std::size_t c = 0; c < {1}; ++c) {{\n{2}{0}}}\n", indent, columns.size(), shifted(body));
    statements += wrapped(fmt::format("constexpr std::array<std::size_t, {}> starts{{{}}};", starts.size(), fmt::join(starts, ", ")), 8);
    statements += fmt::format("{0}for (std::size_t c = 0; c < {1}; ++c)\n{0}    for (std::size_t j = 0; j < {2}; ++j) J[starts[c] + j] = solved[j][c];\n", indent, columns.size(), n_);
    return statements;
}

/// Everything in J. With loops the right sides are put where the solutions belong and solved there.
std::string CppBodies::filled_jacobian(CppFunction& cpp, const FunctionCode& f, const JacobianLayout& layout, By by, bool has_mass) {
    std::string statements;
    const CodeMatrix& accelerations = f.by_loops ? f.right : f.solved;
    if (f.loop) statements += column_loop(cpp, f, layout);
    statements += cpp.compute(accelerations.entries);
    statements += cpp.compute(f.below.entries);
    if (f.by_loops && !has_mass && layout.any_accelerations()) statements += factored_mass(cpp, f);
    std::vector<std::size_t> starts;
    for (std::size_t c = 0; c < layout.columns(); ++c) {
        const auto set = [&](std::size_t row, const std::string& value) {
            if (const auto place = layout.place(row, c)) statements += wrapped(fmt::format("J[{}] = {};", *place, value), 8);
        };
        const auto set_node = [&](std::size_t row, NodeId id) {
            std::string before;
            const std::string text = cpp.value(id, before);
            if (!layout.place(row, c)) return;
            statements += before;
            set(row, text);
        };
        for (std::size_t j = 0; j < n_; ++j)
            if (code_.system.symbols.has_value(j)) set(code_.system.symbols.place(SymbolKind::coordinate, j), by == By::state && c == velocities_ + j ? "Scalar(1)" : "Scalar(0)");
        for (std::size_t j = 0; !f.loop && j < n_; ++j) set_node(velocities_ + j, accelerations.at(j, c));
        for (std::size_t j = 0; f.loop && !layout.has_accelerations(c) && j < n_; ++j) set(velocities_ + j, "Scalar(0)");
        for (std::size_t i = 0; i < m_; ++i) set_node(states_ + i, f.below.at(i, c));
        if (f.by_loops && layout.has_accelerations(c)) starts.push_back(*layout.place(velocities_, c));
    }
    if (starts.empty()) return statements;
    statements += wrapped(fmt::format("constexpr std::array<std::size_t, {}> starts{{{}}};", starts.size(), fmt::join(starts, ", ")), 8);
    helpers_.insert("ldlt");
    statements += fmt::format("{}detail::ldlt_solve_columns<Scalar, {}>({}, J.data(), starts);\n", indent, n_, mass_name());
    return statements;
}

void CppBodies::name_multipliers(CppFunction& cpp, const std::vector<NodeId>& solved_for) const {
    const std::vector<std::size_t>& multipliers = code_.system.motion.multipliers;
    for (std::size_t i = 0; !solved_for.empty() && i < multipliers.size(); ++i) cpp.name_node(solved_for[n_ + i], cpp_name(code_.system.symbols.all(SymbolKind::multiplier)[multipliers[i]]));
}

/// Accelerations for functions that need them but do not solve for them.
std::string CppBodies::accelerations_by_rhs(CppFunction& cpp) {
    cpp.bind_accelerations("dxdt", velocities_);
    return fmt::format("{0}State dxdt;\n{0}rhs({1}x, u, t, dxdt);\n", indent, mode_);
}

CppBody CppBodies::jacobian(Function function, By by) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements;
    if (f.uses_accelerations) statements += accelerations_by_rhs(cpp);
    statements += filled_jacobian(cpp, f, layout(by), by, false);
    static constexpr const char* types[]{"JacobianX", "JacobianU", "JacobianP", "JacobianT"};
    const bool unused = layout(by).size() == 0;
    return finish(cpp, std::move(statements), fmt::format("{}& {}", types[static_cast<std::size_t>(by)], unused ? "/*J*/" : "J"), {.everything = f.uses_accelerations});
}

CppBody CppBodies::mass_matrix() {
    const FunctionCode& f = code_[Function::mass_matrix];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements = cpp.compute(f.results);
    for (std::size_t c = 0; c < n_; ++c)
        for (std::size_t r = 0; r < n_; ++r)
            statements += r >= c ? assigned(cpp, fmt::format("M[{}]", c * n_ + r), f.results[lower_index(r, c)]) : fmt::format("{}M[{}] = M[{}];\n", indent, c * n_ + r, r * n_ + c);
    return finish(cpp, std::move(statements), n_ == 0 ? "MassMatrix& /*M*/" : "MassMatrix& M", {.has_input = false});
}

CppBody CppBodies::values(Function function, const char* type, const char* result, bool has_input) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements;
    if (f.uses_accelerations) statements += accelerations_by_rhs(cpp);
    name_multipliers(cpp, f.solved_for);
    statements += cpp.compute(f.results);
    for (std::size_t i = 0; i < f.results.size(); ++i) statements += assigned(cpp, fmt::format("{}[{}]", result, i), f.results[i]);
    return finish(cpp, std::move(statements), f.results.empty() ? fmt::format("{}& /*{}*/", type, result) : fmt::format("{}& {}", type, result), {.everything = f.uses_accelerations, .has_input = has_input});
}

CppBody CppBodies::constraint_jacobian() {
    const FunctionCode& f = code_[Function::constraint_jacobian];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements = cpp.compute(f.results);
    const std::size_t rows = code_.system.constraints.size();
    for (std::size_t j = 0; j < n_; ++j)
        for (std::size_t i = 0; i < rows && !f.results.empty(); ++i) statements += assigned(cpp, fmt::format("A[{}]", j * rows + i), f.results[i * n_ + j]);
    return finish(cpp, std::move(statements), f.results.empty() || rows == 0 ? "ConstraintJacobian& /*A*/" : "ConstraintJacobian& A", {.has_input = false});
}

/// dh/dx at fixed accelerations, and through the accelerations where outputs contain them.
CppBody CppBodies::output_jacobian(Function function, By by) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    const std::size_t rows = f.by_output.rows;
    if (!f.whole_output.entries.empty()) return whole_output_jacobian(cpp, f, by);
    const bool through = std::any_of(f.by_acceleration.entries.begin(), f.by_acceleration.entries.end(), [&](NodeId id) { return !f.is_zero(id); });
    const bool is_empty = rows == 0 || f.by_output.columns == 0;
    std::string statements;
    if (through && !is_empty && by == By::state) {
        cpp.bind_accelerations("dxdt", velocities_);
        statements += fmt::format("{0}State dxdt;\n{0}JacobianX J;\n{0}rhs_and_jacobian({1}x, u, t, dxdt, J);\n", indent, mode_);
    } else if (through && !is_empty) {
        statements += fmt::format("{0}JacobianU J;\n{0}jacobian_u({1}x, u, t, J);\n", indent, mode_);
    }
    if (f.uses_accelerations && !(through && by == By::state)) statements += accelerations_by_rhs(cpp);
    if (!is_empty) statements += cpp.compute(f.by_output.entries);
    if (!is_empty) statements += cpp.compute(f.by_acceleration.entries);
    const char* name = by == By::state ? "C" : "D";
    for (std::size_t c = 0; !is_empty && c < f.by_output.columns; ++c)
        for (std::size_t r = 0; r < rows; ++r) {
            std::string before;
            std::string text = cpp.value(f.by_output.at(r, c), before);
            for (std::size_t k = 0; k < n_; ++k) {
                const auto place = layout(by).place(velocities_ + k, c);
                if (f.is_zero(f.by_acceleration.at(r, k)) || !place) continue;
                const std::string factor = cpp.value(f.by_acceleration.at(r, k), before);
                text += fmt::format(" + ({}) * J[{}]", factor, *place);
            }
            statements += before + wrapped(fmt::format("{}[{}] = {};", name, c * rows + r, text), 8);
        }
    const char* type = by == By::state ? "OutputJacobianX" : "OutputJacobianU";
    const bool needs_all = (through && !is_empty) || f.uses_accelerations;
    return finish(cpp, std::move(statements), is_empty ? fmt::format("{}& /*{}*/", type, name) : fmt::format("{}& {}", type, name), {.everything = needs_all});
}

/// Where outputs contain multipliers: everything is solved for on the way.
CppBody CppBodies::whole_output_jacobian(CppFunction& cpp, const FunctionCode& f, By by) {
    const char* name = by == By::state ? "C" : "D";
    name_multipliers(cpp, f.solved_for);
    std::string statements = cpp.compute(f.whole_output.entries);
    for (std::size_t i = 0; i < f.whole_output.entries.size(); ++i) statements += assigned(cpp, fmt::format("{}[{}]", name, i), f.whole_output.entries[i]);
    return finish(cpp, std::move(statements), fmt::format("{}& {}", by == By::state ? "OutputJacobianX" : "OutputJacobianU", name), {});
}

CppBody CppBodies::move_back() {
    const Symbols& symbols = code_.system.symbols;
    std::string statements;
    for (std::size_t j = 0; j < n_; ++j)
        if (symbols.has_value(j)) statements += fmt::format("{}x[{}] -= step[{}];\n", indent, symbols.place(SymbolKind::coordinate, j), j);
    for (const Symbols::AttitudeSymbols& attitude : symbols.attitudes()) {
        helpers_.insert("turn_back");
        const auto& [a, b, c] = attitude.coordinates;
        statements += fmt::format("{}detail::turn_back<Scalar>(x.data() + {}, step[{}], step[{}], step[{}]);\n", indent, symbols.place(SymbolKind::state, attitude.parts[0]), a, b, c);
    }
    return {"State& x, const Generalised& step", statements};
}

CppBody CppBodies::correction() {
    const FunctionCode& f = code_[Function::correction];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements = cpp.compute(f.results);
    for (std::size_t j = 0; j < f.results.size(); ++j) statements += assigned(cpp, fmt::format("step[{}]", j), f.results[j]);
    const bool is_needed = std::any_of(f.results.begin(), f.results.end(), [&](NodeId id) { return !f.is_zero(id); });
    if (f.results.empty()) statements = fmt::format("{}step.fill(Scalar(0));\n", indent);  // nothing has to be held in this mode
    return finish(cpp, std::move(statements), !is_needed ? "const Constraints& /*residual*/, Generalised& step" : "const Constraints& residual, Generalised& step", {.has_input = false});
}

CppBody CppBodies::scalar(Function function) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements;
    if (f.uses_accelerations) statements += accelerations_by_rhs(cpp);
    statements += cpp.compute(f.results);
    std::string before;
    const std::string text = cpp.value(f.results[0], before);
    statements += before + wrapped(fmt::format("return {};", text), 8);
    const bool is_energy = function == Function::kinetic_energy || function == Function::potential_energy || function == Function::internal_energy;
    return finish(cpp, std::move(statements), "", {.everything = f.uses_accelerations, .has_input = !is_energy});
}

std::string shifted(const std::string& text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        result += "    " + text.substr(at, end - at) + "\n";
        at = end + 1;
    }
    return result;
}

}  // namespace dalembert
