// SPDX-License-Identifier: GPL-3.0-or-later
#include "cpp/helpers.hpp"

#include <vector>

#include "program/helper_files.hpp"
#include "text/marked_sections.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// Each behind those that it needs.
const std::vector<MarkedSection>& helpers() {
    static const std::vector<MarkedSection> all = [] {
        std::vector<MarkedSection> sections;
        for (const HelperFile& file : helper_files)
            if (file.is_in_cpp)
                for (MarkedSection& section : marked_sections(embedded_file(std::string(file.name) + ".hpp")))
                    sections.push_back(std::move(section));
        return sections;
    }();
    return all;
}

}  // namespace

std::string helper_source(std::set<std::string> names) {
    const auto& all = helpers();
    for (auto helper = all.rbegin(); helper != all.rend(); ++helper)
        if (names.contains(helper->name)) names.insert(helper->needs.begin(), helper->needs.end());
    std::string text;
    for (const MarkedSection& helper : all)
        if (names.contains(helper.name)) text += helper.text + "\n";
    return text;
}

}  // namespace dalembert
