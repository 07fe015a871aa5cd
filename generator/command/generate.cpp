// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/generate.hpp"

#include "command/write_result.hpp"
#include "report/dump.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "text/files.hpp"

namespace dalembert {

namespace {

/// What is known of a header. After generate.
GeneratedHeader generated_header(const Machine& machine, const Header& header, const std::filesystem::path& path) {
    GeneratedHeader result{subject_of(machine.system->scene),
                           path,
                           header.name_space,
                           header.text.size(),
                           machine.system->symbols.degrees(),
                           proofs_of(machine).all_proven(),
                           machine.system->scene.sampling != nullptr,
                           operations(machine, main_function(machine)).total(),
                           {},
                           {},
                           machine.stages,
                           rewritten_places(machine)};
    for (std::size_t i = 0; i < function_count; ++i) {
        const auto function = static_cast<Function>(i);
        if (is_made(header_function(function), *machine.system, machine.wished))
            result.operations.emplace_back(name_of(function), operations(machine, function));
    }
    for (std::size_t i = 0; machine.fields && i < machine.fields->fields.size(); ++i) {
        const FieldFunctions& f = machine.fields->fields[i];
        result.cells.push_back({f.field->body->name, f.field->cells, machine.fields->per_cell(f).total()});
    }
    return result;
}

}  // namespace

ExitCode generate_command(const Options& options, Streams streams) {
    const auto model = loaded(options, streams);
    const std::vector<std::string> scenes =
        options.every_scene ? scene_names(model->model) : std::vector<std::string>{options.choice.scene};
    FileContents files;
    GenerateResult result{{}, options.every_scene, options.explain};
    for (const std::string& scene : scenes) {
        Machine machine = derive_machine(model, scene, options.choice.sizes, parse_fixed(options.fix, model->names));
        show_warnings(machine, streams);
        show_doubts(machine, streams);
        ask_of_code(machine, options);
        const Header header = generate(machine, options.taylor ? SeriesWish::wanted : SeriesWish::none);
        if (!options.dump.empty()) {
            streams.out << dumped(machine, options.dump, header);
            return ExitCode::good;
        }
        const std::filesystem::path path =
            std::filesystem::path(options.output) / (options.header.empty() ? header.file_name : options.header);
        files.emplace_back(path, header.text);
        result.headers.push_back(generated_header(machine, header, path));
    }
    write_files(files);
    write_result(result, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert
