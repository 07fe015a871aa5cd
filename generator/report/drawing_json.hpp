// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a machine as its page reads it.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "report/machine_drawing.hpp"

namespace dalembert {

/// The unit in which pages show what has the dimension of a unit of SI, with factor and offset.
using UsualUnit = std::function<nlohmann::ordered_json(const char* si)>;

nlohmann::ordered_json drawing_json(const MachineDrawing& drawing, const UsualUnit& usual_unit);

}  // namespace dalembert
