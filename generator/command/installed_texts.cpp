// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/installed_texts.hpp"

#include <array>

namespace dalembert {

namespace {

constexpr auto installed_table = std::to_array<InstalledText>({{"man", man_page}, {"bash", bash_completion}, {"zsh", zsh_completion}});

constexpr std::array codes{
    ExitCodeSpec{ExitCode::good, "good"},
    ExitCodeSpec{ExitCode::check_failed, "a check failed"},
    ExitCodeSpec{ExitCode::bad_input, "bad input"},
    ExitCodeSpec{ExitCode::tool_missing, "a tool or compiler is missing or failed"},
    ExitCodeSpec{ExitCode::run_stopped, "a run stopped"},
};
}  // namespace
std::span<const ExitCodeSpec> exit_codes() { return codes; }

std::span<const InstalledText> installed_texts() { return installed_table; }

}  // namespace dalembert
