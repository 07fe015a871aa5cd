// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/entry.hpp"

#include <fmt/format.h>

#include "model/parser.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

using NodeKind = DocumentNode::Kind;

/// The text of a key, without its quotes.
Excerpt key_excerpt(const Span& span) {
    std::size_t begin = span.begin;
    std::size_t end = span.end;
    const std::string_view text = span.text();
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'')) {
        ++begin;
        --end;
    }
    return excerpt_of(span.source, begin, end);
}

bool is_constant(const Expression& expression) {
    bool constant = true;
    for_each(expression, [&](const Expression& e) {
        if (e.kind == Expression::Kind::name && e.name != "pi") constant = false;
    });
    return constant;
}

}  // namespace

Entry::Entry(const DocumentNode::Member& member, const SectionSpec& section, Diagnostics& diagnostics)
    : name_(member.key), span_(member.key_span), section_(section), diagnostics_(diagnostics) {
    const std::string path = section.is_collection ? fmt::format("{}.{}", section.name, name_) : section.name;
    if (member.value.kind != NodeKind::table) {
        if (*section.short_form == '\0') {
            error(Id::wrong_type, member.value.span, fmt::format("[{}] is {}, but must be a table", path, describe(member.value.kind)));
            return;
        }
        values_.emplace(section.short_form, &member.value);
    }
    std::vector<std::string> known;
    for (const KeySpec& key : section.keys) known.emplace_back(key.name);
    for (const DocumentNode::Member& value : member.value.members) {
        if (find_key(section, value.key) != nullptr) {
            values_.emplace(value.key, &value.value);
            continue;
        }
        has_unknown_key_ = true;
        error(Id::unknown_key, value.key_span,
              fmt::format("[{}] has no key '{}'{}{}", path, value.key, did_you_mean(value.key, known),
                          nearest(value.key, known).empty() ? "; it takes " + quoted_list(known) : ""));
    }
    for (const KeySpec& key : section.keys)
        if (key.required && !has(key.name))
            error(Id::missing_key, span_, fmt::format("[{}] needs the key '{}': {}", path, key.name, key.doc));
}

const DocumentNode* Entry::find(std::string_view key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? nullptr : found->second;
}

const DocumentNode* Entry::find(std::string_view key, ValueType type) const {
    const KeySpec* spec = find_key(section_, key);
    if (spec == nullptr || spec->type != type)
        throw std::logic_error(fmt::format("the schema has no key {}.{} of that type", section_.name, key));
    return find(key);
}

Span Entry::span_of(std::string_view key) const {
    const DocumentNode* node = find(key);
    return node == nullptr ? span_ : node->span;
}

void Entry::error(Id id, Span span, std::string message, std::vector<Note> notes) const {
    if (id == Id::missing_key && has_unknown_key_) return;  // the misspelt key is probably the missing one
    diagnostics_.error(id, std::move(span), std::move(message), std::move(notes));
}

void Entry::wrong_type(const DocumentNode& node, ValueType expected) const {
    error(Id::wrong_type, node.span, fmt::format("there is {}; expected: {}", describe(node.kind), describe(expected)));
}

template <class Parse>
auto Entry::attempt(Parse parse) const -> std::optional<decltype(parse())> {
    try {
        return parse();
    } catch (const Failure& failure) {
        for (const Diagnostic& d : failure.diagnostics()) error(d.id, d.span, d.message, d.notes);
        return std::nullopt;
    }
}

std::string Entry::text(std::string_view key) const {
    const KeySpec* spec = find_key(section_, key);
    const DocumentNode* node = find(key, spec != nullptr && spec->type == ValueType::choice ? ValueType::choice : ValueType::text);
    if (node == nullptr) return {};
    if (node->kind == NodeKind::string) return node->string.text;
    wrong_type(*node, ValueType::text);
    return {};
}

int Entry::whole_number(std::string_view key, int otherwise) const {
    const DocumentNode* node = find(key, ValueType::whole_number);
    if (node == nullptr) return otherwise;
    const auto value = node->kind == NodeKind::number ? read_decimal(node->number) : std::nullopt;
    const auto whole = value ? to_int(*value) : std::nullopt;
    if (!whole) wrong_type(*node, ValueType::whole_number);
    return whole.value_or(otherwise);
}

std::optional<Rational> Entry::number(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::number);
    if (node == nullptr) return std::nullopt;
    const auto value = node->kind == NodeKind::number ? read_decimal(node->number) : std::nullopt;
    if (!value) wrong_type(*node, ValueType::number);
    return value;
}

ExpressionPtr Entry::expression(const DocumentNode& node, ValueType type) const {
    if (node.kind == NodeKind::number) {
        if (const auto value = read_decimal(node.number)) return make_number(*value, node.span);
        error(Id::wrong_type, node.span, fmt::format("'{}' is not a decimal number with an exponent between -400 and 400", node.number));
        return nullptr;
    }
    if (node.kind != NodeKind::string) {
        wrong_type(node, type);
        return nullptr;
    }
    return attempt([&] { return parse_expression(node.string); }).value_or(nullptr);
}

ExpressionPtr Entry::constant(const DocumentNode& node, const Unit& unit) const {
    ExpressionPtr value = expression(node, ValueType::constant);
    return value && is_constant(*value) ? to_si(std::move(value), unit) : value;
}

ExpressionPtr Entry::constant(std::string_view key, const Unit& unit) const {
    const DocumentNode* node = find(key, ValueType::constant);
    return node == nullptr ? nullptr : constant(*node, unit);
}

std::vector<ExpressionPtr> Entry::constants(std::string_view key, const Unit& unit) const {
    const DocumentNode* node = find(key, ValueType::constants);
    std::vector<ExpressionPtr> values;
    if (node == nullptr) return values;
    if (node->kind == NodeKind::array) {
        for (const DocumentNode& element : node->elements) values.push_back(constant(element, unit));
    } else {
        values.push_back(constant(*node, unit));
    }
    return values;
}

std::optional<Unit> Entry::unit(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::unit);
    if (node == nullptr) return std::nullopt;
    if (node->kind != NodeKind::string) {
        wrong_type(*node, ValueType::unit);
        return std::nullopt;
    }
    return attempt([&] { return parse_unit(node->string); });
}

/// A bound of a range; null for an infinite one.
ExpressionPtr Entry::bound(const DocumentNode& node, const Unit& unit) const {
    if (node.kind == NodeKind::number && node.number.find("inf") != std::string::npos) return nullptr;
    return constant(node, unit);
}

std::optional<Range> Entry::range(std::string_view key, const Unit& unit) const {
    const DocumentNode* node = find(key, ValueType::range);
    if (node == nullptr) return std::nullopt;
    if (node->kind != NodeKind::array || node->elements.size() != 2) {
        wrong_type(*node, ValueType::range);
        return std::nullopt;
    }
    return Range{bound(node->elements[0], unit), bound(node->elements[1], unit), node->span};
}

/// The type of the key where it may be given in several ways, of which this is one.
ValueType Entry::alternative(std::string_view key, ValueType type) const {
    const KeySpec* spec = find_key(section_, key);
    return spec != nullptr && spec->type == ValueType::torque ? ValueType::torque : type;
}

ExpressionPtr Entry::expression(std::string_view key) const {
    const DocumentNode* node = find(key, alternative(key, ValueType::expression));
    return node == nullptr ? nullptr : expression(*node, ValueType::expression);
}

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
    const bool has_rows = std::any_of(node->elements.begin(), node->elements.end(), [](const DocumentNode& e) { return e.kind == NodeKind::array; });
    std::vector<std::vector<ExpressionPtr>> result;
    const auto row = [&](const DocumentNode& from) {
        result.emplace_back();
        for (const DocumentNode* element : list(&from, ValueType::tensor)) result.back().push_back(expression(*element, ValueType::expression));
    };
    if (!has_rows) row(*node);
    for (std::size_t i = 0; has_rows && i < node->elements.size(); ++i) row(node->elements[i]);
    const bool is_whole = (result.size() == 1 || result.size() == 3) && std::all_of(result.begin(), result.end(), [](const auto& r) { return r.size() == 3; });
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

std::optional<Law> Entry::law(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::law);
    if (node == nullptr) return std::nullopt;
    if (node->kind != NodeKind::string) {
        wrong_type(*node, ValueType::law);
        return std::nullopt;
    }
    return attempt([&] { return parse_law(node->string); });
}

std::optional<Property> Entry::property(std::string_view key) const {
    const KeySpec* spec = find_key(section_, key);
    const DocumentNode* node = find(key, spec == nullptr ? ValueType::property : spec->type);
    if (node == nullptr) return std::nullopt;
    if (node->kind == NodeKind::string) return attempt([&] { return parse_property(node->string); });
    ExpressionPtr value = expression(*node, spec->type);
    return value ? std::optional(Property{{}, std::move(value), node->span}) : std::nullopt;
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

std::optional<Family> Entry::family(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::family);
    if (node == nullptr) return std::nullopt;
    if (node->kind != NodeKind::string) {
        wrong_type(*node, ValueType::family);
        return std::nullopt;
    }
    return attempt([&] { return parse_family(node->string); });
}

std::optional<Condition> Entry::condition(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::condition);
    if (node == nullptr) return std::nullopt;
    if (node->kind != NodeKind::string) {
        wrong_type(*node, ValueType::condition);
        return std::nullopt;
    }
    return attempt([&] { return parse_condition(node->string); });
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

std::vector<std::pair<std::string, Span>> Entry::names(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::effects);
    std::vector<std::pair<std::string, Span>> result;
    if (node == nullptr) return result;
    if (node->kind != NodeKind::array) {
        wrong_type(*node, ValueType::effects);
        return result;
    }
    for (const DocumentNode& element : node->elements) {
        if (element.kind == NodeKind::string) result.emplace_back(element.string.text, element.span);
        else wrong_type(element, ValueType::text);
    }
    return result;
}

std::optional<Reference> Entry::reference(const DocumentNode& node, ValueType type, const char* what) const {
    const ExpressionPtr name = expression(node, type);
    if (!name) return std::nullopt;
    if (name->kind == Expression::Kind::name && name->children.size() <= 1)
        return Reference{name->name, name->children.empty() ? nullptr : name->children[0], name->span};
    error(Id::wrong_type, node.span, fmt::format("'{}' is not the name of {}", name->written(), what));
    return std::nullopt;
}

std::optional<Reference> Entry::reference(std::string_view key, ValueType type, const char* what) const {
    const DocumentNode* node = find(key, type);
    return node == nullptr ? std::nullopt : reference(*node, type, what);
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

std::vector<Reference> Entry::parts(std::string_view key) const {
    std::vector<Reference> result;
    for (const DocumentNode* element : list(find(key, ValueType::parts), ValueType::parts))
        if (auto part = reference(*element, ValueType::part, "a node, of a cell of a rod or block, or of a body")) result.push_back(std::move(*part));
    return result;
}

std::vector<ExpressionPtr> Entry::expressions(std::string_view key) const {
    std::vector<ExpressionPtr> result;
    for (const DocumentNode* element : list(find(key, ValueType::expressions), ValueType::expressions)) result.push_back(expression(*element, ValueType::expression));
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
        if (point->kind != NodeKind::array || point->elements.size() != 2) wrong_type(*point, type);
        else result.push_back({expression(point->elements[0], ValueType::expression), expression(point->elements[1], ValueType::expression)});
    }
    return result;
}

std::optional<Reference> Entry::body(std::string_view key) const { return reference(key, ValueType::body, "a body"); }
std::optional<Reference> Entry::part(std::string_view key) const { return reference(key, ValueType::part, "a medium, volume or reservoir"); }

std::optional<Reference> Entry::constraint(std::string_view key) const { return reference(key, ValueType::part, "a constraint"); }

bool Entry::boolean(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::boolean);
    if (node != nullptr && node->kind != NodeKind::boolean) wrong_type(*node, ValueType::boolean);
    return node != nullptr && node->boolean;
}

std::optional<CoordinateEntry> Entry::coordinate(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::coordinate);
    if (node == nullptr) return std::nullopt;
    const ExpressionPtr name = expression(*node, ValueType::coordinate);
    if (!name) return std::nullopt;
    if (name->kind == Expression::Kind::name && name->children.size() <= 1)
        return CoordinateEntry{name->name, name->children.empty() ? nullptr : name->children[0], nullptr, name->span};
    error(Id::wrong_type, node->span, fmt::format("'{}' is not the name of a coordinate", name->written()));
    return std::nullopt;
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
        if (ExpressionPtr value = expression(member.value, ValueType::expression)) result.emplace_back(key_excerpt(member.key_span), std::move(value));
    return result;
}

std::vector<Excerpt> Entry::excerpts(std::string_view key) const {
    std::vector<Excerpt> result;
    const DocumentNode* node = find(key, ValueType::effects);
    if (node == nullptr) return result;
    for (const DocumentNode* element : list(node, ValueType::effects)) {
        if (element->kind == NodeKind::string) result.push_back(element->string);
        else wrong_type(*element, ValueType::text);
    }
    return result;
}

Excerpt Entry::name_excerpt() const { return key_excerpt(span_); }

std::optional<Excerpt> Entry::excerpt(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::text);
    if (node == nullptr) return std::nullopt;
    if (node->kind == NodeKind::string) return node->string;
    wrong_type(*node, ValueType::text);
    return std::nullopt;
}

std::vector<RunEntry> Entry::by_name(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::expressions_by_name);
    std::vector<RunEntry> result;
    if (node == nullptr) return result;
    if (node->kind != NodeKind::table) {
        wrong_type(*node, ValueType::expressions_by_name);
        return result;
    }
    for (const DocumentNode::Member& member : node->members) {
        const auto variable = attempt([&] { return parse_expression(key_excerpt(member.key_span)); });
        const ExpressionPtr value = expression(member.value, ValueType::expression);
        if (variable && value) result.push_back({*variable, value, member.key_span});
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
        if (plot.y.empty()) error(Id::missing_key, element.span, "a plot without anything to plot");
        else result.push_back(std::move(plot));
    }
    return result;
}

void Entry::fill(Item& item) const {
    item.name = name_;
    item.span = span_;
    if (find_key(section_, "doc") != nullptr) item.doc = text("doc");
    if (find_key(section_, "for") != nullptr) item.family = family("for");
    if (find_key(section_, "when") != nullptr) item.when = condition("when");
}

}  // namespace dalembert
