// SPDX-License-Identifier: GPL-3.0-or-later
// Names that models cannot have, because emitted code could not.
#pragma once

#include <string_view>

namespace dalembert {

/// Words that mean something in C++ and so cannot be members of a header.
bool is_cpp_keyword(std::string_view name);
/// A macro of the standard headers or of compilers.
bool is_cpp_macro(std::string_view name);
/// A name that every generated header defines itself.
bool is_header_name(std::string_view name);
/// A function that C puts outside of every namespace: no namespace can have its name.
bool is_global_function(std::string_view name);

}  // namespace dalembert
