// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/shared.hpp"

#include <fmt/format.h>

#include <ostream>

#include "model/verdict.hpp"

namespace dalembert {

std::shared_ptr<const LoadedModel> loaded(const Options& options, Streams streams) {
    Diagnostics diagnostics;
    auto model = load(options.choice.model, diagnostics);
    for (const Diagnostic& warning : diagnostics.all()) streams.err << render(warning);
    return model;
}

Machine derived(const Options& options, Streams streams) {
    return derive_machine(loaded(options, streams), options.choice.scene, options.choice.sizes);
}

std::string summary(const std::vector<const AuditEntry*>& entries) {
    std::map<Verdict, int> counts;
    for (const AuditEntry* entry : entries) ++counts[entry->result.verdict];
    std::string text;
    for (const auto& [verdict, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, to_string(verdict));
    return text.empty() ? "none" : text;
}

std::vector<const AuditEntry*> pointers(const std::vector<AuditEntry>& entries) {
    std::vector<const AuditEntry*> result;
    for (const AuditEntry& entry : entries) result.push_back(&entry);
    return result;
}

void refuse_fields(const System& system, const char* verb) {
    for (const RodField& field : system.heat.fields)
        throw Failure(Diagnostic{Id::too_large, field.rod->span, fmt::format("the {} cells of rod '{}' are computed in a loop, and '{}' needs each by itself; choose fewer cells", field.geometry.cells(), field.rod->name, verb)});
}

}  // namespace dalembert
