// SPDX-License-Identifier: GPL-3.0-or-later
// Partial derivatives of large sums, of which only the terms with a letter are looked at.
#include "form/jacobian.hpp"

#include "generator/machine.hpp"

using namespace dalembert;
using GiNaC::ex;

TEST_CASE("terms without the letter have no part in a derivative") {
    struct Case {
        const char *system, *scene;
    };
    for (const Case& one : {Case{"n_pendulum", ""}, {"heavy_top", "attitude"}, {"slider_crank", ""}, {"hydraulics/hydraulic_cylinder", "real"}, {"heat/enclosure", ""}, {"heat/heat_conduction", ""}}) {
        CAPTURE(one.system);
        const Machine machine = machine_of(one.system, one.scene);
        const System& system = *machine.system;
        std::vector<ex> outputs, held;
        for (const OutputEquation& output : system.outputs) outputs.push_back(system.with_rates(output.value));
        for (const auto& [coordinate, acceleration] : system.motion.accelerations) held.push_back(acceleration);
        for (const By by : {By::state, By::input, By::parameter, By::time}) {
            const Partials found = partials(system, by);
            const std::vector<const Variable*> columns = column_variables(system.symbols, by);
            const auto check = [&](const std::vector<std::vector<ex>>& derivatives, const std::vector<ex>& rows) {
                REQUIRE(derivatives.size() == columns.size());
                for (std::size_t c = 0; c < columns.size(); ++c) {
                    REQUIRE(derivatives[c].size() == rows.size());
                    for (std::size_t i = 0; i < rows.size(); ++i) CHECK(derivatives[c][i].is_equal(by_column(system, rows[i], *columns[c])));
                }
            };
            check(found.residual, system.motion.residual);
            check(found.state_rate, system.state_rates);
            check(found.output, outputs);
            check(found.held, held);
        }
    }
}
