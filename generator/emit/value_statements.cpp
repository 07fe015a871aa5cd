// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/value_statements.hpp"

#include "graph/lower.hpp"
#include "program/identifiers.hpp"
#include "program/statement_maker.hpp"

namespace dalembert {

Statements value_statements(Code& code, const std::vector<GiNaC::ex>& values, const std::string& target) {
    const Symbols& symbols = code.system.symbols;
    std::vector<GiNaC::ex> written;
    for (const GiNaC::ex& value : values) written.push_back(symbols.without_definitions(value));
    // Steps that are too large to be written out are computed first.
    const std::vector<std::size_t> steps = symbols.steps_in(GiNaC::lst(written.begin(), written.end()));
    std::vector<GiNaC::ex> all;
    std::set<std::string> names{"x", "t", "u", "p_", target};
    const auto name = [&](std::size_t step) { return identifier(symbols.all(SymbolKind::definition)[step]); };
    for (const std::size_t step : steps) {
        all.push_back(symbols.without_model_definitions(symbols.definition_values()[step]));
        names.insert(name(step));
    }
    all.insert(all.end(), written.begin(), written.end());
    const std::vector<Polynomial> polynomials = lower_in_order(all, code.atoms);
    FunctionCode f;
    ProgramBuilder builder(code.atoms, code.cache, ParameterParts::in_place, f.program, code.passes);
    builder.prepare(polynomials);
    for (std::size_t i = 0; i < polynomials.size(); ++i) f.results.push_back(builder.root(i));
    const CachedValues none;
    StatementMaker maker(code, f, none, names);
    maker.bind_locals({steps.begin(), steps.end()});
    Statements statements;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        append(statements, maker.compute({f.results[i]}));
        Value value = maker.value(f.results[i], statements);
        statements.push_back(Declaration{{}, {name(steps[i])}, std::move(value)});
    }
    const std::vector<NodeId> results(f.results.begin() + static_cast<std::ptrdiff_t>(steps.size()), f.results.end());
    append(statements, maker.compute(results));
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (f.is_zero(results[i])) continue;
        const Value value = maker.value(results[i], statements);
        statements.push_back(Assignment{Value::element(Value::name(target), i), value});
    }
    return statements;
}

}  // namespace dalembert
