// SPDX-License-Identifier: GPL-3.0-or-later
// CSV and plot commands: numbers come back as they were, and no name breaks out of its place.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "dalembert/plot.hpp"

using namespace dalembert;

namespace {

std::string written(const Recording& recording) {
    const auto path = std::filesystem::temp_directory_path() / "dalembert_recording_test.csv";
    REQUIRE(write_csv(recording, path.string()));
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    std::filesystem::remove(path);
    return text.str();
}

Recording example() {
    return {{{"t", "s"}, {"phi", "rad"}, {"energy", "J"}}, {{0, 0.1, 1}, {0.5, 1.0 / 3.0, 1e-300}}};
}

}  // namespace

TEST_CASE("CSV: names with units, and every digit that matters") {
    CHECK(written(example()) == "t [s],phi [rad],energy [J]\n0,0.1,1\n0.5,0.3333333333333333,1e-300\n");
    CHECK(std::stod(detail::number_text(0.1 + 0.2)) == 0.1 + 0.2);
    CHECK(std::stod(detail::number_text(std::nextafter(1.0, 2.0))) == std::nextafter(1.0, 2.0));
}

TEST_CASE("CSV: names with commas and quotes") {
    CHECK(written({{{"a,b", "m"}, {"say \"x\"", ""}}, {}}) == "\"a,b [m]\",\"say \"\"x\"\"\"\n");
}

TEST_CASE("CSV: a file that cannot be written is reported") {
    CHECK_FALSE(write_csv(example(), "/nowhere/at/all.csv"));
}

TEST_CASE("plot commands: axes have names and units") {
    const std::string commands = gnuplot_commands(example(), {{"", "", {"phi"}}, {"orbit", "phi", {"energy", "phi"}}}, "Rod");
    CHECK(commands.find("set xlabel 't [s]'") != std::string::npos);
    CHECK(commands.find("set ylabel 'phi [rad]'") != std::string::npos);
    CHECK(commands.find("set xlabel 'phi [rad]'") != std::string::npos);
    CHECK(commands.find("set ylabel '[J], [rad]'") != std::string::npos);
    CHECK(commands.find("set title 'orbit'") != std::string::npos);
}

TEST_CASE("plot commands: text stays text") {
    Recording recording{{{"t", "s"}, {"x", "m'; set output 'elsewhere"}}, {{0, 0}}};
    const std::string commands = gnuplot_commands(recording, {{"it's `id`\nset output 'z'", "", {"x"}}}, "'; system('true'); '");
    // A quote inside becomes another character, so every string ends where it was meant to end.
    std::istringstream lines(commands);
    for (std::string line; std::getline(lines, line);) CHECK(std::count(line.begin(), line.end(), '\'') % 2 == 0);
    CHECK(commands.find('`') == std::string::npos);
    CHECK(commands.find("\nset output") == std::string::npos);
    CHECK(commands.find("system(\xE2\x80\x99true\xE2\x80\x99)") != std::string::npos);
}

TEST_CASE("plot commands: panels with unknown names are left out") {
    const std::string commands = gnuplot_commands(example(), {{"", "", {"psi"}}, {"", "", {"phi"}}}, "Rod");
    CHECK(commands.find("layout 1,1") != std::string::npos);
}

TEST_CASE("plot commands: what is constant but for rounding looks constant, and a path in space keeps its shape") {
    Recording recording{{{"t", "s"}, {"x", "m"}, {"y", "m"}}, {{0, 5, -1}, {1, 5.0000001, 1}, {2, 5, 3}}};
    const std::string over_time = gnuplot_commands(recording, {{"", "", {"x"}}, {"", "", {"y"}}}, "Rod");
    CHECK(over_time.find("set yrange [4.5") != std::string::npos);
    CHECK(over_time.find("set autoscale y") != std::string::npos);
    CHECK(over_time.find("ratio -1") == std::string::npos);
    CHECK(gnuplot_commands(recording, {{"", "x", {"y"}}}, "Rod").find("set size ratio -1") != std::string::npos);
}
