// SPDX-License-Identifier: GPL-3.0-or-later
// Values and statements that loops over cells k share.
#pragma once

#include "program/statement.hpp"

namespace dalembert::field_values {

using Operation = Assignment::Operation;

inline Value cell() { return Value::name("k"); }

/// The index of cell k in an array where the first cell is at `first`.
inline Value at(std::size_t first) { return first == 0 ? cell() : Value::sum({Value::whole(first), cell()}); }

/// value + number
inline Value behind(Value value, std::size_t number) {
    return number == 0 ? value : Value::sum({std::move(value), Value::whole(number)});
}

inline Value entry(const char* array, Value index) { return Value::element(Value::name(array), std::move(index)); }

inline Statement naming(const char* name, Value value) { return Declaration{{}, {name}, std::move(value)}; }

/// From one cell to the next.
inline Statements moved_heat(const Value& here, const Value& next, const Value& amount) {
    const Value heat = Value::name("heat");
    return {naming("heat", amount), Assignment{here, heat, Operation::subtract}, Assignment{next, heat, Operation::add}};
}

}  // namespace dalembert::field_values
