// SPDX-License-Identifier: GPL-3.0-or-later
#include "js/print.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "js/from_c.hpp"
#include "text/safe_text.hpp"
#include "text/wrap.hpp"

namespace dalembert {

namespace {

constexpr std::size_t column_of_code = 8;
const std::string indent_of_code(column_of_code, ' ');

/// A constant is one number here: the nearest double.
int js_precedence(const Value& value) {
    if (value.kind() == Value::Kind::constant) return is_negative(value.exact()) ? 1 : 3;
    return precedence(value);
}

bool is_sine_and_cosine(const Value& call) { return call.text() == "sin_and_cos" || call.text() == "combined_sin_and_cos"; }

}  // namespace

std::string js_number(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    return fmt::format("{}", value);
}

std::string js_string(const std::string& text) {
    std::string result;
    for (const char c : nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace))
        result += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return result;
}

std::string JsPrinter::operand(const Value& value, int least_precedence) {
    return js_precedence(value) < least_precedence ? "(" + text(value) + ")" : text(value);
}

std::string JsPrinter::listed(const std::vector<Value>& parts, const char* between) {
    std::string result;
    for (const Value& part : parts) result += (result.empty() ? "" : between) + text(part);
    return result;
}

std::string JsPrinter::sum(const Value& value) {
    std::string result;
    for (std::size_t i = 0; i < value.parts().size(); ++i) {
        const bool negative = value.negative()[i];
        const std::string term = operand(value.parts()[i], i == 0 && !negative ? 1 : 2);
        result += i == 0 ? (negative ? "-" : "") + term : (negative ? " - " : " + ") + term;
    }
    return result;
}

std::string JsPrinter::product(const Value& value) {
    std::string result = value.factors() == 0 ? "1" : "";
    for (std::size_t i = 0; i < value.parts().size(); ++i)
        result += result.empty() ? operand(value.parts()[i], 2) : (i < value.factors() ? " * " : " / ") + operand(value.parts()[i], 3);
    return result;
}

std::string JsPrinter::call(const Value& value) {
    std::string function = value.text();
    std::vector<std::string> arguments;
    for (const Value& part : value.parts()) arguments.push_back(text(part));
    if (value.where() == Value::Where::plant) return fmt::format("${}({})", function, fmt::join(arguments, ", "));
    if (value.where() == Value::Where::library) return fmt::format("Math.{}({})", function, fmt::join(arguments, ", "));
    if (function == "combined_sin" || function == "combined_cos")  // these differ in float alone
        return fmt::format("Math.{}({})", function.substr(std::string("combined_").size()), arguments.at(0));
    if (function == "compression" && arguments.size() == 2) function = "compression_by_decay";
    if (function == "ldlt_solve_columns") arguments.push_back(arguments.back() + ".length");
    const CHelper helper{function, value.sizes().empty() ? 0 : value.sizes()[0]};
    called_.insert(helper);
    return fmt::format("{}({})", js_name(helper), fmt::join(arguments, ", "));
}

std::string JsPrinter::comparison(const Value& value) {
    static constexpr const char* signs[]{" === ", " < ", " > "};
    return listed(value.parts(), signs[static_cast<std::size_t>(value.comparison())]);
}

std::size_t JsPrinter::mode_number(const std::string& mode) const {
    const std::vector<std::string>& all = plant_.modes.value().modes;
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), mode) - all.begin());
}

std::size_t JsPrinter::event_number(const std::string& event) const {
    const std::vector<PlantEvent>& all = plant_.modes.value().events;
    return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), [&](const PlantEvent& e) { return e.identifier == event; }) -
                                    all.begin());
}

std::string JsPrinter::text(const Value& value) {
    switch (value.kind()) {
        case Value::Kind::none:
            return {};
        case Value::Kind::literal:
            return fmt::format("{}", value.number());
        case Value::Kind::constant:
            return js_number(cln::double_approx(value.exact()));
        case Value::Kind::pi:
            return "Math.PI";
        case Value::Kind::whole:
            return std::to_string(value.number());
        case Value::Kind::whole_array:
        case Value::Kind::name:
            return javascript_name(value.text());
        case Value::Kind::member: {
            static constexpr const char* objects[]{"$p.", "$c.", "energies."};
            return objects[static_cast<std::size_t>(value.object())] + value.text();
        }
        case Value::Kind::element:
            return text(value.parts()[0]) + "[" + text(value.parts()[1]) + "]";
        case Value::Kind::room_from:
        case Value::Kind::part_from:
            return fmt::format("{}.subarray({})", text(value.parts()[0]), text(value.parts()[1]));
        case Value::Kind::list:
            return "Float64Array.of(" + listed(value.parts(), ", ") + ")";
        case Value::Kind::sum:
            return sum(value);
        case Value::Kind::product:
            return product(value);
        case Value::Kind::parenthesised:
            return "(" + text(value.parts()[0]) + ")";
        case Value::Kind::call:
            return call(value);
        case Value::Kind::all_of:
            return value.parts().empty() ? "true" : listed(value.parts(), " && ");
        case Value::Kind::event:
            return std::to_string(event_number(value.text()));
        case Value::Kind::interface_size:
            throw std::logic_error("series in JavaScript");
        case Value::Kind::signed_index:
        case Value::Kind::real:
            return "(" + text(value.parts()[0]) + ")";
        case Value::Kind::comparison:
            return comparison(value);
        case Value::Kind::curve:
            return fmt::format("${}", value.text());
        case Value::Kind::choice:
            return fmt::format("{} ? {} : {}", text(value.parts()[0]), text(value.parts()[1]), text(value.parts()[2]));
    }
    return {};
}

std::string JsPrinter::curves(const std::vector<PlantCurve>& curves) {
    std::string result;
    for (const PlantCurve& curve : curves) {
        result += fmt::format("    /// {}\n    const ${} = Float64Array.of(\n", curve.header(), curve.table);
        for (const std::vector<Value>& row : curve.rows) {
            std::vector<std::string> numbers;
            for (const Value& value : row) numbers.push_back(text(value));
            result += wrapped_list(numbers, 8) + (&row == &curve.rows.back() ? ");\n\n" : ",\n");
        }
    }
    return result;
}

std::string JsPrinter::declaration(const Declaration& d) {
    std::vector<std::string> names;
    for (const std::string& name : d.names) names.push_back(javascript_name(name));
    const std::string all = fmt::format("{}", fmt::join(names, ", "));
    switch (d.type.kind) {
        case Storage::Kind::scalar:
            return d.value.kind() == Value::Kind::none ? fmt::format("let {};", all)
                                                       : fmt::format("{} {} = {};", d.changes ? "let" : "const", all, text(d.value));
        case Storage::Kind::room:
        case Storage::Kind::index:
            return fmt::format("const {} = {};", all, text(d.value));
        case Storage::Kind::indices:
            return fmt::format("const {} = [{}];", all, fmt::join(d.numbers, ", "));
        case Storage::Kind::vector:
            return fmt::format("const {} = new Float64Array({});", all, size_of(plant_, d.type.name));
        case Storage::Kind::array:
        case Storage::Kind::table:
            break;
    }
    if (d.type.sizes.size() == 1) return fmt::format("const {} = new Float64Array({});", all, d.type.sizes[0]);
    return fmt::format("const {} = Array.from({{ length: {} }}, () => new Float64Array({}));", all, d.type.sizes[0], d.type.sizes[1]);
}

/// An array that a function of the runtime makes of a list.
std::string JsPrinter::filled_by_call(const Declaration& d) {
    const CHelper helper{d.value.text(), d.value.sizes()[0]};
    called_.insert(helper);
    const std::string name = javascript_name(d.names[0]);
    return wrapped(fmt::format("const {} = new Float64Array({});", name, d.type.sizes[0]), column_of_code) +
           wrapped(fmt::format("{}({}, {});", js_name(helper), text(d.value.parts()[0]), name), column_of_code);
}

std::string JsPrinter::invocation(const Value& value) {
    if (value.kind() != Value::Kind::call || !is_sine_and_cosine(value)) return wrapped(text(value) + ";", column_of_code);
    const std::string angle = text(value.parts()[0]);
    return wrapped(fmt::format("{} = Math.sin({});", text(value.parts()[1]), angle), column_of_code) +
           wrapped(fmt::format("{} = Math.cos({});", text(value.parts()[2]), angle), column_of_code);
}

std::string JsPrinter::assignment(const Assignment& a) {
    static constexpr const char* operations[]{"=", "+=", "-=", "*="};
    return fmt::format("{} {} {};", text(a.target), operations[static_cast<std::size_t>(a.operation)], text(a.value));
}

std::string JsPrinter::braced(const std::string& head, const Statements& body) {
    return indent_of_code + head + "{\n" + shifted(text(body)) + indent_of_code + "}\n";
}

std::string JsPrinter::modes(const ByMode& by_mode) {
    std::string result = indent_of_code + "switch (mode) {\n";
    for (const ByMode::Case& one : by_mode.cases) {
        for (const std::string& mode : one.modes) result += fmt::format("{}    case {}:  // {}\n", indent_of_code, mode_number(mode), mode);
        if (&one == &by_mode.cases.back()) result += indent_of_code + "    default:\n";
        result += indent_of_code + "    {\n" + shifted(shifted(text(one.body))) +
                  (returns(one.body) ? "" : indent_of_code + "        break;\n") + indent_of_code + "    }\n";
    }
    return result + indent_of_code + "}\n";
}

std::string JsPrinter::one(const Statement& statement) {
    struct Cases {
        JsPrinter& print;
        static std::string line(const std::string& text) { return wrapped(text, column_of_code); }
        std::string operator()(const Declaration& s) const {
            const bool is_made = s.type.kind == Storage::Kind::array && s.value.kind() != Value::Kind::none;
            return is_made ? print.filled_by_call(s) : line(print.declaration(s) + (s.comment.empty() ? "" : "  // " + s.comment));
        }
        std::string operator()(const Assignment& s) const { return line(print.assignment(s)); }
        std::string operator()(const Invocation& s) const { return print.invocation(s.call); }
        std::string operator()(const Filling& s) const {
            return line(fmt::format("{}.fill({});", javascript_name(s.array), print.text(s.value)));
        }
        std::string operator()(const Loop& s) const {
            return print.braced(fmt::format("for (let {0} = {1}; {0} < {2}; ++{0}) ", javascript_name(s.index), s.first, print.text(s.end)),
                                s.body);
        }
        std::string operator()(const OnEvent& s) const {
            return print.braced(fmt::format("if (event_number === {}) ", print.event_number(s.event)), s.body);
        }
        std::string operator()(const ByMode& s) const { return print.modes(s); }
        std::string operator()(const Return& s) const { return line(fmt::format("return {};", print.text(s.value))); }
        std::string operator()(const Braces& s) const { return print.braced("", s.body); }
        std::string operator()(const If& s) const { return print.braced(fmt::format("if ({}) ", print.text(s.condition)), s.body); }
        std::string operator()(const IfRoomForWork&) const { throw std::logic_error("series in JavaScript"); }
        std::string operator()(const FirstInputs&) const { throw std::logic_error("series in JavaScript"); }
        std::string operator()(const NextInputs&) const { throw std::logic_error("series in JavaScript"); }
        std::string operator()(const Unused&) const { return {}; }
    };
    return std::visit(Cases{*this}, statement.content);
}

std::string JsPrinter::text(const Statements& statements) {
    std::string result;
    for (const Statement& statement : statements) result += one(statement);
    return result;
}

std::string JsPrinter::text(const std::vector<Argument>& arguments) {
    std::vector<std::string> names;
    for (const Argument& a : arguments) names.push_back(javascript_name(a.name));
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace dalembert
