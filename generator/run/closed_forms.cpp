// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/closed_forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "emit/runner.hpp"

namespace dalembert {

namespace {

/// All digits of it.
cln::cl_R exact_number(long double value) {
    const double high = static_cast<double>(value);
    const double low = static_cast<double>(value - high);
    return cln::rational(cln::cl_float(high)) + cln::rational(cln::cl_float(low));
}

long double rounded(const cln::cl_R& value) {
    const double high = cln::double_approx(value);
    return static_cast<long double>(high) + static_cast<long double>(cln::double_approx(value - cln::rational(cln::cl_float(high))));
}

}  // namespace

void use_closed_forms(const PreparedRun& run, ReferenceRun& reference) {
    const System& system = *run.machine.system;
    const std::vector<std::string> columns = compared_columns(system);
    for (const auto& [name, form] : run.settings.exact) {
        const auto column = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
        if (column == columns.size()) continue;  // of states that stand behind outputs
        for (std::size_t k = 0; k < reference.counted; ++k) {
            std::vector<long double>& row = reference.rows[k];
            const auto value = value_at(form, {{system.symbols.time(), GiNaC::numeric(exact_number(row[0]))}}, 40);
            const long double scale = std::max<long double>(reference.scales[column], std::fabs(row[column + 1]));
            const double allowed = std::max(1e-9, 1000 * reference.error);
            if (!value || !(std::fabs(rounded(*value) - row[column + 1]) <= allowed * (scale > 0 ? scale : 1.0L)))
                throw Failure(
                    Diagnostic{
                        Id::wrong_closed_form,
                        {},
                        fmt::format(
                            "the closed form of '{}' differs from the run: at t = {:.6g} s it is {}, but the integration gives {:.12g}",
                            name, static_cast<double>(row[0]), value ? fmt::format("{:.12g}", cln::double_approx(*value)) : "no number",
                            static_cast<double>(row[column + 1]))},
                    ExitCode::check_failed);
            row[column + 1] = rounded(*value);
        }
        reference.closed_forms.push_back(name);
    }
}

}  // namespace dalembert
