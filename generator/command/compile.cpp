// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/compile.hpp"

#include "command/write_result.hpp"
#include "run/plant_run.hpp"
#include "run/shared.hpp"
#include "text/process.hpp"
#include "text/template.hpp"

namespace dalembert {

ExitCode compile_command(const Options& options, Streams streams) {
    Machine machine = derived(options, streams);
    refuse_rest(*machine.system, "compile");
    tell_of_samplers(*machine.system, streams);
    ask_of_code(machine, options);
    const Header header = generate(machine);
    const Scene& scene = machine.system->scene;
    const std::filesystem::path folder = options.output;
    CompileResult result{subject_of(scene), folder / fmt::format("{}_{}.so", scene.sized_name(), scene.name), folder / "dalembert_plant.h"};
    const ScratchFolder scratch;
    const std::filesystem::path made = std::filesystem::path(scratch.path()) / "plant.so";
    compile_plant(source_of_plant(*machine.code, header), made);
    const std::string library = read_file(made);
    result.bytes = library.size();
    write_files({{result.plant, library}, {result.header, std::string(embedded_file("plant.h"))}});
    write_result(result, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert
