// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/precision_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plant/methods.hpp"
#include "text/gnuplot.hpp"

namespace dalembert {

namespace {

constexpr std::array colours{"#0060a8", "#c03028", "#2a8a3a", "#8a5a00", "#7a3a9a", "#00858a", "#c06a90", "#606060", "#b09a00", "#30c8c8"};
static_assert(colours.size() == methods_of_integration.size());

struct PlottedCurve {
    std::string method, arithmetic, data;
};

/// One block of data a curve, in the order in which they were measured: time, calls, error at the end, on the way.
std::vector<PlottedCurve> curves_of(const std::vector<WorkPoint>& measured, double until, double floor) {
    std::vector<PlottedCurve> curves;
    for (const WorkPoint& p : measured) {
        if (!p.is_good) continue;
        if (curves.empty() || curves.back().method != p.plan.method || curves.back().arithmetic != p.plan.arithmetic)
            curves.push_back({p.plan.method, p.plan.arithmetic, {}});
        curves.back().data += fmt::format("{:.6g} {} {:.6g} {:.6g}\n", p.fastest / until, p.rhs_calls, std::max(p.error_at_end, floor),
                                          std::max(p.error, floor));
    }
    return curves;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> precision_plot(const std::vector<WorkPoint>& measured, double until,
                                                                const std::vector<Level>& levels, const std::string& title) {
    constexpr double floor = 1e-18;
    const std::vector<PlottedCurve> curves = curves_of(measured, until, floor);
    if (curves.empty()) return {};
    std::vector<std::string> methods;
    for (const PlottedCurve& curve : curves)
        if (std::find(methods.begin(), methods.end(), curve.method) == methods.end()) methods.push_back(curve.method);
    std::string script = "$points << EOD\n";
    for (const PlottedCurve& curve : curves) script += curve.data + "\n\n";
    script +=
        "EOD\nset logscale xy\nset format xy '10^{%L}'\nset grid lc rgb '#dddddd'\nset border 3\nset tics nomirror\nset yrange [*:10]\nset "
        "key off\n";
    const std::vector<std::string> all = method_names();
    const auto look = [&](const std::string& method, const std::string& arithmetic) {
        const auto colour = static_cast<std::size_t>(std::find(all.begin(), all.end(), method) - all.begin());  // the same in every diagram
        const bool is_double = arithmetic == "double", is_float = arithmetic == "float";
        return fmt::format("with linespoints lc rgb '{}' dt {} lw {} pt {} ps {}", method.empty() ? "#404040" : colours[colour],
                           is_double  ? "1"
                           : is_float ? "'-'"
                                      : "'.'",
                           is_double ? 1.6 : 1.0,
                           is_double  ? 7
                           : is_float ? 2
                                      : 6,
                           is_double ? 0.6 : 0.5);
    };
    const auto panel = [&](double left, double bottom, const char* x, const char* y, int column_x, int column_y) {
        std::string text =
            fmt::format("set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n", left,
                        left + 0.31, bottom, bottom + 0.36) +
            fmt::format("set xlabel {} noenhanced\nset ylabel {} noenhanced\n", gnuplot_quoted(x), gnuplot_quoted(y));
        std::string plots;
        for (std::size_t i = 0; i < curves.size(); ++i)
            plots += fmt::format("{}$points index {} using {}:{} {}", plots.empty() ? "plot " : ", ", i, column_x, column_y,
                                 look(curves[i].method, curves[i].arithmetic));
        for (const Level& level : levels)
            if (level.error > floor) plots += fmt::format(", {:.6g} with lines lc rgb '#909090' dt 4 lw 1", level.error);
        return text + plots + "\n";
    };
    // Curves are told by colour and by dashes; one key says both.
    std::string key =
        "set lmargin at screen 0.86\nset rmargin at screen 0.99\nset bmargin at screen 0.1\nset tmargin at screen 0.9\nunset border\nunset "
        "tics\nunset xlabel\nunset ylabel\nunset grid\nset key at screen 0.99,0.88 right top noenhanced samplen 2\nset yrange [1:2]\nset "
        "xrange [1:2]\nplot ";
    for (const std::string& method : methods) key += fmt::format("NaN {} title {}, ", look(method, "double"), gnuplot_quoted(method));
    for (const auto& [arithmetic, name] :
         {std::pair("float", "in float"), std::pair("double", "in double"), std::pair("long_double", "in long double")})
        if (std::any_of(curves.begin(), curves.end(), [&, &a = arithmetic](const auto& curve) { return curve.arithmetic == a; }))
            key += fmt::format("NaN {} title {}, ", look("", arithmetic), gnuplot_quoted(name));
    for (const Level& level : levels)
        if (level.error > floor)
            key += fmt::format("NaN with lines lc rgb '#909090' dt 4 lw 1 title {}, ",
                               gnuplot_quoted(fmt::format("{}: {:.0e}", level.title, level.error)));
    key += "NaN notitle\n";
    const char* times = "time [us per simulated second]";
    const char* calls = "calls of the right-hand side";
    const std::string draw = fmt::format("set multiplot title {} noenhanced\n", gnuplot_quoted(title)) +
                             panel(0.08, 0.57, times, "largest error on the way", 1, 4) +
                             panel(0.47, 0.57, calls, "largest error on the way", 2, 4) +
                             panel(0.08, 0.09, times, "error at the end", 1, 3) + panel(0.47, 0.09, calls, "error at the end", 2, 3) + key +
                             "unset multiplot\nset border\nset tics\nset grid\nset yrange [*:10]\nset xrange [*:*]\nset key off\n";
    return gnuplot_pictures(script, draw, 1300, 900);
}

}  // namespace dalembert
