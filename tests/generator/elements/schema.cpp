// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/schema.hpp"

#include <doctest/doctest.h>

#include "read/document.hpp"

using namespace dalembert;

TEST_CASE("every key of the language has a reference and every example is TOML") {
    for (const SectionSpec& section : sections()) {
        CAPTURE(section.name);
        CHECK(language_reference(section.name).find(section.doc) != std::string::npos);
        for (const KeySpec& key : section.keys) CHECK(language_reference(std::string(section.name) + "." + key.name).find(key.doc) != std::string::npos);
        CHECK_NOTHROW(parse_document(std::make_shared<const Source>("example", section.example)));
    }
    CHECK(language_reference("nonsense").empty());
}
