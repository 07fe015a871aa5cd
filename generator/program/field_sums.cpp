// SPDX-License-Identifier: GPL-3.0-or-later
// Outputs that contain sums over cells.
#include <fmt/format.h>

#include "program/field_bodies.hpp"
#include "program/field_values.hpp"

namespace dalembert {

using namespace field_values;

namespace {

Value of_column(const Value& column, std::size_t output) { return Value::sum({column, Value::whole(output)}); }

}  // namespace

std::string FieldBodies::sum_name(std::size_t i) { return fmt::format("sum_{}", i + 1); }

Statements FieldBodies::sums() {
    Statements statements;
    for (std::size_t i = 0; i < code_.sums.size(); ++i)
        statements.push_back(over(system_.cell_sums[i].field, system_.cell_sums[i].cells, code_.sums[i].term, [&](Results v) {
            return Statements{Assignment{entry("sums", Value::whole(i)), v[0], Assignment::Operation::add}};
        }));
    return statements;
}

/// Adds the slope of a sum, times those of the outputs by it, to a column of C or D, which begins at `column`.
Statements FieldBodies::added_slope(std::size_t i, const FunctionCode& f, const char* array, const Value& column) {
    if (f.is_zero(f.results[0])) return {};
    const SumOutputs& outputs = code_.outputs;
    return {over(system_.cell_sums[i].field, system_.cell_sums[i].cells, f, [&](Results v) {
        Statements added{Declaration{{}, {"slope"}, v[0]}};
        for (std::size_t o = 0; o < outputs.outputs.size(); ++o) {
            if (outputs.by_sum.is_zero(outputs.by_sum.results[i * outputs.outputs.size() + o])) continue;
            const Value more = Value::product({of_matrix("by_sums", i, outputs.outputs[o]), Value::name("slope")});
            added.push_back(Assignment{entry(array, of_column(column, outputs.outputs[o])), more, Assignment::Operation::add});
        }
        return added;
    })};
}

Statements FieldBodies::sum_slopes() {
    Statements statements;
    for (std::size_t i = 0; i < code_.sums.size(); ++i) {
        const Value cell = Value::parenthesised(cell_place(system_.cell_sums[i].field));
        append(statements, added_slope(i, code_.sums[i].slope, "C", Value::product({Value::whole(system_.outputs.size()), cell})));
    }
    return statements;
}

Statements FieldBodies::sum_slopes_by_inputs() {
    Statements statements;
    for (std::size_t i = 0; i < code_.sums.size(); ++i)
        for (const auto& [input, function] : code_.sums[i].by_input)
            append(statements, added_slope(i, function, "D", Value::whole(system_.outputs.size() * input)));
    return statements;
}

/// Results stand column by column, one of each output with sums; `target` says where they go.
Statements FieldBodies::of_outputs(const FunctionCode& f, const std::function<Value(std::size_t column, std::size_t output)>& target) {
    const std::vector<std::size_t>& outputs = code_.outputs.outputs;
    Statements statements = computed(f, [&](Results v) {
        Statements stored;
        for (std::size_t n = 0; n < v.size(); ++n)
            if (!f.is_zero(f.results[n])) stored.push_back(Assignment{target(n / outputs.size(), outputs[n % outputs.size()]), v[n]});
        return stored;
    });
    Statements named;
    for (std::size_t i = 0; i < code_.sums.size(); ++i)
        if (mentions(statements, sum_name(i))) named.push_back(Declaration{{}, {sum_name(i)}, entry("sums", Value::whole(i))});
    append(named, std::move(statements));
    return named;
}

/// The entry of a matrix with a row for each output.
Value FieldBodies::of_matrix(const char* array, std::size_t column, std::size_t output) const {
    return entry(array, Value::whole(system_.outputs.size() * column + output));
}

Statements FieldBodies::output_values() {
    return of_outputs(code_.outputs.values, [](std::size_t, std::size_t output) { return entry("y", Value::whole(output)); });
}

Statements FieldBodies::output_by_state() {
    return of_outputs(code_.outputs.by_state,
                      [this](std::size_t column, std::size_t output) { return of_matrix("C", places_.positions[column], output); });
}

Statements FieldBodies::output_by_input() {
    return of_outputs(code_.outputs.by_input, [this](std::size_t column, std::size_t output) { return of_matrix("D", column, output); });
}

Statements FieldBodies::output_by_sum() {
    return of_outputs(code_.outputs.by_sum,
                      [this](std::size_t column, std::size_t output) { return of_matrix("by_sums", column, output); });
}

}  // namespace dalembert
