// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of functions that compute Taylor series.
#include <fmt/format.h>

#include "emit/cpp_bodies.hpp"
#include "emit/cpp_series.hpp"
#include "cpp/helpers.hpp"
#include "graph/lower.hpp"

namespace dalembert {

namespace {

const std::set<std::string> names_in_series{"x", "u", "t", "k", "s", "row", "rows", "order", "inputs", "next_inputs", "u_now", "by_k", "by_next", "number", "solved", "mass", "p_", "c_", "detail", "Scalar", "State", "Input"};

/// What stands before the statements of order k.
std::string begin_of_order(const CppSeries& series, const std::string& blanks) {
    std::string text;
    if (series.uses_number()) text += blanks + "const Scalar number = Scalar(k);\n";
    if (series.rows() == 0) return text;
    text += fmt::format("{0}std::array<Scalar, {1}> s;\n{0}detail::series_sums<Scalar, {1}>(rows, k, s.data());\n{0}Scalar* const row = rows + {2} * k;\n", blanks, series.rows(), 2 * series.rows());
    return text;
}

}  // namespace

CppBody CppBodies::series() {
    SeriesCode made = make_series(code_.atoms, *code_.series_of, code_.system.unknown_places());
    const Symbols& symbols = code_.system.symbols;
    std::set<std::string> arguments = arguments_;
    arguments.insert(names_in_series.begin(), names_in_series.end());
    const FunctionCode f = made.function;
    CppSeries::Use use;
    use.bind = [&](CppFunction& cpp) {
        cpp.bind_state(Value::element(Value::name("x"), 0));
        cpp.bind_accelerations(Value::element(Value::name("x"), 1), velocities_);
        for (std::size_t j = 0; !f.by_loops && j < n_; ++j) cpp.name_node(f.accelerations[j], cpp_name(symbols.all(SymbolKind::acceleration)[j]));
        if (!f.by_loops) name_multipliers(cpp, f.accelerations);
    };
    const std::string blanks = std::string(indent) + "    ";
    use.assign = [&](CppSeries& series) {
        std::string text;
        const auto set = [&](std::size_t place, NodeId id) {
            const std::string now = series.now(id, 2);
            text += wrapped(fmt::format("x[k + 1][{}] = {};", place, now.empty() ? "Scalar(0)" : now + " * by_next"), 12);
        };
        for (std::size_t j = 0; j < n_; ++j)
            if (symbols.has_value(j)) text += fmt::format("{}x[k + 1][{}] = x[k][{}] * by_next;\n", blanks, symbols.place(SymbolKind::coordinate, j), velocities_ + j);
        for (std::size_t j = 0; j < n_; ++j) set(velocities_ + j, f.accelerations[j]);
        for (std::size_t i = 0; i < m_; ++i) set(states_ + i, f.results[i]);
        const std::string power = series.now(f.results[m_], 2);
        text += wrapped(fmt::format("if constexpr (std::tuple_size<StateOrMore>::value > state_count) x[k + 1][state_count] = {};", power.empty() ? "Scalar(0)" : power + " * by_next"), 12);
        return text;
    };
    CppSeries series(code_, std::move(made), cached_values_, arguments, use);
    const auto first_order = [](std::size_t place) { return Value::element(Value::element(Value::name("x"), 1), place); };
    std::string statements = series.start([&](CppFunction& cpp) {
        if (!f.by_loops) return cpp_text(cpp.compute(f.accelerations));
        std::vector<NodeId> first = f.mass;
        first.insert(first.end(), f.force.begin(), f.force.end());
        Statements solve = cpp.compute(first);
        append(solve, factored_mass(cpp, f));
        for (std::size_t j = 0; j < n_; ++j) append(solve, assigned(cpp, first_order(velocities_ + j), f.force[j]));
        helpers_.insert("ldlt");
        append(solve, solved(Value::part_from(Value::element(Value::name("x"), 1), velocities_)));
        return cpp_text(solve);
    });
    CppFunction& cpp = series.code_at_start();
    for (std::size_t j = 0; j < n_; ++j)
        if (symbols.has_value(j)) statements += fmt::format("{}x[1][{}] = x[0][{}];\n", indent, symbols.place(SymbolKind::coordinate, j), velocities_ + j);
    for (std::size_t j = 0; !f.by_loops && j < n_; ++j) statements += cpp_text(assigned(cpp, first_order(velocities_ + j), f.accelerations[j]));
    for (std::size_t i = 0; i < m_; ++i) statements += cpp_text(assigned(cpp, first_order(states_ + i), f.results[i]));
    statements += cpp_text(assigned(cpp, Value::name("if constexpr (std::tuple_size<StateOrMore>::value > state_count) x[1][state_count]"), f.results[m_]));
    const std::string step = series.step();
    const bool by_k = step.find("by_k") != std::string::npos;
    if (by_k) statements += std::string(indent) + "Scalar by_k(1);\n";
    statements += fmt::format("{}for (std::size_t k = 1; k < order; ++k) {{\n", indent);
    if (by_k || step.find("by_next") != std::string::npos) statements += blanks + "const Scalar by_next = Scalar(1) / Scalar(k + 1);\n";
    const bool uses_inputs = cpp.uses_input();
    if (uses_inputs) statements += blanks + "const Input u_now = next_inputs(k);\n";
    statements += begin_of_order(series, blanks) + step;
    if (by_k) statements += blanks + "by_k = by_next;\n";
    statements += std::string(indent) + "}\n";
    std::string head = scope(cpp.called());
    if (uses_inputs) head += fmt::format("{0}Input u{{}};\n{0}const auto next_inputs = inputs.series(x, t, u, rows + 2 * series_rows * order);\n", indent);
    if (series.rows() > 0) helpers_.insert("series_sums");
    series_rows_ = series.rows();
    CppBody body;
    body.arguments = argument("const Inputs&", "inputs", uses_inputs) + ", " + argument("Scalar", "t", uses_inputs || cpp.uses_time()) + ", std::size_t order, StateOrMore* x, " + argument("Scalar*", "rows", uses_inputs || series.rows() > 0);
    body.statements = head + statements;
    return body;
}

namespace {

SeriesCode series_of(Code& code, const std::vector<GiNaC::ex>& inputs) {
    std::vector<Polynomial> polynomials;
    for (const GiNaC::ex& input : inputs) polynomials.push_back(lower(code.system.symbols.without_definitions(input), code.atoms));
    FunctionCode f;
    ProgramBuilder builder(code.atoms, code.cache, ParameterParts::in_place, f.program, code.passes);
    builder.prepare(polynomials);
    for (std::size_t i = 0; i < polynomials.size(); ++i) f.results.push_back(builder.root(i));
    return make_series(code.atoms, f, {});
}

}  // namespace

bool have_series(Code& code, const std::vector<GiNaC::ex>& inputs) { return !series_of(code, inputs).missing; }

InputSeries input_series(Code& code, const std::vector<GiNaC::ex>& inputs) {
    SeriesCode made = series_of(code, inputs);
    if (made.missing)
        throw Failure(Diagnostic{Id::no_series, {}, fmt::format("the input '{}' contains '{}', of which no Taylor series is known; another method does without", code.system.symbols.all(SymbolKind::input)[made.missing->index].name, name_of(made.missing->op))});
    const FunctionCode results = made.function;
    CppSeries::Use use;
    use.bind = [](CppFunction& cpp) { cpp.bind_state(Value::element(Value::name("x"), 0)); };
    use.assign = [&](CppSeries& series) {
        std::string text;
        for (std::size_t i = 0; i < results.results.size(); ++i)
            if (const std::string now = series.now(results.results[i]); !now.empty()) text += wrapped(fmt::format("u_now[{}] = {};", i, now), 12);
        return text;
    };
    const CachedValues none;
    CppSeries series(code, std::move(made), none, names_in_series, use);
    std::string statements = series.start([](CppFunction&) { return std::string(); });
    CppFunction& cpp = series.code_at_start();
    for (std::size_t i = 0; i < results.results.size(); ++i) {
        if (results.is_zero(results.results[i])) continue;
        Statements before;
        const Value value = cpp.value(results.results[i], before);
        statements += cpp_text(before) + fmt::format("        u[{}] = {};\n", i, cpp_text(value));
    }
    const std::string step = series.step();
    std::string head;
    for (const std::string& name : cpp.called())
        if (!is_helper(name)) head += fmt::format("        using std::{};\n", name);
    std::string inner;
    if (step.find("by_k") != std::string::npos) inner += "            const Scalar by_k = Scalar(1) / Scalar(k);\n";
    return {series.rows(), head + statements, inner + begin_of_order(series, std::string(indent) + "    ") + step};
}

}  // namespace dalembert
