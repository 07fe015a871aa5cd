// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>

#include "command/command_line.hpp"
#include "command/json_output.hpp"
#include "command/shared.hpp"
#include "emit/equations.hpp"

namespace dalembert {

ExitCode derive_command(const Options& options, Streams streams) {
    const Machine machine = derived(options, streams);
    const System& system = *machine.system;
    if (options.format == "json") {
        nlohmann::ordered_json json = json_result("derive", system.scene);
        json.update(equations_as_json(system));
        streams.out << printed(json);
    } else {
        streams.out << (options.format == "latex" ? equations_as_latex(system) : equations_as_text(system));
    }
    return ExitCode::good;
}

}  // namespace dalembert
