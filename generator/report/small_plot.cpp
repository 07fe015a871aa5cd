// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/small_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "emit/mathml.hpp"
#include "report/simplify.hpp"

namespace dalembert {

namespace {

constexpr double picture_width = 320, picture_height = 180;
constexpr double ticks_up = 4.5, ticks_across = 6, letter_width = 5.7;
constexpr std::size_t most_points = 120, letters_in_line = 46;
constexpr std::array curve_colors{"#2f7fd0", "#d0503c", "#2f9a4f", "#b07d10", "#8e5bd0", "#12929a", "#cc5f97", "#808890"};

/// Values from `low` to `high` between two places in px.
struct SmallAxis {
    double low, high, from, to;
    double place(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

struct SmallCurve {
    std::string name;
    std::size_t column;
};

/// What is constant but for roundings looks constant.
SmallAxis axis_of(const detail::Limits& limits, double from, double to) {
    const double size = std::max(std::abs(limits.low), std::abs(limits.high));
    if (!std::isfinite(size)) return {0, 1, from, to};
    const bool is_flat = !(limits.span() > 1e-6 * size);
    const double margin = is_flat ? (size > 0 ? size / 10 : 1) : limits.span() / 40;
    return {limits.low - margin, limits.high + margin, from, to};
}

/// Stretches the longer one of two axes, so that a length is the same on both.
void keep_shape(SmallAxis& x, SmallAxis& y) {
    const double by_x = (x.high - x.low) / std::abs(x.to - x.from), by_y = (y.high - y.low) / std::abs(y.to - y.from);
    SmallAxis& wide = by_x < by_y ? x : y;
    const double middle = (wide.low + wide.high) / 2, half = (wide.high - wide.low) / 2 * std::max(by_x, by_y) / std::min(by_x, by_y);
    wide.low = middle - half;
    wide.high = middle + half;
}

/// Round values, at most so many.
std::vector<double> ticks_of(const SmallAxis& axis, double most) {
    const double least = (axis.high - axis.low) / most, decade = std::pow(10.0, std::floor(std::log10(least)));
    const double step = decade * (least <= decade ? 1 : least <= 2 * decade ? 2 : least <= 5 * decade ? 5 : 10);
    std::vector<double> ticks;
    for (double k = std::ceil(axis.low / step); k * step <= axis.high && ticks.size() < 10; ++k) ticks.push_back(k == 0 ? 0 : k * step);
    return ticks;
}

/// "0.3", "2e6"
std::string tick_text(double value) {
    std::string text = fmt::format("{:.5g}", value);
    for (const char* zero : {"e+0", "e+", "e-0"})
        if (const std::size_t at = text.find(zero); at != std::string::npos) text.replace(at, std::string(zero).size(), zero[1] == '-' ? "e-" : "e");
    return text;
}

std::string text_at(double x, double y, const char* anchor, const std::string& inside) {
    return fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\"{}>{}</text>\n", x, y, *anchor == '\0' ? "" : fmt::format(" text-anchor=\"{}\"", anchor), inside);
}

/// Tenths of a px, as short as SVG allows.
std::string tenths(long n) {
    const long size = std::abs(n);
    std::string text = n < 0 ? "-" : "";
    if (size >= 10 || size == 0) text += std::to_string(size / 10);
    return size % 10 == 0 ? text : text + "." + std::to_string(size % 10);
}

/// "M30 20l1.5-2 ..."
std::string path_of(const std::vector<std::vector<PicturePoint>>& pieces) {
    std::string path;
    for (const std::vector<PicturePoint>& piece : pieces) {
        long x = 0, y = 0;
        bool is_first = true;
        for (const PicturePoint& point : piece) {
            const long next_x = std::lround(10 * point.x), next_y = std::lround(10 * point.y);
            if (!is_first && next_x == x && next_y == y && piece.size() > 2) continue;
            const std::string step_x = tenths(next_x - x), step_y = tenths(next_y - y);
            path += is_first ? "M" : path.back() == 'l' || step_x[0] == '-' ? "" : " ";
            path += step_x + (step_y[0] == '-' ? "" : " ") + step_y + (is_first ? "l" : "");
            is_first = false;
            x = next_x;
            y = next_y;
        }
    }
    return path;
}

std::string picture(const std::string& title, const std::string& inside) {
    return fmt::format(
        "<!-- SPDX-License-Identifier: BSL-1.0 -->\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"10\" fill=\"#737b84\">\n<title>{2}</title>\n{3}</svg>\n",
        picture_width, picture_height, html_text(title), inside);
}

/// Names of curves in their colours, with units, in lines that are not too long.
std::vector<std::string> legend(const Recording& recording, const std::vector<SmallCurve>& curves) {
    std::vector<std::string> lines(1);
    std::size_t letters = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const std::string& unit = recording.columns[curves[i].column].unit;
        const bool says_unit = !unit.empty() && (i + 1 == curves.size() || recording.columns[curves[i + 1].column].unit != unit);
        const std::size_t length = curves[i].name.size() + (says_unit ? unit.size() + 3 : 0) + 2;
        if (letters > 0 && letters + length > letters_in_line && lines.size() < 2) {
            lines.emplace_back();
            letters = 0;
        }
        lines.back() += fmt::format("{}<tspan fill=\"{}\">{}</tspan>{}", letters == 0 ? "" : "&#160; ", curve_colors[i % curve_colors.size()],
                                    html_text(curves[i].name), says_unit ? " [" + html_text(unit) + "]" : "");
        letters += length;
    }
    return lines;
}

/// Pieces of a curve where its values are finite, in px.
std::vector<std::vector<PicturePoint>> pieces_of(const Recording& recording, std::size_t x, std::size_t y, const SmallAxis& across,
                                                 const SmallAxis& up) {
    std::vector<std::vector<PicturePoint>> pieces(1);
    for (const std::vector<double>& row : recording.rows) {
        if (std::isfinite(row[x]) && std::isfinite(row[y])) pieces.back().push_back({across.place(row[x]), up.place(row[y])});
        else if (!pieces.back().empty()) pieces.emplace_back();
    }
    if (pieces.back().empty()) pieces.pop_back();
    return pieces;
}

}  // namespace

std::string small_plot(const Recording& recording, const Panel& panel) {
    std::vector<SmallCurve> curves;
    std::vector<std::string> names;
    for (const std::string& name : panel.y)
        if (const std::size_t column = recording.find(name); column < recording.columns.size()) {
            curves.push_back({name, column});
            names.push_back(name);
        }
    const std::size_t x = panel.x.empty() ? 0 : recording.find(panel.x);
    if (curves.empty() || x >= recording.columns.size()) return small_text("The run records nothing that can be plotted.");
    const std::vector<std::string> lines = legend(recording, curves);
    const double top = 10 + 12 * static_cast<double>(lines.size()), bottom = picture_height - 28;
    SmallAxis up = axis_of(detail::limits(recording, names), bottom, top);
    std::size_t widest = 1;
    for (const double tick : ticks_of(up, ticks_up)) widest = std::max(widest, tick_text(tick).size());
    const double left = 8 + letter_width * static_cast<double>(widest);
    const detail::Limits over = detail::limits(recording, {recording.columns[x].name});
    SmallAxis across{over.low, over.high, left, picture_width - 8};
    const bool is_path = !panel.x.empty() && recording.columns[x].unit == recording.columns[curves[0].column].unit;
    if (is_path || !(over.span() > 0)) across = axis_of(over, left, picture_width - 8);
    if (is_path) keep_shape(across, up);

    std::string grid, text, drawn;
    for (const double tick : ticks_of(across, ticks_across)) {
        const double place = across.place(tick);
        grid += fmt::format("M{:.1f} {:.0f}V{:.0f}", place, top, bottom);
        const std::string number = tick_text(tick);
        const double half = letter_width * static_cast<double>(number.size()) / 2;
        text += text_at(std::min(place, picture_width - 1 - half), bottom + 11, "middle", number);
    }
    for (const double tick : ticks_of(up, ticks_up)) {
        grid += fmt::format("M{:.1f} {:.1f}H{:.0f}", left, up.place(tick), picture_width - 8);
        text += text_at(left - 4, up.place(tick) + 3.5, "end", tick_text(tick));
    }
    for (std::size_t i = 0; i < lines.size(); ++i) text += text_at(left, 12 + 12 * static_cast<double>(i), "", lines[i]);
    text += text_at(picture_width - 8, picture_height - 4, "end", html_text(recording.columns[x].title()));
    std::string said;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const auto pieces = simplified(pieces_of(recording, x, curves[i].column, across, up), most_points);
        drawn += fmt::format("<path stroke=\"{}\" d=\"{}\"/>\n", curve_colors[i % curve_colors.size()], path_of(pieces));
        said += (said.empty() ? "" : ", ") + curves[i].name;
    }
    const std::string title = fmt::format("{} over {}{}", said, recording.columns[x].name, panel.title.empty() ? "" : ": " + panel.title);
    return picture(title, fmt::format("<path d=\"{}\" stroke=\"#80808055\" stroke-width=\".6\"/>\n{}<g fill=\"none\" stroke-width=\"1.5\" "
                                      "stroke-linejoin=\"round\" stroke-linecap=\"round\">\n{}</g>\n",
                                      grid, text, drawn));
}

std::string small_text(const std::string& sentence) {
    return picture(sentence, text_at(picture_width / 2, picture_height / 2, "middle", html_text(sentence)));
}

}  // namespace dalembert
