// SPDX-License-Identifier: BSL-1.0
// On the desk: turns what the board wrote into CSV, and looks whether the rod stands: check FILE >CSV
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

int main(int count, char** arguments) {
    if (count != 2) return std::fprintf(stderr, "check FILE: what the board wrote\n"), 2;
    constexpr std::array<const char*, 11> names{"t", "s", "phi", "dot(s)", "dot(phi)", "estimated s", "estimated phi", "estimated dot(s)", "estimated dot(phi)", "f_e", "instructions"};
    constexpr double upright = 3.14159265358979;
    for (std::size_t i = 0; i < names.size(); ++i) std::printf("%s%s", i == 0 ? "" : ",", names[i]);
    std::printf("\n");

    std::ifstream in(arguments[1]);
    std::array<double, names.size()> row{};
    double largest_force = 0, largest_angle = 0, late_angle = 0, late_cart = 0, first_error = -1, late_error = 0;
    bool ended = false;
    for (std::string line, word; std::getline(in, line);) {
        std::istringstream words(line);
        words >> word;
        ended = word == "end";
        if (word != "sample") continue;
        for (std::size_t i = 0; i < row.size(); ++i) {
            std::uint32_t bits = 0;
            float value;
            words >> std::hex >> bits;
            std::memcpy(&value, &bits, sizeof value);
            row[i] = static_cast<double>(value);
            std::printf("%s%.7g", i == 0 ? "" : ",", row[i]);
        }
        std::printf("\n");
        // NaN must fail: differences are compared below so that it does.
        const double angle = std::abs(row[2] - upright), error = std::max(std::abs(row[5] - row[1]), std::abs(row[6] - row[2]));
        largest_force = std::max(largest_force, std::abs(row[9]));
        largest_angle = std::isfinite(angle) ? std::max(largest_angle, angle) : INFINITY;
        if (first_error < 0) first_error = angle;  // what the observer does not know
        if (row[0] >= 4) late_angle = std::max(late_angle, angle), late_cart = std::max(late_cart, std::abs(row[1])), late_error = std::max(late_error, error);
    }
    std::fprintf(stderr, "at first %.3f rad off; largest angle %.3f rad, largest force %.1f N; after 4 s: %.1e rad, %.1e m, error of the observer %.1e; %.0f instructions a sample\n", first_error,
                 largest_angle, largest_force, late_angle, late_cart, late_error, row[10]);
    const auto holds = [](bool is_so, const char* what) {
        if (!is_so) std::fprintf(stderr, "the example fails: %s\n", what);
        return is_so;
    };
    bool good = holds(ended && row[0] > 4.9, "the board did not come to its end");
    good &= holds(std::abs(first_error - 0.2) < 1e-3, "the rod does not begin 0.2 rad off");
    good &= holds(largest_angle < 0.4, "the rod goes further than 0.4 rad from upright");
    good &= holds(late_angle < 1e-3 && late_cart < 5e-3, "the rod does not come to rest upright");
    good &= holds(late_error < 1e-3, "the error of the observer does not decay");
    good &= holds(largest_force <= 40, "the force is larger than allowed");
    return good ? 0 : 1;
}
