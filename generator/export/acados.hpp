// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of the dynamics that acados calls, and a Python file that makes an AcadosModel with them.
#pragma once

#include "export/target.hpp"

namespace dalembert {

Exported acados_files(const ExportSubject& subject, const ExportWish& wish);

}  // namespace dalembert
