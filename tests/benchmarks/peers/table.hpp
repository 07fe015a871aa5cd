// SPDX-License-Identifier: GPL-3.0-or-later
// The builds of SUNDIALS that are compared with, and the table of what was found.
#pragma once

#include <string>
#include <vector>

namespace peers {

/// One build of SUNDIALS: that of the system, or one below a prefix of its own.
struct Build {
    std::string name;
    std::string prefix;  ///< empty: the system's
    std::string include_flags() const;
    std::string link_flags() const;
};

/// The system's where it has one, and that of DALEMBERT_SUNDIALS_ROOT.
std::vector<Build> builds();

/// Reads all FOLDER/*.cheapest.csv, writes FOLDER/peers.csv and FOLDER/peers_runs.csv, and prints. Returns the exit code.
int print_table(const std::string& folder, const std::string& flags);

}  // namespace peers
