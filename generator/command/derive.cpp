// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>

#include "command/command_line.hpp"
#include "report/json_output.hpp"
#include "run/shared.hpp"
#include "emit/equations.hpp"

namespace dalembert {

ExitCode derive_command(const Options& options, Streams streams) {
    const Machine machine = derived(options, streams);
    std::vector<const System*> modes{machine.system.get()};
    for (const Machine& other : machine.other_modes) modes.push_back(other.system.get());
    if (options.format == "json") {
        nlohmann::ordered_json json = json_result("derive", machine.system->scene);
        json.update(equations_as_json(*machine.system));
        for (const System* system : modes)
            if (system->scene.mode) json["modes"].push_back(mode_as_json(*system));
        streams.out << printed(json);
        return ExitCode::good;
    }
    for (const System* system : modes) streams.out << (system == modes.front() ? "" : "\n") << (options.format == "latex" ? equations_as_latex(*system) : equations_as_text(*system));
    return ExitCode::good;
}

}  // namespace dalembert
