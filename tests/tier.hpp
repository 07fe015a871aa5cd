// SPDX-License-Identifier: GPL-3.0-or-later
// The tier that runs. The quick tier takes a part of what takes long, the full tier everything.
#pragma once

#include <cstdlib>

inline bool is_full_tier() { return std::getenv("DALEMBERT_FULL") != nullptr; }
