// SPDX-License-Identifier: GPL-3.0-or-later
// Names of parts in a file, and the files of parts.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "read/parts.hpp"
#include "text/budgets.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace {

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Keys of texts that hold no names.
bool is_plain_text(std::string_view key) {
    constexpr std::array<std::string_view, 5> keys{"doc", "source", "file", "column", "unit"};
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

class NameJoin {
public:
    explicit NameJoin(const std::vector<std::string>& parts) : parts_(parts) {}

    /// Sections, entries and their keys are `depth` 0, 1 and 2; deeper keys are names.
    void run(DocumentNode& node, int depth) const {
        if (node.kind == DocumentNode::Kind::string) join(node.string.text);
        for (DocumentNode& element : node.elements) run(element, depth + 1);
        std::vector<DocumentNode::Member> members;
        for (DocumentNode::Member& member : node.members) add(members, std::move(member), depth);
        node.members = std::move(members);
    }

private:
    void add(std::vector<DocumentNode::Member>& members, DocumentNode::Member member, int depth) const {
        const bool is_plain = depth == 0 ? member.key == "model" : depth == 2 && is_plain_text(member.key);
        if (is_plain) {
            members.push_back(std::move(member));
            return;
        }
        const bool is_name = depth > 2 && std::find(parts_.begin(), parts_.end(), member.key) != parts_.end();
        if (is_name && member.value.kind == DocumentNode::Kind::table && member.value.span.text().substr(0, 1) != "{") {
            for (DocumentNode::Member& inside : member.value.members)
                add(members, {member.key + "_" + inside.key, cover(member.key_span, inside.key_span), std::move(inside.value)}, depth);
            return;
        }
        join(member.key);
        run(member.value, depth + 1);
        members.push_back(std::move(member));
    }

    /// Points become underscores, so that every character keeps its place.
    void join(std::string& text) const {
        for (std::size_t at = text.find('.'); at != std::string::npos; at = text.find('.', at + 1)) {
            std::size_t begin = at;
            while (begin > 0 && is_letter(text[begin - 1])) --begin;
            const bool is_before_name = at + 1 < text.size() && std::isalpha(static_cast<unsigned char>(text[at + 1])) != 0;
            if (is_before_name && std::find(parts_.begin(), parts_.end(), text.substr(begin, at - begin)) != parts_.end()) text[at] = '_';
        }
    }

    const std::vector<std::string>& parts_;
};

}  // namespace

void join_names(DocumentNode& root, const std::vector<std::string>& parts) {
    if (!parts.empty()) NameJoin(parts).run(root, 0);
}

SourcePtr source_of_part(const DocumentNode::Member& use, const DocumentNode& file, const char* word) {
    namespace fs = std::filesystem;
    const SourcePtr& user = use.key_span.source;
    const fs::path path = (fs::path(user->name()).parent_path() / file.string.text).lexically_normal();
    const auto is_same = [&](const Source& other) {
        std::error_code error;
        return fs::path(other.name()).lexically_normal() == path || fs::equivalent(other.name(), path, error);
    };
    int depth = 0;
    std::vector<Note> way;
    for (const Source* outer = user.get(); outer != nullptr; ++depth) {
        const WayIn* in = outer->way_in();
        if (is_same(*outer))
            throw Failure(
                Diagnostic{Id::cyclic_definition, file.span,
                           fmt::format("'{}' is used as a {} of itself", path.filename().string(), word)});
        outer = in == nullptr ? nullptr : in->place.source.get();
    }
    if (depth > budget::part_depth)
        throw Failure(Diagnostic{Id::too_deep, file.span, fmt::format("parts are nested more than {} levels deep", budget::part_depth)});
    try {
        const SourcePtr read = read_text_file(path);
        return std::make_shared<const Source>(read->name(), read->text(), std::make_shared<const WayIn>(WayIn{use.key_span, use.key}));
    } catch (const Failure& failure) {
        const Diagnostic& first = failure.diagnostics().front();
        if (first.span) throw;
        throw Failure(Diagnostic{first.id, file.span,
                                 fmt::format("{}; the path of {} '{}' begins beside the file that uses it", first.message, word, use.key)});
    }
}

}  // namespace dalembert
