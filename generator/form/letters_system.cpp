// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/letters_system.hpp"

#include "elements/model.hpp"

namespace dalembert {

std::unique_ptr<System> letters_alone(const Names& names, const Model& model) {
    Scene scene;
    scene.model = &model;
    scene.name = "letters";
    const auto all = [&]<class T>(const std::vector<T>& items, std::vector<Member<T>>& members) {
        for (const T& item : items) {
            const auto [from, to] = item.family ? bounds(*item.family, scene) : std::pair(0, 0);
            for (int k = from; k <= to; ++k) members.push_back({&item, k});
        }
    };
    all(model.parameters, scene.parameters);
    all(model.coordinates, scene.coordinates);
    auto system = std::make_unique<System>(names, std::move(scene));
    system->symbols.define({});
    return system;
}

}  // namespace dalembert
