// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/new.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/checks.hpp"
#include "command/project_kinds.hpp"
#include "command/write_result.hpp"
#include "text/template.hpp"

namespace dalembert {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(Id id, std::string sentence) { throw Failure(Diagnostic{id, {}, std::move(sentence)}); }

void check_name(const std::string& name) {
    if (const auto problem = problem_of_model_name(name)) refuse(problem->id, problem->sentence);
}

/// Nothing that exists is written over.
void check_folder(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder, error)) return;
    if (!fs::is_directory(folder, error))
        refuse(Id::bad_option, fmt::format("the project needs the folder '{}', but there is a file of this name", folder.string()));
    if (!fs::is_empty(folder, error) || error)
        refuse(Id::bad_option, fmt::format("the folder '{}' exists and is not empty; a new project needs a new folder, or an empty one",
                                           folder.string()));
}

/// The files of a project: templates/new/FOLDER/NAME.toml.in becomes NAME.toml, with the name of the project.
void add_files(FileContents& files, const std::string& folder_of_templates, const std::string& name, const fs::path& folder) {
    const std::string start = "new/" + folder_of_templates + "/", placeholder = "NAME", ending = ".in";
    for (const EmbeddedFile& file : embedded_files()) {
        if (!file.name.starts_with(start)) continue;
        std::string file_name(file.name.substr(start.size(), file.name.size() - start.size() - ending.size()));
        if (file_name.starts_with(placeholder)) file_name.replace(0, placeholder.size(), name);
        std::map<std::string, std::string> values;
        if (file.text.find("@" + placeholder + "@") != std::string_view::npos) values[placeholder] = name;
        files.emplace_back(folder / file_name, fill_template(file.text, values));
    }
}

}  // namespace

ExitCode new_command(const Options& options, Streams streams) {
    const auto kind =
        std::find_if(project_kinds.begin(), project_kinds.end(), [&](const ProjectKind& one) { return one.name == options.kind; });
    const fs::path folder = (fs::path(options.output) / options.project).lexically_normal();
    check_name(options.project);
    check_folder(folder);
    FileContents files;
    add_files(files, "common", options.project, folder);
    add_files(files, kind->name, options.project, folder);
    std::sort(files.begin(), files.end());
    write_files(files);
    write_result(NewResult{options.project, kind->name, kind->doc, folder, paths_of(files)}, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert
