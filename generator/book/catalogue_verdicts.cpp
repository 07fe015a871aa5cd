// SPDX-License-Identifier: GPL-3.0-or-later
#include "book/catalogue_verdicts.hpp"

#include <fmt/format.h>

#include "elements/model.hpp"
#include "elements/runs.hpp"
#include "form/letters_system.hpp"
#include "form/mode_systems.hpp"
#include "text/guardian.hpp"
#include "text/nearest.hpp"

namespace dalembert {

std::shared_ptr<const LoadedModel> CatalogueVerdicts::loaded(const CatalogueEntry& entry) {
    const std::filesystem::path path = (std::filesystem::path(catalogue_.source->name()).parent_path() / entry.model).lexically_normal();
    auto& known = models_[path.string()];
    if (known) return known;
    if (!std::filesystem::is_regular_file(path))
        fail(Id::unreadable_file, entry.model_span,
             fmt::format("entry '{1}' names the model '{0}', but there is no such file", entry.model, entry.name));
    Diagnostics warnings;
    return known = load(path, warnings);
}

/// Letters that the model does not have are parameters that nothing in it depends on.
const CatalogueVerdicts::Derived& CatalogueVerdicts::derived(const CatalogueEntry& entry, const std::string& scene) {
    auto base = loaded(entry);
    try {
        resolve_scene(base->model, scene);
    } catch (const Failure& failure) {
        fail(failure.diagnostics().front().id, entry.scene_span, failure.diagnostics().front().message);
    }
    Model extended = with_letters(catalogue_, entry, &base->model);
    const std::size_t first = base->model.parameters.size();
    std::string key = entry.model + "\n" + scene;
    for (std::size_t i = first; i < extended.parameters.size(); ++i)
        key +=
            fmt::format("\n{}:{}:{}", extended.parameters[i].name, extended.parameters[i].span.begin, extended.parameters[i].unit.written);
    if (extended.coordinates.size() > base->model.coordinates.size())
        fail(Id::not_allowed_here, extended.coordinates.back().span,
             fmt::format("'{}' is a function of time, but model '{}' has no such coordinate", extended.coordinates.back().name,
                         base->model.name));
    auto& result = derived_[key];
    if (!result.loaded) {
        const bool has_letters = extended.parameters.size() > first;
        result.loaded = has_letters ? std::make_shared<const LoadedModel>(std::move(extended)) : base;
        result.modes = derive_systems(*result.loaded, scene, first);
    }
    return result;
}

const PrintedEquation& CatalogueVerdicts::printed_in_model(const CatalogueEntry& entry) {
    const Model& model = loaded(entry)->model;
    const std::string& name = entry.printed.empty() ? entry.name : entry.printed;
    std::vector<std::string> known;
    for (const PrintedEquation& printed : model.printed) {
        if (printed.name == name) return printed;
        known.push_back(printed.name);
    }
    fail(Id::unknown_name, entry.span,
         fmt::format("entry '{}' has no equation, and model '{}' prints no '{}'{}", entry.name, model.name, name,
                     did_you_mean(name, known)));
}

namespace {

/// What the catalogue says of an equation goes before what the model says.
void take_over(const CatalogueEntry& entry, PrintedEquation& printed) {
    printed.name = entry.name;
    if (!entry.source.empty()) printed.source = entry.source;
    if (!entry.doc.empty()) printed.doc = entry.doc;
    if (entry.expected) printed.expected = entry.expected;
}

}  // namespace

EntryParts CatalogueVerdicts::each(const CatalogueEntry& written, const Visit& visit) {
    if (!written.unreadable.empty()) throw Failure(written.unreadable);
    if (!written.not_checkable.empty()) return {};
    EntryParts parts;
    for (const CatalogueEntry& entry : with_equations(catalogue_, written, written.model.empty() ? nullptr : &loaded(written)->model)) {
        each_system(entry, visit);
        parts = entry.parts;
    }
    return parts;
}

void CatalogueVerdicts::each_system(const CatalogueEntry& entry, const Visit& visit) {
    Diagnostics diagnostics;
    if (entry.model.empty()) {
        const LoadedModel letters(with_letters(catalogue_, entry, nullptr));
        const PrintedEquation checked = checked_entry(catalogue_, entry, letters.model, diagnostics);
        diagnostics.stop_on_errors();
        visit(*letters_alone(letters.names, letters.model), checked);
        return;
    }
    const PrintedEquation* printed = entry.equations.empty() ? &printed_in_model(entry) : nullptr;
    std::vector<std::string> scenes{entry.scene};
    if (printed != nullptr && entry.scene.empty()) scenes = scene_names(loaded(entry)->model);
    bool is_mode = entry.mode.empty();
    std::vector<std::string> known;
    for (const std::string& scene : scenes) {
        const Derived& machine = derived(entry, scene);
        PrintedEquation checked = printed != nullptr ? *printed : checked_entry(catalogue_, entry, machine.loaded->model, diagnostics);
        diagnostics.stop_on_errors();
        take_over(entry, checked);
        for (const auto& system : machine.modes) {
            if (system->scene.mode) known.push_back(system->scene.modes[*system->scene.mode].name);
            if (!entry.mode.empty() && (known.empty() || known.back() != entry.mode)) continue;
            is_mode = true;
            visit(*system, checked);
        }
    }
    if (!is_mode)
        fail(Id::unknown_name, entry.span,
             known.empty()
                 ? fmt::format("the model of entry '{}' has no modes, and so no mode '{}'", entry.name, entry.mode)
                 : fmt::format("the model of entry '{}' has no mode '{}'; its modes are {}", entry.name, entry.mode, quoted_list(known)));
}

std::vector<PrintedRow> CatalogueVerdicts::check(const CatalogueEntry& entry) {
    enter_stage(fmt::format("the check of '{}'", entry.name));
    PrintedVerdicts verdicts(writes_derived_);
    if (!entry.unreadable.empty()) throw Failure(entry.unreadable);
    if (!entry.not_checkable.empty()) verdicts.add_unchecked(entry, entry.not_checkable);
    const Model* const model = entry.model.empty() || !entry.latex ? nullptr : &loaded(entry)->model;
    const EntryParts parts = each(entry, [&](const System& system, const PrintedEquation& checked) {
        std::optional<LatexText> text;
        if (entry.latex) text.emplace(catalogue_, entry, model, checked);
        verdicts.add(system, checked, text ? &*text : nullptr);
    });
    std::vector<PrintedRow> rows = verdicts.rows();
    for (PrintedRow& row : rows) row.parts = parts;
    return rows;
}

}  // namespace dalembert
