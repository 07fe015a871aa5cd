// SPDX-License-Identifier: GPL-3.0-or-later
// Work on all processors, with results in order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace dalembert {

/// Calls work(0) ... work(count - 1), a few at a time, and take(i, result) in this thread, one after the other.
template <class Work, class Take>
void in_parallel(std::size_t count, Work work, Take take) {
    const std::size_t workers = std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::future<decltype(work(std::size_t{}))>> running;
    for (std::size_t i = 0; i < count; ++i) {
        for (; running.size() < count && running.size() < i + workers;)
            running.push_back(std::async(std::launch::async, [&work, place = running.size()] { return work(place); }));
        take(i, running[i].get());
    }
}

}  // namespace dalembert
