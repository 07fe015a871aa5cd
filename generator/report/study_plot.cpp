// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/study_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "text/gnuplot.hpp"

namespace dalembert {

namespace {

constexpr std::size_t most_rows = 4, most_columns = 4;  // of panels
constexpr std::size_t most_dots = 5000;
constexpr int panel_width = 300, panel_height = 230;

/// As many bins as the root of the number of values, 5 to 60.
std::string histogram(const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const auto bins = static_cast<std::size_t>(std::clamp(std::sqrt(static_cast<double>(values.size())), 5.0, 60.0));
    const double width = *most > *least ? (*most - *least) / static_cast<double>(bins) : std::max(std::fabs(*least), 1.0) / 100;
    std::vector<std::size_t> counts(bins, 0);
    for (const double value : values) ++counts[std::min(static_cast<std::size_t>((value - *least) / width), bins - 1)];
    std::string data;
    for (std::size_t i = 0; i < bins; ++i)
        data += fmt::format("{:.8g} {} {:.8g}\n", *least + (static_cast<double>(i) + 0.5) * width, counts[i], width);
    return data;
}

std::string label(const char* axis, const Column& column) {
    return fmt::format("set {}label {} noenhanced\n", axis, gnuplot_quoted(column.title()));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> study_plot(const RunTable& table, const std::string& title) {
    const std::size_t across = std::min(table.varied.size(), most_columns - 1);
    std::string data, draw;
    std::size_t rows = 0;
    for (std::size_t y = 0; y < table.observed.size() && rows < most_rows; ++y) {
        std::vector<const RowOfRun*> good;
        std::vector<double> values;
        for (const RowOfRun& row : table.rows)
            if (row.is_good() && std::isfinite(row.observed[y])) {
                good.push_back(&row);
                values.push_back(row.observed[y]);
            }
        if (good.empty()) continue;
        data += fmt::format("$histogram_{} << EOD\n{}EOD\n$dots_{} << EOD\n", y, histogram(values), y);
        const std::size_t stride = (good.size() + most_dots - 1) / most_dots;
        for (std::size_t k = 0; k < good.size(); k += stride) {
            for (std::size_t x = 0; x < across; ++x) data += fmt::format("{:.8g} ", good[k]->varied[x]);
            data += fmt::format("{:.8g}\n", good[k]->observed[y]);
        }
        data += "EOD\n";
        draw += label("x", table.observed[y]) + "set ylabel 'runs'\nset yrange [0:*]\n" +
                fmt::format(
                    "plot $histogram_{} using 1:2:3 with boxes fs solid 0.6 border lc rgb '#2f7fd0' lc rgb '#2f7fd0' notitle\n"
                    "set yrange [*:*]\n",
                    y);
        for (std::size_t x = 0; x < across; ++x)
            draw += label("x", table.varied[x]) + label("y", table.observed[y]) +
                    fmt::format("plot $dots_{} using {}:{} with points pt 7 ps 0.25 lc rgb '#600060ad' notitle\n", y, x + 1, across + 1);
        ++rows;
    }
    if (rows == 0) return {};
    const std::string script =
        data + "set grid lc rgb '#dddddd'\nset border 3\nset tics nomirror\nset tics font ',8'\nset xtics rotate by -40\n";
    const std::string panels =
        fmt::format("set multiplot layout {},{} title {} noenhanced\n{}unset multiplot\n", rows, across + 1, gnuplot_quoted(title), draw);
    return gnuplot_pictures(script, panels, static_cast<int>(across + 1) * panel_width, static_cast<int>(rows) * panel_height + 40);
}

}  // namespace dalembert
