// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/view_validity.hpp"

#include "elements/model.hpp"
#include "elements/view.hpp"
#include "form/signs.hpp"

namespace dalembert {

void check_view_values(const System& system, const Values& values, ValueConditions* conditions) {
    const std::optional<View>& view = system.scene.model->view;
    if (!view) return;
    const StartValues value(system, values, conditions);
    for (const ViewPart& part : view->parts) {
        const OfKind found = system.names.find_element(part.name, viewed_kinds());
        if (found.item != nullptr && system.scene.holds(found.item->when)) check_signs(part, part.name, {}, system, value);
    }
}

}  // namespace dalembert
