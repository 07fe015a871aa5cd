// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/condition.hpp"

#include <doctest/doctest.h>

using namespace dalembert;

TEST_CASE("conditions") {
    const auto holds = [](const std::string& text, const std::set<std::string>& effects) {
        return parse_condition(excerpt_of(std::make_shared<const Source>("test", text))).holds(effects);
    };
    CHECK(holds("a", {"a"}));
    CHECK_FALSE(holds("a", {"b"}));
    CHECK(holds("not a", {}));
    CHECK(holds("a or b and c", {"a"}));
    CHECK_FALSE(holds("(a or b) and c", {"a"}));
    CHECK(holds("not (a and b)", {"a"}));
    CHECK(holds("not not a", {"a"}));
    for (const char* bad : {"", "and", "a b", "not", "(a", "a or", "a)"}) {
        CAPTURE(bad);
        CHECK_THROWS_AS(holds(bad, {}), Failure);
    }
}
