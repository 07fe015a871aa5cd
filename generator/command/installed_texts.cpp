// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/installed_texts.hpp"

#include <array>

namespace dalembert {

namespace {

constexpr auto installed_table = std::to_array<InstalledText>({{"man", man_page}, {"bash", bash_completion}, {"zsh", zsh_completion}});

}  // namespace

std::span<const InstalledText> installed_texts() { return installed_table; }

}  // namespace dalembert
