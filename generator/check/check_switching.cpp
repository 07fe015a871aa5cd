// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "check/checks.hpp"
#include "elements/circuits.hpp"
#include "elements/every_kind.hpp"
#include "elements/kinds.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

class SwitchingCheck {
public:
    SwitchingCheck(const Model& model, Diagnostics& diagnostics) : model_(model), names_(model), diagnostics_(diagnostics) {
        for (const ModeGroup& group : model.modes)
            for (const Mode& mode : group.modes) modes_.insert(mode.name);
    }

    void run() {
        for_each_kind(model_, [&]<class Items>(const char*, const Items& items) {
            if constexpr (requires { kind_of<typename Items::value_type>; })
                if constexpr (kind_of<typename Items::value_type>.facts.in_all_modes) same_in_all_modes(items);
        });
        for (const ModeGroup& group : model_.modes)
            if (const auto mode = mode_in(group.when))
                wrong(mode->second,
                      fmt::format("'{}' must have its modes in all modes of the machine, not only in '{}'", group.name, mode->first));
        for (const Event& event : model_.events) check(event);
    }

private:
    void wrong(const Span& span, std::string message, std::vector<Note> notes = {}) {
        diagnostics_.error(Id::wrong_modes, span, std::move(message), std::move(notes));
    }

    std::optional<std::pair<std::string, Span>> mode_in(const std::optional<Condition>& when) const {
        std::vector<std::pair<std::string, Span>> named;
        if (when) when->collect(named);
        const auto found = std::find_if(named.begin(), named.end(), [&](const auto& n) { return modes_.contains(n.first); });
        return found == named.end() ? std::nullopt : std::optional(*found);
    }

    template <class T>
    void same_in_all_modes(const std::vector<T>& items) {
        for (const T& item : items) {
            const auto mode = mode_in(item.when);
            if (!mode) continue;
            wrong(mode->second,
                  fmt::format("all modes must have the same states, inputs and outputs, but the {} '{}' depends on the mode '{}'; in an "
                              "expression, the name of a mode is 1 in this mode and 0 in others",
                              kind_of<T>.word, item.name, mode->first),
                  {{item.span, fmt::format("'{}' is defined here", item.name)}});
        }
    }

    void check(const Event& event) {
        // What an element watches may depend on a profile alone: it jumps where the phase ends.
        const unsigned still = on_parameters | on_modes, depends = dependence(*event.guard, names_);
        if ((depends & ~still) == 0 && !(event.is_made && (depends & on_modes) != 0) && told_.insert(event.guard->span.begin).second) {
            const Branch* driven = switch_of(event);
            wrong(event.guard->span,
                  driven != nullptr
                      ? fmt::format("what closes switch '{}' contains nothing that moves, so it is open or closed for ever; put a resistor "
                                    "in its place, or leave it out",
                                    driven->name)
                      : fmt::format("the guard of event '{}' contains nothing that moves, so it never crosses zero", event.name));
        }
        if (!event.ends && event.next.empty() && event.reset.empty() && !event.meets)
            wrong(event.span,
                  fmt::format("event '{}' leads to no mode, resets nothing and does not end the run, so it would happen again at once",
                              event.name));
        for (const auto* next : {&event.next, &event.rest})
            for (const Condition& condition : *next) target(event, condition);
        for (const auto* reset : {&event.reset, &event.rest_reset}) resets(event, *reset);
    }

    /// The switch of a circuit that an event opens or closes; null for others.
    const Branch* switch_of(const Event& event) const {
        const auto found = std::find_if(model_.branches.begin(), model_.branches.end(), [&](const Branch& branch) {
            return branch.law == Branch::Law::switching && event.is_made && event.name.starts_with(branch.name + "_");
        });
        return found == model_.branches.end() ? nullptr : &*found;
    }

    /// "open", "open and cold": modes of different groups.
    void target(const Event& event, const Condition& condition) {
        if (condition.kind == Condition::Kind::conjunction) {
            std::set<const ModeGroup*> groups;
            for (const Condition& part : condition.parts) {
                target(event, part);
                for (const ModeGroup& group : model_.modes) {
                    const bool is_in =
                        std::any_of(group.modes.begin(), group.modes.end(), [&](const Mode& mode) { return mode.name == part.effect; });
                    if (is_in && !groups.insert(&group).second)
                        wrong(condition.span, fmt::format("event '{}' leads to two modes of '{}' at once", event.name, group.name));
                }
            }
            return;
        }
        if (condition.kind == Condition::Kind::effect && modes_.contains(condition.effect)) return;
        if (condition.kind == Condition::Kind::effect)
            diagnostics_.error(
                Id::unknown_name, condition.span,
                fmt::format("there is no mode '{}'{}", condition.effect, did_you_mean(condition.effect, {modes_.begin(), modes_.end()})));
        else wrong(condition.span, fmt::format("event '{}' leads to a mode, or to modes of different groups joined by 'and'", event.name));
    }

    void resets(const Event& event, const std::vector<RunEntry>& entries) {
        std::vector<std::pair<std::string, Span>> seen;
        for (const RunEntry& entry : entries) {
            const Expression& variable = *entry.variable;
            const bool is_rate = variable.kind == Expression::Kind::call && variable.name == "dot" && variable.children.size() == 1;
            if (is_rate && event.meets)
                wrong(entry.span,
                      fmt::format("event '{}' resets '{}', but the impact on '{}' already sets it", event.name, variable.written(),
                                  event.meets->name),
                      {{event.meets->span, "the impact stands here"}});
            const Expression& named = is_rate ? *variable.children[0] : variable;
            const Named* found = named.kind == Expression::Kind::name ? names_.find(named.name) : nullptr;
            const bool is_coordinate = found != nullptr && found->kind == Named::Kind::coordinate;
            if (!is_coordinate && (is_rate || found == nullptr || found->kind != Named::Kind::state)) {
                wrong(entry.span,
                      fmt::format("event '{}' cannot reset '{}', which is neither a state nor a coordinate nor the velocity of one",
                                  event.name, variable.written()));
                continue;
            }
            std::string key;
            for (const char c : variable.written())
                if (c != ' ') key += c;
            const auto other = std::find_if(seen.begin(), seen.end(), [&](const auto& s) { return s.first == key; });
            if (other != seen.end())
                wrong(entry.span, fmt::format("event '{}' resets '{}' twice", event.name, variable.written()),
                      {{other->second, "it is reset here, too"}});
            seen.emplace_back(key, entry.span);
        }
    }

    const Model& model_;
    Names names_;
    Diagnostics& diagnostics_;
    std::set<std::string> modes_;
    std::set<std::size_t> told_;  ///< places of guards that never move: several events of an element may watch one
};

}  // namespace

void check_switching(const Model& model, Diagnostics& diagnostics) {
    if (!model.modes.empty() || !model.events.empty() || !model.constraints.empty()) SwitchingCheck(model, diagnostics).run();
}

}  // namespace dalembert
