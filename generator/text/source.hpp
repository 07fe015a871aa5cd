// SPDX-License-Identifier: GPL-3.0-or-later
// Where something stands: a text with its name, and spans of it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dalembert {

/// Line and column, both from 1. The column counts characters (UTF-8 code points), as editors do.
struct Position {
    std::size_t line = 1;
    std::size_t column = 1;
};

struct WayIn;

/// A text that diagnostics can point into: a model file, or one argument of the command line.
class Source {
public:
    Source(std::string name, std::string text, std::shared_ptr<const WayIn> way_in = nullptr);

    const std::string& name() const { return name_; }
    const std::string& text() const { return text_; }
    Position position(std::size_t offset) const;
    /// The offset of a position; the end of the text when it lies behind it.
    std::size_t offset(Position position) const;
    /// The line (from 1) without its line break.
    std::string_view line(std::size_t number) const;
    /// Of a part that another file uses: where; null of all else.
    const WayIn* way_in() const { return way_in_.get(); }

private:
    std::string name_;
    std::string text_;
    std::vector<std::size_t> line_starts_;
    std::shared_ptr<const WayIn> way_in_;
};

using SourcePtr = std::shared_ptr<const Source>;

/// Bytes [begin, end) of a source. A span without source belongs to nothing in particular.
struct Span {
    SourcePtr source;
    std::size_t begin = 0;
    std::size_t end = 0;

    std::string_view text() const {
        return source ? std::string_view(source->text()).substr(begin, end - begin) : std::string_view();
    }
    explicit operator bool() const { return source != nullptr; }
};

/// The place that uses a file as a part, and the name that the part has there.
struct WayIn {
    Span place;
    std::string name;
};

/// From the begin of one span to the end of another in the same source.
inline Span cover(const Span& first, const Span& last) { return {first.source, first.begin, last.end}; }

/// How many characters (code points) a UTF-8 text has.
std::size_t character_count(std::string_view text);

}  // namespace dalembert
