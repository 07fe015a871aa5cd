// SPDX-License-Identifier: GPL-3.0-or-later
#include <doctest/doctest.h>

#include "run/plant_run.hpp"

using namespace dalembert;

TEST_CASE("the time axis of a plot has a unit that can be read off") {
    struct Row {
        double end;
        const char* unit;
        double shown;
    };
    for (const Row& row : {Row{1199, "s", 1199}, Row{1800, "min", 30}, Row{10800, "h", 3}, Row{864000, "d", 10}}) {
        CAPTURE(row.end);
        const Recording recording{{{"t", "s"}, {"T", "K"}}, {{0, 280}, {row.end, 300}}};
        const Recording plot = for_plots(recording, {{"T", "degC", 1, 273.15}});
        CHECK(plot.columns[0].unit == row.unit);
        CHECK(plot.rows[1][0] == doctest::Approx(row.shown));
        CHECK(plot.columns[1].unit == "degC");
        CHECK(plot.rows[1][1] == doctest::Approx(26.85));
    }
    CHECK(for_plots({{{"t", "s"}}, {}}, {}).columns[0].unit == "s");
}
