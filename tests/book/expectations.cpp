// SPDX-License-Identifier: GPL-3.0-or-later
// A verdict comes from the derivation: without what is expected of them, entries get the same.
#include <doctest/doctest.h>

#include "book/catalogues.hpp"

using namespace dalembert;

TEST_CASE("verdicts do not depend on what is expected") {
    int compared = 0;
    for_each_entry([&](CatalogueVerdicts& verdicts, const CatalogueEntry& entry) {
        if (!entry.expected) return;
        CatalogueEntry unexpected = entry;
        unexpected.expected.reset();
        CatalogueEntry otherwise = entry;
        otherwise.expected = Verdict::proven;
        const auto rows = verdicts.check(entry);
        INFO(entry.name);
        for (const CatalogueEntry& other : {unexpected, otherwise}) {
            const auto again = verdicts.check(other);
            REQUIRE(again.size() == rows.size());
            for (std::size_t i = 0; i < rows.size(); ++i) {
                CHECK(again[i].verdict() == rows[i].verdict());
                CHECK(again[i].difference == rows[i].difference);
            }
        }
        ++compared;
    });
    CHECK(compared > 20);
}

TEST_CASE("what is wrong comes with numbers to see it by") {
    for_each_entry([](CatalogueVerdicts& verdicts, const CatalogueEntry& entry) {
        if (entry.expected != Verdict::wrong) return;
        for (const PrintedRow& row : verdicts.check(entry)) {
            INFO(row.id);
            CHECK(row.counterexample.has_value());
        }
    });
}
