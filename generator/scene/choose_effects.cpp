// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/choose_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/model.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

using Effects = std::set<std::string>;

const Effect& find_effect(const Model& model, const std::string& name) {
    return *std::find_if(model.effects.begin(), model.effects.end(), [&](const Effect& e) { return e.name == name; });
}

/// The effects named with all that they imply, some left out.
Effects with_implied(const Model& model, std::vector<std::string> pending, const Effects& left_out) {
    Effects effects;
    while (!pending.empty()) {
        const std::string name = pending.back();
        pending.pop_back();
        if (left_out.contains(name) || !effects.insert(name).second) continue;
        for (const auto& [implied, span] : find_effect(model, name).implies) pending.push_back(implied);
    }
    return effects;
}

class EffectCheck {
public:
    EffectCheck(const Model& model, const SceneWish& wish, const Span& place) : model_(model), wish_(wish), place_(place) {}

    /// What is to be added is not there yet, what is to be left out is.
    void changes(const Effects& before) const {
        for (const auto& [name, is_added] : wish_.changes)
            if (before.contains(name) == is_added)
                fail(fmt::format("scene '{}' already {} '{}', so it cannot {}", wish_.base, is_added ? "has" : "lacks", name,
                                 is_added ? "be added" : "be left out"));
    }

    void together(const Effects& effects) const {
        std::map<std::string, std::string> levels;
        for (const Effect& effect : model_.effects) {
            if (!effects.contains(effect.name)) continue;
            for (const auto& [implied, span] : effect.implies)
                if (!effects.contains(implied))
                    fail(fmt::format("scene '{}' leaves out '{}', which '{}' implies", wish_.text, implied, effect.name),
                         {{span, "it is implied here"}});
            for (const auto& [excluded, span] : effect.excludes)
                if (effects.contains(excluded))
                    fail(fmt::format("scene '{}' contains '{}' and '{}', which exclude each other", wish_.text, effect.name, excluded),
                         {{span, "it is excluded here"}});
            if (effect.level_of.empty()) continue;
            const auto [other, is_first] = levels.emplace(effect.level_of, effect.name);
            if (!is_first)
                fail(fmt::format("scene '{}' contains '{}' and '{}', two levels of '{}'", wish_.text, other->second, effect.name,
                                 effect.level_of),
                     {{effect.span, fmt::format("'{}' is declared here", effect.name)}});
        }
    }

private:
    [[noreturn]] void fail(std::string message, std::vector<Note> notes = {}) const {
        throw Failure(Diagnostic{Id::scene_contradiction, place_, std::move(message), std::move(notes)});
    }

    const Model& model_;
    const SceneWish& wish_;
    Span place_;
};

}  // namespace

SceneWish::SceneWish(const std::string& written) : text(written) {
    std::size_t sign = std::min(text.find_first_of("+-"), text.size());
    base = text.substr(0, sign);
    while (sign < text.size()) {
        const std::size_t next = std::min(text.find_first_of("+-", sign + 1), text.size());
        changes.emplace_back(text.substr(sign + 1, next - sign - 1), text[sign] == '+');
        sign = next;
    }
}

std::string SceneWish::name() const {
    std::string result = base;
    for (const auto& [effect, is_added] : changes) result += (is_added ? "_with_" : "_without_") + effect;
    return result;
}

const SceneChoice* find_choice(const Model& model, const std::string& name) {
    const auto found = std::find_if(model.scenes.begin(), model.scenes.end(), [&](const SceneChoice& s) { return s.name == name; });
    return found == model.scenes.end() ? nullptr : &*found;
}

std::set<std::string> effects_of(const Model& model, const SceneWish& wish) {
    const SceneChoice* choice = find_choice(model, wish.base);
    std::vector<std::string> named;
    if (choice != nullptr) {
        for (const auto& [name, span] : choice->effects) named.push_back(name);
    } else {
        for (const Effect& effect : model.effects) named.push_back(effect.name);
    }
    const EffectCheck check(model, wish, choice != nullptr ? choice->span : model.name_span);
    check.changes(with_implied(model, named, {}));
    Effects left_out;
    for (const auto& [name, is_added] : wish.changes) {
        if (is_added) named.push_back(name);
        else left_out.insert(name);
    }
    const Effects effects = with_implied(model, std::move(named), left_out);
    check.together(effects);
    return effects;
}

}  // namespace dalembert
