// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/accuracy.hpp"

#include "command/write_result.hpp"
#include "run/shared.hpp"

namespace dalembert {

ExitCode accuracy_command(const Options& options, Streams streams) {
    Machine machine = derived(options, streams);
    refuse_fields(*machine.system, "accuracy");
    ask_of_code(machine, options);
    const Header header = generate(machine);
    const AccuracyMeasurement measurement(machine, header);
    const auto measured = [&](const Arithmetic& arithmetic) {
        return measurement.measure(arithmetic, static_cast<std::size_t>(options.test_points), options.seed);
    };
    AccuracyReport in_float = measured(float_arithmetic()), in_double = measured(double_arithmetic());
    AccuracyResult result{subject_of(machine.system->scene), options.seed, options.ulp_limit, {}, std::move(in_float), std::move(in_double),
                          rewritten_places(machine), options.explain};
    for (const Variable* input : ExactCode::inputs(*machine.system)) result.inputs.push_back(input->name);
    write_result(result, options, streams);
    return result.is_good() ? ExitCode::good : ExitCode::check_failed;
}

}  // namespace dalembert
