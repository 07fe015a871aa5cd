// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/conduction.hpp"
#include "elements/fluids.hpp"
#include "elements/heat.hpp"
#include "elements/model.hpp"
#include "scene/choose_effects.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

}  // namespace

bool Scene::has_temperature(const Volume& volume, const Names& names) const {
    return volume.temperature && holds(names.find(volume.temperature->name)->item->when);
}

bool Scene::has_capacity(const HeatNode& node, const Names& names) const {
    return node.capacity && holds(names.find(node.temperature->name)->item->when);
}

std::string Field::written() const { return fmt::format("{} '{}'", kind, body->name); }

const Field* Scene::find_field(const Item& body) const {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.body == &body; });
    return found == fields.end() ? nullptr : &*found;
}

std::size_t Scene::state_count() const {
    std::size_t count = 2 * coordinates.size() + states.size();
    for (const Field& field : fields) count += static_cast<std::size_t>(field.to - field.from + 1) - field.tapped.size();
    return count;
}

bool Scene::holds(const std::optional<Condition>& when) const {
    if (!when) return true;
    if (mode) return holds(when, *mode);
    for (std::size_t i = 0; i < modes.size(); ++i)
        if (holds(when, i)) return true;
    return modes.empty() && holds(when, 0);
}

bool Scene::holds(const std::optional<Condition>& when, std::size_t in_mode) const {
    if (!when) return true;
    std::set<std::string> present;
    for (const Effect* effect : effects_in) present.insert(effect->name);
    if (in_mode < modes.size())
        for (const Mode* part : modes[in_mode].parts) present.insert(part->name);
    return when->holds(present);
}

std::string Scene::sized_name() const {
    std::string result = model->name;
    for (const Size& size : model->sizes) result += fmt::format("_{}{}", size.name, sizes.at(size.name));
    return result;
}

std::vector<std::string> scene_names(const Model& model) {
    if (model.scenes.empty()) return {"full"};
    std::vector<std::string> names;
    for (const SceneChoice& scene : model.scenes) names.push_back(scene.name);
    return names;
}

std::string resolve_scene(const Model& model, const std::string& wanted) {
    const std::vector<std::string> known = scene_names(model);
    const SceneWish wish(wanted);
    for (const auto& [effect, is_added] : wish.changes) {
        std::vector<std::string> effects;
        for (const Effect& declared : model.effects) effects.push_back(declared.name);
        if (std::find(effects.begin(), effects.end(), effect) == effects.end())
            fail(Id::unknown_name, model.name_span,
                 fmt::format("model '{}' has no effect '{}', which '{}' should {}{}", model.name, effect, wanted,
                             is_added ? "add" : "leave out",
                             effects.empty() ? "; it has none at all" : "; its effects are " + quoted_list(effects)));
    }
    if (wish.base.empty()) {
        if (known.size() == 1) return known.front() + wanted;
        if (!model.default_scene.empty()) return model.default_scene + wanted;
        fail(Id::scene_needed, model.name_span,
             fmt::format("model '{}' has the scenes {}; choose one with --scene", model.name, quoted_list(known)));
    }
    if (std::find(known.begin(), known.end(), wish.base) == known.end())
        fail(Id::unknown_scene, Span{std::make_shared<const Source>("--scene", wanted), 0, wish.base.size()},
             fmt::format("model '{}' has no scene '{}'; its scenes are {}", model.name, wish.base, quoted_list(known)));
    return wanted;
}

void warn_of_unused(const Model& model, Diagnostics& diagnostics) {
    std::set<std::string> used;
    visit(model, [&](const Site& site) {
        for_each(*site.expression, [&](const Expression& e) {
            if (e.kind == Kind::name) used.insert(e.name);
        });
    });
    for (const Rod& rod : model.rods) used.insert(rod.temperature.name);
    for (const Block& block : model.blocks) used.insert(block.temperature.name);
    for (const Sampler& sampler : model.samplers)
        for (const RunEntry& entry : sampler.of_machine) used.insert(sampler.name + "_" + entry.variable->name);
    const auto warn = [&](const auto& items, const char* kind) {
        for (const auto& item : items)
            if (!used.contains(item.name) && !item.is_made)  // the force of a bar is worth knowing by itself
                diagnostics.warning(Id::unused, item.span, fmt::format("nothing uses the {} '{}'", kind, item.name));
    };
    warn(model.parameters, "parameter");
    warn(model.definitions, "definition");
    warn(model.inputs, "input");
}

}  // namespace dalembert
