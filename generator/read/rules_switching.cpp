// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "read/rules.hpp"
#include "text/nearest.hpp"

namespace dalembert {

void check_rules(const Entry& e, ModeGroup& group) {
    const auto final = e.names("final");
    for (const auto& [name, span] : e.names("modes")) {
        Mode mode;
        mode.name = name;
        mode.span = span;
        mode.when = group.when;
        mode.is_final = std::any_of(final.begin(), final.end(), [&, wanted = name](const auto& f) { return f.first == wanted; });
        group.modes.push_back(std::move(mode));
    }
    if (group.modes.size() < 2)
        e.error(Id::wrong_modes, e.span(),
                fmt::format("'{}' has {}; a group needs at least two modes", e.name(), group.modes.empty() ? "no mode" : "one mode"));
    std::vector<std::string> known;
    for (const Mode& mode : group.modes) known.push_back(mode.name);
    for (const auto& [name, span] : final)
        if (std::find(known.begin(), known.end(), name) == known.end())
            e.error(Id::unknown_name, span, fmt::format("'{}' is no mode of '{}'; its modes are {}", name, e.name(), quoted_list(known)));
}

void check_rules(const Entry& e, Event& event) {
    if (event.ends && (e.has("next") || e.has("reset") || e.has("rest") || e.has("meets")))
        e.error(Id::wrong_modes, e.span_of("ends"),
                fmt::format("event '{}' ends the run, so it cannot lead to a mode or reset anything", e.name()));
}

void check_rules(const Entry& e, Profile& profile) {
    for (const Phase& phase : profile.phases) {
        const bool is_last = &phase == &profile.phases.back();
        if (!is_last && !phase.until)
            e.error(Id::missing_key, phase.span,
                    fmt::format("phase '{}' of profile '{}' needs 'until', the time of its end: only the last phase has no end", phase.name,
                                e.name()));
        const auto lasts = [&](const Span& span, const char* key) {
            e.error(Id::unknown_key, span,
                    fmt::format("phase '{}' is the last one of profile '{}' and has no end; leave out '{}'", phase.name, e.name(), key));
        };
        if (is_last && phase.until) lasts(phase.until->span, "until");
        if (is_last && !phase.reset.empty()) lasts(phase.reset.front().span, "reset");
    }
    if (profile.phases.size() < 2) e.error(Id::wrong_modes, e.span(), fmt::format("profile '{}' needs two phases or more", e.name()));
}

}  // namespace dalembert
