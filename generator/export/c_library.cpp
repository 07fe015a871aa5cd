// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/c_library.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "plant/compiler.hpp"
#include "text/diagnostic.hpp"
#include "text/process.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

/// Runs a compiler, and returns what it prints.
std::string called(const std::vector<std::string>& command, const std::string& refused) {
    const auto fail = [](std::string message) {
        throw Failure(Diagnostic{Id::tool_failed, {}, std::move(message)}, ExitCode::tool_missing);
    };
    const ProcessResult result = run_process(command);
    if (result.exit_code == 127)
        fail(fmt::format("the compiler '{}' cannot be started; set CC to a C compiler (on Debian: apt-get install gcc), or write the "
                         "sources alone with `--sources-only`",
                         command.front()));
    if (result.exit_code != 0)
        fail(fmt::format("the compiler '{}' refuses {}: {}", command.front(), refused, complaint(result.errors)));
    return result.output;
}

}  // namespace

std::vector<std::vector<std::string>> c_compilers() {
    const char* variable = std::getenv("CC");
    std::istringstream commands(variable != nullptr ? variable : "");
    std::vector<std::vector<std::string>> result;
    for (std::string command; std::getline(commands, command, ';');) {
        std::istringstream words(command);
        std::vector<std::string> compiler;
        for (std::string word; words >> word;) compiler.push_back(word);
        if (!compiler.empty()) result.push_back(std::move(compiler));
    }
    return result.empty() ? std::vector<std::vector<std::string>>{{"cc"}} : result;
}

std::string machine_of(const std::vector<std::string>& compiler) {
    std::vector<std::string> command = compiler;
    command.emplace_back("-dumpmachine");
    const std::string said = called(command, "to tell for which machine it compiles");
    return said.substr(0, said.find_first_of("\r\n"));
}

FileContents texts_of_runs() {
    FileContents texts;
    for (const EmbeddedFile& file : embedded_files())
        if (file.name.starts_with("dalembert_") && file.name.ends_with(".h")) texts.emplace_back(file.name, file.text);
    return texts;
}

// Calls of sin and the like need not set errno: equal calls become one.
std::vector<std::string> c_library_options() { return {"-std=c99", "-O2", "-fno-math-errno", "-fPIC", "-shared", "-fvisibility=hidden"}; }

std::string c_library(const FileContents& files, const std::string& main_file, std::vector<std::string> compiler) {
    const ScratchFolder scratch;
    const std::filesystem::path folder = scratch.path(), library = folder / "made.so";
    FileContents sources;
    for (const auto& [path, content] : files) sources.emplace_back(folder / path, content);
    write_files(sources);
    // Nothing in the library tells where it was made.
    const std::vector<std::string> places{fmt::format("-ffile-prefix-map={}=.", folder.string()), "-o", library.string(),
                                          (folder / main_file).string(), "-lm"};
    for (const std::vector<std::string>& options : {c_library_options(), places})
        compiler.insert(compiler.end(), options.begin(), options.end());
    called(compiler, fmt::format("the exported file '{}'", main_file));
    return read_file(library);
}

}  // namespace dalembert
