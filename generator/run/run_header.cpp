// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/run_header.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "text/diagnostic.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(std::string message) { throw Failure(Diagnostic{Id::tool_failed, {}, std::move(message)}, ExitCode::tool_missing); }

/// The runtime headers: beside an installed program, else where the program was built from.
std::string runtime_folder() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    std::vector<fs::path> candidates;
    if (!error) candidates.push_back(program.parent_path().parent_path() / "include");
    candidates.emplace_back(DALEMBERT_RUNTIME_DIR);
    for (const fs::path& candidate : candidates)
        if (fs::exists(candidate / "dalembert" / "simulate.hpp", error)) return candidate.string();
    fail("the runtime headers (dalembert/simulate.hpp) are neither installed beside the program nor where it was built");
}

std::vector<std::string> compiler() {
    const char* variable = std::getenv("CXX");
    std::istringstream words(variable != nullptr && *variable != '\0' ? variable : "c++");
    std::vector<std::string> result;
    for (std::string word; words >> word;) result.push_back(word);
    return result.empty() ? std::vector<std::string>{"c++"} : result;
}

/// The line that says what is wrong, or the first one.
std::string complaint(const std::string& text) {
    std::istringstream lines(text);
    std::string first;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("error") != std::string::npos) return line;
        if (first.empty()) first = line;
    }
    return first;
}

/// Straight-line functions of many thousands of operations take a compiler that optimises them hours, and run a few times slower without.
std::string for_the_compiler(const std::string& header) {
    constexpr std::size_t most = 600000;  // characters
    if (header.size() <= most) return header;
    return "#include <array>\n#include <cmath>\n#include <cstddef>\n#include <limits>\n#pragma GCC push_options\n#pragma GCC "
           "optimize(\"O0\")\n" +
           header + "#pragma GCC pop_options\n";
}

}  // namespace

void compile_with_header(const ScratchFolder& folder, const Header& header, const std::string& source, const char* optimisation) {
    const fs::path at = folder.path();
    write_files({{at / header.file_name, for_the_compiler(header.text)}, {at / "main.cpp", source}});
    std::vector<std::string> command = compiler();
    const std::string name = command.front();
    const std::vector<std::string> rest{"-std=c++17",
                                        optimisation,
                                        "-I",
                                        folder.path(),
                                        "-I",
                                        runtime_folder(),
                                        "-isystem",
                                        "/usr/include/eigen3",
                                        (at / "main.cpp").string(),
                                        "-o",
                                        (at / "program").string()};
    command.insert(command.end(), rest.begin(), rest.end());
    const ProcessResult compiled = run_process(command);
    if (compiled.exit_code == 127)
        fail(fmt::format("the compiler '{}' cannot be started; set CXX to a C++17 compiler (on Debian: apt-get install g++)", name));
    if (compiled.exit_code != 0) fail(fmt::format("the compiler '{}' refuses the generated program: {}", name, complaint(compiled.errors)));
}

std::map<std::string, std::string> run_compiled(const ScratchFolder& folder, const std::vector<std::string>& arguments) {
    const fs::path at = folder.path();
    std::vector<std::string> run{(at / "program").string()};
    run.insert(run.end(), arguments.begin(), arguments.end());
    const ProcessResult ran = run_process(run);
    std::map<std::string, std::string> values{{"exit", std::to_string(ran.exit_code)}};
    std::istringstream lines(ran.output);
    for (std::string line; std::getline(lines, line);)
        if (const std::size_t equals = line.find('='); equals != std::string::npos)
            values[line.substr(0, equals)] = line.substr(equals + 1);
    if (!values.contains("status")) fail(fmt::format("the generated program ended with code {}: {}", ran.exit_code, complaint(ran.errors)));
    return values;
}

std::map<std::string, std::string> run_with_header(const ScratchFolder& folder, const Header& header, const std::string& source,
                                                   const std::vector<std::string>& arguments, const char* optimisation) {
    compile_with_header(folder, header, source, optimisation);
    return run_compiled(folder, arguments);
}

}  // namespace dalembert
