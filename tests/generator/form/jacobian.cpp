// SPDX-License-Identifier: GPL-3.0-or-later
// Partial derivatives of large sums, of which only the terms with a letter are looked at.
#include "form/jacobian.hpp"

#include <set>
#include <string>

#include "generator/machine.hpp"
#include "graph/code.hpp"
#include "graph/verify.hpp"

using namespace dalembert;
using GiNaC::ex;

TEST_CASE("terms without the letter have no part in a derivative") {
    struct Case {
        const char *system, *scene;
    };
    for (const Case& one : {Case{"n_pendulum", ""},
                            {"heavy_top", "attitude"},
                            {"slider_crank", ""},
                            {"hydraulics/hydraulic_cylinder", "real"},
                            {"heat/enclosure", ""},
                            {"heat/heat_conduction", ""}}) {
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
                    for (std::size_t i = 0; i < rows.size(); ++i)
                        CHECK(derivatives[c][i].is_equal(by_column(system, rows[i], *columns[c])));
                }
            };
            check(found.residual, system.motion.residual);
            check(found.state_rate, system.state_rates);
            check(found.output, outputs);
            check(found.held, held);
        }
    }
}

TEST_CASE("derivatives by parameters that nobody asks for are left out") {
    Machine machine = machine_of("cart_pendulum", "lab");
    const std::vector<const Variable*> columns = column_variables(machine.system->symbols, By::parameter);
    const auto all = make_code(*machine.system);
    machine.system->slopes_by = std::set<std::string>{"d_R"};
    const auto few = make_code(*machine.system);
    const auto entries = [&](const Code& code, const Variable& column) {
        std::size_t count = 0;
        const FunctionCode& function = code[Function::jacobian_p];
        for (std::size_t row = 0; row < function.right.rows; ++row)
            count += !function.is_zero(function.right.at(row, column.position));
        return count;
    };
    for (const Variable* column : columns) {
        CAPTURE(column->name);
        CHECK(entries(*few, *column) == (column->name == "d_R" ? entries(*all, *column) : 0));
    }
    CHECK(few->count(Function::jacobian_p).total() < all->count(Function::jacobian_p).total() / 2);
    CHECK(few->count(Function::rhs_and_jacobian).total() == all->count(Function::rhs_and_jacobian).total());
    for (const AuditEntry& entry : verify(*few)) CHECK(entry.result.verdict == Verdict::proven);
}
