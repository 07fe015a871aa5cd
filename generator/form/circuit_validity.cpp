// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/circuit_validity.hpp"

#include "form/signs.hpp"

namespace dalembert {

void check_circuit_values(const System& system, const Values& values, ValueConditions* conditions) {
    const StartValues value(system, values, conditions);
    for (const auto& member : system.scene.branches)
        check_signs(*member.item, member.name(), Translator::indices_of(member), system, value);
}

}  // namespace dalembert
