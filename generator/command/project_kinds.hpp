// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of projects that `dalembert new` writes.
#pragma once

#include <array>

namespace dalembert {

/// Its files are the templates in templates/new/NAME, and those in templates/new/common.
struct ProjectKind {
    const char* name;
    const char* doc;
};

/// The first is written where none is asked for.
inline constexpr auto project_kinds = std::to_array<ProjectKind>({
    {"mechanics", "a cart with a pendulum"},
    {"hydraulics", "a tank with a pump and a valve"},
    {"heat", "a room with a heater"},
    {"controller", "a rod on a cart that a controller in float keeps upright"},
    {"catalogue", "the equations of a page in LaTeX, checked against a model"},
});

}  // namespace dalembert
