// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "read/matrices.hpp"
#include "read/rules.hpp"
#include "text/budgets.hpp"

namespace dalembert {

void check_rules(const Entry& e, PrintedEquation& printed) {
    printed.equations = e.has("equations") ? e.equations("equations") : e.equations("equation");
    for (const RunEntry& letter : e.by_name("with")) {
        if (letter.variable->kind == Expression::Kind::name && letter.variable->children.empty())
            printed.letters.push_back({letter.variable->name, letter.value, letter.span});
        else
            e.error(Id::bad_name, letter.span, fmt::format("'{}' is not a letter", letter.variable->written()));
    }
    for (const RunEntry& entry : e.by_name("at")) printed.at.push_back({entry.variable, entry.value});
    printed.shown = printed.equations;
    printed.shown_letters = printed.letters;
    try {
        take_matrices_apart(printed);
    } catch (const Failure& failure) {
        for (const Diagnostic& d : failure.diagnostics()) e.error(d.id, d.span, d.message);
    }
}

void check_rules(const Entry& e, Run& run) {
    run.scene_span = e.span_of("scene");
    if (!cln::plusp(run.tolerance) || run.tolerance >= 1)
        e.error(Id::value_out_of_range, e.span_of("tolerance"), "the tolerance lies between 0 and 1");
    if (run.samples < 1 || run.samples > budget::samples)
        e.error(Id::value_out_of_range, e.span_of("samples"), fmt::format("the number of samples lies between 1 and {}", budget::samples));
}

}  // namespace dalembert
