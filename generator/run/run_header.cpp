// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/run_header.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "plant/compiler.hpp"
#include "text/diagnostic.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace fs = std::filesystem;

void compile_with_header(const ScratchFolder& folder, const Header& header, const std::string& source, const char* optimisation) {
    const fs::path at = folder.path();
    write_files({{at / header.file_name, for_the_compiler(header.text)}, {at / "main.cpp", source}});
    compile({optimisation, "-I", folder.path(), "-isystem", "/usr/include/eigen3", (at / "main.cpp").string(), "-o",
             (at / "program").string()});
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
    if (!values.contains("status"))
        throw Failure(
            Diagnostic{
                Id::tool_failed, {}, fmt::format("the generated program ended with code {}: {}", ran.exit_code, complaint(ran.errors))},
            ExitCode::tool_missing);
    return values;
}

}  // namespace dalembert
