// SPDX-License-Identifier: GPL-3.0-or-later
// A verdict comes from the derivation: without what is expected of them, entries get the same.
#include <doctest/doctest.h>

#include <filesystem>
#include <set>

#include "command/catalogue_verdicts.hpp"
#include "text/files.hpp"

using namespace dalembert;
namespace fs = std::filesystem;

TEST_CASE("verdicts do not depend on what is expected") {
    std::set<fs::path> files;
    for (const auto& file : fs::directory_iterator(fs::path(SOURCE_DIR) / "systems" / "book")) files.insert(file.path());
    int compared = 0;
    for (const fs::path& file : files) {
        Diagnostics diagnostics;
        const Catalogue catalogue = read_catalogue(read_text_file(file), diagnostics);
        CatalogueVerdicts verdicts(catalogue);
        for (const CatalogueEntry& entry : catalogue.entries) {
            if (!entry.expected) continue;
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
        }
    }
    CHECK(compared > 20);
}

TEST_CASE("what is wrong comes with numbers to see it by") {
    std::set<fs::path> files;
    for (const auto& file : fs::directory_iterator(fs::path(SOURCE_DIR) / "systems" / "book")) files.insert(file.path());
    for (const fs::path& file : files) {
        Diagnostics diagnostics;
        const Catalogue catalogue = read_catalogue(read_text_file(file), diagnostics);
        CatalogueVerdicts verdicts(catalogue);
        for (const CatalogueEntry& entry : catalogue.entries) {
            if (entry.expected != Verdict::wrong) continue;
            for (const PrintedRow& row : verdicts.check(entry)) {
                INFO(row.id);
                CHECK(row.counterexample.has_value());
            }
        }
    }
}
