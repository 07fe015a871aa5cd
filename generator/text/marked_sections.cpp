// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/marked_sections.hpp"

#include <regex>
#include <stdexcept>

namespace dalembert {

std::vector<MarkedSection> marked_sections(std::string_view text) {
    static const std::regex begin("// begin (\\w+):([ \\w,]*)\n"), word("\\w+");
    const std::string whole(text);
    std::vector<MarkedSection> sections;
    for (std::sregex_iterator at(whole.begin(), whole.end(), begin), end; at != end; ++at) {
        MarkedSection& section = sections.emplace_back();
        section.name = (*at)[1];
        const std::string needs = (*at)[2];
        for (std::sregex_iterator need(needs.begin(), needs.end(), word); need != end; ++need) section.needs.push_back(need->str());
        const auto from = static_cast<std::size_t>(at->position() + at->length());
        const std::size_t to = whole.find("// end " + section.name + "\n", from);
        if (to == std::string::npos) throw std::logic_error("a section that does not end: " + section.name);
        section.text = whole.substr(from, to - from);
    }
    return sections;
}

}  // namespace dalembert
