// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in expressions as a number: measured characteristics, kept for good, so that expressions may be handed on.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>

#include "text/digest.hpp"

namespace dalembert {

/// Of 48 bits, so that it stays whole where it is made a double.
inline std::uint64_t hash_of(const std::string& text) {
    const std::uint64_t hash = digest(text);
    return (hash ^ (hash >> 48U)) & 0xFFFFFFFFFFFFULL;
}

/// All of one kind in this run of the program, by their numbers.
template <class T>
class Numbered {
public:
    /// The same for the same text, which says all of it, in every run.
    std::uint64_t number_of(const std::string& text, const T& one) {
        const std::uint64_t number = hash_of(text);
        const std::scoped_lock lock(mutex_);
        const auto [known, is_new] = all_.emplace(number, one);
        if (!is_new && !(known->second == one)) throw std::logic_error("two characteristics have one number");
        return number;
    }
    /// Throws std::logic_error for a number of none.
    const T& operator[](std::uint64_t number) {
        const std::scoped_lock lock(mutex_);
        const auto found = all_.find(number);
        if (found == all_.end()) throw std::logic_error("a number of no characteristic");
        return found->second;
    }

private:
    std::mutex mutex_;
    std::map<std::uint64_t, T> all_;
};

}  // namespace dalembert
