// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/c_library.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "plant/compiler.hpp"
#include "text/diagnostic.hpp"
#include "text/process.hpp"

namespace dalembert {

std::string c_library(const FileContents& files, const std::string& main_file) {
    const auto fail = [](std::string message) {
        throw Failure(Diagnostic{Id::tool_failed, {}, std::move(message)}, ExitCode::tool_missing);
    };
    const ScratchFolder scratch;
    const std::filesystem::path folder = scratch.path(), library = folder / "made.so";
    FileContents sources;
    for (const auto& [path, content] : files) sources.emplace_back(folder / path, content);
    write_files(sources);
    const char* variable = std::getenv("CC");
    std::istringstream words(variable != nullptr && *variable != '\0' ? variable : "cc");
    std::vector<std::string> command;
    for (std::string word; words >> word;) command.push_back(word);
    if (command.empty()) command = {"cc"};
    const std::string name = command.front();
    // Calls of sin and the like need not set errno: equal calls become one.
    command.insert(command.end(), {"-std=c99", "-O2", "-fno-math-errno", "-fPIC", "-shared", "-fvisibility=hidden", "-o", library.string(),
                                   (folder / main_file).string(), "-lm"});
    const ProcessResult compiled = run_process(command);
    if (compiled.exit_code == 127)
        fail(fmt::format("the compiler '{}' cannot be started; set CC to a C compiler (on Debian: apt-get install gcc), or write the sources "
                         "alone with `--sources-only`",
                         name));
    if (compiled.exit_code != 0)
        fail(fmt::format("the compiler '{}' refuses the exported file '{}': {}", name, main_file, complaint(compiled.errors)));
    return read_file(library);
}

}  // namespace dalembert
