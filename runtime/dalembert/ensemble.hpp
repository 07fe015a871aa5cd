// SPDX-License-Identifier: BSL-1.0
// Many runs of a machine, each with parameters, start states or inputs of its own, over the threads of the computer.
// If threads are a separate library, link it (-pthread).
#pragma once

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <type_traits>
#include <vector>

#include "dalembert/recording.hpp"

namespace dalembert {
inline namespace v1 {

/// Random numbers of one run of an ensemble. They follow only from the seed and the number of the run: the number of threads and the order
/// of the runs do not change them, and they are the same on every machine. SplitMix64 (Steele, Lea and Flood 2014).
class Draws {
public:
    Draws(std::uint64_t seed, std::size_t run) noexcept : state_(mixed(mixed(seed) + run)) {}

    /// At least 0, below 1.
    double uniform() noexcept { return static_cast<double>(next() >> 11) * 0x1p-53; }
    double uniform(double low, double high) noexcept { return low + (high - low) * uniform(); }
    /// Box and Muller's method.
    double normal(double mean, double deviation) noexcept {
        const double radius = std::sqrt(-2 * std::log1p(-uniform()));
        return mean + deviation * radius * std::cos(6.283185307179586 * uniform());
    }

private:
    static std::uint64_t mixed(std::uint64_t z) noexcept {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    std::uint64_t next() noexcept { return mixed(state_ += 0x9e3779b97f4a7c15u); }

    std::uint64_t state_;
};

struct EnsembleOptions {
    std::size_t runs = 1000;
    unsigned threads = 0;  ///< 0: as many as the computer has
    std::uint64_t seed = 1;
    double progress_interval = 0.5;  ///< s, between two calls of `progress`
};

/// Calls work(run, draws) for every run, 0 to runs - 1, from several threads at once, and returns the results in this order.
/// `work` must not change data that its calls share. progress(done, runs) is called at most every `progress_interval` and once at the end,
/// never twice at a time. If it returns false, the ensemble ends: the other results are empty. If the system cannot start more threads, the
/// existing ones do the work.
template <class Work, class Progress>
auto run_ensemble(const EnsembleOptions& options, const Work& work, Progress&& progress) {
    using Result = std::invoke_result_t<const Work&, std::size_t, Draws&>;
    using Clock = std::chrono::steady_clock;
    std::vector<std::optional<Result>> results(options.runs);
    std::atomic<std::size_t> next{0}, done{0};
    std::atomic<bool> goes_on{true};
    std::mutex talking;
    Clock::time_point last = Clock::now();
    const auto take_runs = [&] {
        for (std::size_t run = next++; run < options.runs && goes_on; run = next++) {
            Draws draws(options.seed, run);
            results[run].emplace(work(run, draws));
            ++done;
            const std::unique_lock<std::mutex> turn(talking, std::try_to_lock);
            if (!turn || std::chrono::duration<double>(Clock::now() - last).count() < options.progress_interval) continue;
            last = Clock::now();
            if (!progress(done.load(), options.runs)) goes_on = false;
        }
    };
    const unsigned wanted = options.threads > 0 ? options.threads : std::thread::hardware_concurrency();
    std::vector<std::thread> threads;
    for (unsigned k = 1; k < wanted && k < options.runs; ++k) {
        try {
            threads.emplace_back(take_runs);
        } catch (const std::system_error&) {
            break;
        }
    }
    take_runs();
    for (std::thread& thread : threads) thread.join();
    progress(done.load(), options.runs);
    return results;
}

template <class Work>
auto run_ensemble(const EnsembleOptions& options, const Work& work) {
    return run_ensemble(options, work, [](std::size_t, std::size_t) { return true; });
}

/// A row for each finished run: its number, then its results. For write_csv.
template <class Row>
Recording recording_of_ensemble(std::vector<Column> columns, const std::vector<std::optional<Row>>& results) {
    Recording recording;
    recording.columns = {{"run", ""}};
    recording.columns.insert(recording.columns.end(), columns.begin(), columns.end());
    for (std::size_t run = 0; run < results.size(); ++run) {
        if (!results[run]) continue;
        recording.rows.push_back({static_cast<double>(run)});
        recording.rows.back().insert(recording.rows.back().end(), results[run]->begin(), results[run]->end());
    }
    return recording;
}

}  // namespace v1
}  // namespace dalembert
