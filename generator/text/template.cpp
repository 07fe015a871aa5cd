// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/template.hpp"

#include <set>
#include <stdexcept>

namespace dalembert {

std::string_view embedded_file(std::string_view name) {
    for (const EmbeddedFile& file : embedded_files())
        if (file.name == name) return file.text;
    throw std::logic_error("no embedded file " + std::string(name));
}

std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values) {
    std::string result;
    std::set<std::string> used;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t open = text.find('@', at);
        if (open == std::string_view::npos) {
            result += text.substr(at);
            break;
        }
        const std::size_t close = text.find('@', open + 1);
        if (close == std::string_view::npos) throw std::logic_error("a template ends inside a placeholder");
        const std::string name(text.substr(open + 1, close - open - 1));
        const auto value = values.find(name);
        if (value == values.end()) throw std::logic_error("a template has a placeholder that nothing fills: " + name);
        result += text.substr(at, open - at);
        result += value->second;
        used.insert(name);
        at = close + 1;
    }
    for (const auto& [name, value] : values)
        if (!used.contains(name)) throw std::logic_error("a template has no place for " + name);
    return result;
}

std::map<std::string, std::string> values_for(std::string_view text, const std::map<std::string, std::string>& values) {
    std::map<std::string, std::string> some;
    for (const auto& value : values)
        if (text.find("@" + value.first + "@") != std::string_view::npos) some.insert(value);
    return some;
}

void fill_part(const char* name, std::string_view text, std::map<std::string, std::string>& values) {
    const std::map<std::string, std::string> own = values_for(text, values);
    std::string filled = fill_template(text, own);
    for (const auto& value : own) values.erase(value.first);
    values[name] = std::move(filled);
}

}  // namespace dalembert
