// SPDX-License-Identifier: GPL-3.0-or-later
// The reference page of verbs, options and exit codes.
#pragma once

#include "reference/page.hpp"

namespace dalembert {

Page verb_page();

}  // namespace dalembert
