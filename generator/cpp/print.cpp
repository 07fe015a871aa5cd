// SPDX-License-Identifier: GPL-3.0-or-later
#include "cpp/print.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dalembert {

namespace {

const std::string indent_of_body = "        ";

std::string operand(const Value& value, int least_precedence) {
    return precedence(value) < least_precedence ? "(" + cpp_text(value) + ")" : cpp_text(value);
}

std::string listed(const std::vector<Value>& parts, const char* between) {
    std::string text;
    for (const Value& part : parts) text += (text.empty() ? "" : between) + cpp_text(part);
    return text;
}

std::string sum_text(const Value& sum) {
    std::string text;
    for (std::size_t i = 0; i < sum.parts().size(); ++i) {
        const bool negative = sum.negative()[i];
        const std::string term = operand(sum.parts()[i], i == 0 && !negative ? 1 : 2);
        text += i == 0 ? (negative ? "-" : "") + term : (negative ? " - " : " + ") + term;
    }
    return text;
}

std::string product_text(const Value& product) {
    std::string text = product.factors() == 0 ? "Scalar(1)" : "";
    for (std::size_t i = 0; i < product.parts().size(); ++i) {
        const bool is_factor = i < product.factors();
        text += text.empty() ? operand(product.parts()[i], 2) : (is_factor ? " * " : " / ") + operand(product.parts()[i], 3);
    }
    return text;
}

std::string call_text(const Value& call) {
    std::string sizes;
    for (const std::size_t size : call.sizes()) sizes += fmt::format(", {}", size);
    const std::string arguments = listed(call.parts(), ", ");
    return call.where() == Value::Where::helper ? fmt::format("detail::{}<Scalar{}>({})", call.text(), sizes, arguments)
                                                : fmt::format("{}({})", call.text(), arguments);
}

std::string member_text(const Value& member) {
    switch (member.object()) {
        case Value::Object::parameters: return "p_." + member.text();
        case Value::Object::cached: return "c_." + member.text();
        case Value::Object::energies: return "energies." + member.text();
    }
    return {};
}

std::string comparison_text(const Value& value) {
    static constexpr const char* signs[]{" == ", " < ", " > "};
    return listed(value.parts(), signs[static_cast<std::size_t>(value.comparison())]);
}

std::string declaration_text(const Declaration& d) {
    const std::string names = fmt::format("{}", fmt::join(d.names, ", "));
    const bool has_value = d.value.kind() != Value::Kind::none;
    const std::string zeros = d.is_zeroed ? "{}" : "";
    switch (d.type.kind) {
        case Storage::Kind::scalar:
            return has_value ? fmt::format("{}Scalar {} = {};", d.changes ? "" : "const ", names, cpp_text(d.value))
                             : fmt::format("Scalar {};", names);
        case Storage::Kind::index: return fmt::format("const std::size_t {} = {};", names, cpp_text(d.value));
        case Storage::Kind::array:
            return has_value ? fmt::format("const auto {} = {};", names, cpp_text(d.value))
                             : fmt::format("std::array<Scalar, {}> {}{};", d.type.sizes[0], names, zeros);
        case Storage::Kind::indices:
            return fmt::format("constexpr std::array<std::size_t, {}> {}{{{}}};", d.numbers.size(), names, fmt::join(d.numbers, ", "));
        case Storage::Kind::room: return fmt::format("Scalar* const {} = {};", names, cpp_text(d.value));
        case Storage::Kind::vector: return fmt::format("{} {}{};", d.type.name, names, zeros);
        case Storage::Kind::table: break;
    }
    return fmt::format("Scalar {}[{}]{};", names, fmt::join(d.type.sizes, "]["), zeros);
}

std::string assignment_text(const Assignment& a) {
    static constexpr const char* operations[]{"=", "+=", "-=", "*="};
    return fmt::format("{} {} {};", cpp_text(a.target), operations[static_cast<std::size_t>(a.operation)], cpp_text(a.value));
}

std::string braced(const std::string& head, const Statements& body) {
    return indent_of_body + head + "{\n" + shifted(cpp_text(body)) + indent_of_body + "}\n";
}

/// Around one assignment without braces.
std::string conditional_text(const std::string& head, const Statements& body) {
    const auto* one = body.size() == 1 ? std::get_if<Assignment>(&body[0].content) : nullptr;
    return one == nullptr ? braced(head, body) : wrapped(head + assignment_text(*one), indent_of_body.size());
}

std::string first_inputs_text(const FirstInputs& first) {
    const std::string arguments =
        fmt::format("{}, {}, {}, {}", cpp_text(first.states), cpp_text(first.time), first.input, cpp_text(first.room));
    return fmt::format("{0}Input {1}{{}};\n{0}const auto next_inputs = inputs.series({2});\n", indent_of_body, first.input, arguments);
}

/// Loops in loops around one statement need no braces.
std::string loop_text(const Loop& loop) {
    const std::string head = fmt::format("for (std::size_t {0} = {1}; {0} < {2}; ++{0}) ", loop.index, loop.first, cpp_text(loop.end));
    const auto* inner = loop.body.size() == 1 ? std::get_if<Loop>(&loop.body[0].content) : nullptr;
    if (inner == nullptr || inner->body.size() > 1) return braced(head, loop.body);
    const std::string body = cpp_text(inner->body);
    return fmt::format("{0}{1}\n{0}    for (std::size_t {2} = {3}; {2} < {4}; ++{2}) {5}", indent_of_body, head.substr(0, head.size() - 1),
                       inner->index, inner->first, cpp_text(inner->end), body.substr(body.find_first_not_of(' ')));
}

std::string modes_text(const ByMode& by_mode) {
    std::string text = indent_of_body + "switch (mode) {\n";
    for (const ByMode::Case& one : by_mode.cases) {
        std::string labels;
        for (const std::string& mode : one.modes) labels += fmt::format("{}            case Mode::{}:", labels.empty() ? "" : "\n", mode);
        if (&one == &by_mode.cases.back()) labels += "\n            default:";
        text += labels + " {\n" + shifted(shifted(cpp_body(one.body))) + (returns(one.body) ? "" : "                break;\n") +
                "            }\n";
    }
    return text + indent_of_body + "}\n";
}

struct Printer {
    static constexpr std::size_t column = 8;
    std::string operator()(const Declaration& s) const {
        return wrapped(declaration_text(s) + (s.comment.empty() ? "" : "  // " + s.comment), column);
    }
    std::string operator()(const Assignment& s) const { return wrapped(assignment_text(s), column); }
    std::string operator()(const Invocation& s) const { return wrapped(cpp_text(s.call) + ";", column); }
    std::string operator()(const Filling& s) const { return fmt::format("{}{}.fill({});\n", indent_of_body, s.array, cpp_text(s.value)); }
    std::string operator()(const Loop& s) const { return loop_text(s); }
    std::string operator()(const OnEvent& s) const { return braced(fmt::format("if (event_number == event::{}) ", s.event), s.body); }
    std::string operator()(const ByMode& s) const { return modes_text(s); }
    std::string operator()(const Return& s) const { return wrapped(fmt::format("return {};", cpp_text(s.value)), column); }
    std::string operator()(const Braces& s) const { return indent_of_body + "{\n" + shifted(cpp_body(s.body)) + indent_of_body + "}\n"; }
    std::string operator()(const If& s) const { return conditional_text(fmt::format("if ({}) ", cpp_text(s.condition)), s.body); }
    std::string operator()(const IfRoomForWork& s) const {
        return conditional_text("if constexpr (std::tuple_size<StateOrMore>::value > state_count) ", s.body);
    }
    std::string operator()(const FirstInputs& s) const { return first_inputs_text(s); }
    std::string operator()(const NextInputs& s) const {
        return fmt::format("{}const Input {} = next_inputs({});\n", indent_of_body, s.input, cpp_text(s.order));
    }
    std::string operator()(const Unused& s) const { return fmt::format("{}(void){};\n", indent_of_body, s.name); }
};

}  // namespace

std::string cpp_text(const Value& value) {
    switch (value.kind()) {
        case Value::Kind::none: return {};
        case Value::Kind::literal: return fmt::format("Scalar({})", value.number());
        case Value::Kind::constant: return cpp_text(written_out(value.exact()));
        case Value::Kind::pi: return "detail::pi<Scalar>()";
        case Value::Kind::whole: return std::to_string(value.number());
        case Value::Kind::name: return value.text();
        case Value::Kind::member: return member_text(value);
        case Value::Kind::element: return cpp_text(value.parts()[0]) + "[" + cpp_text(value.parts()[1]) + "]";
        case Value::Kind::whole_array: return value.text() + ".data()";
        case Value::Kind::part_from: return cpp_text(value.parts()[0]) + ".data() + " + cpp_text(value.parts()[1]);
        case Value::Kind::list: return "{" + listed(value.parts(), ", ") + "}";
        case Value::Kind::sum: return sum_text(value);
        case Value::Kind::product: return product_text(value);
        case Value::Kind::parenthesised: return "(" + cpp_text(value.parts()[0]) + ")";
        case Value::Kind::call: return call_text(value);
        case Value::Kind::all_of: return value.parts().empty() ? "true" : listed(value.parts(), " && ");
        case Value::Kind::event: return "event::" + value.text();
        case Value::Kind::interface_size: return value.text();
        case Value::Kind::room_from: return listed(value.parts(), " + ");
        case Value::Kind::real: return "Scalar(" + cpp_text(value.parts()[0]) + ")";
        case Value::Kind::signed_index: return "static_cast<int>(" + cpp_text(value.parts()[0]) + ")";
        case Value::Kind::comparison: return comparison_text(value);
        case Value::Kind::curve: return fmt::format("detail::{}<Scalar>", value.text());
        case Value::Kind::choice:
            return fmt::format("{} ? {} : {}", cpp_text(value.parts()[0]), cpp_text(value.parts()[1]), cpp_text(value.parts()[2]));
    }
    return {};
}

std::string cpp_text(const Statements& statements) {
    std::string text;
    for (const Statement& statement : statements) text += std::visit(Printer(), statement.content);
    return text;
}

std::string cpp_body(const Statements& statements) {
    std::string text;
    for (const std::string& name : library_calls(statements)) text += fmt::format("{}using std::{};\n", indent_of_body, name);
    return text + cpp_text(statements);
}

std::string cpp_text(const std::vector<Argument>& arguments) {
    std::string text;
    for (const Argument& a : arguments) {
        const char* before = a.passing == Argument::Passing::read ? "const " : "";
        const char* after = a.passing == Argument::Passing::value ? "" : a.passing == Argument::Passing::room ? "*" : "&";
        const std::string type = a.type == "EventNumber" || a.type == "Index" ? "std::size_t" : a.type;
        text += fmt::format("{}{}{}{} {}", text.empty() ? "" : ", ", before, type, after, a.is_used ? a.name : "/*" + a.name + "*/");
    }
    return text;
}

}  // namespace dalembert
