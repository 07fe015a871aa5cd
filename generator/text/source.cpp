// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/source.hpp"

#include <algorithm>

namespace dalembert {

namespace {
bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }
}  // namespace

std::size_t character_count(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_character));
}

Source::Source(std::string name, std::string text, std::shared_ptr<const WayIn> way_in)
    : name_(std::move(name)), text_(std::move(text)), line_starts_{0}, way_in_(std::move(way_in)) {
    for (std::size_t i = 0; i < text_.size(); ++i)
        if (text_[i] == '\n') line_starts_.push_back(i + 1);
}

Position Source::position(std::size_t offset) const {
    offset = std::min(offset, text_.size());
    const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
    const auto line = static_cast<std::size_t>(next - line_starts_.begin());
    const std::size_t start = line_starts_[line - 1];
    return {line, character_count(std::string_view(text_).substr(start, offset - start)) + 1};
}

std::size_t Source::offset(Position position) const {
    if (position.line == 0 || position.line > line_starts_.size()) return text_.size();
    std::size_t at = line_starts_[position.line - 1];
    for (std::size_t column = 1; column < position.column && at < text_.size(); ++column) {
        ++at;
        while (at < text_.size() && !starts_character(text_[at])) ++at;
    }
    return at;
}

std::string_view Source::line(std::size_t number) const {
    if (number == 0 || number > line_starts_.size()) return {};
    const std::size_t begin = line_starts_[number - 1];
    std::size_t end = number < line_starts_.size() ? line_starts_[number] - 1 : text_.size();
    if (end > begin && text_[end - 1] == '\r') --end;
    return std::string_view(text_).substr(begin, end - begin);
}

}  // namespace dalembert
