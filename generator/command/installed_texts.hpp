// SPDX-License-Identifier: GPL-3.0-or-later
// Texts about the command line that an installation brings along: man page and completion. They are made from the descriptions of verbs.
#pragma once

#include <span>
#include <string>

namespace dalembert {

struct InstalledText {
    const char* format;  ///< as `help --format` names it
    std::string (*make)();
};

std::span<const InstalledText> installed_texts();

std::string man_page();
std::string bash_completion();
std::string zsh_completion();

}  // namespace dalembert
