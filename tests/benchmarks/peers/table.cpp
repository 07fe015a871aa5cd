// SPDX-License-Identifier: GPL-3.0-or-later
#include "benchmarks/peers/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace peers {

namespace fs = std::filesystem;

namespace {

constexpr const char* titles = "machine,build,states,error,our_method,our_tolerance,our_error,our_microseconds,their_method,their_tolerance,their_error,their_microseconds,their_setup_microseconds,reference,reference_error\n";
constexpr const char* titles_of_runs = "machine,build,method,tolerance,error,microseconds\n";

using Cells = std::vector<std::string>;

Cells cells_of(const std::string& line) {
    Cells cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    return cells;
}

std::string all_files(const fs::path& folder, const std::string& ending) {
    std::set<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().string().ends_with(ending)) paths.insert(entry.path());
    std::ostringstream text;
    for (const fs::path& path : paths) {
        std::ifstream file(path);
        if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
    }
    return text.str();
}

/// Ratios of one build and one target.
struct Ratios {
    double sum_of_logarithms = 0, smallest = INFINITY, largest = 0;
    int count = 0, lost = 0;
    std::string where;
    void add(double ratio, const std::string& machine) {
        sum_of_logarithms += std::log(ratio);
        ++count;
        lost += ratio < 1 ? 1 : 0;
        largest = std::max(largest, ratio);
        if (ratio < smallest) where = machine;
        smallest = std::min(smallest, ratio);
    }
};

/// "dop853 12.3 | cvode bdf 45.6 | 3.7"
std::string cell(const Cells& c, double ratio) {
    const auto side = [](const std::string& method, const std::string& microseconds) { return method == "none" ? std::string("not reached") : fmt::format("{:.1f} {}", std::stod(microseconds), method); };
    return fmt::format("{:<18} {:<20} {:>6}", side(c[4], c[7]), side(c[8], c[11]), ratio > 0 ? fmt::format("{:.1f}", ratio) : "");
}

}  // namespace

std::string Build::include_flags() const { return prefix.empty() ? "" : "-isystem " + prefix + "/include"; }

/// A build below a prefix is taken from its archives where it has them; its shared libraries are found at run time too.
std::string Build::link_flags() const {
    const std::string names = "-lsundials_cvode -lsundials_arkode -lsundials_nvecserial";
    if (prefix.empty()) return names + " -lm";
    return fmt::format("-L{0}/lib -Wl,-rpath,{0}/lib {1} -lm", prefix, names);
}

std::vector<Build> builds() {
    std::vector<Build> result;
    if (PEERS_SYSTEM) result.push_back({"system", ""});
    if (std::string(PEERS_ROOT) != "") result.push_back({"root", PEERS_ROOT});
    return result;
}

int print_table(const std::string& folder, const std::string& flags) {
    const std::string cheapest = all_files(folder, ".cheapest.csv");
    std::ofstream(fs::path(folder) / "peers.csv") << titles << cheapest;
    std::ofstream(fs::path(folder) / "peers_runs.csv") << titles_of_runs << all_files(folder, ".runs.csv");
    std::map<std::string, std::map<std::string, std::map<std::string, Cells>>> rows;  // build, machine, target
    std::istringstream lines(cheapest);
    for (std::string line; std::getline(lines, line);)
        if (const Cells c = cells_of(line); c.size() == 15) rows[c[1]][c[0]][c[3]] = c;
    for (const auto& [build, machines] : rows) {
        fmt::print("\nSUNDIALS {} ({}); both sides with {}; microseconds of a run, ratio = theirs / ours\n\n", PEERS_VERSION, build == "system" ? "as the system has it" : std::string("from ") + PEERS_ROOT, flags);
        fmt::print("{:<34} {:>6}  {:<46}  {:<46}\n{:<34} {:>6}  {:<18} {:<20} {:>6}  {:<18} {:<20} {:>6}\n", "", "", "largest error 1e-6", "largest error 1e-9", "machine", "states", "ours", "theirs", "ratio", "ours", "theirs", "ratio");
        std::map<std::string, Ratios> ratios, without_setup;
        for (const auto& [machine, targets] : machines) {
            std::string text = fmt::format("{:<34} {:>6}", machine, targets.begin()->second[2]);
            for (const char* target : {"1e-06", "1e-09"}) {
                const auto found = targets.find(target);
                if (found == targets.end()) continue;
                const Cells& c = found->second;
                const double ours = std::stod(c[7]), theirs = std::stod(c[11]), setup = std::stod(c[12]);
                const double ratio = ours > 0 && theirs > 0 ? theirs / ours : 0;
                text += "  " + cell(c, ratio);
                if (!(ratio > 0)) continue;
                ratios[target].add(ratio, machine);
                without_setup[target].add(std::max(theirs - setup, 1e-3) / ours, machine);
            }
            fmt::print("{}\n", text);
        }
        for (auto& [target, r] : ratios) {
            const Ratios& w = without_setup[target];
            fmt::print("\nerror {}: {} machines, geometric mean {:.1f}, smallest {:.2f} ({}), {} lost; without the time in which SUNDIALS is set up {:.1f} and {:.2f} ({})", target, r.count, std::exp(r.sum_of_logarithms / r.count), r.smallest, r.where, r.lost,
                       std::exp(w.sum_of_logarithms / w.count), w.smallest, w.where);
        }
        fmt::print("\n");
    }
    fmt::print("\n{0}/peers.csv\n{0}/peers_runs.csv\n", folder);
    return rows.empty() ? 1 : 0;
}

}  // namespace peers
