// SPDX-License-Identifier: GPL-3.0-or-later
// A scene of a model as JavaScript, for the page that runs it.
#pragma once

#include "report/machine_drawing.hpp"
#include "report/machine_page.hpp"

namespace dalembert {

/// The module of its plant, and the object with all else that the page needs of the scene. `file`: the model, for commands.
struct SceneScript {
    std::string module, object;
};
SceneScript scene_script(ScenePage& scene, const MachineDrawing& drawing, const std::string& file);

}  // namespace dalembert
