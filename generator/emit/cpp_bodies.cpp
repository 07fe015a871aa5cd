// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/cpp_bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "emit/helpers.hpp"
#include "emit/notation.hpp"
#include "graph/raise.hpp"

namespace dalembert {

namespace {

const std::set<std::string> argument_names{"x", "u", "t", "J", "M", "y", "dxdt", "b", "Q", "p", "starts", "start", "p_", "c_", "mass", "detail", "Scalar", "State"};
const std::set<std::string> names_of_modes{"mode", "event", "event_number", "g", "rates", "by_time", "k"};

constexpr const char* indent = "        ";

}  // namespace

SharedMembers::SharedMembers(std::vector<const Code*> modes) : modes_(std::move(modes)) {
    const Symbols& first = modes_.front()->system.symbols;
    for (std::size_t i = first.model_definitions(); i < first.count(SymbolKind::definition); ++i) only_in_update_.insert(i);
    std::map<std::string, std::size_t> numbers;
    std::size_t count = 0;
    for (const Code* code : modes_) {
        std::set<std::uint32_t> used;
        for (const FunctionCode& f : code->functions)
            for (const NodeId id : f.program.in_order(f.roots())) {
                const Node& node = f.program[id];
                if (node.kind == Node::Kind::cached) used.insert(node.index);
                const Variable* variable = node.kind == Node::Kind::symbol ? code->atoms[node.index].variable : nullptr;
                const bool is_definition = variable != nullptr && variable->kind == SymbolKind::definition;
                if (is_definition && &f != &(*code)[Function::update]) only_in_update_.erase(variable->position);
            }
        const Notation write(code->system.symbols, Style::text);
        const CachedMeaning meaning = cached_meaning(*code);
        for (const std::uint32_t index : used) {
            if (modes_.size() == 1) {
                cached_[code].emplace(index, count++);
                continue;
            }
            const auto [known, is_new] = numbers.emplace(write(meaning(index)), count);
            if (is_new) ++count;
            cached_[code].emplace(index, known->second);
        }
        cached_[code];
    }
    layouts_.emplace_back(modes_, Function::rhs_and_jacobian, By::state);
    layouts_.emplace_back(modes_, Function::jacobian_u, By::input);
    layouts_.emplace_back(modes_, Function::jacobian_p, By::parameter);
    layouts_.emplace_back(modes_, Function::jacobian_t, By::time);
}

CppBodies::CppBodies(const Code& code, const SharedMembers& shared)
    : code_(code), shared_(shared), n_(code.system.symbols.degrees()), m_(code.system.symbols.states()), cached_(shared.cached(code)), mode_(shared.has_modes() ? "mode, " : ""), arguments_(argument_names) {
    for (const auto& [index, number] : cached_) cached_texts_.emplace(index, "c_." + cached_name(code.system.symbols, number));
    if (!code.solve.unrolled) helpers_.insert("ldlt");
    if (shared.has_modes()) arguments_.insert(names_of_modes.begin(), names_of_modes.end());
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
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements = motion(cpp, f);
    return finish(cpp, std::move(statements), "State& dxdt", {.state = n_ > 0});
}

CppBody CppBodies::rhs_and_jacobian() {
    const FunctionCode& f = code_[Function::rhs_and_jacobian];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
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

CppBody CppBodies::values(Function function, const char* type, const char* result) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements;
    if (f.uses_accelerations) statements += accelerations_by_rhs(cpp);
    statements += cpp.compute(f.results);
    for (std::size_t i = 0; i < f.results.size(); ++i) statements += assigned(cpp, fmt::format("{}[{}]", result, i), f.results[i]);
    return finish(cpp, std::move(statements), f.results.empty() ? fmt::format("{}& /*{}*/", type, result) : fmt::format("{}& {}", type, result), {.everything = f.uses_accelerations});
}

/// dh/dx at fixed accelerations, and through the accelerations where outputs contain them.
CppBody CppBodies::output_jacobian(Function function, By by) {
    const FunctionCode& f = code_[function];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    const std::size_t rows = f.by_output.rows;
    const bool through = std::any_of(f.by_acceleration.entries.begin(), f.by_acceleration.entries.end(), [&](NodeId id) { return !f.is_zero(id); });
    const bool is_empty = rows == 0 || f.by_output.columns == 0;
    std::string statements;
    if (through && !is_empty && by == By::state) {
        cpp.bind_accelerations("dxdt", n_);
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

/// Rates of the accelerations that occur, by the chain rule along the motion, with inputs held.
std::string CppBodies::jerks(const FunctionCode& f) {
    std::string statements = fmt::format("{0}State dxdt;\n{0}JacobianX J;\n{0}rhs_and_jacobian(mode, x, u, t, dxdt, J);\n{0}JacobianT by_time;\n{0}jacobian_t(mode, x, u, t, by_time);\n", indent);
    for (const NodeId id : f.program.in_order(f.roots())) {
        const Node& node = f.program[id];
        const Variable* variable = node.kind == Node::Kind::symbol ? code_.atoms[node.index].variable : nullptr;
        if (variable == nullptr || variable->kind != SymbolKind::jerk) continue;
        const std::size_t row = n_ + variable->position;
        std::string sum = fmt::format("by_time[{}]", row);
        for (std::size_t c = 0; c < layout(By::state).columns(); ++c)
            if (const auto place = layout(By::state).place(row, c)) sum += fmt::format(" + J[{}] * dxdt[{}]", *place, c);
        statements += wrapped(fmt::format("const Scalar {} = {};", cpp_name(*variable), sum), 8);
    }
    return statements;
}

CppBody CppBodies::guards(Function function, const char* type, const char* result) {
    FunctionCode f = code_[function];
    std::vector<std::size_t> watched;
    for (std::size_t e = 0; e < code_.system.events.size(); ++e)
        if (code_.system.events[e].is_watched) watched.push_back(e);
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements;
    if (f.uses_jerks) statements += jerks(f);
    else if (f.uses_accelerations) statements += accelerations_by_rhs(cpp);
    cpp.bind_accelerations("dxdt", n_);
    for (const std::size_t e : watched) {
        statements += cpp.compute({f.results[e]});
        statements += assigned(cpp, fmt::format("{}[{}]", result, e), f.results[e]);
    }
    return finish(cpp, std::move(statements), watched.empty() ? fmt::format("{}& /*{}*/", type, result) : fmt::format("{}& {}", type, result), {.everything = f.uses_accelerations || f.uses_jerks});
}

CppBody CppBodies::conditions() {
    const FunctionCode& f = code_[Function::conditions];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements = cpp.compute(f.results);
    std::string all;
    const std::size_t count = code_.condition_places.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::string value = cpp.value(f.results[i], statements);
        const std::string size = cpp.value(f.results[count + i], statements);
        all += fmt::format("{}detail::is_near<Scalar>(x[{}], {}, {})", i == 0 ? "" : " && ", code_.condition_places[i], value, size);
    }
    if (!f.results.empty()) helpers_.insert("is_near");
    statements += fmt::format("{}return {};\n", indent, f.results.empty() ? "true" : all);
    return finish(cpp, std::move(statements), "", {.state = !f.results.empty()});
}

CppBody CppBodies::resets(const std::vector<ResetCode>& resets) {
    const FunctionCode& f = code_[Function::resets];
    std::string statements;
    bool uses_input = false, uses_time = false;
    std::set<std::string> called;
    for (std::size_t e = 0; e < resets.size(); ++e) {
        if (resets[e].places.empty()) continue;
        FunctionCode one = f;
        one.solved = one.right = {};
        const auto first = f.results.begin() + static_cast<std::ptrdiff_t>(resets[e].first);
        one.results.assign(first, first + static_cast<std::ptrdiff_t>(resets[e].places.size()));
        CppFunction cpp(code_, one, cached_texts_, arguments_);
        // Everything is read before anything is written.
        std::string body = cpp.compute(one.results);
        std::vector<std::string> values;
        for (const NodeId result : one.results) values.push_back(cpp.value(result, body));
        const bool at_once = values.size() > 1;
        for (std::size_t i = 0; at_once && i < values.size(); ++i) body += wrapped(fmt::format("const Scalar new_{}_ = {};", i, values[i]), 8);
        for (std::size_t i = 0; i < values.size(); ++i) body += wrapped(fmt::format("x[{}] = {};", resets[e].places[i], at_once ? fmt::format("new_{}_", i) : values[i]), 8);
        statements += fmt::format("{0}if (event_number == event::{1}) {{\n{2}{0}}}\n", indent, cpp_name(code_.system.events[e].name, 0, false), shifted(body));
        uses_input = uses_input || cpp.uses_input();
        uses_time = uses_time || cpp.uses_time();
        called.insert(cpp.called().begin(), cpp.called().end());
    }
    std::string scope;
    for (const std::string& name : called) {
        if (is_helper(name)) helpers_.insert(name);
        else scope += fmt::format("{}using std::{};\n", indent, name);
    }
    const auto argument = [](const char* type, const char* name, bool used) { return used ? fmt::format("{} {}", type, name) : fmt::format("{} /*{}*/", type, name); };
    return {argument("State&", "x", !statements.empty()) + ", " + argument("const Input&", "u", uses_input) + ", " + argument("Scalar", "t", uses_time), scope + statements};
}

CppBody CppBodies::kinks(const std::vector<std::string>& names) {
    const FunctionCode& f = code_[Function::guards];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements;
    for (std::size_t k = 0; k < names.size(); ++k) {
        const auto& guards = code_.system.fluids.guards;
        const auto found = std::find_if(guards.begin(), guards.end(), [&](const Guard& g) { return !g.ends && g.name + g.doc == names[k]; });
        if (found == guards.end()) {
            statements += fmt::format("{}k[{}] = Scalar(1);\n", indent, k);
            continue;
        }
        const NodeId result = f.results[static_cast<std::size_t>(found - guards.begin())];
        statements += cpp.compute({result});
        statements += assigned(cpp, fmt::format("k[{}]", k), result);
    }
    return finish(cpp, std::move(statements), names.empty() ? "Kinks& /*k*/" : "Kinks& k", {.everything = f.uses_accelerations});
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
