// SPDX-License-Identifier: GPL-3.0-or-later
// `peers write FOLDER MODEL...` writes a program for each model, and how ninja builds and runs them; `peers table FOLDER` prints what they
// found. See ./dev peers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <iostream>

#include "benchmarks/peers/table.hpp"
#include "run/shared.hpp"
#include "run/simulation.hpp"
#include "form/system.hpp"

namespace {

using namespace dalembert;
namespace fs = std::filesystem;

constexpr std::size_t most_states = 20;

/// The type Problem that programs of `dalembert cost` have, without their main.
std::string problem_source(PreparedRun& run) {
    const std::string source = work_precision_source(*run.machine.code, run.header, run.values, run.settings, {"double"});
    const std::size_t end = source.find("int main(");
    if (end == std::string::npos) throw std::runtime_error("the template work_precision.cpp.in has no main");
    return source.substr(0, end) + "#include \"benchmarks/peers/compare.hpp\"\n\nint main(int argc, char** argv) { return peers::compare<Problem>(argc, argv); }\n";
}

/// The name of what was written; nothing where the machine is left out, which is said.
std::string write_problem(const fs::path& folder, const std::string& path) {
    Options options;
    options.choice.model = path;
    const Streams streams{std::cout, std::cerr};
    const auto leave_out = [&](const std::string& why) {
        fmt::print("{} is left out: {}\n", path, why);
        return std::string();
    };
    try {
        const auto model = loaded(options, streams);
        const std::string bound = scene_of_run(model->model, "");
        PreparedRun run = prepare_run(model, bound.empty() ? resolve_scene(model->model, "") : bound, options, "cost", true);
        const Scene& scene = run.machine.system->scene;
        if (!scene.modes.empty()) return leave_out("it switches");
        if (scene.state_count() == 0) return leave_out("it has no states");
        if (scene.state_count() > most_states) return leave_out(fmt::format("it has {} states", scene.state_count()));
        if (!(run.settings.until > 0)) return leave_out("it has no run");
        write_files({{folder / run.header.file_name, run.header.text}, {folder / (run.name + ".cpp"), problem_source(run)}});
        return run.name;
    } catch (const Failure& failure) {
        return leave_out(failure.diagnostics().empty() ? failure.what() : failure.diagnostics().front().message);
    }
}

/// Programs are compiled side by side, and run one after the other. All builds are of one version, which the programs make sure of.
std::string ninja_file(const std::vector<std::string>& names, const std::vector<peers::Build>& builds) {
    std::string text = fmt::format("flags = -std=c++17 {} -I. -I{}/runtime -I{}/tests -isystem /usr/include/eigen3\npool one\n  depth = 1\nrule compile\n  command = {} $flags $include -MD -MF $out.d -c $in -o $out\n  depfile = $out.d\n  deps = gcc\n",
                                   PEERS_FLAGS, SOURCE_DIR, SOURCE_DIR, PEERS_COMPILER);
    text += fmt::format("rule link\n  command = {} $in $libraries -o $out\nrule run\n  command = ./$in $name \"$build\" $name.$build.cheapest.csv $name.$build.runs.csv\n  pool = one\n  description = $name, $build\n", PEERS_COMPILER);
    for (const std::string& name : names) {
        text += fmt::format("build {0}.o: compile {0}.cpp\n  include = {1}\n", name, builds.front().include_flags());
        for (const peers::Build& build : builds) {
            text += fmt::format("build {0}.{1}.program: link {0}.o\n  libraries = {2}\n", name, build.name, build.link_flags());
            text += fmt::format("build {0}.{1}.cheapest.csv | {0}.{1}.runs.csv: run {0}.{1}.program\n  name = {0}\n  build = {1}\n", name, build.name);
        }
    }
    return text;
}

}  // namespace

int main(int argc, char** argv) try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.size() == 2 && arguments[0] == "table") return peers::print_table(arguments[1], PEERS_FLAGS);
    if (arguments.size() < 3 || arguments[0] != "write") {
        fmt::print(stderr, "peers write FOLDER MODEL... | peers table FOLDER\n");
        return 2;
    }
    const fs::path folder = arguments[1];
    fs::create_directories(folder);
    std::vector<std::string> names;
    for (std::size_t i = 2; i < arguments.size(); ++i)
        if (const std::string name = write_problem(folder, arguments[i]); !name.empty()) names.push_back(name);
    write_files({{folder / "build.ninja", ninja_file(names, peers::builds())}});
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "peers: {}\n", error.what());
    return 3;
}
