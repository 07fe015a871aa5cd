// SPDX-License-Identifier: GPL-3.0-or-later
#include "c/helpers.hpp"

#include <map>
#include <regex>
#include <stdexcept>
#include <vector>

#include "text/template.hpp"

namespace dalembert {

namespace {

/// What stands between "// begin NAME: needs" and "// end NAME".
struct Section {
    std::string name;
    std::vector<std::string> needs;
    std::string text;
    bool has_size;
};

class Library {
public:
    Library() {
        for (const char* file : {"math_functions", "scalar_functions", "angle_functions", "fluid_functions", "heat_functions",
                                 "heat_networks", "junctions", "series_functions", "ldlt"})
            read(std::string(embedded_file(std::string(file) + ".h.in")));
    }

    const Section& of_function(const std::string& function) const {
        const auto found = by_function_.find(function);
        if (found == by_function_.end()) throw std::logic_error("no function of runtime/c: " + function);
        return sections_.at(found->second);
    }
    const Section& section(const std::string& name) const { return sections_.at(name); }

private:
    void read(const std::string& text) {
        static const std::regex begin("// begin (\\w+):([ \\w,]*)\n"), word("\\w+"),
            function("static inline \\w+\\*? NAME_(\\w+?)(?:_SIZE)?\\(");
        for (std::sregex_iterator at(text.begin(), text.end(), begin), end; at != end; ++at) {
            Section section{(*at)[1], {}, {}, false};
            const std::string needs = (*at)[2];
            for (std::sregex_iterator need(needs.begin(), needs.end(), word); need != end; ++need) section.needs.push_back(need->str());
            const auto from = static_cast<std::size_t>(at->position() + at->length());
            section.text = text.substr(from, text.find("// end " + section.name + "\n", from) - from);
            section.has_size = section.text.find("_SIZE(") != std::string::npos;
            for (std::sregex_iterator one(section.text.begin(), section.text.end(), function); one != end; ++one)
                by_function_[(*one)[1]] = section.name;
            sections_[section.name] = std::move(section);
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
    Collector(const Library& library, std::string name) : library_(library), name_(std::move(name)) {}

    void add(const Section& section, std::size_t size) {
        const std::size_t own = section.has_size ? size : 0;
        if (!done_.insert({section.name, own}).second) return;
        for (const std::string& need : section.needs) add(library_.section(need), own);
        text_ += replaced(replaced(section.text, "SIZE", std::to_string(own)), "NAME", name_) + "\n";
    }
    std::string text() && { return std::move(text_); }

private:
    const Library& library_;
    std::string name_;
    std::set<CHelper> done_;
    std::string text_;
};

}  // namespace

std::string c_helper_source(const std::set<CHelper>& helpers, const std::string& name) {
    static const Library library;
    Collector collector(library, name);
    collector.add(library.section("real"), 0);
    for (const CHelper& helper : helpers) collector.add(library.of_function(helper.function), helper.size);
    return std::move(collector).text();
}

}  // namespace dalembert
