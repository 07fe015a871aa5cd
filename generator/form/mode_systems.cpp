// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/mode_systems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "form/input_kinks.hpp"
#include "text/budgets.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

using Systems = std::vector<std::unique_ptr<System>>;

[[noreturn]] void too_many(const Scene& scene) {
    const ModeGroup& last = *scene.mode_groups.back();
    throw Failure(Diagnostic{Id::too_large, last.span,
                             fmt::format("scene '{}' has more than {} possible modes, out of {} combinations, and this version derives no "
                                         "more: each mode of '{}' combines with each mode of the other groups",
                                         scene.name, budget::modes, scene.modes.size(), last.name)});
}

bool is_same_limit(const EventEquation& a, const EventEquation& b) { return a.name == b.name && a.doc == b.doc; }

/// A volume may have a limit in some modes only: where flows reach it. Each mode gets a place for all of them, behind the events of the
/// model.
void align_limits(const Systems& modes) {
    std::vector<EventEquation> limits;
    const auto find = [](std::vector<EventEquation>& events, const EventEquation& limit) {
        return std::find_if(events.begin(), events.end(),
                            [&](const EventEquation& e) { return e.item == nullptr && is_same_limit(e, limit); });
    };
    for (const auto& system : modes)
        for (const EventEquation& event : system->events)
            if (event.item == nullptr && find(limits, event) == limits.end()) limits.push_back(event);
    for (const auto& system : modes) {
        std::vector<EventEquation> aligned;
        std::copy_if(system->events.begin(), system->events.end(), std::back_inserter(aligned),
                     [](const EventEquation& e) { return e.item != nullptr; });
        for (const EventEquation& limit : limits) {
            const auto own = find(system->events, limit);
            aligned.push_back(own != system->events.end() ? *own
                                                          : EventEquation{nullptr, limit.name, limit.doc, true, false, 0, 0, {}, {}});
        }
        system->events = std::move(aligned);
    }
}

/// What is left of the modes, in all systems.
void renumber(const Systems& modes) {
    std::vector<SceneMode> kept;
    for (const auto& system : modes) kept.push_back(system->scene.modes[*system->scene.mode]);
    for (std::size_t i = 0; i < modes.size(); ++i) {
        modes[i]->scene.modes = kept;
        modes[i]->scene.mode = i;
    }
}

/// What is the same in several modes.
void tell_once(const Systems& modes) {
    std::set<std::pair<std::size_t, std::string>> told;
    for (const auto& system : modes)
        std::erase_if(system->warnings, [&](const Diagnostic& d) { return !told.insert({d.span.begin, d.message}).second; });
}

Systems modes_of(const Names& names, const Scene& scene) {
    Systems modes;
    if (scene.modes.empty()) {
        modes.push_back(derive(names, scene));
        return modes;
    }
    std::vector<std::pair<std::size_t, Failure>> overdetermined;
    std::vector<Diagnostic> left_out;
    for (std::size_t mode = 0; mode < scene.modes.size(); ++mode) {
        try {
            modes.push_back(derive(names, in_mode(scene, mode)));
            if (modes.size() > budget::modes) too_many(scene);
        } catch (const Failure& failure) {
            if (failure.diagnostics().front().id != Id::doubly_determined) throw;
            overdetermined.emplace_back(mode, failure);
            if (failure.diagnostics().front().severity == Severity::warning) left_out.push_back(failure.diagnostics().front());
        }
    }
    if (!overdetermined.empty()) {
        for (const ModeGroup* group : scene.mode_groups)
            for (const Mode& part : group->modes) {
                const auto is_left = [&](const auto& system) { return system->scene.modes[*system->scene.mode].is_in(part.name); };
                if (std::any_of(modes.begin(), modes.end(), is_left)) continue;
                const auto has_part = [&](const auto& failed) { return scene.modes[failed.first].is_in(part.name); };
                throw std::find_if(overdetermined.begin(), overdetermined.end(), has_part)->second;
            }
        renumber(modes);
        std::vector<Diagnostic>& warnings = modes.front()->warnings;
        warnings.insert(warnings.begin(), left_out.begin(), left_out.end());
    }
    tell_once(modes);
    align_limits(modes);
    return modes;
}

}  // namespace

std::vector<std::unique_ptr<System>> derive_modes(const Names& names, const Scene& scene) {
    Systems modes = modes_of(names, scene);
    if (scene.sampling == nullptr) find_time_switches(modes);
    return modes;
}

}  // namespace dalembert
