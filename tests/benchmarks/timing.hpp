// SPDX-License-Identifier: GPL-3.0-or-later
// Times two ways to compute the same in turns, so that both meet the same noise; what counts is their ratio.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace timing {

/// Makes the compiler believe that the object is used and changed.
template <class T>
void keep(T& object) {
    asm volatile("" : "+m"(object) : : "memory");
}

struct Pair {
    double first, second;  ///< ns a call, medians
    double ratio;          ///< median of first/second over the rounds
};

/// A round calls each of both `calls` times.
template <class First, class Second>
Pair in_turns(First&& first, Second&& second, std::size_t calls) {
    const auto nanoseconds = [calls](auto&& body) {
        const auto begin = std::chrono::steady_clock::now();
        body(calls);
        return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() / static_cast<double>(calls);
    };
    const auto median = [](std::vector<double> values) {
        std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
        return values[values.size() / 2];
    };
    std::vector<double> a, b, ratios;
    for (int round = 0; round < 51; ++round) {
        const bool swapped = round % 2 == 1;
        const double x = swapped ? 0 : nanoseconds(first);
        const double y = nanoseconds(second);
        a.push_back(swapped ? nanoseconds(first) : x);
        b.push_back(y);
        ratios.push_back(a.back() / b.back());
    }
    return {median(a), median(b), median(ratios)};
}

}  // namespace timing
