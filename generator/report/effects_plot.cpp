// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/effects_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "text/gnuplot.hpp"

namespace dalembert {

std::vector<std::pair<std::string, std::string>> effects_plot(const SceneComparison& comparison, const std::string& title) {
    // On a logarithmic axis no deviation at all is drawn a decade below the smallest one.
    double smallest = 1;
    for (const ComparedScene& s : comparison.scenes)
        if (const Deviation* worst = s.worst(); worst != nullptr && worst->relative > 0) smallest = std::min(smallest, worst->relative);
    const double floor = std::max(std::pow(10.0, std::floor(std::log10(smallest)) - 1), 1e-17);
    // Times are told by that of the scene compared with, because they are another machine's on another day.
    const ComparedScene& reference = comparison.scenes[comparison.against];
    std::string data;
    for (const bool is_named : {true, false}) {
        for (std::size_t i = 0; i < comparison.scenes.size(); ++i) {
            const ComparedScene& s = comparison.scenes[i];
            if (s.is_named != is_named || !s.is_known() || s.deviations.empty() || s.worst() == nullptr) continue;
            data +=
                fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} \"{}\"\n", s.median() / reference.median(), std::max(s.worst()->relative, floor),
                            s.nanoseconds.front() / reference.median(), s.nanoseconds.back() / reference.median(),
                            i == comparison.against       ? s.wish + " (compared with)"
                            : s.worst()->relative < floor ? s.wish + " (no deviation)"
                                                          : s.wish);
        }
        data += "\n\n";
    }
    const std::string script =
        fmt::format("$points << EOD\n{}EOD\n", data) +
        "set logscale y\nset format y '%.0e'\nset offsets graph 0.05, graph 0.25, 0, 0\nset yrange [" + fmt::format("{:.3g}", floor / 2) +
        ":*]\nset xrange [0:*]\nset xlabel " +
        gnuplot_quoted(fmt::format("time of one right-hand side, relative to '{}' ({:.3g} ns)", reference.wish, reference.median())) +
        " noenhanced\nset ylabel 'largest deviation of an output, relative'\nset key outside top right horizontal\nset grid lc rgb "
        "'#dddddd'\nset border 3\n"
        "set tics nomirror\n" +
        fmt::format("set title {} noenhanced\n", gnuplot_quoted(title + ": scenes, and scenes with one effect changed"));
    const std::string draw =
        "plot $points index 0 using 1:2:3:4 with xerrorbars pt 7 ps 1.2 lc rgb '#0060ad' title 'scenes of the model', $points index 1 "
        "using 1:2:3:4 with xerrorbars pt 6 lc rgb '#c03028' title 'one effect changed', "
        "$points index 0 using 1:2:5 with labels left offset 0.8,0.6 font ',9' textcolor rgb '#0060ad' noenhanced notitle, "
        "$points index 1 using 1:2:5 with labels left offset 0.8,-0.6 font ',9' textcolor rgb '#c03028' noenhanced notitle\n";
    return gnuplot_pictures(script, draw, 900, 600);
}

}  // namespace dalembert
