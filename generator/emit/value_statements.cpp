// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/value_statements.hpp"

#include "graph/lower.hpp"
#include "program/statement_maker.hpp"

namespace dalembert {

Statements value_statements(Code& code, const std::vector<GiNaC::ex>& values, const std::string& target) {
    std::vector<GiNaC::ex> written;
    for (const GiNaC::ex& value : values) written.push_back(code.system.symbols.without_definitions(value));
    const std::vector<Polynomial> polynomials = lower_in_order(written, code.atoms);
    FunctionCode f;
    ProgramBuilder builder(code.atoms, code.cache, ParameterParts::in_place, f.program, code.passes);
    builder.prepare(polynomials);
    for (std::size_t i = 0; i < polynomials.size(); ++i) f.results.push_back(builder.root(i));
    const CachedValues none;
    StatementMaker maker(code, f, none, {"x", "t", "u", "p_", target});
    Statements statements = maker.compute(f.results);
    for (std::size_t i = 0; i < f.results.size(); ++i) {
        if (f.is_zero(f.results[i])) continue;
        const Value value = maker.value(f.results[i], statements);
        statements.push_back(Assignment{Value::element(Value::name(target), i), value});
    }
    return statements;
}

}  // namespace dalembert
