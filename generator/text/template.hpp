// SPDX-License-Identifier: GPL-3.0-or-later
// Templates with @PLACEHOLDERS@, built into the program. A placeholder without text, or a text without placeholder, is an error.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace dalembert {

struct EmbeddedFile {
    std::string_view name;  ///< below its folder, as "system.hpp.in" or "new/heat/main.cpp.in"
    std::string_view text;
};

/// The files in templates/, the runtime files from which headers take helpers, and tests/errors/NAME.txt for examples of messages.
std::span<const EmbeddedFile> embedded_files();

/// The text of one of them.
std::string_view embedded_file(std::string_view name);

std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values);
/// Those of the values that the template has a place for. Others may belong to a template that this one is a part of.
std::map<std::string, std::string> values_for(std::string_view text, const std::map<std::string, std::string>& values);
/// Fills one template and puts its text in the place of the values that it took, under a name.
void fill_part(const char* name, std::string_view text, std::map<std::string, std::string>& values);

}  // namespace dalembert
