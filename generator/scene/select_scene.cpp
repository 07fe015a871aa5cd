// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/every_kind.hpp"
#include "scene/choose_effects.hpp"
#include "scene/choose_fields.hpp"
#include "scene/choose_modes.hpp"
#include "scene/determined_states.hpp"
#include "scene/used_names.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

class Selection {
public:
    Selection(const Model& model, const Names& names, const std::string& name) : model_(model), names_(names), fields_(scene_) {
        scene_.model = &model;
        const SceneWish wish(name);
        scene_.name = wish.name();
        scene_.base = wish.base;
        scene_.wish = name;
        if (const SceneChoice* choice = find_choice(model, wish.base)) scene_.doc = choice->doc;
        for (const auto& [effect, is_added] : wish.changes)
            scene_.doc += fmt::format("{}{} '{}'", scene_.doc.empty() ? "" : ", ", is_added ? "with" : "without", effect);
        effects_ = effects_of(model, wish);
        for (const Effect& effect : model.effects)
            (effects_.contains(effect.name) ? scene_.effects_in : scene_.effects_out).push_back(&effect);
    }

    void set_sizes(const std::map<std::string, int>& wanted) {
        for (const auto& [name, value] : wanted)
            if (std::none_of(model_.sizes.begin(), model_.sizes.end(), [&, key = name](const Size& s) { return s.name == key; })) {
                std::vector<std::string> known;
                for (const Size& size : model_.sizes) known.push_back(size.name);
                fail(Id::unknown_size, model_.name_span,
                     fmt::format("the model has no size '{}'{}", name, known.empty() ? "; it has none at all" : did_you_mean(name, known)));
            }
        for (const Size& size : model_.sizes) {
            const auto given = wanted.find(size.name);
            const int value = given != wanted.end() ? given->second : index_value(*size.value, scene_, {});
            scene_.sizes[size.name] = value;
            if (value < 0)
                fail(Id::value_out_of_range, size.span, fmt::format("size '{}' is {}; a size is not negative", size.name, value));
            if (!size.range) continue;
            const bool too_small = size.range->low && value < index_value(*size.range->low, scene_, {});
            const bool too_large = size.range->high && value > index_value(*size.range->high, scene_, {});
            if (too_small || too_large)
                fail(Id::value_out_of_range, size.range->span,
                     fmt::format("size '{}' is {}, {} its range", size.name, value, too_small ? "below" : "above"));
        }
    }

    Scene take() {
        choose_modes(scene_);
        for_each_common_kind(model_, scene_, [&](const auto& items, auto& members) { choose(items, members); });
        complete_modes(scene_);
        const bool any_mass =
            std::any_of(scene_.bodies.begin(), scene_.bodies.end(), [](const auto& body) { return body.item->mass != nullptr; });
        if (model_.gravity && any_mass && scene_.holds(model_.gravity->when)) scene_.gravity = &*model_.gravity;
        if (scene_.modes.empty()) fields_.find_all(names_);
        UsedNames used(scene_, names_, fields_);
        used.find_all();
        choose_used(used);
        check_determined(scene_, names_);
        const bool is_at_rest =
            !scene_.loads.empty() || !scene_.solids.empty() || !scene_.stickings.empty();  // statics need nothing that moves
        check_samplers();
        if (scene_.coordinates.empty() && scene_.states.empty() && !is_at_rest && scene_.sampling == nullptr)
            fail(Id::nothing_left, model_.name_span,
                 fmt::format("scene '{}' has neither a coordinate nor a state that anything uses", scene_.name));
        return std::move(scene_);
    }

private:
    template <class T>
    void add_members(const T& item, std::vector<Member<T>>& members) {
        if (!item.family) {
            members.push_back({&item});
            return;
        }
        const auto [from, to] = bounds(*item.family, scene_);
        for (int index = from; index <= to; ++index) members.push_back({&item, index});
    }

    /// What is in the scene by its condition alone.
    template <class T>
    void choose(const std::vector<T>& items, std::vector<Member<T>>& members) {
        if constexpr (!is_there_where_used<T>)
            for (const T& item : items)
                if (scene_.holds(item.when)) add_members(item, members);
    }
    template <class T>
    void choose(const std::vector<T>& items, std::vector<const T*>& chosen) {
        if constexpr (!is_there_where_used<T>)
            for (const T& item : items)
                if (scene_.holds(item.when)) chosen.push_back(&item);
    }
    /// Sizes are set and modes chosen before; gravity acts where there is a mass.
    void choose(const std::vector<Size>&, std::map<std::string, int, std::less<>>&) {}
    void choose(const std::optional<Gravity>&, const Gravity*) {}
    void choose(const std::optional<ControllerSampling>& sampling, const ControllerSampling*& chosen) {
        chosen = sampling ? &*sampling : nullptr;
    }
    void choose(const std::vector<ModeGroup>&, std::vector<SceneMode>&) {}

    /// Media are in the scene already.
    void choose_used(const UsedNames& used) {
        for (const Parameter& parameter : model_.parameters)
            if (used.contains(parameter.name)) add_members(parameter, scene_.parameters);
        for (const Input& input : model_.inputs)
            if (used.contains(input.name)) add_members(input, scene_.inputs);
        for (const State& state : model_.states) {
            if (!used.contains(state.name)) continue;
            const Field* field = fields_.find(state.name);
            if (field == nullptr) add_members(state, scene_.states);
            else for (const int index : field->tapped) scene_.states.push_back({&state, index});
        }
        for (const Definition& definition : model_.definitions)
            if (used.contains(definition.name) && (dependence(*definition.value, names_) & ~on_parameters) == 0)
                add_members(definition, scene_.definitions);
        for (const Solid& solid : model_.solids)
            if (used.contains_solid(solid.name)) scene_.solids.push_back(&solid);
    }

    /// Each sets inputs that are there, and none sets what another one does.
    void check_samplers() {
        std::map<std::string, const Sampler*> set;
        for (const Sampler* sampler : scene_.samplers)
            for (const RunEntry& entry : sampler->sets) {
                const std::string& name = entry.value->name;
                const bool is_there = std::any_of(scene_.inputs.begin(), scene_.inputs.end(),
                                                  [&](const Member<Input>& input) { return input.item->name == name; });
                if (!is_there)
                    fail(Id::needs_absent, entry.span,
                         fmt::format("sampler '{}' sets input '{}', which scene '{}' leaves out; give the sampler a 'when'",
                                     sampler->name, name, scene_.name));
                if (const auto [known, is_new] = set.emplace(name, sampler); !is_new)
                    fail(Id::doubly_defined, entry.span,
                         fmt::format("in scene '{}', input '{}' is set by the samplers '{}' and '{}'", scene_.name, name,
                                     known->second->name, sampler->name),
                         {{known->second->span, "one of them is here"}});
            }
    }

    const Model& model_;
    const Names& names_;
    Scene scene_;
    FieldChoice fields_;
    std::set<std::string> effects_;
};

}  // namespace

Scene select_scene(const Model& model, const Names& names, const std::string& scene, const std::map<std::string, int>& sizes) {
    Selection selection(model, names, scene);
    selection.set_sizes(sizes);
    return selection.take();
}

}  // namespace dalembert
