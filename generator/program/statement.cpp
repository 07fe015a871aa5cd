// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/statement.hpp"

namespace dalembert {

struct Value::Content {
    Kind kind = Kind::none;
    unsigned long number = 0;
    Rational exact = 0;
    Object object = Object::parameters;
    Where where = Where::library;
    std::string text = {};
    std::vector<Value> parts = {};
    std::vector<bool> negative = {};
    std::size_t factors = 0;
    std::vector<std::size_t> sizes = {};
    Comparison comparison = Comparison::equal;
    friend bool operator==(const Content&, const Content&) = default;
};

Value::Value(Content content) : content_(std::make_shared<const Content>(std::move(content))) {}

Value Value::with_parts(Kind kind, std::vector<Value> parts) { return Value({.kind = kind, .parts = std::move(parts)}); }
Value Value::literal(unsigned long number) { return Value({.kind = Kind::literal, .number = number}); }
Value Value::constant(const Rational& exact) { return Value({.kind = Kind::constant, .exact = exact}); }
Value Value::pi() { return Value({.kind = Kind::pi}); }
Value Value::whole(std::size_t number) { return Value({.kind = Kind::whole, .number = number}); }
Value Value::name(std::string text) { return Value({.kind = Kind::name, .text = std::move(text)}); }
Value Value::whole_array(std::string name) { return Value({.kind = Kind::whole_array, .text = std::move(name)}); }
Value Value::curve(std::string name) { return Value({.kind = Kind::curve, .text = std::move(name)}); }
Value Value::event(std::string name) { return Value({.kind = Kind::event, .text = std::move(name)}); }
Value Value::interface_size(std::string name) { return Value({.kind = Kind::interface_size, .text = std::move(name)}); }
Value Value::member(Object object, std::string text) { return Value({.kind = Kind::member, .object = object, .text = std::move(text)}); }
Value Value::element(Value array, Value index) { return with_parts(Kind::element, {std::move(array), std::move(index)}); }
Value Value::part_from(Value array, std::size_t first) { return with_parts(Kind::part_from, {std::move(array), whole(first)}); }
Value Value::room_from(Value array, Value first) { return with_parts(Kind::room_from, {std::move(array), std::move(first)}); }
Value Value::real(Value index) { return with_parts(Kind::real, {std::move(index)}); }
Value Value::signed_index(Value index) { return with_parts(Kind::signed_index, {std::move(index)}); }
Value Value::list(std::vector<Value> parts) { return with_parts(Kind::list, std::move(parts)); }
Value Value::parenthesised(Value value) { return with_parts(Kind::parenthesised, {std::move(value)}); }
Value Value::all_of(std::vector<Value> conditions) { return with_parts(Kind::all_of, std::move(conditions)); }

Value Value::choice(Value condition, Value then, Value otherwise) {
    return with_parts(Kind::choice, {std::move(condition), std::move(then), std::move(otherwise)});
}
Value Value::comparison(Comparison holds, Value a, Value b) {
    return Value({.kind = Kind::comparison, .parts = {std::move(a), std::move(b)}, .comparison = holds});
}

Value Value::sum(std::vector<Value> terms, std::vector<bool> negative) {
    negative.resize(terms.size());
    return Value({.kind = Kind::sum, .parts = std::move(terms), .negative = std::move(negative)});
}

Value Value::product(std::vector<Value> factors, std::vector<Value> divisors) {
    const std::size_t count = factors.size();
    factors.insert(factors.end(), divisors.begin(), divisors.end());
    return Value({.kind = Kind::product, .parts = std::move(factors), .factors = count});
}

Value Value::call(Where where, std::string function, std::vector<Value> arguments, std::vector<std::size_t> sizes) {
    return Value(
        {.kind = Kind::call, .where = where, .text = std::move(function), .parts = std::move(arguments), .sizes = std::move(sizes)});
}

Value::Kind Value::kind() const { return content_ ? content_->kind : Kind::none; }
unsigned long Value::number() const { return content_->number; }
const Rational& Value::exact() const { return content_->exact; }
Value::Object Value::object() const { return content_->object; }
Value::Where Value::where() const { return content_->where; }
const std::string& Value::text() const { return content_->text; }
const std::vector<Value>& Value::parts() const { return content_->parts; }
const std::vector<bool>& Value::negative() const { return content_->negative; }
std::size_t Value::factors() const { return content_->factors; }
const std::vector<std::size_t>& Value::sizes() const { return content_->sizes; }
Value::Comparison Value::comparison() const { return content_->comparison; }

bool operator==(const Value& a, const Value& b) {
    if (a.content_ == b.content_) return true;
    return a.content_ && b.content_ && *a.content_ == *b.content_;
}

namespace {

/// Whole numbers of any size from literals.
Value chunks(const cln::cl_I& value) {
    const cln::cl_I base = 1'000'000'000;
    if (value < base) return Value::literal(cln::cl_I_to_ulong(value));
    const cln::cl_I high = cln::floor1(value, base);
    const cln::cl_I low = value - high * base;
    const Value above = high < base ? chunks(high) : Value::parenthesised(chunks(high));
    const Value product = Value::product({above, Value::literal(1'000'000'000)});
    return cln::zerop(low) ? product : Value::sum({product, Value::literal(cln::cl_I_to_ulong(low))});
}

/// A number to 45 digits, in groups of nine.
Value to_45_digits(const Rational& value) {
    const cln::cl_I base = 1'000'000'000;
    cln::cl_RA rest = cln::abs(value);
    int groups = 0;
    for (; rest >= base; ++groups) rest = rest / base;
    for (; rest < 1; --groups) rest = rest * base;
    std::vector<Value> parts;
    for (int i = 0; i < 5; ++i) {
        const cln::cl_I part = cln::floor1(rest);
        parts.push_back(Value::literal(cln::cl_I_to_ulong(part)));
        rest = (rest - part) * base;
    }
    const Value group = Value::literal(1'000'000'000);
    Value sum = parts.back();
    for (std::size_t i = parts.size() - 1; i-- > 0;) sum = Value::parenthesised(Value::sum({parts[i], Value::product({sum}, {group})}));
    std::vector<Value> factors{sum}, divisors;
    for (int i = 0; i < groups; ++i) factors.push_back(group);
    for (int i = 0; i > groups; --i) divisors.push_back(group);
    return factors.size() == 1 && divisors.empty() ? sum : Value::product(factors, divisors);
}

}  // namespace

Value written_out(const Rational& exact) {
    constexpr std::size_t most_bits = 100;  // what float holds
    Value size;
    if (bit_length(exact) > most_bits) {
        size = to_45_digits(exact);
    } else {
        const auto whole = [](const cln::cl_I& v) {
            const Value written = chunks(v);
            return written.kind() == Value::Kind::literal ? written : Value::parenthesised(written);
        };
        size = whole(cln::abs(cln::numerator(exact)));
        if (!is_integer(exact)) size = Value::product({size}, {whole(cln::denominator(exact))});
    }
    return is_negative(exact) ? Value::sum({size}, {true}) : size;
}

int precedence(const Value& value) {
    switch (value.kind()) {
        case Value::Kind::sum: return 1;
        case Value::Kind::product: return 2;
        case Value::Kind::constant: return written_out(value.exact()).kind() == Value::Kind::literal ? 3 : 1;
        default: return 3;
    }
}

namespace {

std::size_t width_within(const Value& value, int least_precedence) { return width(value) + (precedence(value) < least_precedence ? 2 : 0); }

std::size_t width_of_list(const std::vector<Value>& parts) {
    std::size_t sum = parts.empty() ? 0 : 2 * (parts.size() - 1);
    for (const Value& part : parts) sum += width(part);
    return sum;
}

std::size_t width_of_call(const Value& call) {
    const std::size_t arguments = width_of_list(call.parts()) + 2;
    if (call.where() != Value::Where::helper) return call.text().size() + arguments;
    std::size_t sizes = 0;
    for (const std::size_t size : call.sizes()) sizes += 2 + std::to_string(size).size();
    return std::string("detail::<Scalar>").size() + call.text().size() + sizes + arguments;
}

std::size_t width_of_operations(const Value& value) {
    const std::vector<Value>& parts = value.parts();
    const bool is_sum = value.kind() == Value::Kind::sum;
    std::size_t sum = !is_sum && value.factors() == 0 ? std::string("Scalar(1)").size() + 3 : 0;
    if (!parts.empty()) sum += 3 * (parts.size() - 1);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (is_sum) sum += width_within(parts[i], i == 0 && !value.negative()[i] ? 1 : 2) + (i == 0 && value.negative()[i] ? 1 : 0);
        else sum += width_within(parts[i], i == 0 && value.factors() > 0 ? 2 : 3);
    }
    return sum;
}

}  // namespace

std::size_t width(const Value& value) {
    switch (value.kind()) {
        case Value::Kind::none: return 0;
        case Value::Kind::literal: return std::string("Scalar()").size() + std::to_string(value.number()).size();
        case Value::Kind::constant: return width(written_out(value.exact()));
        case Value::Kind::pi: return std::string("detail::pi<Scalar>()").size();
        case Value::Kind::whole: return std::to_string(value.number()).size();
        case Value::Kind::name:
        case Value::Kind::interface_size: return value.text().size();
        case Value::Kind::member: return (value.object() == Value::Object::energies ? 9 : 3) + value.text().size();
        case Value::Kind::element: return width(value.parts()[0]) + width(value.parts()[1]) + 2;
        case Value::Kind::whole_array: return value.text().size() + std::string(".data()").size();
        case Value::Kind::part_from: return width(value.parts()[0]) + width(value.parts()[1]) + std::string(".data() + ").size();
        case Value::Kind::list:
        case Value::Kind::parenthesised: return width_of_list(value.parts()) + 2;
        case Value::Kind::sum:
        case Value::Kind::product: return width_of_operations(value);
        case Value::Kind::call: return width_of_call(value);
        case Value::Kind::all_of: return value.parts().empty() ? 4 : width_of_list(value.parts()) + 2 * (value.parts().size() - 1);
        case Value::Kind::event: return std::string("event::").size() + value.text().size();
        case Value::Kind::curve: return std::string("detail::<Scalar>").size() + value.text().size();
        case Value::Kind::room_from: return width_of_list(value.parts()) + 1;
        case Value::Kind::real: return std::string("Scalar()").size() + width(value.parts()[0]);
        case Value::Kind::signed_index: return std::string("static_cast<int>()").size() + width(value.parts()[0]);
        case Value::Kind::comparison: return width_of_list(value.parts()) + (value.comparison() == Value::Comparison::equal ? 2 : 1);
        case Value::Kind::choice: return width_of_list(value.parts()) + 2;
    }
    return 0;
}

}  // namespace dalembert
