// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/document.hpp"

#include <doctest/doctest.h>

using namespace dalembert;

TEST_CASE("order of writing, exact numbers, and the places of characters") {
    const auto source = std::make_shared<const Source>("m.toml",
                                                       "zeta = 1.50e-3\n"
                                                       "alpha = \"x\\u002By\"\n"
                                                       "[b]\n"
                                                       "literal = 'a\\b'\n"
                                                       "long = \"\"\"\n"
                                                       "first\\\n"
                                                       "   second\"\"\"\n");
    const DocumentNode root = parse_document(source);
    REQUIRE(root.members.size() == 3);
    CHECK(root.members[0].key == "zeta");
    CHECK(root.members[1].key == "alpha");
    CHECK(root.members[0].value.number == "1.50e-3");
    const Excerpt& escaped = root.members[1].value.string;
    CHECK(escaped.text == "x+y");
    CHECK(source->text()[escaped.offsets[0]] == 'x');
    CHECK(source->text()[escaped.offsets[1]] == '\\');
    CHECK(source->text()[escaped.offsets[2]] == 'y');
    const DocumentNode& b = root.members[2].value;
    CHECK(b.find("literal")->value.string.text == "a\\b");
    const Excerpt& lines = b.find("long")->value.string;
    CHECK(lines.text == "firstsecond");
    CHECK(source->text()[lines.offsets[5]] == 's');
    CHECK(lines.offsets.size() == lines.text.size() + 1);
}
