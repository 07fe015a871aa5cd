// SPDX-License-Identifier: GPL-3.0-or-later
// A TOML file as a tree in the order of writing, with the place of every key and value. Numbers stay decimal text, because a
// binary floating-point number is no longer what the user wrote.
#pragma once

#include <string>
#include <vector>

#include "language/lexer.hpp"

namespace dalembert {

struct DocumentNode {
    enum class Kind { table, array, string, number, boolean, other };
    struct Member;

    Kind kind = Kind::other;
    Span span;
    std::vector<Member> members;              ///< of a table, in the order of writing
    std::vector<DocumentNode> elements;       ///< of an array
    Excerpt string = {};                      ///< of a string: its text without quotes and escapes
    std::string number = {};                  ///< of a number: as written
    bool boolean = false;

    const Member* find(std::string_view key) const;
};

struct DocumentNode::Member {
    std::string key;
    Span key_span;
    DocumentNode value;
};

/// "a table", "a number", ...
const char* describe(DocumentNode::Kind kind);

/// Throws Failure (toml-syntax).
DocumentNode parse_document(const SourcePtr& source);

}  // namespace dalembert
