// SPDX-License-Identifier: GPL-3.0-or-later
// Templates with @PLACEHOLDERS@, built into the program. A placeholder without text, or a text without placeholder, is an error.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace dalembert {

/// The text of a file in templates/ ("system.hpp.in"), or of the runtime files from which headers take helpers.
std::string_view embedded_file(std::string_view name);

std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values);

}  // namespace dalembert
