// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/fix_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/model.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// Whether an expression is made of fixed parameters, sizes and indices alone.
bool is_of_fixed(const Expression& expression, const Scene& scene, const Names& names) {
    bool all = true;
    for_each(expression, [&](const Expression& part) {
        if (part.kind != Expression::Kind::name) return;
        if (find_quantity(part.name) != nullptr) all = false;
        const Named* named = names.find(part.name);
        if (named == nullptr) return;
        if (named->kind == Named::Kind::definition) all = all && is_of_fixed(*named->definition().value, scene, names);
        else all = all && (named->kind == Named::Kind::size || scene.fixed.contains(part.name));
    });
    return all;
}

void fold(Scene& scene, const Names& names) {
    std::erase_if(scene.parameters, [&](const auto& member) { return scene.fixed.contains(member.item->name); });
    for (const auto& member : scene.definitions)
        if (is_of_fixed(*member.item->value, scene, names)) scene.folded.insert(member.item->name);
    std::erase_if(scene.definitions, [&](const auto& member) { return scene.folded.contains(member.item->name); });
}

}  // namespace

void fix_parameters(Scene& scene, const Names& names, const FixWish& wish) {
    if (wish.text.empty()) return;
    std::vector<std::string> known;
    for (const auto& member : scene.parameters)
        if (known.empty() || known.back() != member.item->name) known.push_back(member.item->name);
    if (wish.all)
        for (const std::string& name : known) scene.fixed[name] = nullptr;
    for (const auto& [name, value] : wish.some) {
        if (name->kind != Expression::Kind::name || !name->children.empty() ||
            std::find(known.begin(), known.end(), name->name) == known.end())
            throw Failure(Diagnostic{
                Id::unknown_name, name->span,
                fmt::format("'{}' is not a parameter of scene '{}'{}", name->written(), scene.name, did_you_mean(name->name, known))});
        if (!scene.fixed.emplace(name->name, value).second)
            throw Failure(Diagnostic{Id::bad_option, name->span, fmt::format("'{}' is fixed twice", name->name)});
    }
    scene.fix_text = wish.text;
    fold(scene, names);
}

void fix_as_in(Scene& scene, const Names& names, const Scene& other) {
    scene.fixed = other.fixed;
    scene.fix_text = other.fix_text;
    if (!scene.fixed.empty()) fold(scene, names);
}

}  // namespace dalembert
