// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dalembert {

/// Where bodies are placed on each other: whether the motion is solved for from body to body.
enum class ChainUse { where_shorter, wherever_possible, never };

}  // namespace dalembert
