// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/compiler.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "text/diagnostic.hpp"
#include "text/process.hpp"

namespace dalembert {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(std::string message) { throw Failure(Diagnostic{Id::tool_failed, {}, std::move(message)}, ExitCode::tool_missing); }

}  // namespace

std::vector<std::string> compiler_command() {
    const char* variable = std::getenv("CXX");
    std::istringstream words(variable != nullptr && *variable != '\0' ? variable : "c++");
    std::vector<std::string> result;
    for (std::string word; words >> word;) result.push_back(word);
    return result.empty() ? std::vector<std::string>{"c++"} : result;
}

std::string runtime_folder() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    std::vector<fs::path> candidates;  // where it was built, and where it is installed
    if (!error) candidates = {program.parent_path() / "include", program.parent_path().parent_path() / "include"};
    for (const fs::path& candidate : candidates)
        if (fs::exists(candidate / "dalembert" / "simulate.hpp", error)) return candidate.string();
    fail(fmt::format("the runtime headers (dalembert/simulate.hpp) are not installed beside the program '{}', in '{}'", program.string(),
                     candidates.empty() ? "../include" : candidates.back().string()));
}

void compile(const std::vector<std::string>& arguments) {
    std::vector<std::string> command = compiler_command();
    const std::string name = command.front();
    command.insert(command.end(), {"-std=c++17", "-I", runtime_folder()});
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ProcessResult compiled = run_process(command);
    if (compiled.exit_code == 127)
        fail(fmt::format("the compiler '{}' cannot be started; set CXX to a C++17 compiler (on Debian: apt-get install g++)", name));
    if (compiled.exit_code != 0) fail(fmt::format("the compiler '{}' refuses the generated program: {}", name, complaint(compiled.errors)));
}

std::string for_the_compiler(const std::string& header) {
    constexpr std::size_t most = 600000;  // characters
    if (header.size() <= most) return header;
    return "#include <array>\n#include <cmath>\n#include <cstddef>\n#include <limits>\n#pragma GCC push_options\n#pragma GCC "
           "optimize(\"O0\")\n" +
           header + "#pragma GCC pop_options\n";
}

std::string complaint(const std::string& text) {
    std::istringstream lines(text);
    std::string first;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("error") != std::string::npos) return line;
        if (first.empty()) first = line;
    }
    return first;
}

}  // namespace dalembert
