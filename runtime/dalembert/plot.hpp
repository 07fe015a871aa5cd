// SPDX-License-Identifier: BSL-1.0
// Plots through gnuplot: one picture with a panel for each plot, as SVG and PNG.
#pragma once

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "dalembert/recording.hpp"

namespace dalembert {
inline namespace v1 {

/// Curves over one column; an empty x is the first column of the recording.
struct Panel {
    std::string title;
    std::string x;
    std::vector<std::string> y;
    std::vector<std::string> points = {};  ///< drawn as points and not as lines
};

namespace detail {

/// The name of a file; a quote in it is doubled.
inline std::string gnuplot_path(const std::string& path) {
    std::string result = "'";
    for (const char c : path) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

/// A gnuplot string. In single quotes only the quote itself is special; it becomes typographic.
inline std::string gnuplot_string(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'')
            result += "\xE2\x80\x99";
        else if (static_cast<unsigned char>(c) < 0x20 || c == '`')
            result += ' ';
        else
            result += c;
    }
    return result + "'";
}

/// The title of a single curve; the units of several curves, which the legend names.
inline std::string axis_title(const Recording& recording, const std::vector<std::string>& names) {
    if (names.size() == 1) return recording.columns[recording.find(names[0])].title();
    std::string title;
    for (const std::string& name : names) {
        const std::string unit = "[" + recording.columns[recording.find(name)].unit + "]";
        if (unit != "[]" && title.find(unit) == std::string::npos) title += (title.empty() ? "" : ", ") + unit;
    }
    return title;
}

struct Limits {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double span() const { return high - low; }
};

inline Limits limits(const Recording& recording, const std::vector<std::string>& names) {
    Limits result;
    for (const std::string& name : names) {
        for (const std::vector<double>& row : recording.rows) {
            result.low = std::min(result.low, row[recording.find(name)]);
            result.high = std::max(result.high, row[recording.find(name)]);
        }
    }
    return result;
}

/// Limits for curves that change by rounding only, so that constant curves look constant; otherwise gnuplot's own.
inline std::string range_command(const Limits& y) {
    const double size = std::max(std::abs(y.low), std::abs(y.high));
    if (!std::isfinite(size) || !(size > 0) || !(y.span() < 1e-6 * size)) return "set autoscale y\n";
    const double middle = (y.low + y.high) / 2;
    return "set yrange [" + number_text(middle - 0.1 * size) + ":" + number_text(middle + 0.1 * size) + "]\n";
}

/// A path in space keeps its shape; its numbers below need room, since it may be narrow.
inline std::string path_commands(const Limits& x, const Limits& y) {
    constexpr double panel_width = 750;
    constexpr double panel_height = 180;
    constexpr double label_width = 90;
    const double width = y.span() > 0 ? std::min(panel_width, panel_height * x.span() / y.span()) : panel_width;
    const double least = x.span() / std::max(2.0, width / label_width);
    const double decade = std::pow(10.0, std::floor(std::log10(least)));
    const double step = decade * (least <= decade ? 1 : least <= 2 * decade ? 2 : least <= 5 * decade ? 5 : 10);
    return "set size ratio -1\nset lmargin\nset rmargin\n" +
           (std::isfinite(step) && step > 0 ? "set xtics " + number_text(step) + "\n" : std::string());
}

/// Rows for a picture. Of very many, those that hold the smallest or largest value of a column among their neighbours: they look the same.
inline std::vector<const std::vector<double>*> rows_to_draw(const Recording& recording) {
    constexpr std::size_t most = 20000, groups = 2000;
    const std::size_t count = recording.rows.size(), length = count <= most ? 1 : (count + groups - 1) / groups;
    std::vector<bool> is_drawn(count, length == 1);
    for (std::size_t begin = 0; length > 1 && begin < count; begin += length) {
        const std::size_t end = std::min(begin + length, count);
        is_drawn[begin] = is_drawn[end - 1] = true;
        for (std::size_t column = 0; column < recording.columns.size(); ++column) {
            std::size_t low = begin, high = begin;
            for (std::size_t i = begin; i < end; ++i) {
                if (recording.rows[i][column] < recording.rows[low][column]) low = i;
                if (recording.rows[i][column] > recording.rows[high][column]) high = i;
            }
            is_drawn[low] = is_drawn[high] = true;
        }
    }
    std::vector<const std::vector<double>*> rows;
    for (std::size_t i = 0; i < count; ++i)
        if (is_drawn[i]) rows.push_back(&recording.rows[i]);
    return rows;
}

}  // namespace detail

/// The commands that draw the panels below each other. Panels with a name that the recording does not have are left out.
inline std::string gnuplot_commands(const Recording& recording, const std::vector<Panel>& panels, const std::string& title) {
    std::vector<Panel> drawn;
    for (const Panel& panel : panels) {
        bool known = panel.x.empty() || recording.find(panel.x) < recording.columns.size();
        for (const auto* names : {&panel.y, &panel.points})
            for (const std::string& name : *names) known = known && recording.find(name) < recording.columns.size();
        if (known && !panel.y.empty()) drawn.push_back(panel);
    }
    std::string text =
        "set encoding utf8\nset grid lc rgb '#d0d0d0'\nset key noenhanced above right horizontal\nset tics nomirror\nset border 3\n";
    text += "array color[8] = ['#0060a8', '#c03028', '#2a8a3a', '#8a5a00', '#7a3a9a', '#00858a', '#c06a90', '#606060']\n";
    text += "set multiplot layout " + std::to_string(drawn.size()) + ",1 title " + detail::gnuplot_string(title) + " noenhanced\n";
    for (const Panel& panel : drawn) {
        const std::string x = panel.x.empty() ? recording.columns[0].name : panel.x;
        const std::size_t column_x = recording.find(x);
        text += "set xlabel " + detail::gnuplot_string(recording.columns[column_x].title()) + " noenhanced\n";
        text += "set ylabel " + detail::gnuplot_string(detail::axis_title(recording, panel.y)) + " noenhanced\n";
        text += panel.title.empty() ? "unset title\n" : "set title " + detail::gnuplot_string(panel.title) + " noenhanced\n";
        const bool is_path = !panel.x.empty() && recording.columns[column_x].unit == recording.columns[recording.find(panel.y[0])].unit;
        const detail::Limits y = detail::limits(recording, panel.y);
        if (is_path)
            text += detail::path_commands(detail::limits(recording, {x}), y);
        else
            text += "set size noratio\nset lmargin at screen 0.13\nset rmargin at screen 0.96\nset xtics autofreq\n";
        text += detail::range_command(y);
        text += panel.y.size() + panel.points.size() > 1 ? "set key on\n" : "set key off\n";
        text += "plot ";
        for (const std::string& name : panel.points)
            text += "$data using " + std::to_string(column_x + 1) + ":" + std::to_string(recording.find(name) + 1) +
                    " with points pt 7 ps 0.35 lc rgb '#909090' title " + detail::gnuplot_string(name) + ", ";
        for (std::size_t i = 0; i < panel.y.size(); ++i) {
            const std::string columns = std::to_string(column_x + 1) + ":" + std::to_string(recording.find(panel.y[i]) + 1);
            text += std::string(i == 0 ? "" : ", ") + "$data using " + columns + " with lines lw 1.5 lc rgb color[" +
                    std::to_string(i % 8 + 1) + "] title " + detail::gnuplot_string(panel.y[i]);
        }
        text += "\n";
    }
    return text + "unset multiplot\n";
}

/// Draws PATH.svg and PATH.png. Returns false when gnuplot is missing or fails.
inline bool draw(const Recording& recording, const std::vector<Panel>& panels, const std::string& title, const std::string& path) {
    const auto before =
        std::signal(SIGPIPE, SIG_IGN);  // a gnuplot that is missing or ends early is a false below, not the end of the program
    FILE* gnuplot = popen("gnuplot", "w");
    if (gnuplot == nullptr) {
        std::signal(SIGPIPE, before);
        return false;
    }
    std::string text = "$data << EOD\n";
    for (const std::vector<double>* row : detail::rows_to_draw(recording)) {
        for (const double value : *row) text += detail::number_text(value) + " ";
        text += "\n";
    }
    text += "EOD\n";
    const std::string commands = gnuplot_commands(recording, panels, title);
    const int height = 90 + 260 * static_cast<int>(panels.empty() ? 1 : panels.size());
    const std::string size = "size 900," + std::to_string(height);
    text += "set terminal svg " + size + " font 'sans,13' background '#ffffff'\nset output " + detail::gnuplot_path(path + ".svg") + "\n" +
            commands;
    text += "set output\nset terminal pngcairo " + size + " font 'sans,11'\nset output " + detail::gnuplot_path(path + ".png") + "\n" +
            commands + "set output\n";
    const bool written = std::fwrite(text.data(), 1, text.size(), gnuplot) == text.size();
    const bool drawn = pclose(gnuplot) == 0 && written;
    std::signal(SIGPIPE, before);
    return drawn;
}

}  // namespace v1
}  // namespace dalembert
