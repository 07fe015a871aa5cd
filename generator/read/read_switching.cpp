// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/read_switching.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/nearest.hpp"

namespace dalembert {

namespace {

void needs_one(const Entry& e, const char* what, const char* a, const char* b) {
    if (e.has(a) == e.has(b)) e.error(Id::missing_key, e.span(), fmt::format("{} '{}' needs either a {} or a {}, and not both", what, e.name(), a, b));
}

}  // namespace

void read(const Entry& e, ModeGroup& group) {
    const auto final = e.names("final");
    for (const auto& [name, span] : e.names("modes")) {
        Mode mode;
        mode.name = name;
        mode.span = span;
        mode.when = group.when;
        mode.is_final = std::any_of(final.begin(), final.end(), [&, wanted = name](const auto& f) { return f.first == wanted; });
        group.modes.push_back(std::move(mode));
    }
    if (group.modes.size() < 2) e.error(Id::wrong_modes, e.span(), fmt::format("'{}' has {}; modes are at least two, of which one holds", e.name(), group.modes.empty() ? "no mode" : "one mode"));
    std::vector<std::string> known;
    for (const Mode& mode : group.modes) known.push_back(mode.name);
    for (const auto& [name, span] : final)
        if (std::find(known.begin(), known.end(), name) == known.end()) e.error(Id::unknown_name, span, fmt::format("'{}' is no mode of '{}'; its modes are {}", name, e.name(), quoted_list(known)));
}

void read(const Entry& e, Constraint& constraint) {
    constraint.rate = e.expression("rate");
    constraint.position = e.expression("position");
    needs_one(e, "constraint", "rate", "position");
    if (const auto coordinate = e.coordinate("eliminates")) constraint.eliminates = Reference{coordinate->coordinate, coordinate->index, coordinate->span};
    constraint.multiplier = e.boolean("multiplier");
    if (constraint.eliminates && constraint.multiplier)
        e.error(Id::unknown_key, e.span_of("eliminates"), fmt::format("constraint '{}' either eliminates a coordinate or has a multiplier, and not both", e.name()));
}

void read(const Entry& e, Event& event) {
    event.guard = e.expression("guard");
    const std::string direction = e.text("direction");
    event.rises = direction == "rising";
    if (!direction.empty() && direction != "rising" && direction != "falling")
        e.error(Id::wrong_type, e.span_of("direction"), fmt::format("the direction is 'falling' or 'rising', not '{}'", direction));
    event.ends = e.boolean("ends");
    event.reset = e.by_name("reset");
    event.meets = e.constraint("meets");
    event.restitution = e.expression("restitution");
    event.next = e.conditions("next");
    event.rest = e.conditions("rest");
    event.rest_reset = e.by_name("rest_reset");
    if (event.ends && (e.has("next") || e.has("reset") || e.has("rest") || e.has("meets")))
        e.error(Id::wrong_modes, e.span_of("ends"), fmt::format("event '{}' ends the run, so that nothing follows it", e.name()));
    if (e.has("restitution") && !e.has("meets")) e.error(Id::missing_key, e.span_of("restitution"), fmt::format("event '{}' has a restitution, but meets no constraint", e.name()));
    if (e.has("rest_reset") && !e.has("rest")) e.error(Id::missing_key, e.span_of("rest_reset"), fmt::format("event '{}' says what is reset at rest, but not to which mode that leads: it needs 'rest'", e.name()));
}

void read(const Entry& e, Friction& friction) {
    friction.rate = e.expression("rate");
    friction.normal_force = e.expression("normal_force");
    friction.coefficient = e.expression("coefficient");
    friction.static_coefficient = e.expression("static_coefficient");
}

void read(const Entry& e, Stop& stop) {
    stop.gap = e.expression("gap");
    stop.restitution = e.expression("restitution");
}

void read(const Entry& e, Contact& contact) {
    contact.elongation = e.expression("elongation");
    contact.stiffness = e.expression("stiffness");
    contact.damping = e.expression("damping");
    contact.play = e.expression("play");
}

void read(const Entry& e, Saturation& saturation) {
    saturation.value = e.expression("value");
    saturation.low = e.expression("low");
    saturation.high = e.expression("high");
}

void read(const Entry& e, Profile& profile) {
    e.each("phases", phase_section(), [&](const Entry& part, bool is_last) {
        Phase phase;
        phase.name = part.text("name");
        phase.span = part.span();
        phase.value = part.expression("value");
        phase.until = part.expression("until");
        phase.reset = part.by_name("reset");
        if (!is_last && !part.has("until"))
            part.error(Id::missing_key, phase.span, fmt::format("phase '{}' of profile '{}' needs a time until which it lasts: only the last one lasts for ever", phase.name, e.name()));
        for (const char* key : {"until", "reset"})
            if (is_last && part.has(key)) part.error(Id::unknown_key, part.span_of(key), fmt::format("phase '{}' is the last one of profile '{}' and lasts for ever, so that it has no '{}'", phase.name, e.name(), key));
        profile.phases.push_back(std::move(phase));
    });
    if (profile.phases.size() < 2) e.error(Id::wrong_modes, e.span(), fmt::format("profile '{}' needs two phases or more", e.name()));
}

}  // namespace dalembert
