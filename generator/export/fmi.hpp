// SPDX-License-Identifier: GPL-3.0-or-later
// Functional mock-up units: one .fmu for model exchange and co-simulation, with sources and the binary for this machine.
#pragma once

#include "export/target.hpp"

namespace dalembert {

Exported fmi2_files(const ExportSubject& subject, const ExportWish& wish);
Exported fmi3_files(const ExportSubject& subject, const ExportWish& wish);

}  // namespace dalembert
