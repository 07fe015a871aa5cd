// SPDX-License-Identifier: GPL-3.0-or-later
// A MEX function for Octave and MATLAB.
#pragma once

#include "export/target.hpp"

namespace dalembert {

Exported octave_files(const ExportSubject& subject, const ExportWish& wish);

}  // namespace dalembert
