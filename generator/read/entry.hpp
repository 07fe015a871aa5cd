// SPDX-License-Identifier: GPL-3.0-or-later
// One entry of a model file ([bodies.rod], say), read key by key against the schema. Problems are collected, not thrown, so that
// one run reports all of them.
#pragma once

#include <map>
#include <optional>

#include "read/document.hpp"
#include "elements/model.hpp"
#include "elements/schema.hpp"

namespace dalembert {

class Entry {
public:
    /// Reports unknown and missing keys. `place` is what messages call it; "[bodies.rod]" if left out.
    Entry(const DocumentNode::Member& member, const SectionSpec& section, Diagnostics& diagnostics, std::string place = {});

    const std::string& name() const { return name_; }
    const Span& span() const { return span_; }
    bool has(std::string_view key) const { return find(key) != nullptr; }
    Span span_of(std::string_view key) const;
    void error(Id id, Span span, std::string message, std::vector<Note> notes = {}) const;

    /// What is absent or cannot be read comes back empty or as the value given.
    std::string text(std::string_view key) const;
    int whole_number(std::string_view key, int otherwise) const;
    std::optional<Rational> number(std::string_view key) const;
    /// In SI. Constants are taken in the unit, expressions with names are in SI already.
    ExpressionPtr constant(std::string_view key, const Unit& unit) const;
    /// Likewise, one or a list of them.
    MemberValues member_values(std::string_view key, const Unit& unit) const;
    std::optional<Unit> unit(std::string_view key) const;
    std::optional<Range> range(std::string_view key, const Unit& unit) const;
    ExpressionPtr expression(std::string_view key) const;
    /// "a < b": 1 where it holds, else -1.
    ExpressionPtr comparison(std::string_view key) const;
    std::optional<VectorExpression> vector(std::string_view key) const;
    bool is_list(std::string_view key) const;
    /// Of a list, whatever its elements are; 0 of what is none.
    std::size_t length(std::string_view key) const;
    std::vector<Turn> turns(std::string_view key) const;
    /// An expression alone, a row of three, or three rows of three.
    std::vector<std::vector<ExpressionPtr>> tensor(std::string_view key) const;
    std::optional<Law> law(std::string_view key) const;
    std::optional<Property> property(std::string_view key) const;
    std::vector<Equation> equations(std::string_view key) const;
    std::optional<Family> family(std::string_view key) const;
    std::optional<Condition> condition(std::string_view key) const;
    /// One or a list.
    std::vector<Condition> conditions(std::string_view key) const;
    NamesWithPlaces names(std::string_view key) const;
    /// `what` is the kind of thing that is named: "body".
    std::optional<Reference> reference(std::string_view key, const std::string& what) const;
    std::vector<Reference> references(std::string_view key, const std::string& what) const;
    std::vector<ExpressionPtr> expressions(std::string_view key) const;
    /// One or a list of two.
    std::vector<ExpressionPtr> one_or_two(std::string_view key) const;
    /// Null for what is left out as "?".
    std::vector<std::vector<ExpressionPtr>> matrix(std::string_view key) const;
    std::vector<std::vector<ExpressionPtr>> grid(std::string_view key) const;
    /// One expression for all as a table of one.
    std::vector<std::vector<ExpressionPtr>> table(std::string_view key) const;
    /// Also pieces: a length and the number of its cells.
    std::vector<std::array<ExpressionPtr, 2>> points(std::string_view key) const;
    bool boolean(std::string_view key) const;
    std::optional<CoordinateEntry> coordinate(std::string_view key) const;
    /// { NAME = expression } where the names are coordinates.
    std::vector<CoordinateEntry> coordinates(std::string_view key) const;
    /// Of a table: the text of each key, and the expression.
    std::vector<std::pair<Excerpt, ExpressionPtr>> by_text(std::string_view key) const;
    Excerpt name_excerpt() const;
    /// A text with the place of each of its characters.
    std::optional<Excerpt> excerpt(std::string_view key) const;
    std::vector<Excerpt> excerpts(std::string_view key) const;
    std::vector<RunEntry> by_name(std::string_view key) const;
    /// Likewise; of a list an entry for each value.
    std::vector<RunEntry> values_by_name(std::string_view key) const;
    std::vector<Plot> plots(std::string_view key) const;
    /// Calls read(part) for an inline table, an Entry by a schema of its own.
    template <class Read>
    void within(std::string_view key, const SectionSpec& section, const std::string& place, const Read& read) const {
        if (const DocumentNode* node = find(key)) inside(Entry({section.name, node->span, *node}, section, diagnostics_, place), read);
    }

    /// The same for each of a list of tables.
    template <class Read>
    void each(std::string_view key, const SectionSpec& section, const std::string& place, const Read& read) const {
        for (const DocumentNode* node : list(find(key, ValueType::tables), ValueType::tables))
            inside(Entry({section.name, node->span, *node}, section, diagnostics_, place), read);
    }

    /// The same for a table of tables, each with its name.
    template <class Read>
    void each_named(std::string_view key, const SectionSpec& section, const Read& read) const {
        const DocumentNode* node = table_of_tables(key);
        if (node == nullptr) return;
        for (const DocumentNode::Member& member : node->members) inside(Entry(member, section, diagnostics_), read);
    }

    /// name, span, doc, for, when
    void fill(Item& item) const;

private:
    template <class Read>
    void inside(const Entry& part, const Read& read) const {
        read(part);
        has_unknown_key_ = has_unknown_key_ || part.has_unknown_key_;
    }
    const DocumentNode* find(std::string_view key) const;
    const DocumentNode* find(std::string_view key, ValueType type) const;
    void wrong_type(const DocumentNode& node, ValueType expected) const;
    void empty_list(const DocumentNode& node) const;
    std::vector<RunEntry> by_name(std::string_view key, ValueType type) const;
    ExpressionPtr expression(const DocumentNode& node, ValueType type) const;
    std::optional<Reference> reference(const DocumentNode& node, ValueType type, const std::string& what) const;
    /// The elements of a list; none, with an error, where it is no list.
    ValueType alternative(std::string_view key, ValueType type) const;
    const DocumentNode* table_of_tables(std::string_view key) const;
    std::vector<const DocumentNode*> list(const DocumentNode* node, ValueType type) const;
    ExpressionPtr constant(const DocumentNode& node, const Unit& unit) const;
    ExpressionPtr bound(const DocumentNode& node, const Unit& unit) const;
    /// The text of a key, without its quotes.
    static Excerpt key_excerpt(const Span& span);
    /// The same of a key, in which names of parts are joined.
    static Excerpt key_excerpt(const DocumentNode::Member& member);
    /// What a text says in a small language of its own.
    template <class Value>
    std::optional<Value> parsed(std::string_view key, ValueType type, Value (*parse)(const Excerpt&)) const {
        const DocumentNode* node = find(key, type);
        if (node == nullptr) return std::nullopt;
        if (node->kind == DocumentNode::Kind::string) return attempt([&] { return parse(node->string); });
        wrong_type(*node, type);
        return std::nullopt;
    }
    /// Nothing where it fails; the problems are collected.
    template <class Parse>
    auto attempt(Parse parse) const -> std::optional<decltype(parse())> {
        try {
            return parse();
        } catch (const Failure& failure) {
            for (const Diagnostic& d : failure.diagnostics()) error(d.id, d.span, d.message, d.notes);
            return std::nullopt;
        }
    }

    std::string name_;
    Span span_;
    const SectionSpec& section_;
    Diagnostics& diagnostics_;
    std::map<std::string, const DocumentNode*, std::less<>> values_;
    mutable bool has_unknown_key_ = false;  ///< here or in a table inside: probably the misspelt one that is missing
};

}  // namespace dalembert
