// SPDX-License-Identifier: GPL-3.0-or-later
// Keys whose value is a list or a table.
#include <fmt/format.h>

#include <algorithm>

#include "elements/runs.hpp"
#include "language/parser.hpp"
#include "read/entry.hpp"

namespace dalembert {

namespace {

using NodeKind = DocumentNode::Kind;

}  // namespace

bool Entry::is_list(std::string_view key) const {
    const DocumentNode* node = find(key);
    return node != nullptr && node->kind == NodeKind::array;
}

std::vector<Turn> Entry::turns(std::string_view key) const {
    std::vector<Turn> result;
    for (const DocumentNode* turn : list(find(key, ValueType::turns), ValueType::turns)) {
        const bool is_pair = turn->kind == NodeKind::array && turn->elements.size() == 2 && turn->elements[0].kind == NodeKind::string;
        const std::string axis = is_pair ? turn->elements[0].string.text : "";
        if (axis != "x" && axis != "y" && axis != "z") wrong_type(*turn, ValueType::turns);
        else result.push_back({static_cast<std::size_t>(axis[0] - 'x'), expression(turn->elements[1], ValueType::expression)});
    }
    return result;
}

std::vector<std::vector<ExpressionPtr>> Entry::tensor(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::tensor);
    if (node == nullptr) return {};
    if (node->kind != NodeKind::array) return {{expression(*node, ValueType::tensor)}};
    const bool has_rows =
        std::any_of(node->elements.begin(), node->elements.end(), [](const DocumentNode& e) { return e.kind == NodeKind::array; });
    std::vector<std::vector<ExpressionPtr>> result;
    const auto row = [&](const DocumentNode& from) {
        result.emplace_back();
        for (const DocumentNode* element : list(&from, ValueType::tensor))
            result.back().push_back(expression(*element, ValueType::expression));
    };
    if (!has_rows) row(*node);
    for (std::size_t i = 0; has_rows && i < node->elements.size(); ++i) row(node->elements[i]);
    const bool is_whole = (result.size() == 1 || result.size() == 3) &&
                          std::all_of(result.begin(), result.end(), [](const auto& r) { return r.size() == 3; });
    if (is_whole) return result;
    wrong_type(*node, ValueType::tensor);
    return {};
}

std::optional<VectorExpression> Entry::vector(std::string_view key) const {
    const ValueType type = alternative(key, ValueType::vector);
    const DocumentNode* node = find(key, type);
    if (node == nullptr) return std::nullopt;
    if (node->kind != NodeKind::array || node->elements.size() < 2 || node->elements.size() > 3) {
        wrong_type(*node, type);
        return std::nullopt;
    }
    VectorExpression vector{nullptr, nullptr, make_number(0, node->span)};
    for (std::size_t i = 0; i < node->elements.size(); ++i) vector[i] = expression(node->elements[i], ValueType::expression);
    if (!vector[0] || !vector[1] || !vector[2]) return std::nullopt;
    return vector;
}

std::vector<Equation> Entry::equations(std::string_view key) const {
    const KeySpec* spec = find_key(section_, key);
    const DocumentNode* node = find(key, spec == nullptr ? ValueType::equation : spec->type);
    std::vector<Equation> result;
    if (node == nullptr) return result;
    const bool is_list = spec->type == ValueType::equations;
    if (node->kind != (is_list ? NodeKind::array : NodeKind::string)) {
        wrong_type(*node, spec->type);
        return result;
    }
    const auto add = [&](const DocumentNode& one) {
        if (one.kind != NodeKind::string) return wrong_type(one, ValueType::equation);
        if (auto equation = attempt([&] { return parse_equation(one.string); })) result.push_back(std::move(*equation));
    };
    if (!is_list) add(*node);
    for (const DocumentNode& element : node->elements) add(element);
    if (is_list && node->elements.empty()) error(Id::wrong_type, node->span, fmt::format("'{}' is empty; there is nothing to check", key));
    return result;
}

std::vector<Condition> Entry::conditions(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::modes);
    std::vector<Condition> result;
    if (node == nullptr) return result;
    const auto add = [&](const DocumentNode& element) {
        if (element.kind != NodeKind::string) return wrong_type(element, ValueType::modes);
        if (auto parsed = attempt([&] { return parse_condition(element.string); })) result.push_back(std::move(*parsed));
    };
    if (node->kind != NodeKind::array) add(*node);
    else std::for_each(node->elements.begin(), node->elements.end(), add);
    return result;
}

std::size_t Entry::length(std::string_view key) const { return is_list(key) ? find(key)->elements.size() : 0; }

NamesWithPlaces Entry::names(std::string_view key) const {
    NamesWithPlaces result;
    for (const DocumentNode* element : list(find(key, ValueType::effects), ValueType::effects)) {
        if (element->kind == NodeKind::string) result.emplace_back(element->string.text, element->span);
        else wrong_type(*element, ValueType::text);
    }
    return result;
}

std::vector<const DocumentNode*> Entry::list(const DocumentNode* node, ValueType type) const {
    std::vector<const DocumentNode*> result;
    if (node == nullptr) return result;
    if (node->kind != NodeKind::array) {
        wrong_type(*node, type);
        return result;
    }
    for (const DocumentNode& element : node->elements) result.push_back(&element);
    return result;
}

std::vector<Reference> Entry::references(std::string_view key, const std::string& what) const {
    std::vector<Reference> result;
    for (const DocumentNode* element : list(find(key, ValueType::parts), ValueType::parts))
        if (auto part = reference(*element, ValueType::part, what)) result.push_back(std::move(*part));
    return result;
}

std::vector<ExpressionPtr> Entry::expressions(std::string_view key) const {
    std::vector<ExpressionPtr> result;
    for (const DocumentNode* element : list(find(key, ValueType::expressions), ValueType::expressions))
        result.push_back(expression(*element, ValueType::expression));
    return result;
}

std::vector<ExpressionPtr> Entry::one_or_two(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::one_or_two);
    if (node == nullptr) return {};
    if (node->kind != NodeKind::array) return {expression(*node, ValueType::one_or_two)};
    std::vector<ExpressionPtr> result;
    for (const DocumentNode& element : node->elements) result.push_back(expression(element, ValueType::expression));
    if (result.size() != 1 && result.size() != 2) wrong_type(*node, ValueType::one_or_two);
    return result;
}

const DocumentNode* Entry::table_of_tables(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::named_tables);
    if (node == nullptr || node->kind == NodeKind::table) return node;
    wrong_type(*node, ValueType::named_tables);
    return nullptr;
}

std::vector<std::vector<ExpressionPtr>> Entry::matrix(std::string_view key) const {
    std::vector<std::vector<ExpressionPtr>> result;
    for (const DocumentNode* row : list(find(key, ValueType::matrix), ValueType::matrix)) {
        result.emplace_back();
        for (const DocumentNode* element : list(row, ValueType::matrix)) {
            const bool is_left_out = element->kind == NodeKind::string && (element->string.text.empty() || element->string.text == "?");
            result.back().push_back(is_left_out ? nullptr : expression(*element, ValueType::expression));
        }
    }
    return result;
}

std::vector<std::vector<ExpressionPtr>> Entry::grid(std::string_view key) const {
    std::vector<std::vector<ExpressionPtr>> result;
    for (const DocumentNode* row : list(find(key, ValueType::grid), ValueType::grid)) {
        result.emplace_back();
        for (const DocumentNode* element : list(row, ValueType::grid)) result.back().push_back(expression(*element, ValueType::expression));
    }
    return result;
}

std::vector<std::vector<ExpressionPtr>> Entry::table(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::table);
    if (node == nullptr) return {};
    if (node->kind != NodeKind::array) return {{expression(*node, ValueType::table)}};
    std::vector<std::vector<ExpressionPtr>> result;
    for (const DocumentNode& row : node->elements) {
        result.emplace_back();
        for (const DocumentNode* element : list(&row, ValueType::table)) result.back().push_back(expression(*element, ValueType::table));
    }
    return result;
}

std::vector<std::array<ExpressionPtr, 2>> Entry::points(std::string_view key) const {
    const KeySpec* spec = find_key(section_, key);
    const ValueType type = spec != nullptr && spec->type == ValueType::pieces ? ValueType::pieces : ValueType::points;
    std::vector<std::array<ExpressionPtr, 2>> result;
    for (const DocumentNode* point : list(find(key, type), type)) {
        if (point->kind != NodeKind::array) wrong_type(*point, type);
        else if (const std::size_t count = point->elements.size(); count != 2)
            error(Id::wrong_type, point->span,
                  fmt::format("there {} {} instead of two numbers; expected: {}", count == 1 ? "is" : "are", count, describe(type)));
        else
            result.push_back(
                {expression(point->elements[0], ValueType::expression), expression(point->elements[1], ValueType::expression)});
    }
    return result;
}

std::vector<std::pair<Excerpt, ExpressionPtr>> Entry::by_text(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::expressions_by_name);
    std::vector<std::pair<Excerpt, ExpressionPtr>> result;
    if (node == nullptr) return result;
    if (node->kind != NodeKind::table) {
        wrong_type(*node, ValueType::expressions_by_name);
        return result;
    }
    for (const DocumentNode::Member& member : node->members)
        if (ExpressionPtr value = expression(member.value, ValueType::expression))
            result.emplace_back(key_excerpt(member), std::move(value));
    return result;
}

std::vector<Excerpt> Entry::excerpts(std::string_view key) const {
    std::vector<Excerpt> result;
    for (const DocumentNode* element : list(find(key, ValueType::effects), ValueType::effects)) {
        if (element->kind == NodeKind::string) result.push_back(element->string);
        else wrong_type(*element, ValueType::text);
    }
    return result;
}

std::vector<RunEntry> Entry::by_name(std::string_view key) const { return by_name(key, ValueType::expressions_by_name); }

std::vector<RunEntry> Entry::values_by_name(std::string_view key) const { return by_name(key, ValueType::values_by_name); }

std::vector<RunEntry> Entry::by_name(std::string_view key, ValueType type) const {
    const DocumentNode* node = find(key, type);
    std::vector<RunEntry> result;
    if (node == nullptr) return result;
    if (node->kind != NodeKind::table) {
        wrong_type(*node, type);
        return result;
    }
    for (const DocumentNode::Member& member : node->members) {
        const auto variable = attempt([&] { return parse_expression(key_excerpt(member)); });
        const auto add = [&](const DocumentNode& written, std::optional<RunEntry::OfList> of_list) {
            const ExpressionPtr value = expression(written, ValueType::expression);
            if (variable && value) result.push_back({*variable, value, member.key_span, of_list});
        };
        if (type != ValueType::values_by_name || member.value.kind != NodeKind::array) {
            add(member.value, {});
            continue;
        }
        const auto& values = member.value.elements;
        if (values.empty()) empty_list(member.value);
        for (std::size_t i = 0; i < values.size(); ++i) add(values[i], RunEntry::OfList{i, values.size()});
    }
    return result;
}

std::vector<CoordinateEntry> Entry::coordinates(std::string_view key) const {
    std::vector<CoordinateEntry> result;
    for (const RunEntry& entry : by_name(key)) {
        const Expression& name = *entry.variable;
        if (name.kind == Expression::Kind::name && name.children.size() <= 1)
            result.push_back({name.name, name.children.empty() ? nullptr : name.children[0], entry.value, entry.span});
        else
            error(Id::wrong_type, entry.span, fmt::format("'{}' is not the name of a coordinate", name.written()));
    }
    return result;
}

std::vector<Plot> Entry::plots(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::plots);
    std::vector<Plot> result;
    if (node == nullptr) return result;
    if (node->kind != NodeKind::array) {
        wrong_type(*node, ValueType::plots);
        return result;
    }
    const auto list = [&](const DocumentNode& from, std::vector<std::string>& to) {
        for (const DocumentNode& element : from.elements) {
            if (element.kind == NodeKind::string) to.push_back(element.string.text);
            else wrong_type(element, ValueType::text);
        }
    };
    for (const DocumentNode& element : node->elements) {
        Plot plot{{}, {}, {}, element.span};
        if (element.kind == NodeKind::array) {
            list(element, plot.y);
        } else if (element.kind == NodeKind::table) {
            for (const DocumentNode::Member& member : element.members) {
                if (member.key == "y" && member.value.kind == NodeKind::array) list(member.value, plot.y);
                else if (member.key == "x" && member.value.kind == NodeKind::string) plot.x = member.value.string.text;
                else if (member.key == "title" && member.value.kind == NodeKind::string) plot.title = member.value.string.text;
                else error(Id::unknown_key, member.key_span, "a plot is a list of names or { title = text, x = name, y = [names] }");
            }
        } else {
            wrong_type(element, ValueType::plots);
        }
        if (plot.y.empty())
            error(Id::missing_key, element.span, "a plot needs at least one name");
        else result.push_back(std::move(plot));
    }
    return result;
}

}  // namespace dalembert
