// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that CasADi takes as `external`.
#pragma once

#include "export/target.hpp"

namespace dalembert {

Exported casadi_files(const ExportSubject& subject, const ExportWish& wish);

}  // namespace dalembert
