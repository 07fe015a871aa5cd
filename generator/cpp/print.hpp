// SPDX-License-Identifier: GPL-3.0-or-later
// Values and statements as C++, in member functions of a class for any scalar type.
#pragma once

#include "program/statement.hpp"
#include "text/wrap.hpp"

namespace dalembert {

std::string cpp_text(const Value& value);
/// Statements from column 8 on.
std::string cpp_text(const Statements& statements);
/// The same behind declarations that put the functions of <cmath> that they call into scope.
std::string cpp_body(const Statements& statements);
/// "const State& x, const Input& /*u*/". The name of an unused argument becomes a comment.
std::string cpp_text(const std::vector<Argument>& arguments);

}  // namespace dalembert
