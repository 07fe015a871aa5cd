// SPDX-License-Identifier: GPL-3.0-or-later
// The controller on the board: what it sets for what the simulation measured, in hexadecimal digits of float.
#include <cstdint>
#include <cstring>

#include "board/board.hpp"
#include "measured.hpp"

extern "C" float sample_of_controller(const float* measured);  // in C99, see controller.c.in

int program() {
    for (const auto& measured : measurements) {
        const float set = sample_of_controller(measured);
        std::uint32_t bits;
        std::memcpy(&bits, &set, sizeof bits);
        board::write(bits, 16);
        board::write("\n");
    }
    return 0;
}
