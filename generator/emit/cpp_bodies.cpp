// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/cpp_bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/helpers.hpp"

namespace dalembert {

namespace {

const std::set<std::string> argument_names{"x", "u", "t", "J", "M", "y", "dxdt", "b", "Q", "p", "starts", "start", "p_", "c_", "mass", "detail", "Scalar", "State"};

constexpr const char* indent = "        ";

}  // namespace

CppBodies::CppBodies(const Code& code) : code_(code), n_(code.solve.n), m_(code.system.symbols.states()) {
    std::set<std::uint32_t> used;
    const Symbols& symbols = code.system.symbols;
    for (std::size_t i = symbols.model_definitions(); i < symbols.count(SymbolKind::definition); ++i) only_in_update_.insert(i);
    for (const FunctionCode& f : code.functions)
        for (const NodeId id : f.program.in_order(f.roots())) {
            const Node& node = f.program[id];
            if (node.kind == Node::Kind::cached) used.insert(node.index);
            const Variable* variable = node.kind == Node::Kind::symbol ? code.atoms[node.index].variable : nullptr;
            const bool is_definition = variable != nullptr && variable->kind == SymbolKind::definition;
            if (is_definition && &f != &code[Function::update]) only_in_update_.erase(variable->position);
        }
    for (const std::uint32_t index : used) {
        cached_texts_.emplace(index, "c_." + cached_name(code.system.symbols, cached_.size()));
        cached_.emplace(index, cached_.size());
    }
    layouts_.emplace_back(code, code[Function::rhs_and_jacobian], By::state);
    layouts_.emplace_back(code, code[Function::jacobian_u], By::input);
    layouts_.emplace_back(code, code[Function::jacobian_p], By::parameter);
    layouts_.emplace_back(code, code[Function::jacobian_t], By::time);
    if (!code.solve.unrolled) helpers_.insert("ldlt");
}

std::string CppBodies::assigned(CppFunction& cpp, const std::string& target, NodeId value) {
    std::string statements;
    const std::string text = cpp.value(value, statements);
    return statements + wrapped(fmt::format("{} = {};", target, text), 8);
}

/// Puts the functions that are called into scope and comments out the names of arguments that are not used.
CppBody CppBodies::finish(const CppFunction& cpp, std::string statements, const std::string& result, Uses uses) {
    std::string scope;
    for (const std::string& name : cpp.called()) {
        if (is_helper(name)) helpers_.insert(name);
        else scope += fmt::format("{}using std::{};\n", indent, name);
    }
    const auto argument = [](const char* type, const char* name, bool used) { return used ? fmt::format("{} {}", type, name) : fmt::format("{} /*{}*/", type, name); };
    CppBody body;
    body.arguments = argument("const State&", "x", cpp.uses_state() || uses.state || uses.everything);
    if (uses.has_input) body.arguments += ", " + argument("const Input&", "u", cpp.uses_input() || uses.everything);
    body.arguments += ", " + argument("Scalar", "t", cpp.uses_time() || uses.everything);
    if (!result.empty()) body.arguments += ", " + result;
    body.statements = scope + std::move(statements);
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
        if (!only_in_update_.empty()) need_parts(f.results[i]);
    }
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < order.size(); ++i)
        if (needed.contains(order[i])) result.push_back(i);
    return result;
}

CppBody CppBodies::update() {
    const FunctionCode& all = code_[Function::update];
    // Only what some function uses is computed.
    FunctionCode f = all;
    const std::vector<std::size_t> needed = needed_definitions();
    f.results.clear();
    for (const std::size_t i : needed) f.results.push_back(all.results[i]);
    for (const auto& [index, number] : cached_) f.results.push_back(all.results[code_.definition_order.size() + index]);
    CppFunction cpp(code_, f, cached_texts_, argument_names);
    cpp.bind_locals(only_in_update_);
    std::string statements;
    const auto& definitions = code_.system.symbols.all(SymbolKind::definition);
    for (std::size_t i = 0; i < f.results.size(); ++i) {
        statements += cpp.compute({f.results[i]});
        const bool is_definition = i < needed.size();
        const std::size_t definition = is_definition ? code_.definition_order[needed[i]] : 0;
        const std::string target = is_definition ? cpp_name(definitions[definition]) : cached_name(code_.system.symbols, i - needed.size());
        const bool is_local = is_definition && !is_kept(definition);
        statements += assigned(cpp, (is_local ? "const Scalar " : "c_.") + target, f.results[i]);
    }
    if (f.by_loops && code_.solve.is_constant) {
        statements += cpp.compute(f.mass);
        for (std::size_t i = 0; i < f.mass.size(); ++i) statements += assigned(cpp, fmt::format("c_.mass_factors[{}]", i), f.mass[i]);
        statements += fmt::format("{}detail::ldlt_factor<Scalar, {}>(c_.mass_factors);\n", indent, n_);
    }
    return finish(cpp, std::move(statements), "", {});
}

CppBody CppBodies::start_state() {
    const FunctionCode& f = code_[Function::start_state];
    CppFunction cpp(code_, f, cached_texts_, argument_names);
    std::string statements = cpp.compute(f.results);
    for (std::size_t i = 0; i < f.results.size(); ++i)
        if (!f.is_zero(f.results[i])) statements += assigned(cpp, fmt::format("x[{}]", i), f.results[i]);
    return finish(cpp, std::move(statements), "", {});
}

std::string CppBodies::mass_name() const { return code_.solve.is_constant ? "c_.mass_factors" : "mass"; }

/// By loops: M of this motion, factored. A constant one was factored in update().
std::string CppBodies::factored_mass(CppFunction& cpp, const FunctionCode& f) {
    if (code_.solve.is_constant) return {};
    std::string statements = cpp.compute(f.mass);
    statements += fmt::format("{}std::array<Scalar, {}> mass;\n", indent, f.mass.size());
    for (std::size_t i = 0; i < f.mass.size(); ++i) statements += assigned(cpp, fmt::format("mass[{}]", i), f.mass[i]);
    return statements + fmt::format("{}detail::ldlt_factor<Scalar, {}>(mass);\n", indent, n_);
}

/// dxdt, in the names of the function's program.
std::string CppBodies::motion(CppFunction& cpp, const FunctionCode& f) {
    cpp.bind_accelerations("dxdt", n_);
    std::string statements;
    if (f.by_loops) {
        std::vector<NodeId> first = code_.solve.is_constant ? std::vector<NodeId>() : f.mass;
        first.insert(first.end(), f.force.begin(), f.force.end());
        statements += cpp.compute(first);
        statements += factored_mass(cpp, f);
        for (std::size_t j = 0; j < n_; ++j) statements += assigned(cpp, fmt::format("dxdt[{}]", n_ + j), f.force[j]);
        statements += fmt::format("{}detail::ldlt_solve<Scalar, {}>({}, dxdt.data() + {});\n", indent, n_, mass_name(), n_);
    } else {
        for (std::size_t j = 0; j < n_; ++j) cpp.name_node(f.accelerations[j], cpp_name(code_.system.symbols.all(SymbolKind::acceleration)[j]));
        statements += cpp.compute(f.accelerations);
    }
    statements += cpp.compute(f.results);
    for (std::size_t j = 0; j < n_; ++j) statements += fmt::format("{}dxdt[{}] = x[{}];\n", indent, j, n_ + j);
    for (std::size_t j = 0; !f.by_loops && j < n_; ++j) statements += assigned(cpp, fmt::format("dxdt[{}]", n_ + j), f.accelerations[j]);
    for (std::size_t i = 0; i < m_; ++i) statements += assigned(cpp, fmt::format("dxdt[{}]", 2 * n_ + i), f.results[i]);
    return statements;
}

CppBody CppBodies::rhs() {
    const FunctionCode& f = code_[Function::rhs];
    CppFunction cpp(code_, f, cached_texts_, argument_names);
    std::string statements = motion(cpp, f);
    return finish(cpp, std::move(statements), "State& dxdt", {.state = n_ > 0});
}

CppBody CppBodies::rhs_and_jacobian() {
    const FunctionCode& f = code_[Function::rhs_and_jacobian];
    CppFunction cpp(code_, f, cached_texts_, argument_names);
    std::string statements = motion(cpp, f);
    statements += filled_jacobian(cpp, f, layout(By::state), By::state, true);
    return finish(cpp, std::move(statements), "State& dxdt, JacobianX& J", {.state = n_ > 0});
}

/// Everything in J. With loops the right sides are put where the solutions belong and solved there.
std::string CppBodies::filled_jacobian(CppFunction& cpp, const FunctionCode& f, const JacobianLayout& layout, By by, bool has_mass) {
    std::string statements;
    const CodeMatrix& accelerations = f.by_loops ? f.right : f.solved;
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
        for (std::size_t j = 0; j < n_; ++j) set(j, by == By::state && c == n_ + j ? "Scalar(1)" : "Scalar(0)");
        for (std::size_t j = 0; j < n_; ++j) set_node(n_ + j, accelerations.at(j, c));
        for (std::size_t i = 0; i < m_; ++i) set_node(2 * n_ + i, f.below.at(i, c));
        if (f.by_loops && layout.has_accelerations(c)) starts.push_back(*layout.place(n_, c));
    }
    if (starts.empty()) return statements;
    statements += wrapped(fmt::format("constexpr std::array<std::size_t, {}> starts{{{}}};", starts.size(), fmt::join(starts, ", ")), 8);
    statements += fmt::format("{}detail::ldlt_solve_columns<Scalar, {}>({}, J.data(), starts);\n", indent, n_, mass_name());
    return statements;
}

/// Accelerations for functions that need them but do not solve for them.
std::string CppBodies::accelerations_by_rhs(CppFunction& cpp) {
    cpp.bind_accelerations("dxdt", n_);
    return fmt::format("{}State dxdt;\n{}rhs(x, u, t, dxdt);\n", indent, indent);
}

CppBody CppBodies::jacobian(Function function, By by) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, argument_names);
    std::string statements;
    if (f.uses_accelerations) statements += accelerations_by_rhs(cpp);
    statements += filled_jacobian(cpp, f, layout(by), by, false);
    static constexpr const char* types[]{"JacobianX", "JacobianU", "JacobianP", "JacobianT"};
    const bool unused = layout(by).size() == 0;
    return finish(cpp, std::move(statements), fmt::format("{}& {}", types[static_cast<std::size_t>(by)], unused ? "/*J*/" : "J"), {.everything = f.uses_accelerations});
}

CppBody CppBodies::mass_matrix() {
    const FunctionCode& f = code_[Function::mass_matrix];
    CppFunction cpp(code_, f, cached_texts_, argument_names);
    std::string statements = cpp.compute(f.results);
    for (std::size_t c = 0; c < n_; ++c)
        for (std::size_t r = 0; r < n_; ++r)
            statements += r >= c ? assigned(cpp, fmt::format("M[{}]", c * n_ + r), f.results[lower_index(r, c)]) : fmt::format("{}M[{}] = M[{}];\n", indent, c * n_ + r, r * n_ + c);
    return finish(cpp, std::move(statements), n_ == 0 ? "MassMatrix& /*M*/" : "MassMatrix& M", {.has_input = false});
}

CppBody CppBodies::values(Function function, const char* type, const char* result) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, argument_names);
    std::string statements;
    if (f.uses_accelerations) statements += accelerations_by_rhs(cpp);
    statements += cpp.compute(f.results);
    for (std::size_t i = 0; i < f.results.size(); ++i) statements += assigned(cpp, fmt::format("{}[{}]", result, i), f.results[i]);
    return finish(cpp, std::move(statements), f.results.empty() ? fmt::format("{}& /*{}*/", type, result) : fmt::format("{}& {}", type, result), {.everything = f.uses_accelerations});
}

/// dh/dx at fixed accelerations, and through the accelerations where outputs contain them.
CppBody CppBodies::output_jacobian(Function function, By by) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, argument_names);
    const std::size_t rows = f.by_output.rows;
    const bool through = std::any_of(f.by_acceleration.entries.begin(), f.by_acceleration.entries.end(), [&](NodeId id) { return !f.is_zero(id); });
    const bool is_empty = rows == 0 || f.by_output.columns == 0;
    std::string statements;
    if (through && !is_empty && by == By::state) {
        cpp.bind_accelerations("dxdt", n_);
        statements += fmt::format("{0}State dxdt;\n{0}JacobianX J;\n{0}rhs_and_jacobian(x, u, t, dxdt, J);\n", indent);
    } else if (through && !is_empty) {
        statements += fmt::format("{0}JacobianU J;\n{0}jacobian_u(x, u, t, J);\n", indent);
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
                const auto place = layout(by).place(n_ + k, c);
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

CppBody CppBodies::scalar(Function function) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, argument_names);
    std::string statements;
    if (f.uses_accelerations) statements += accelerations_by_rhs(cpp);
    statements += cpp.compute(f.results);
    std::string before;
    const std::string text = cpp.value(f.results[0], before);
    statements += before + wrapped(fmt::format("return {};", text), 8);
    const bool is_energy = function == Function::kinetic_energy || function == Function::potential_energy || function == Function::internal_energy;
    return finish(cpp, std::move(statements), "", {.everything = f.uses_accelerations, .has_input = !is_energy});
}

}  // namespace dalembert
