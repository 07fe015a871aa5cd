// SPDX-License-Identifier: GPL-3.0-or-later
// Work on all processors, with results in order.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace dalembert {

/// Calls work(0) ... work(count - 1) in so many threads, 0: one a processor, and take(i, result) in this thread, one after the other. Work
/// runs ahead of what is taken by a few results a thread. What work or take throws comes out of here.
template <class Work, class Take>
void in_parallel(std::size_t count, Work work, Take take, std::size_t threads = 0) {
    using Result = decltype(work(std::size_t{}));
    if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
    threads = std::min(threads, count);
    const std::size_t ahead = 8 * threads;
    std::vector<std::promise<Result>> promises(count);
    std::mutex mutex;
    std::condition_variable may_go_on;
    std::size_t next = 0, taken = 0;
    bool stops = false;
    const auto worker = [&] {
        while (true) {
            std::unique_lock lock(mutex);
            may_go_on.wait(lock, [&] { return stops || next == count || next < taken + ahead; });
            if (stops || next == count) return;
            const std::size_t place = next++;
            lock.unlock();
            try {
                promises[place].set_value(work(place));
            } catch (...) {
                promises[place].set_exception(std::current_exception());
            }
        }
    };
    std::vector<std::jthread> workers;
    const auto advance = [&](bool stop) {
        const std::lock_guard lock(mutex);
        ++taken;
        stops = stops || stop;
        may_go_on.notify_all();
    };
    try {
        for (std::size_t i = 0; i < threads; ++i) workers.emplace_back(worker);
        for (std::size_t i = 0; i < count; ++i) {
            take(i, promises[i].get_future().get());
            advance(false);
        }
    } catch (...) {
        advance(true);
        throw;
    }
}

}  // namespace dalembert
