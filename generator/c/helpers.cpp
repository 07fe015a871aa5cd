// SPDX-License-Identifier: GPL-3.0-or-later
#include "c/helpers.hpp"

#include <map>
#include <regex>
#include <stdexcept>
#include <vector>

#include "program/helper_files.hpp"
#include "text/marked_sections.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

struct Section {
    MarkedSection marked;
    bool has_size;
};

class Library {
public:
    Library() {
        for (const HelperFile& file : helper_files)
            if (file.is_in_c) read(embedded_file(std::string(file.name) + ".h.in"));
    }

    const Section& of_function(const std::string& function) const {
        const auto found = by_function_.find(function);
        if (found == by_function_.end()) throw std::logic_error("no function of runtime/c: " + function);
        return sections_.at(found->second);
    }
    const Section& section(const std::string& name) const { return sections_.at(name); }

private:
    void read(std::string_view file) {
        static const std::regex function("static inline \\w+\\*? NAME_(\\w+?)(?:_SIZE)?\\(");
        for (MarkedSection& marked : marked_sections(file)) {
            for (std::sregex_iterator one(marked.text.begin(), marked.text.end(), function), end; one != end; ++one)
                by_function_[(*one)[1]] = marked.name;
            const bool has_size = marked.text.find("_SIZE(") != std::string::npos;
            const std::string name = marked.name;
            sections_[name] = {std::move(marked), has_size};
        }
    }

    std::map<std::string, Section> sections_;
    std::map<std::string, std::string> by_function_;
};

std::string replaced(std::string text, const std::string& word, const std::string& by) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size())) text.replace(at, word.size(), by);
    return text;
}

class Collector {
public:
    explicit Collector(const Library& library) : library_(library) {}

    void add(const Section& section, std::size_t size) {
        const std::size_t own = section.has_size ? size : 0;
        if (!done_.insert({section.marked.name, own}).second) return;
        for (const std::string& need : section.marked.needs) add(library_.section(need), own);
        sections_.push_back({section.marked.name, replaced(section.marked.text, "SIZE", std::to_string(own))});
    }
    std::vector<CHelperSection> sections() && { return std::move(sections_); }

private:
    const Library& library_;
    std::set<CHelper> done_;
    std::vector<CHelperSection> sections_;
};

}  // namespace

std::vector<CHelperSection> c_helper_sections(const std::set<CHelper>& helpers) {
    static const Library library;
    Collector collector(library);
    collector.add(library.section("real"), 0);
    for (const CHelper& helper : helpers) collector.add(library.of_function(helper.function), helper.size);
    return std::move(collector).sections();
}

std::string c_helper_source(const std::set<CHelper>& helpers, const std::string& name) {
    std::string text;
    for (const CHelperSection& section : c_helper_sections(helpers)) text += replaced(section.text, "NAME", name) + "\n";
    return text;
}

}  // namespace dalembert
