// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/schema.hpp"

#include <doctest/doctest.h>

#include <set>

#include "read/document.hpp"

using namespace dalembert;

TEST_CASE("every key of the language has a sentence or words to choose from, and every example is TOML") {
    for (const SectionSpec& section : sections()) {
        CAPTURE(section.name);
        CHECK(*section.doc != '\0');
        for (const KeySpec& key : section.keys) {
            CAPTURE(key.name);
            CHECK((!key.doc.empty() || !key.lines.empty()));
        }
        CHECK_NOTHROW(parse_document(std::make_shared<const Source>("example", section.example)));
    }
}

TEST_CASE("every section belongs to one domain") {
    std::set<std::string> seen;
    for (const Domain& domain : domains())
        for (const SectionSpec* section : sections_of(domain)) CHECK(seen.insert(section->name).second);
    CHECK(seen.size() == sections().size());
}

TEST_CASE("units of keys: those of the element itself are U") {
    const auto unit = [](const char* section, const char* key) { return find_key(*find_section(section), key)->unit; };
    CHECK(unit("bodies", "mass") == "kg");
    CHECK(unit("links", "conductance") == "W/K");
    CHECK(unit("parameters", "value") == "U");
    CHECK(unit("coordinates", "start_rate") == "U/s");
    CHECK(unit("states", "derivative") == "U/s");
    CHECK(unit("springs", "stiffness") == "J/U^2");
    CHECK(unit("generalised_forces", "force") == "J/U");
}
