// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/octave.hpp"

#include <fmt/format.h>

#include "export/c_library.hpp"
#include "export/example_run.hpp"
#include "export/plant_texts.hpp"
#include "run/plant_run.hpp"
#include "text/process.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace {

constexpr const char* flags = "-std=c99 -O2 -fno-math-errno";

/// Lines of a comment.
std::string commented(const std::string& text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        result += end == at ? "%\n" : "% " + text.substr(at, end - at) + "\n";
        at = end + 1;
    }
    return result;
}

FileContents octave_texts(const ExportSubject& subject) {
    FileContents texts = subject.c_files;
    for (auto& text : texts_of_runs()) texts.push_back(std::move(text));
    for (const char* name : {"many_points.h", "recorded_run.h"}) texts.emplace_back(name, embedded_file(name));
    for (const char* name : {"octave.c", "octave_arguments.h", "octave_names.h", "octave_run.h"})
        texts.emplace_back(name, embedded_file(fmt::format("octave/{}", name)));
    texts.emplace_back("plant.c", fill_template(embedded_file("octave/plant.c.in"), {{"NAME", subject.name}}));
    texts.emplace_back("build.m", fill_template(embedded_file("octave/build.m.in"), {{"NAME", subject.name}, {"FLAGS", flags}}));
    return texts;
}

std::string function_text(const ExportSubject& subject) {
    const Plant& plant = subject.plant;
    return fill_template(embedded_file("octave/plant.m.in"),
                         {{"NAME", subject.name},
                          {"AT", "@"},  // of function handles
                          {"TITLE", plant.title.empty() ? plant.model : plant.title},
                          {"SCENE", plant.scene},
                          {"TABLES", commented(table_text("States x", plant.states) + table_text("Inputs u", plant.inputs) +
                                               table_text("Outputs y", plant.outputs) + table_text("Parameters p", plant.parameters))},
                          {"EQUATIONS", commented(equations_text(subject.machine))}});
}

/// The fields of a struct by the places of the names in a table: "p.(fields{3}) = 2;" needs no spelling of names in two languages.
std::string assignments(const NamedNumbers& numbers, const std::vector<PlantQuantity>& table, const char* pattern) {
    std::string text;
    for (std::size_t i = 0; i < table.size(); ++i)
        for (const auto& [name, value] : numbers)
            if (name == table[i].name) text += fmt::format(fmt::runtime(pattern), i + 1, value, name);
    return text;
}

std::string octave_example(const ExportSubject& subject) {
    const ExampleRun run = example_run(subject);
    std::string inputs;
    for (const auto& [name, value] : run.inputs) inputs += fmt::format("{}{}", inputs.empty() ? "" : "; ", value);
    return fill_template(
        embedded_file("octave/example.m.in"),
        {{"NAME", subject.name},
         {"PARAMETERS", assignments(run.parameters, subject.plant.parameters, "p.(plant.parameters({0}).field) = {1};  % {2}\n")},
         {"START", assignments(run.start, subject.plant.states, "x0({0}) = {1};  % {2}\n")},
         {"INPUTS", "[" + inputs + "]"},
         {"UNTIL", fmt::format("{}", run.until)}});
}

/// The MEX function; a note where there is no mkoctfile, or it fails.
void compile_mex(Exported& result, const FileContents& texts, const ExportSubject& subject) {
    const ScratchFolder scratch;
    const std::filesystem::path folder = scratch.path(), made = folder / "made.mex";
    FileContents placed;
    for (const auto& [path, content] : texts) placed.emplace_back(folder / path, content);
    write_files(placed);
    // Without the names of source files that debuggers read: they would tell the folder.
    const ProcessResult compiled = run_process({"env", fmt::format("CFLAGS={} -ffile-prefix-map={}=.", flags, folder.string()), "mkoctfile",
                                                "--mex", "-s", "-I" + folder.string(), "-o", made.string(), (folder / "plant.c").string()});
    if (compiled.exit_code == 0 && std::filesystem::exists(made))
        result.files.emplace_back(std::filesystem::path(subject.name) / (subject.name + "_mex.mex"), read_file(made));
    else
        result.notes.push_back(
            fmt::format("the MEX function is not compiled, because mkoctfile {}; Octave or MATLAB compile it at the first call of {}",
                        compiled.exit_code == 127 ? "is missing (on Debian: apt-get install octave-dev)" : "fails", subject.name));
}

}  // namespace

Exported octave_files(const ExportSubject& subject, const ExportWish& wish) {
    const std::filesystem::path folder = subject.name;
    const FileContents texts = octave_texts(subject);
    Exported result;
    result.files.emplace_back(folder / (subject.name + ".m"), function_text(subject));
    result.files.emplace_back(folder / (subject.name + "_example.m"), octave_example(subject));
    for (const auto& [path, text] : texts) result.files.emplace_back(folder / "c" / path, text);
    if (!wish.sources_only) compile_mex(result, texts, subject);
    return result;
}

}  // namespace dalembert
