// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/entry.hpp"

#include <fmt/format.h>

#include "language/parser.hpp"
#include "check/written_values.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

using NodeKind = DocumentNode::Kind;

}  // namespace

Entry::Entry(const DocumentNode::Member& member, const SectionSpec& section, Diagnostics& diagnostics, std::string place)
    : name_(member.key), span_(member.key_span), section_(section), diagnostics_(diagnostics) {
    if (place.empty()) place = section.is_collection ? fmt::format("[{}.{}]", section.name, name_) : fmt::format("[{}]", section.name);
    if (member.value.kind != NodeKind::table) {
        if (*section.short_form == '\0') {
            error(Id::wrong_type, member.value.span, fmt::format("{} is {}, but must be a table", place, describe(member.value.kind)));
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
              fmt::format("{} has no key '{}'{}{}", place, value.key, did_you_mean(value.key, known),
                          nearest(value.key, known).empty() ? "; it takes " + quoted_list(known) : ""));
    }
    for (const KeySpec& key : section.keys)
        if (key.required && !has(key.name))
            error(Id::missing_key, span_,
                  fmt::format("{} needs the key '{}': {}", place, key.name, key.choices.empty() ? key.doc : key.choices));
}

Excerpt Entry::key_excerpt(const Span& span) {
    std::size_t begin = span.begin;
    std::size_t end = span.end;
    const std::string_view text = span.text();
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'')) {
        ++begin;
        --end;
    }
    return excerpt_of(span.source, begin, end);
}

Excerpt Entry::key_excerpt(const DocumentNode::Member& member) {
    Excerpt written = key_excerpt(member.key_span);
    if (written.text.size() == member.key.size()) written.text = member.key;
    return written;
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
    if (id == Id::missing_key && has_unknown_key_) return;
    diagnostics_.error(id, std::move(span), std::move(message), std::move(notes));
}

void Entry::wrong_type(const DocumentNode& node, ValueType expected) const {
    error(Id::wrong_type, node.span, fmt::format("there is {}; expected: {}", describe(node.kind), describe(expected)));
}

std::string Entry::text(std::string_view key) const {
    const std::optional<Excerpt> written = excerpt(key);
    return written ? written->text : "";
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
    return value && is_plain_number(*value) ? to_si(std::move(value), unit) : value;
}

ExpressionPtr Entry::constant(std::string_view key, const Unit& unit) const {
    const DocumentNode* node = find(key, ValueType::constant);
    return node == nullptr ? nullptr : constant(*node, unit);
}

MemberValues Entry::member_values(std::string_view key, const Unit& unit) const {
    const DocumentNode* node = find(key, ValueType::constants);
    if (node == nullptr) return {};
    if (node->kind != NodeKind::array) return constant(*node, unit);
    MemberValues values;
    values.is_list = true;
    values.span = node->span;
    for (const DocumentNode& element : node->elements) values.push_back(constant(element, unit));
    if (values.empty()) empty_list(*node);
    return values;
}

void Entry::empty_list(const DocumentNode& node) const {
    error(Id::wrong_type, node.span, "the list is empty; it takes one value for each member of the family");
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

ExpressionPtr Entry::comparison(std::string_view key) const {
    return parsed(key, ValueType::comparison, parse_comparison).value_or(nullptr);
}

std::optional<Law> Entry::law(std::string_view key) const { return parsed(key, ValueType::law, parse_law); }

std::optional<Property> Entry::property(std::string_view key) const {
    const KeySpec* spec = find_key(section_, key);
    const DocumentNode* node = find(key, spec == nullptr ? ValueType::property : spec->type);
    if (node == nullptr) return std::nullopt;
    if (node->kind == NodeKind::string) return attempt([&] { return parse_property(node->string); });
    ExpressionPtr value = expression(*node, spec->type);
    return value ? std::optional(Property{{}, std::move(value), node->span}) : std::nullopt;
}

std::optional<Family> Entry::family(std::string_view key) const { return parsed(key, ValueType::family, parse_family); }

std::optional<Condition> Entry::condition(std::string_view key) const { return parsed(key, ValueType::condition, parse_condition); }

std::optional<Reference> Entry::reference(const DocumentNode& node, ValueType type, const std::string& what) const {
    const ExpressionPtr name = expression(node, type);
    if (!name) return std::nullopt;
    if (name->kind == Expression::Kind::name && name->children.size() <= 1)
        return Reference{name->name, name->children.empty() ? nullptr : name->children[0], name->span};
    const char* article = std::string_view("aeiou").find(what.front()) == std::string_view::npos ? "a" : "an";
    error(Id::wrong_type, node.span, fmt::format("'{}' is not the name of {} {}", name->written(), article, what));
    return std::nullopt;
}

std::optional<Reference> Entry::reference(std::string_view key, const std::string& what) const {
    const DocumentNode* node = find(key, ValueType::part);
    return node == nullptr ? std::nullopt : reference(*node, ValueType::part, what);
}

bool Entry::boolean(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::boolean);
    if (node != nullptr && node->kind != NodeKind::boolean) wrong_type(*node, ValueType::boolean);
    return node != nullptr && node->boolean;
}

std::optional<CoordinateEntry> Entry::coordinate(std::string_view key) const {
    const DocumentNode* node = find(key, ValueType::coordinate);
    const auto named = node == nullptr ? std::nullopt : reference(*node, ValueType::coordinate, "coordinate");
    return named ? std::optional(CoordinateEntry{named->name, named->index, nullptr, named->span}) : std::nullopt;
}

Excerpt Entry::name_excerpt() const { return key_excerpt(span_); }

std::optional<Excerpt> Entry::excerpt(std::string_view key) const {
    const KeySpec* spec = find_key(section_, key);
    const DocumentNode* node = find(key, spec != nullptr && spec->type == ValueType::choice ? ValueType::choice : ValueType::text);
    if (node == nullptr) return std::nullopt;
    if (node->kind == NodeKind::string) return node->string;
    wrong_type(*node, ValueType::text);
    return std::nullopt;
}

void Entry::fill(Item& item) const {
    item.name = name_;
    item.span = span_;
    if (find_key(section_, "doc") != nullptr) item.doc = text("doc");
    if (find_key(section_, "for") != nullptr) item.family = family("for");
    if (find_key(section_, "when") != nullptr) item.when = condition("when");
}

}  // namespace dalembert
