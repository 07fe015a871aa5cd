// SPDX-License-Identifier: GPL-3.0-or-later
#include "c/print.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>


#include "text/safe_text.hpp"
#include "text/wrap.hpp"

namespace dalembert {

namespace {

constexpr std::size_t column_of_body = 4;
const std::string indent_of_body(column_of_body, ' ');

}  // namespace

std::string CPrinter::operand(const Value& value, int least_precedence) {
    return precedence(value) < least_precedence ? "(" + text(value) + ")" : text(value);
}

std::string CPrinter::listed(const std::vector<Value>& parts, const char* between) {
    std::string result;
    for (const Value& part : parts) result += (result.empty() ? "" : between) + text(part);
    return result;
}

std::string CPrinter::sum(const Value& value) {
    std::string result;
    for (std::size_t i = 0; i < value.parts().size(); ++i) {
        const bool negative = value.negative()[i];
        const std::string term = operand(value.parts()[i], i == 0 && !negative ? 1 : 2);
        result += i == 0 ? (negative ? "-" : "") + term : (negative ? " - " : " + ") + term;
    }
    return result;
}

std::string CPrinter::product(const Value& value) {
    std::string result = value.factors() == 0 ? text(Value::literal(1)) : "";
    for (std::size_t i = 0; i < value.parts().size(); ++i)
        result += result.empty() ? operand(value.parts()[i], 2) : (i < value.factors() ? " * " : " / ") + operand(value.parts()[i], 3);
    return result;
}

/// Functions that have another name or other arguments than in the statements: C has neither overloads nor references, and knows no size of
/// an array.
std::string CPrinter::call(const Value& value) {
    std::string function = value.text();
    std::vector<std::string> arguments;
    for (const Value& part : value.parts()) arguments.push_back(text(part));
    if (value.where() == Value::Where::plant)
        return fmt::format("{}_{}(plant_{}{})", name_, function, arguments.empty() ? "" : ", ", fmt::join(arguments, ", "));
    if (function == "abs") function = "fabs";
    if (function == "compression" && arguments.size() == 2) function = "compression_by_decay";
    if (function == "sin_and_cos" || function == "combined_sin_and_cos")
        for (std::size_t i = 1; i < arguments.size(); ++i) arguments[i] = "&" + arguments[i];
    if (function == "ldlt_solve_columns") arguments.push_back(fmt::format("sizeof {0} / sizeof {0}[0]", arguments.back()));
    const std::size_t size = value.sizes().empty() ? 0 : value.sizes()[0];
    call(CHelper{function, size});
    return fmt::format("{}_{}{}({})", name_, function, size == 0 ? "" : fmt::format("_{}", size), fmt::join(arguments, ", "));
}

std::string CPrinter::member(const Value& value) const {
    switch (value.object()) {
        case Value::Object::parameters: return "plant_->p." + value.text();
        case Value::Object::cached: return "plant_->c." + value.text();
        case Value::Object::energies: return "energies->" + value.text();
    }
    return {};
}

std::string CPrinter::text(const Value& value) {
    switch (value.kind()) {
        case Value::Kind::none: return {};
        case Value::Kind::literal: return fmt::format("{}_R({})", name_, value.number());
        case Value::Kind::constant: return text(written_out(value.exact()));
        case Value::Kind::pi: call(CHelper{"pi"}); return name_ + "_pi()";
        case Value::Kind::whole: return std::to_string(value.number());
        case Value::Kind::whole_array:
        case Value::Kind::name: return value.text();
        case Value::Kind::member: return member(value);
        case Value::Kind::element: return text(value.parts()[0]) + "[" + text(value.parts()[1]) + "]";
        case Value::Kind::part_from: return text(value.parts()[0]) + " + " + text(value.parts()[1]);
        case Value::Kind::list: return "{" + listed(value.parts(), ", ") + "}";
        case Value::Kind::sum: return sum(value);
        case Value::Kind::product: return product(value);
        case Value::Kind::parenthesised: return "(" + text(value.parts()[0]) + ")";
        case Value::Kind::call: return call(value);
        case Value::Kind::all_of: return value.parts().empty() ? "true" : listed(value.parts(), " && ");
        case Value::Kind::event: return name_ + "_e_" + value.text();
        case Value::Kind::interface_size: return name_ + "_" + value.text();
        case Value::Kind::room_from: return listed(value.parts(), " + ");
        case Value::Kind::real: return fmt::format("({}_real)({})", name_, text(value.parts()[0]));
        case Value::Kind::signed_index: return fmt::format("(int)({})", text(value.parts()[0]));
        case Value::Kind::comparison: return comparison(value);
        case Value::Kind::curve: return fmt::format("{}_{}", name_, value.text());
        case Value::Kind::choice:
            return fmt::format("{} ? {} : {}", text(value.parts()[0]), text(value.parts()[1]), text(value.parts()[2]));
    }
    return {};
}

std::string CPrinter::comparison(const Value& value) {
    static constexpr const char* signs[]{" == ", " < ", " > "};
    return listed(value.parts(), signs[static_cast<std::size_t>(value.comparison())]);
}

std::string CPrinter::declaration(const Declaration& d) {
    const std::string names = fmt::format("{}", fmt::join(d.names, ", "));
    const bool has_value = d.value.kind() != Value::Kind::none;
    const char* zeros = !d.is_zeroed ? "" : d.type.sizes.size() > 1 ? " = {{0}}" : " = {0}";
    switch (d.type.kind) {
        case Storage::Kind::scalar:
            return has_value ? fmt::format("{}{}_real {} = {};", d.changes ? "" : "const ", name_, names, text(d.value))
                             : fmt::format("{}_real {};", name_, names);
        case Storage::Kind::index: return fmt::format("const size_t {} = {};", names, text(d.value));
        case Storage::Kind::indices:
            return fmt::format("static const size_t {}[{}] = {{{}}};", names, d.numbers.size(), fmt::join(d.numbers, ", "));
        case Storage::Kind::room: return fmt::format("{}_real* const {} = {};", name_, names, text(d.value));
        case Storage::Kind::vector: return fmt::format("{}_real {}[{}]{};", name_, names, size_of(plant_, d.type.name), zeros);
        case Storage::Kind::array:
        case Storage::Kind::table: break;
    }
    return fmt::format("{}_real {}[{}]{};", name_, names, fmt::join(d.type.sizes, "]["), zeros);
}

/// An array that a function of the runtime makes of a list.
std::string CPrinter::filled_by_call(const Declaration& d) {
    const Value& list = d.value.parts()[0];
    const std::size_t size = d.value.sizes()[0];
    call(CHelper{d.value.text(), size});
    return wrapped(fmt::format("{}_real {}[{}];", name_, d.names[0], d.type.sizes[0]), column_of_body) + indent_of_body + "{\n" +
           wrapped(fmt::format("{}_real data_[{}] = {};", name_, list.parts().size(), text(list)), column_of_body + 4) +
           wrapped(fmt::format("{}_{}_{}(data_, {});", name_, d.value.text(), size, d.names[0]), column_of_body + 4) + indent_of_body +
           "}\n";
}

std::string CPrinter::assignment(const Assignment& a) {
    static constexpr const char* operations[]{"=", "+=", "-=", "*="};
    return fmt::format("{} {} {};", text(a.target), operations[static_cast<std::size_t>(a.operation)], text(a.value));
}

std::string CPrinter::filling(const Filling& f) {
    return fmt::format("{0}for (size_t i_ = 0; i_ < {1}; ++i_) {2}[i_] = {3};\n", indent_of_body, size_of(plant_, f.vector), f.array,
                       text(f.value));
}

std::string CPrinter::braced(const std::string& head, const Statements& body) {
    return indent_of_body + head + "{\n" + shifted(text(body)) + indent_of_body + "}\n";
}

std::string CPrinter::inputs(const std::string& name) const {
    return fmt::format("{}{}_real {}[{}];\n", indent_of_body, name_, name, size_of(plant_, "Input"));
}

std::string CPrinter::loop(const Loop& loop) {
    return braced(fmt::format("for (size_t {0} = {1}; {0} < {2}; ++{0}) ", loop.index, loop.first, text(loop.end)), loop.body);
}

std::string CPrinter::modes(const ByMode& by_mode) {
    std::string result = indent_of_body + "switch (mode) {\n";
    for (const ByMode::Case& one : by_mode.cases) {
        for (const std::string& mode : one.modes) result += fmt::format("        case {}_m_{}:\n", name_, mode);
        if (&one == &by_mode.cases.back()) result += "        default:\n";
        result.back() = ' ';
        result += "{\n" + shifted(shifted(text(one.body))) + (returns(one.body) ? "" : "            break;\n") + "        }\n";
    }
    return result + indent_of_body + "}\n";
}

std::string CPrinter::one(const Statement& statement) {
    const auto line = [](const std::string& text) { return wrapped(text, column_of_body); };
    struct Cases {
        CPrinter& print;
        const decltype(line)& line_of;
        std::string operator()(const Declaration& s) const {
            const bool is_made = s.type.kind == Storage::Kind::array && s.value.kind() != Value::Kind::none;
            return is_made ? print.filled_by_call(s) : line_of(print.declaration(s) + (s.comment.empty() ? "" : "  // " + s.comment));
        }
        std::string operator()(const Assignment& s) const { return line_of(print.assignment(s)); }
        std::string operator()(const Invocation& s) const { return line_of(print.text(s.call) + ";"); }
        std::string operator()(const Filling& s) const { return print.filling(s); }
        std::string operator()(const Loop& s) const { return print.loop(s); }
        std::string operator()(const OnEvent& s) const {
            return print.braced(fmt::format("if (event_number == {}_e_{}) ", print.name_, s.event), s.body);
        }
        std::string operator()(const ByMode& s) const { return print.modes(s); }
        std::string operator()(const Return& s) const { return line_of(fmt::format("return {};", print.text(s.value))); }
        std::string operator()(const Braces& s) const { return print.braced("", s.body); }
        std::string operator()(const If& s) const { return print.braced(fmt::format("if ({}) ", print.text(s.condition)), s.body); }
        std::string operator()(const IfRoomForWork& s) const { return print.text(s.body); }  // in C there always is
        std::string operator()(const FirstInputs& s) const {
            return print.inputs(s.input) +
                   line_of(fmt::format("inputs->first(inputs->data, {}[0], {}, {});", print.text(s.states), print.text(s.time), s.input));
        }
        std::string operator()(const NextInputs& s) const {
            return print.inputs(s.input) + line_of(fmt::format("inputs->next(inputs->data, {}, x, {});", print.text(s.order), s.input));
        }
        std::string operator()(const Unused& s) const { return fmt::format("{}(void){};\n", indent_of_body, s.name); }
    };
    return std::visit(Cases{*this, line}, statement.content);
}

std::string CPrinter::text(const Statements& statements) {
    std::string result;
    for (const Statement& statement : statements) result += one(statement);
    return result;
}

std::string CPrinter::text(const std::vector<Argument>& arguments) {
    std::string result;
    for (const Argument& a : arguments) {
        result += result.empty() ? "" : ", ";
        if (a.type == "Scalar" && a.passing == Argument::Passing::room) result += fmt::format("{}_real* {}", name_, a.name);
        else if (a.type == "Scalar") result += fmt::format("{}_real {}", name_, a.name);
        else if (a.type == "Mode") result += fmt::format("{}_mode {}", name_, a.name);
        else if (a.type == "EventNumber" || a.type == "Index") result += "size_t " + a.name;
        else if (a.type == "Inputs") result += fmt::format("const {}_input_series* {}", name_, a.name);
        else if (a.type == "StateOrMore") result += fmt::format("{}_real (*{})[{}]", name_, a.name, size_of(plant_, "State") + 1);
        else if (a.type == "Energies") result += fmt::format("{}_energies* {}", name_, a.name);
        else {
            const char* before = a.passing == Argument::Passing::read ? "const " : "";
            const std::size_t size = size_of(plant_, a.type);
            result += size == 0 ? fmt::format("{}{}_real* {}", before, name_, a.name)
                                : fmt::format("{}{}_real {}[{}]", before, name_, a.name, size);
        }
    }
    return result;
}

std::string CPrinter::curves(const std::vector<PlantCurve>& curves) {
    std::string result;
    for (const PlantCurve& curve : curves) {
        result += fmt::format("/// {0}\nstatic const {1}_real {1}_{2}[{3}] = {{\n", curve.header(), name_, curve.table, curve.size());
        for (const std::vector<Value>& row : curve.rows) {
            std::vector<std::string> numbers;
            for (const Value& value : row) numbers.push_back(text(value));
            result += wrapped_list(numbers, column_of_body) + (&row == &curve.rows.back() ? "};\n\n" : ",\n");
        }
    }
    return result;
}

std::string CPrinter::body(const FunctionBody& body) {
    std::string unused = uses_plant(body.statements) ? "" : indent_of_body + "(void)plant_;\n";
    for (const Argument& a : body.arguments)
        if (!a.is_used) unused += fmt::format("{}(void){};\n", indent_of_body, a.name);
    return unused + text(body.statements);
}

}  // namespace dalembert
