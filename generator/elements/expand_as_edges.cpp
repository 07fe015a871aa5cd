// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "elements/bodies.hpp"
#include "elements/circuits.hpp"
#include "elements/element.hpp"
#include "elements/expand_switching.hpp"
#include "elements/fluids.hpp"
#include "elements/heat.hpp"
#include "elements/model.hpp"

namespace dalembert {

namespace {

const std::vector<std::string> saturation_modes{"within", "below", "above"};
const std::vector<std::string> friction_modes{"sticks", "slides_forwards", "slides_backwards"};
const std::vector<std::string> valve_modes{"shut", "open"};
const std::vector<std::string> orifice_modes{"subsonic", "choked", "subsonic_back", "choked_back"};

const std::vector<std::string>& modes_of(const Flow& flow) { return flow.law == Flow::Law::check_valve ? valve_modes : orifice_modes; }

/// Each combination has code of its own: more of them take long to derive and to compile. What cannot be written without modes may have
/// more.
constexpr int few = 64;
/// States of frictions cost more in a run than modes do.
constexpr int few_with_frictions = 128;

/// All combinations, whether or not they can be.
double combinations(const Model& model) {
    double count = 1;
    for ([[maybe_unused]] const Friction& friction : model.frictions) count *= 3;
    for ([[maybe_unused]] const Stop& stop : model.stops) count *= 2;
    for (const Contact& contact : model.contacts) count *= 1 + (contact.damping ? 2 : 1) * (contact.play ? 2 : 1);
    for (const Profile& profile : model.profiles) count *= static_cast<double>(std::max<std::size_t>(profile.phases.size(), 1));
    for (const ModeGroup& group : model.modes) count *= static_cast<double>(std::max<std::size_t>(group.modes.size(), 1));
    for (const Volume& volume : model.volumes) count *= volume.empties ? 2 : 1;
    for (const HeatNode& node : model.nodes) count *= node.boiling ? 2 : 1;
    for (const Branch& branch : model.branches) count *= branch.has_modes() ? 2 : 1;
    count *= std::pow(3, model.saturations.size());
    for (const Flow& flow : model.flows)
        if (flow.switches) count *= static_cast<double>(modes_of(flow).size());
    return count;
}

/// Whether a text has a word that is a name, or what a file that is used calls it, without the names in front.
bool has_word(const std::string& text, const std::string& name, const std::string& ending) {
    const auto is_letter = [&](std::size_t i) {
        return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
    };
    for (std::size_t at = text.find(ending); at != std::string::npos; at = text.find(ending, at + 1)) {
        std::size_t begin = at;
        while (begin > 0 && is_letter(begin - 1)) --begin;
        if (begin == at || is_letter(at + ending.size())) continue;
        const std::string word = text.substr(begin, at + ending.size() - begin);
        if (word == name || name.ends_with("_" + word)) return true;
    }
    return false;
}

/// Whether the file names a mode of an element.
bool is_named(const Model& model, const Item& item, const std::vector<std::string>& modes) {
    return std::any_of(modes.begin(), modes.end(), [&](const std::string& mode) {
        const std::string ending = "_" + mode;
        return has_word(item.span.source->text(), item.name + ending, ending) || has_word(model.source->text(), item.name + ending, ending);
    });
}

ExpressionPtr call(const char* function, const ExpressionPtr& a, const ExpressionPtr& b) {
    return std::make_shared<Expression>(Expression{Expression::Kind::call, a->span, 0, function, {a, b}});
}

}  // namespace

void expand_as_edges(Model& model, Diagnostics& diagnostics) {
    const double count = combinations(model);
    if (count <= few) return;
    std::vector<std::string> names;
    Span first;
    const auto note = [&](const Item& item) {
        if (names.empty()) first = item.span;
        names.push_back(fmt::format("'{}'", item.name));
    };
    for (const Saturation& saturation : model.saturations) {
        if (!saturation.value || !saturation.low || !saturation.high || is_named(model, saturation, saturation_modes)) continue;
        note(saturation);
        Definition limited = Element(model, saturation).make<Definition>(saturation.name, saturation.when);
        limited.value = call("min", call("max", saturation.value, saturation.low), saturation.high);
        model.definitions.push_back(std::move(limited));
    }
    for (Flow& flow : model.flows) {
        if (!flow.switches || is_named(model, flow, modes_of(flow))) continue;
        note(flow);
        flow.switches = false;
    }
    if (names.empty()) return;
    diagnostics.warning(
        Id::too_large, first,
        fmt::format("with the modes of all elements there would be {:g} combinations, each with its own code. Therefore {} {} no modes; a "
                    "run locates the switching as a kink or jump. An element keeps its modes if the file names one of them",
                    count, fmt::join(names, ", "), names.size() == 1 ? "brings" : "bring"));
}

void keep_frictions_apart(Model& model, Diagnostics& diagnostics) {
    const double count = combinations(model);
    if (count <= few_with_frictions) return;
    // An impact turns velocities round, and frictions with them: that is known of modes alone.
    const bool has_impacts = !model.stops.empty() || std::any_of(model.events.begin(), model.events.end(),
                                                                 [](const Event& event) { return event.meets || !event.reset.empty(); });
    if (has_impacts) return;
    // Where frictions are more than freedoms, rates of some follow from those of others: modes leave out what cannot be, a state cannot.
    const bool has_families =
        std::any_of(model.coordinates.begin(), model.coordinates.end(), [](const Coordinate& q) { return q.family.has_value(); });
    if (!has_families && model.frictions.size() > model.coordinates.size() + 3 * model.attitudes.size()) return;
    std::vector<std::string> names;
    Span first;
    for (Friction& friction : model.frictions) {
        if (is_named(model, friction, friction_modes)) continue;
        if (names.empty()) first = friction.span;
        names.push_back(fmt::format("'{}'", friction.name));
        friction.by_state = true;
    }
    if (names.empty()) return;
    diagnostics.warning(Id::too_large, first,
                        fmt::format("with the modes of all elements there would be {:g} combinations, each with its own code. Therefore {} "
                                    "{} no modes, but one state each, as '{}_direction': 0 if it sticks, 1 or -1 if it slides forwards or "
                                    "backwards. A friction keeps its modes if the file names one of them",
                                    count, fmt::join(names, ", "), names.size() == 1 ? "brings" : "bring",
                                    names.front().substr(1, names.front().size() - 2)));
}

}  // namespace dalembert
