// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of the functions that only a machine that switches has.
#include <fmt/format.h>

#include <algorithm>

#include "emit/cpp_bodies.hpp"

namespace dalembert {

/// Rates of the accelerations that occur, by the chain rule along the motion, with inputs held.
std::string CppBodies::jerks(const FunctionCode& f) {
    std::string statements = fmt::format("{0}State dxdt;\n{0}JacobianX J;\n{0}rhs_and_jacobian(mode, x, u, t, dxdt, J);\n{0}JacobianT by_time;\n{0}jacobian_t(mode, x, u, t, by_time);\n", indent);
    for (const NodeId id : f.program.in_order(f.roots())) {
        const Node& node = f.program[id];
        const Variable* variable = node.kind == Node::Kind::symbol ? code_.atoms[node.index].variable : nullptr;
        if (variable == nullptr || variable->kind != SymbolKind::jerk) continue;
        const std::size_t row = velocities_ + variable->position;
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
    cpp.bind_accelerations("dxdt", velocities_);
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
        const std::string entry = code_.condition_places[i] ? fmt::format("x[{}]", *code_.condition_places[i]) : "Scalar(0)";
        all += fmt::format("{}detail::is_near<Scalar>({}, {}, {})", i == 0 ? "" : " && ", entry, value, size);
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
    return {argument("State&", "x", !statements.empty()) + ", " + argument("const Input&", "u", uses_input) + ", " + argument("Scalar", "t", uses_time), scope(called) + statements};
}

CppBody CppBodies::kinks(const std::vector<Guard>& kinks) {
    const FunctionCode& f = code_[Function::guards];
    CppFunction cpp(code_, f, cached_texts_, arguments_);
    std::string statements;
    for (std::size_t k = 0; k < kinks.size(); ++k) {
        const auto& guards = code_.system.guards;
        const auto found = std::find_if(guards.begin(), guards.end(), [&](const Guard& g) { return g.is_same(kinks[k]); });
        if (found == guards.end()) {
            statements += fmt::format("{}k[{}] = Scalar(1);\n", indent, k);
            continue;
        }
        const NodeId result = f.results[static_cast<std::size_t>(found - guards.begin())];
        statements += cpp.compute({result});
        statements += assigned(cpp, fmt::format("k[{}]", k), result);
    }
    return finish(cpp, std::move(statements), kinks.empty() ? "Kinks& /*k*/" : "Kinks& k", {.everything = f.uses_accelerations});
}

}  // namespace dalembert
