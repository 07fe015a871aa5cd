// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the runtime whose functions are copied into generated code that needs them.
#pragma once

#include <array>

namespace dalembert {

struct HelperFile {
    const char* name;
    bool is_in_cpp, is_in_c;
};

/// Each behind those that it needs.
inline constexpr std::array helper_files{
    HelperFile{"math_functions", false, true},
    HelperFile{"scalar_functions", true, true},
    HelperFile{"angle_functions", true, true},
    HelperFile{"fluid_functions", true, true},
    HelperFile{"heat_functions", true, true},
    HelperFile{"curve_functions", true, true},
    HelperFile{"unroll", true, false},
    HelperFile{"heat_networks", true, true},
    HelperFile{"junctions", true, true},
    HelperFile{"series_functions", true, true},
    HelperFile{"ldlt", true, true},
};

}  // namespace dalembert
