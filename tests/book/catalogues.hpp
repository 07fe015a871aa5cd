// SPDX-License-Identifier: GPL-3.0-or-later
// The catalogues of printed equations, in order.
#pragma once

#include <filesystem>
#include <set>

#include "book/catalogue_verdicts.hpp"
#include "text/files.hpp"
#include "tier.hpp"

/// Calls visit(verdicts, entry) for all entries of systems/book; in the quick tier not for those of two catalogues that take as long as all
/// others.
template <class Visit>
void for_each_entry(Visit visit) {
    using namespace dalembert;
    std::set<std::filesystem::path> files;
    for (const auto& file : std::filesystem::directory_iterator(std::filesystem::path(SOURCE_DIR) / "systems" / "book"))
        if (file.path().extension() == ".toml") files.insert(file.path());
    for (const std::filesystem::path& file : files) {
        if (!is_full_tier() && (file.stem() == "4_1_heat_transfer" || file.stem() == "3_3_mass_and_momentum")) continue;
        Diagnostics diagnostics;
        const Catalogue catalogue = read_catalogue(read_text_file(file), diagnostics);
        CatalogueVerdicts verdicts(catalogue);
        for (const CatalogueEntry& entry : catalogue.entries) visit(verdicts, entry);
    }
}
