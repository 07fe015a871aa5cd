// SPDX-License-Identifier: GPL-3.0-or-later
// The entries of a catalogue against the models that they are about, each of which is derived once, and by themselves.
#pragma once

#include "book/printed_verdicts.hpp"
#include "printed/catalogue.hpp"

namespace dalembert {

class CatalogueVerdicts {
public:
    explicit CatalogueVerdicts(const Catalogue& catalogue, bool writes_derived = false)
        : catalogue_(catalogue), writes_derived_(writes_derived) {}

    using Visit = std::function<void(const System&, const PrintedEquation&)>;
    /// Every system that an entry is checked in, with the entry as it is checked there: none where there is nothing to check. Returns what
    /// of it is read. Throws Failure where the entry is not about its model.
    EntryParts each(const CatalogueEntry& entry, const Visit& visit);
    /// The rows of an entry: one, or of a family one for each member. Throws as `each`.
    std::vector<PrintedRow> check(const CatalogueEntry& entry);

private:
    void each_system(const CatalogueEntry& entry, const Visit& visit);
    /// A scene of a model with letters added, in all its modes.
    struct Derived {
        std::shared_ptr<const LoadedModel> loaded;
        std::vector<std::unique_ptr<System>> modes;
    };
    const Derived& derived(const CatalogueEntry& entry, const std::string& scene);
    const PrintedEquation& printed_in_model(const CatalogueEntry& entry);
    std::shared_ptr<const LoadedModel> loaded(const CatalogueEntry& entry);

    const Catalogue& catalogue_;
    bool writes_derived_;
    std::map<std::string, std::shared_ptr<const LoadedModel>> models_;
    std::map<std::string, Derived> derived_;
};

}  // namespace dalembert
