// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "text/budgets.hpp"

namespace dalembert {

namespace {

Position position(const toml::source_position& p) { return {p.line, p.column}; }

class Converter {
public:
    explicit Converter(SourcePtr source) : source_(std::move(source)) {}

    Span span(const toml::source_region& region) const {
        return {source_, source_->offset(position(region.begin)), source_->offset(position(region.end))};
    }

    DocumentNode node(const toml::node& from, int depth = 0) const {
        DocumentNode result;
        result.span = span(from.source());
        if (depth > budget::nested_values)
            throw Failure(Diagnostic{Id::too_deep, result.span,
                                     fmt::format("tables and lists are nested more than {} levels deep", budget::nested_values)});
        if (const toml::table* table = from.as_table()) {
            result.kind = DocumentNode::Kind::table;
            for (const auto& [key, value] : *table)
                result.members.push_back({std::string(key.str()), span(key.source()), node(value, depth + 1)});
            // toml++ sorts keys by name; the order of writing is the order of declaration.
            std::stable_sort(result.members.begin(), result.members.end(),
                             [](const auto& a, const auto& b) { return a.key_span.begin < b.key_span.begin; });
        } else if (const toml::array* array = from.as_array()) {
            result.kind = DocumentNode::Kind::array;
            for (const toml::node& element : *array) result.elements.push_back(node(element, depth + 1));
        } else if (from.is_string()) {
            result.kind = DocumentNode::Kind::string;
            result.string = string(result.span, from.as_string()->get());
        } else if (from.is_number()) {
            result.kind = DocumentNode::Kind::number;
            result.number = std::string(result.span.text());
        } else if (from.is_boolean()) {
            result.kind = DocumentNode::Kind::boolean;
            result.boolean = from.as_boolean()->get();
        }
        return result;
    }

private:
    /// Finds for every byte of the string's value the byte of the file that it came from.
    Excerpt string(const Span& token, const std::string& value) const {
        const std::string_view raw = token.text();
        const bool multi_line = raw.starts_with("\"\"\"") || raw.starts_with("'''");
        const bool literal = raw.starts_with('\'');
        std::size_t i = multi_line ? 3 : 1;
        if (multi_line && raw.substr(i).starts_with("\r\n")) i += 2;
        else if (multi_line && raw.substr(i).starts_with('\n')) i += 1;

        Excerpt excerpt{source_, value, {}};
        excerpt.offsets.reserve(value.size() + 1);
        while (excerpt.offsets.size() < value.size() && i < raw.size()) {
            if (literal || raw[i] != '\\') {
                excerpt.offsets.push_back(token.begin + i++);
                continue;
            }
            const std::size_t escape = i++;
            const char kind = raw[i++];
            const std::size_t digits = kind == 'u' ? 4 : kind == 'U' ? 8 : 0;
            if (kind == '\n' || kind == '\r' || kind == ' ' || kind == '\t') {  // a line-ending backslash swallows white space
                while (i < raw.size() && (raw[i] == ' ' || raw[i] == '\t' || raw[i] == '\n' || raw[i] == '\r')) ++i;
                continue;
            }
            i += digits;
            excerpt.offsets.push_back(token.begin + escape);
            // The remaining bytes of a character written as \uXXXX all come from that escape.
            while (excerpt.offsets.size() < value.size() &&
                   (static_cast<unsigned char>(value[excerpt.offsets.size()]) & 0xC0U) == 0x80U)
                excerpt.offsets.push_back(token.begin + escape);
        }
        const std::size_t close = token.end > token.begin ? token.end - (multi_line ? 3 : 1) : token.end;
        excerpt.offsets.resize(value.size() + 1, close);
        return excerpt;
    }

    SourcePtr source_;
};

/// What to do about a value around this place that is an expression without quotes; nothing where it is none.
std::string unquoted(const std::string& text, std::size_t place) {
    const std::size_t line = place == 0 ? 0 : text.rfind('\n', place - 1) + 1;
    const std::size_t equals = text.rfind('=', std::min(place, text.size() - 1));
    if (text.empty() || equals == std::string::npos || equals < line) return {};
    const std::size_t begin = text.find_first_not_of(" \t", equals + 1);
    if (begin == std::string::npos) return {};
    const std::string value = text.substr(begin, text.find_first_of(",}#\n", begin) - begin);
    const std::string trimmed = value.substr(0, value.find_last_not_of(" \t\r") + 1);
    const bool is_expression = !trimmed.empty() && trimmed.find_first_of("\"'[{=") == std::string::npos &&
                               trimmed.find_first_of("abcdfghijklmnopqrstuvwxyzABCDFGHIJKLMNOPQRSTUVWXYZ*/^(") != std::string::npos;
    return is_expression ? "; an expression stands in quotes: \"" + trimmed + "\"" : std::string();
}

}  // namespace

const DocumentNode::Member* DocumentNode::find(std::string_view key) const {
    const auto found = std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.key == key; });
    return found == members.end() ? nullptr : &*found;
}

const char* describe(DocumentNode::Kind kind) {
    switch (kind) {
        case DocumentNode::Kind::table: return "a table";
        case DocumentNode::Kind::array: return "a list";
        case DocumentNode::Kind::string: return "a text";
        case DocumentNode::Kind::number: return "a number";
        case DocumentNode::Kind::boolean: return "true or false";
        case DocumentNode::Kind::other: break;
    }
    return "a date";
}

DocumentNode parse_document(const SourcePtr& source) {
    const Converter converter(source);
    try {
        return converter.node(toml::parse(std::string_view(source->text()), std::string_view(source->name())));
    } catch (const toml::parse_error& error) {
        Span span = converter.span(error.source());
        const std::string hint = unquoted(source->text(), span.begin);
        throw Failure(
            Diagnostic{Id::toml_syntax, std::move(span), "the file is not valid TOML: " + std::string(error.description()) + hint});
    }
}

}  // namespace dalembert
