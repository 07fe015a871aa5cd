// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "js/c_to_javascript.hpp"

namespace dalembert {

CType CToJavascript::type_of_name(const std::string& name) const {
    for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
        if (const auto found = scope->find(name); found != scope->end()) return found->second;
    if (const auto table = unit_.tables.find(name); table != unit_.tables.end()) return table->second;
    return {};
}

CType CToJavascript::type_of(const CTree& e) const {
    switch (e->kind) {
        case Kind::number:
            return {e->text.find_first_of(".e") == std::string::npos || e->text.starts_with("0x") ? CType::Base::whole : CType::Base::real};
        case Kind::name:
            if (e->text == "NAME_DIGITS") return {CType::Base::whole};
            return type_of_name(e->text);
        case Kind::call: {
            if (e->parts[0]->kind != Kind::name) return {};
            if (e->parts[0]->text == "NAME_R") return {CType::Base::real};
            const auto found = unit_.results.find(e->parts[0]->text);
            return found == unit_.results.end() ? CType{CType::Base::real} : found->second;
        }
        case Kind::member: {
            const CType object = type_of(e->parts[0]);
            const auto structure = unit_.structures.find(object.structure);
            if (structure == unit_.structures.end()) return {};
            for (const CVariable& m : structure->second.members)
                if (m.name == e->text) return m.type;
            return {};
        }
        case Kind::index:
            return type_of(e->parts[0]).element();
        case Kind::unary:
            if (e->text == "*") return type_of(e->parts[0]).element();
            if (e->text == "&") {
                CType type = type_of(e->parts[0]);
                ++type.pointers;
                return type;
            }
            return e->text == "!" ? CType{CType::Base::whole} : type_of(e->parts[0]);
        case Kind::postfix:
            return type_of(e->parts[0]);
        case Kind::binary: {
            const CType left = type_of(e->parts[0]), right = type_of(e->parts[1]);
            if (left.is_place() || e->text == "*" || e->text == "/" || e->text == "+" || e->text == "-" || e->text == "%")
                return left.is_place() ? left : left.is_whole() && right.is_whole() ? left : CType{CType::Base::real};
            return {CType::Base::whole};
        }
        case Kind::assignment:
            return type_of(e->parts[0]);
        case Kind::conditional: {
            const CType yes = type_of(e->parts[1]);
            return yes.is_whole() && !type_of(e->parts[2]).is_whole() ? type_of(e->parts[2]) : yes;
        }
        case Kind::cast:
            return e->type;
        case Kind::size_of:
            return {CType::Base::whole};
        case Kind::comma:
            return type_of(e->parts[1]);
        default:
            return {};
    }
}

std::string CToJavascript::copied(const CTree& e) {
    if (e->kind == Kind::call) return expression(e);
    return fmt::format("copy_{}({})", type_of(e).structure, expression(e));
}

int CToJavascript::tightness_of(const CTree& e) {
    switch (e->kind) {
        case Kind::comma:
        case Kind::assignment:
        case Kind::conditional:
            return 0;
        case Kind::binary:
            return c_tightness(e->text);
        case Kind::unary:
            return 11;
        case Kind::cast:
            return tightness_of(e->parts[0]);
        case Kind::call:
            return e->parts[0]->kind == Kind::name && e->parts[0]->text == "NAME_R" ? tightness_of(e->parts[1]) : 12;
        default:
            return 12;
    }
}

std::string CToJavascript::operand(const CTree& e, int least) {
    const std::string text = expression(e);
    return tightness_of(e) < least ? "(" + text + ")" : text;
}

bool CToJavascript::is_boxed(const CTree& e) const {
    return e->kind == Kind::name && addressed_.contains(e->text) && type_of_name(e->text).is_number();
}

std::string CToJavascript::address(const CTree& e) {
    const CType type = type_of(e);
    if (is_boxed(e)) return javascript_name(e->text);
    if (type.is_structure() || type.is_array()) return operand(e);
    if (e->kind == Kind::unary && e->text == "*") return operand(e->parts[0]);
    if (e->kind == Kind::index) return fmt::format("{}.subarray({})", operand(e->parts[0]), expression(e->parts[1]));
    const std::string place = expression(e);
    return fmt::format("{{ get 0() {{ return {0}; }}, set 0(value_) {{ {0} = value_; }} }}", place);
}

std::string CToJavascript::binary(const CNode& e) {
    const CType left = type_of(e.parts[0]), right = type_of(e.parts[1]);
    if (left.is_place() && (e.text == "+" || e.text == "-") && !right.is_place()) {
        if (e.text == "-") throw std::logic_error("an array that begins before itself");
        return fmt::format("{}.subarray({})", operand(e.parts[0]), expression(e.parts[1]));
    }
    const int own = c_tightness(e.text);
    std::string text = fmt::format("{} {} {}", operand(e.parts[0], own), e.text, operand(e.parts[1], own + 1));
    return e.text == "/" && left.is_whole() && right.is_whole() ? "Math.trunc(" + text + ")" : text;
}

std::string CToJavascript::call(const CNode& e) {
    const CTree& function = e.parts[0];
    std::vector<std::string> arguments;
    for (std::size_t i = 1; i < e.parts.size(); ++i)
        if (e.parts[i]->kind != Kind::name || e.parts[i]->text != options_.left_out_argument) arguments.push_back(expression(e.parts[i]));
    if (function->kind == Kind::name && function->text == "NAME_R") return arguments.at(0);
    const std::string called = function->kind != Kind::name                                 ? operand(function)
                               : type_of_name(function->text).base == CType::Base::function ? javascript_name(function->text)
                                                                                            : options_.name(function->text);
    return fmt::format("{}({})", called, fmt::join(arguments, ", "));
}

std::string CToJavascript::name_of(const std::string& name) {
    if (name == "NULL") return "null";
    if (name == "INFINITY" || name == "HUGE_VAL") return "Infinity";
    if (name == "true" || name == "false") return name;
    for (auto scope = scopes_.rbegin(); scope + 1 != scopes_.rend(); ++scope)
        if (scope->contains(name)) return javascript_name(name) + (addressed_.contains(name) && scope->at(name).is_number() ? "[0]" : "");
    return options_.name(name);
}

std::string CToJavascript::cast(const CNode& e) {
    if (e.type.is_whole() && e.parts[0]->kind == Kind::unary && e.parts[0]->text == "-") return "Number.MAX_SAFE_INTEGER";  // (size_t)-1
    const bool cuts = e.type.is_whole() && type_of(e.parts[0]).base == CType::Base::real;
    return cuts ? fmt::format("Math.trunc({})", expression(e.parts[0])) : expression(e.parts[0]);
}

std::string CToJavascript::assignment(const CNode& e) {
    const CType type = type_of(e.parts[0]);
    if (type.is_structure()) return fmt::format("Object.assign({}, {})", expression(e.parts[0]), copied(e.parts[1]));
    if (e.text == "/=" && type.is_whole()) return fmt::format("{0} = Math.trunc({0} / {1})", expression(e.parts[0]), operand(e.parts[1]));
    return fmt::format("{} {} {}", expression(e.parts[0]), e.text, expression(e.parts[1]));
}

std::string CToJavascript::expression(const CTree& e) {
    switch (e->kind) {
        case Kind::number:
        case Kind::string:
            return e->text;
        case Kind::name:
            return name_of(e->text);
        case Kind::call:
            return call(*e);
        case Kind::member:
            return fmt::format("{}.{}", operand(e->parts[0]), e->text);
        case Kind::index:
            return fmt::format("{}[{}]", operand(e->parts[0]), expression(e->parts[1]));
        case Kind::unary:
            if (e->text == "&") return address(e->parts[0]);
            if (e->text == "*") return type_of(e).is_structure() ? operand(e->parts[0]) : fmt::format("{}[0]", operand(e->parts[0]));
            return e->text + operand(e->parts[0]);
        case Kind::postfix:
            return operand(e->parts[0]) + e->text;
        case Kind::binary:
            return binary(*e);
        case Kind::assignment:
            return assignment(*e);
        case Kind::conditional:
            return fmt::format("{} ? {} : {}", operand(e->parts[0], 1), operand(e->parts[1], 1),
                               operand(e->parts[2], e->parts[2]->kind == Kind::conditional ? 0 : 1));
        case Kind::cast:
            return cast(*e);
        case Kind::size_of:
            return e->parts.empty() ? "1" : fmt::format("{}.length", operand(e->parts[0]));
        case Kind::comma:
            return fmt::format("{}, {}", expression(e->parts[0]), expression(e->parts[1]));
        default:
            throw std::logic_error("an expression of C that is not translated");
    }
}

}  // namespace dalembert
