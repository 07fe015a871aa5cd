// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/source.hpp"

#include <doctest/doctest.h>

#include "text/diagnostic.hpp"
#include "text/nearest.hpp"

using namespace dalembert;

TEST_CASE("positions count characters, not bytes") {
    const Source source("m.toml", "a\nb\xc3\xa9" "c\r\n");
    CHECK(source.position(0).line == 1);
    CHECK(source.position(5).line == 2);
    CHECK(source.position(5).column == 3);
    CHECK(source.offset({2, 3}) == 5);
    CHECK(source.line(2) == "b\xc3\xa9" "c");
    CHECK(source.offset({9, 1}) == source.text().size());
}

TEST_CASE("a diagnostic shows the line, a caret and the other place") {
    const auto source = std::make_shared<const Source>("m.toml", "mass = \"m + s\"\nm = 1\n");
    const std::string text = render({Id::unit_mismatch, {source, 8, 13}, "two units", {{{source, 15, 16}, "'m' is defined here"}}});
    CHECK(text ==
          "m.toml:1:9: error[unit-mismatch]: two units\n"
          "    1 | mass = \"m + s\"\n"
          "      |         ^^^^^\n"
          "m.toml:2:1: note: 'm' is defined here\n"
          "    2 | m = 1\n"
          "      | ^\n");
}

TEST_CASE("control characters never reach the terminal") {
    const auto source = std::make_shared<const Source>("m\033[2J.toml", "a\033[31mb");
    CHECK(render({Id::syntax, {source, 0, 1}, "bad\033[0m"}).find('\033') == std::string::npos);
}

TEST_CASE("nearest words") {
    CHECK(nearest("stifness", {"stiffness", "elongation"}) == "stiffness");
    CHECK(nearest("ab", {"ba"}) == "ba");
    CHECK(nearest("zzz", {"stiffness"}).empty());
    CHECK(quoted_list({"a", "b", "c"}) == "'a', 'b' and 'c'");
}
