// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "command/command_line.hpp"
#include "text/guardian.hpp"

extern const char* const dalembert_version_and_commit;

int main(int argc, char** argv) {
    const int code = dalembert::guarded_program([&] { return dalembert::run_program({argv + 1, argv + argc}, {std::cout, std::cerr}, dalembert_version_and_commit); });
    if (std::cout.flush()) return code;
    std::cerr << "dalembert: the output cannot be written\n";
    return static_cast<int>(dalembert::ExitCode::tool_missing);
}
