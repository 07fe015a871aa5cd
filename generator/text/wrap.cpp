// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/wrap.hpp"

namespace dalembert {

namespace {

constexpr std::size_t longest_line = 128;

}  // namespace

std::string shifted(const std::string& text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        result += "    " + text.substr(at, end - at) + "\n";
        at = end + 1;
    }
    return result;
}

std::string wrapped_list(const std::vector<std::string>& parts, std::size_t column) {
    std::string result, line(column, ' ');
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string part = parts[i] + (i + 1 < parts.size() ? "," : "");
        const bool is_first = line.find_first_not_of(' ') == std::string::npos;
        if (!is_first && line.size() + 1 + part.size() > longest_line) {
            result += line + "\n";
            line = std::string(column + 4, ' ') + part;
        } else {
            line += (is_first ? "" : " ") + part;
        }
    }
    return result + line;
}

std::string wrapped(const std::string& statement, std::size_t column) {
    const std::string blanks(column, ' ');
    std::string result;
    std::string rest = statement;
    bool first = true;
    while (true) {
        const std::size_t room = longest_line - column - (first ? 0 : 4);
        if (rest.size() <= room) break;
        // The last operator at the shallowest depth that still fits.
        std::size_t best = std::string::npos;
        int best_depth = 1000;
        int depth = 0;
        for (std::size_t i = 0; i + 2 < rest.size() && i < room; ++i) {
            if (rest[i] == '(' || rest[i] == '[') ++depth;
            if (rest[i] == ')' || rest[i] == ']') --depth;
            const bool is_operator = rest[i] == ' ' &&
                                     (rest[i + 1] == '+' || rest[i + 1] == '-' || rest[i + 1] == '*' || rest[i + 1] == '/') &&
                                     rest[i + 2] == ' ';
            if (is_operator && i > room / 3 && depth <= best_depth) {
                best = i;
                best_depth = depth;
            }
        }
        if (best == std::string::npos) break;
        result += blanks + (first ? "" : "    ") + rest.substr(0, best) + "\n";
        rest = rest.substr(best + 1);
        first = false;
    }
    return result + blanks + (first ? "" : "    ") + rest + "\n";
}

}  // namespace dalembert
