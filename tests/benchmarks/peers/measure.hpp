// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of two sides that are timed in turns, so that both meet the same noise; what counts of each run is its shortest time.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace peers {

inline std::string text_of(double value) {
    std::array<char, 32> buffer;
    std::snprintf(buffer.data(), buffer.size(), "%.4g", value);
    return buffer.data();
}

inline bool write_text(const char* path, const std::string& text) {
    std::FILE* file = std::fopen(path, "w");
    if (file == nullptr) return false;
    const bool is_written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    return std::fclose(file) == 0 && is_written;
}

template <class Run>
double seconds_of(const Run& run) {
    const auto begin = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// s, of at least 20 runs.
template <class Run>
double shortest(const Run& run) {
    double best = seconds_of(run);
    for (int i = 0; i < 20; ++i) best = std::min(best, seconds_of(run));
    return best;
}

/// One way to make the run.
struct Candidate {
    bool is_ours = false;
    std::string method;
    double tolerance = 0;
    double error = INFINITY;
    double seconds = INFINITY;     ///< the shortest time
    std::function<bool()> run;

    std::string line() const { return method + "," + text_of(tolerance) + "," + text_of(error) + "," + text_of(seconds * 1e6); }
    static std::string no_line() { return "none,0,0,0"; }
};

/// All tolerances of a method, from coarse to fine, in half decades; no finer ones behind one that took too long, or two that failed.
template <class Run, class Error>
void sweep(std::vector<Candidate>& candidates, bool is_ours, const char* method, Run run, Error error) {
    constexpr double too_long = 0.4;  // s
    int failures = 0;
    for (int k = 0; k <= 20 && failures < 3; ++k) {
        Candidate c;
        c.is_ours = is_ours;
        c.method = method;
        c.tolerance = std::pow(10.0, -3 - 0.5 * k);
        c.run = [run, tolerance = c.tolerance] { return run(tolerance); };
        bool is_good = false;
        const double first = seconds_of([&] { is_good = c.run(); });
        failures = is_good ? 0 : failures + 1;
        if (is_good) {
            c.error = error();
            c.seconds = first;
            for (int i = 0; i < 4 && first < too_long / 20; ++i) c.seconds = std::min(c.seconds, seconds_of(c.run));
            candidates.push_back(c);
        }
        if (first > too_long) return;
    }
}

struct Pair {
    const Candidate* ours = nullptr;
    const Candidate* theirs = nullptr;
};

/// The cheapest run of each side that reaches the target. Whatever was nearly as cheap in the sweep is timed again, one after the other.
inline Pair time_in_turns(std::vector<Candidate>& candidates, double target) {
    constexpr double near = 1.5, enough = 0.5, fewest = 5, most = 3000;  // enough: s
    const auto best_of = [&](bool is_ours) {
        const Candidate* best = nullptr;
        for (const Candidate& c : candidates)
            if (c.is_ours == is_ours && c.error <= target && (best == nullptr || c.seconds < best->seconds)) best = &c;
        return best;
    };
    const Candidate* const best[] = {best_of(false), best_of(true)};
    std::vector<Candidate*> chosen;
    double total = 0;
    for (Candidate& c : candidates) {
        if (best[c.is_ours] == nullptr || c.error > target || c.seconds > near * best[c.is_ours]->seconds) continue;
        chosen.push_back(&c);
        total += c.seconds;
    }
    if (total > 0) {
        const int rounds = static_cast<int>(std::clamp(enough / total, fewest, most));
        for (int i = 0; i < rounds; ++i)
            for (Candidate* c : chosen) c->seconds = std::min(c->seconds, seconds_of(c->run));
    }
    return {best_of(true), best_of(false)};
}

}  // namespace peers
