// SPDX-License-Identifier: GPL-3.0-or-later
// Names that nobody defined, and of which the text shows where they come from.
#include <fmt/format.h>

#include <array>

#include "check/checks.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

struct SmallLetter {
    std::string_view prefix, name, printed, is_called;
};
constexpr std::array<SmallLetter, 2> small_letters{{{"d_", "d", "d", "a differential"}, {"delta_", "delta", "\\delta", "a variation"}}};

constexpr std::array<std::string_view, 8> marks{"_bold", "_vec", "_hat", "_bar", "_tilde", "_cal", "_over", "_under"};

/// Where the mark stands in a name, as the last or before an index.
std::size_t place_of(std::string_view mark, const std::string& name) {
    const std::size_t at = name.find(mark);
    const bool is_whole = at != std::string::npos && (at + mark.size() == name.size() || name[at + mark.size()] == '_');
    return is_whole ? at : std::string::npos;
}

}  // namespace

std::string hint_for_unknown(const Expression& e, const Names& names) {
    const std::string printed = e.written();
    for (const SmallLetter& letter : small_letters) {
        if (!e.name.starts_with(letter.prefix) || !printed.starts_with(letter.printed) || printed == e.name) continue;
        if (names.find(letter.name) == nullptr) continue;
        std::string rest = printed.substr(letter.printed.size());
        rest.erase(0, rest.find_first_not_of(' '));
        return fmt::format("; '{}' is read as {}. For {} times {} write {}\\,{}", printed, letter.is_called, letter.printed, rest,
                           letter.printed, rest);
    }
    if (printed.find('\\') == std::string::npos) return did_you_mean(e.name, names.all());
    for (const std::string_view mark : marks) {
        const std::size_t at = place_of(mark, e.name);
        if (at == std::string::npos) continue;
        std::string plain = e.name;
        plain.erase(at, mark.size());
        const bool has_dot = printed.starts_with("\\dot") || printed.starts_with("\\ddot");
        return fmt::format("; write with = {{ {} = \"...\" }}{}", e.name,
                           has_dot ? "" : fmt::format(", or '{}' = \"{}\" under [notation]", printed, plain));
    }
    return did_you_mean(e.name, names.all());
}

}  // namespace dalembert
