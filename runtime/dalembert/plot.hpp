// SPDX-License-Identifier: BSL-1.0
// Plots through gnuplot: one picture with a panel for each plot, as SVG and PNG.
#pragma once

#include <cstdio>
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
};

namespace detail {

/// A gnuplot string. In single quotes nothing is special but the quote itself.
inline std::string gnuplot_string(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'') result += "''";
        else if (static_cast<unsigned char>(c) < 0x20 || c == '`') result += ' ';
        else result += c;
    }
    return result + "'";
}

/// "s, phi [m]" when all have the unit, else each with its own.
inline std::string axis_title(const Recording& recording, const std::vector<std::string>& names) {
    std::string title;
    bool same = true;
    for (const std::string& name : names) same = same && recording.columns[recording.find(name)].unit == recording.columns[recording.find(names[0])].unit;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Column& column = recording.columns[recording.find(names[i])];
        title += (i == 0 ? "" : ", ") + (same ? column.name : column.title());
    }
    const std::string& unit = recording.columns[recording.find(names[0])].unit;
    return same && !unit.empty() ? title + " [" + unit + "]" : title;
}

}  // namespace detail

/// The commands that draw the panels below each other. Panels with a name that the recording does not have are left out.
inline std::string gnuplot_commands(const Recording& recording, const std::vector<Panel>& panels, const std::string& title) {
    std::vector<Panel> drawn;
    for (const Panel& panel : panels) {
        bool known = panel.x.empty() || recording.find(panel.x) < recording.columns.size();
        for (const std::string& name : panel.y) known = known && recording.find(name) < recording.columns.size();
        if (known && !panel.y.empty()) drawn.push_back(panel);
    }
    std::string text = "set encoding utf8\nset grid lc rgb '#d0d0d0'\nset key noenhanced outside right top\nset tics nomirror\nset border 3\nset lmargin 11\n";
    text += "array color[8] = ['#0060a8', '#c03028', '#2a8a3a', '#8a5a00', '#7a3a9a', '#00858a', '#c06a90', '#606060']\n";
    text += "set multiplot layout " + std::to_string(drawn.size()) + ",1 title " + detail::gnuplot_string(title) + " noenhanced\n";
    for (const Panel& panel : drawn) {
        const std::string x = panel.x.empty() ? recording.columns[0].name : panel.x;
        const std::size_t column_x = recording.find(x);
        text += "set xlabel " + detail::gnuplot_string(recording.columns[column_x].title()) + " noenhanced\n";
        text += "set ylabel " + detail::gnuplot_string(detail::axis_title(recording, panel.y)) + " noenhanced\n";
        text += panel.title.empty() ? "unset title\n" : "set title " + detail::gnuplot_string(panel.title) + " noenhanced\n";
        text += panel.y.size() > 1 ? "set key on\n" : "set key off\n";
        text += "plot ";
        for (std::size_t i = 0; i < panel.y.size(); ++i) {
            const std::string columns = std::to_string(column_x + 1) + ":" + std::to_string(recording.find(panel.y[i]) + 1);
            text += std::string(i == 0 ? "" : ", ") + "$data using " + columns + " with lines lw 1.5 lc rgb color[" + std::to_string(i % 8 + 1) + "] title " +
                    detail::gnuplot_string(panel.y[i]);
        }
        text += "\n";
    }
    return text + "unset multiplot\n";
}

/// Draws PATH.svg and PATH.png. Returns false when gnuplot is missing or fails.
inline bool draw(const Recording& recording, const std::vector<Panel>& panels, const std::string& title, const std::string& path) {
    FILE* gnuplot = popen("gnuplot", "w");
    if (gnuplot == nullptr) return false;
    std::string text = "$data << EOD\n";
    for (const std::vector<double>& row : recording.rows) {
        for (const double value : row) text += detail::number_text(value) + " ";
        text += "\n";
    }
    text += "EOD\n";
    const std::string commands = gnuplot_commands(recording, panels, title);
    const int height = 90 + 260 * static_cast<int>(panels.empty() ? 1 : panels.size());
    const std::string size = "size 900," + std::to_string(height);
    text += "set terminal svg " + size + " font 'sans,13' background '#ffffff'\nset output " + detail::gnuplot_string(path + ".svg") + "\n" + commands;
    text += "set output\nset terminal pngcairo " + size + " font 'sans,11'\nset output " + detail::gnuplot_string(path + ".png") + "\n" + commands + "set output\n";
    const bool written = std::fwrite(text.data(), 1, text.size(), gnuplot) == text.size();
    return pclose(gnuplot) == 0 && written;
}

}  // namespace v1
}  // namespace dalembert
