// SPDX-License-Identifier: GPL-3.0-or-later
// What is wrong with a model as a page: its text, and each message below the line that it is about.
#pragma once

#include <string>
#include <vector>

#include "text/diagnostic.hpp"

namespace dalembert {

/// Without diagnostics it says that the page is being made. `script`: of the page; empty for none.
std::string error_page(const SourcePtr& model, const std::vector<Diagnostic>& diagnostics, const std::string& script);

}  // namespace dalembert
