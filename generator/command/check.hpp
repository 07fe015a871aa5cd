// SPDX-License-Identifier: GPL-3.0-or-later
// `dalembert check` of one file, for verbs that show what it finds.
#pragma once

#include "report/check.hpp"
#include "run/options.hpp"

namespace dalembert {

/// A model or a catalogue. What it finds is also written to `streams` as it is found, but for `--format json`. Throws Failure where the
/// file is the only one of the options and cannot be read.
CheckedFile check_file(const std::string& path, const Options& options, Streams streams);

}  // namespace dalembert
