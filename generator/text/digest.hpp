// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace dalembert {

/// FNV-1a (Fowler, Noll, Vo) with 64 bits; of several texts one after the other, from that of those before. The same on every machine.
inline std::uint64_t digest(std::string_view text, std::uint64_t before = 0xcbf29ce484222325) {
    for (const char c : text) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return before;
}

}  // namespace dalembert
