// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of functions that compute Taylor series.
#include <fmt/format.h>

#include "program/function_bodies.hpp"
#include "program/series_statements.hpp"
#include "graph/lower.hpp"

namespace dalembert {

namespace {

const std::set<std::string> names_in_series{"x",      "u",           "t",      "k",      "s",       "row",    "rows",   "order",
                                            "inputs", "next_inputs", "u_now",  "by_k",   "by_next", "number", "solved", "mass",
                                            "p_",     "c_",          "detail", "Scalar", "State",   "Input"};

const Value order_k = Value::name("k");
const Value next_order = Value::sum({order_k, Value::whole(1)});

/// Coefficient of this order of a state.
Value coefficient(const Value& order, std::size_t place) { return Value::element(Value::element(Value::name("x"), order), place); }
Value coefficient(std::size_t order, std::size_t place) { return coefficient(Value::whole(order), place); }

/// That of the work on the plant, behind those of its states.
Statement work_coefficient(const Value& order, Value value) {
    const Value target = Value::element(Value::element(Value::name("x"), order), Value::interface_size("state_count"));
    return IfRoomForWork{{Assignment{target, std::move(value)}}};
}

/// z_(k+1) from the coefficient of its rate.
Value integrated(const Value& rate) {
    return rate.kind() == Value::Kind::none ? Value::constant(0) : Value::product({rate, Value::name("by_next")});
}

Value inverse_of(const Value& index) { return Value::product({Value::literal(1)}, {Value::real(index)}); }

/// What stands before the statements of order k.
Statements begin_of_order(const SeriesStatements& series) {
    Statements statements;
    if (series.uses_number()) statements.push_back(Declaration{{}, {"number"}, Value::real(order_k)});
    const std::size_t rows = series.rows();
    if (rows == 0) return statements;
    statements.push_back(Declaration{{Storage::Kind::array, {rows}}, {"s"}});
    const Value all_rows = Value::name("rows");
    statements.push_back(
        Invocation{Value::call(Value::Where::helper, "series_sums", {all_rows, order_k, Value::whole_array("s")}, {rows})});
    statements.push_back(
        Declaration{{Storage::Kind::room}, {"row"}, Value::room_from(all_rows, Value::product({Value::whole(2 * rows), order_k}))});
    return statements;
}

}  // namespace

/// Coefficients of order k + 1 of all states, from those of order k of their rates.
Statements FunctionBodies::integrated_rates(SeriesStatements& series, const FunctionCode& f) const {
    const Symbols& symbols = code_.system.symbols;
    Statements statements;
    const auto set = [&](std::size_t place, const Value& rate) {
        statements.push_back(Assignment{coefficient(next_order, place), integrated(rate)});
    };
    for (std::size_t j = 0; j < n_; ++j)
        if (symbols.has_value(j)) set(symbols.place(SymbolKind::coordinate, j), coefficient(order_k, velocities_ + j));
    for (std::size_t j = 0; j < n_; ++j) set(velocities_ + j, series.now(f.accelerations[j]));
    for (std::size_t i = 0; i < m_; ++i) set(states_ + i, series.now(f.results[i]));
    statements.push_back(work_coefficient(next_order, integrated(series.now(f.results[m_]))));
    return statements;
}

/// Accelerations by loops, where they stand in the first coefficients.
Statements FunctionBodies::solved_at_start(StatementMaker& maker, const FunctionCode& f) {
    if (!f.by_loops) return maker.compute(f.accelerations);
    std::vector<NodeId> first = f.mass;
    first.insert(first.end(), f.force.begin(), f.force.end());
    Statements statements = maker.compute(first);
    append(statements, factored_mass(maker, f));
    for (std::size_t j = 0; j < n_; ++j) append(statements, assigned(maker, coefficient(1, velocities_ + j), f.force[j]));
    helpers_.insert("ldlt");
    append(statements, solved(Value::part_from(Value::element(Value::name("x"), 1), velocities_)));
    return statements;
}

/// First coefficients of what was computed.
Statements FunctionBodies::rates_at_start(StatementMaker& maker, const FunctionCode& f) {
    const Symbols& symbols = code_.system.symbols;
    Statements statements;
    for (std::size_t j = 0; j < n_; ++j)
        if (symbols.has_value(j))
            statements.push_back(Assignment{coefficient(1, symbols.place(SymbolKind::coordinate, j)), coefficient(0, velocities_ + j)});
    for (std::size_t j = 0; !f.by_loops && j < n_; ++j)
        append(statements, assigned(maker, coefficient(1, velocities_ + j), f.accelerations[j]));
    for (std::size_t i = 0; i < m_; ++i) append(statements, assigned(maker, coefficient(1, states_ + i), f.results[i]));
    Value power = maker.value(f.results[m_], statements);
    statements.push_back(work_coefficient(Value::whole(1), std::move(power)));
    return statements;
}

/// Order by order: `step` is what one of them computes.
Statements FunctionBodies::loop_over_orders(const SeriesStatements& series, Statements step, bool uses_inputs) {
    const bool by_k = mentions(step, "by_k");
    Statements statements, body;
    if (by_k) statements.push_back(Declaration{.type = {}, .names = {"by_k"}, .value = Value::literal(1), .changes = true});
    if (by_k || mentions(step, "by_next")) body.push_back(Declaration{{}, {"by_next"}, inverse_of(next_order)});
    if (uses_inputs) body.push_back(NextInputs{"u_now", order_k});
    append(body, begin_of_order(series));
    append(body, std::move(step));
    if (by_k) body.push_back(Assignment{Value::name("by_k"), Value::name("by_next")});
    statements.push_back(Loop{"k", 1, Value::name("order"), std::move(body)});
    return statements;
}

FunctionBody FunctionBodies::series() {
    SeriesCode made = make_series(code_.atoms, *code_.series_of, code_.system.unknown_places());
    std::set<std::string> arguments = arguments_;
    arguments.insert(names_in_series.begin(), names_in_series.end());
    const FunctionCode f = made.function;
    SeriesStatements::Use use;
    use.bind = [&](StatementMaker& maker) {
        maker.bind_state(Value::element(Value::name("x"), 0));
        maker.bind_accelerations(Value::element(Value::name("x"), 1), velocities_);
        if (f.by_loops) return;
        for (std::size_t j = 0; j < n_; ++j)
            maker.name_node(f.accelerations[j], identifier(code_.system.symbols.all(SymbolKind::acceleration)[j]));
        name_multipliers(maker, f.accelerations);
    };
    use.assign = [&](SeriesStatements& series) { return integrated_rates(series, f); };
    SeriesStatements series(code_, std::move(made), cached_values_, arguments, use);
    Statements at_start = series.start([&](StatementMaker& maker) { return solved_at_start(maker, f); });
    StatementMaker& maker = series.code_at_start();
    append(at_start, rates_at_start(maker, f));
    const bool uses_inputs = maker.uses_input();
    append(at_start, loop_over_orders(series, series.step(), uses_inputs));
    Statements statements;
    if (uses_inputs) {
        const Value first =
            Value::product({Value::whole(2), Value::interface_size("series_rows"), Value::name("order")});  // behind those of the plant
        statements.push_back(FirstInputs{Value::name("x"), Value::name("t"), "u", Value::room_from(Value::name("rows"), first)});
    }
    append(statements, std::move(at_start));
    helpers_.insert(maker.helpers().begin(), maker.helpers().end());
    if (series.rows() > 0) helpers_.insert("series_sums");
    series_rows_ = series.rows();
    using enum Argument::Passing;
    return {{{"Inputs", "inputs", read, uses_inputs},
             {"Scalar", "t", value, uses_inputs || maker.uses_time()},
             {"Index", "order", value},
             {"StateOrMore", "x", room},
             {"Scalar", "rows", room, uses_inputs || series.rows() > 0}},
            std::move(statements)};
}

namespace {

SeriesCode series_of(Code& code, const std::vector<GiNaC::ex>& inputs) {
    std::vector<GiNaC::ex> written;
    for (const GiNaC::ex& input : inputs) written.push_back(code.system.symbols.without_definitions(input));
    const std::vector<Polynomial> polynomials = lower_in_order(written, code.atoms);
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
        throw Failure(
            Diagnostic{Id::no_series,
                       {},
                       fmt::format("the input '{}' contains '{}', of which no Taylor series is known; another method does without",
                                   code.system.symbols.all(SymbolKind::input)[made.missing->index].name, name_of(made.missing->op))});
    const FunctionCode results = made.function;
    SeriesStatements::Use use;
    use.bind = [](StatementMaker& maker) { maker.bind_state(Value::element(Value::name("x"), 0)); };
    use.assign = [&](SeriesStatements& series) {
        Statements statements;
        for (std::size_t i = 0; i < results.results.size(); ++i) {
            const Value now = series.now(results.results[i]);
            if (now.kind() != Value::Kind::none) statements.push_back(Assignment{Value::element(Value::name("u_now"), i), now});
        }
        return statements;
    };
    const CachedValues none;
    SeriesStatements series(code, std::move(made), none, names_in_series, use);
    Statements start = series.start([](StatementMaker&) { return Statements(); });
    StatementMaker& maker = series.code_at_start();
    for (std::size_t i = 0; i < results.results.size(); ++i) {
        if (results.is_zero(results.results[i])) continue;
        const Value value = maker.value(results.results[i], start);
        start.push_back(Assignment{Value::element(Value::name("u"), i), value});
    }
    Statements step = series.step(), order;
    if (mentions(step, "by_k")) order.push_back(Declaration{{}, {"by_k"}, inverse_of(order_k)});
    append(order, begin_of_order(series));
    append(order, std::move(step));
    return {series.rows(), std::move(start), std::move(order)};
}

}  // namespace dalembert
