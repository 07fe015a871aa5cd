// SPDX-License-Identifier: GPL-3.0-or-later
// Other programs, called without a shell.
#pragma once

#include <string>
#include <vector>

namespace dalembert {

struct ProcessResult {
    int exit_code;         ///< 127 when the program could not be started
    std::string output;    ///< standard output
    std::string errors;    ///< standard error
};

/// Runs a program found in PATH and waits for it.
ProcessResult run_process(const std::vector<std::string>& arguments);

/// A folder for temporary files that is gone with the object.
class ScratchFolder {
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

}  // namespace dalembert
