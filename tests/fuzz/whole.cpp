// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "command/command_line.hpp"
#include "fuzz/targets.hpp"

namespace fs = std::filesystem;

namespace fuzz {

namespace {

/// Catalogues may name model files by paths of their own, which is no place for random bytes.
void check(const std::string& bytes) {
    if (bytes.find("model") != std::string::npos && bytes.find("[catalogue]") != std::string::npos) return;
    static const fs::path file = fs::temp_directory_path() / ("dalembert-fuzz-" + std::to_string(getpid()) + ".toml");
    std::ofstream(file, std::ios::binary) << bytes;
    for (const char* verb : {"check", "evaluate"}) {
        std::ostringstream out, err;
        const int code = dalembert::run_program({verb, file.string()}, {out, err});
        if (code < 0 || code > 2 || err.str().find("defect of") != std::string::npos) {
            std::fputs(err.str().c_str(), stderr);
            std::abort();
        }
    }
    fs::remove(file);
}

}  // namespace

Target whole() { return {"check", check}; }

}  // namespace fuzz
