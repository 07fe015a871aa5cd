// SPDX-License-Identifier: GPL-3.0-or-later
// A package for Python.
#pragma once

#include "export/target.hpp"

namespace dalembert {

Exported python_files(const ExportSubject& subject, const ExportWish& wish);

}  // namespace dalembert
