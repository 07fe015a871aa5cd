// SPDX-License-Identifier: BSL-1.0
// What the programs for the board see of it: output through the debugger (semihosting), and a counter of instructions.
#pragma once

#include <cstdint>

/// The program; the start-up calls it and hands what it returns to the debugger.
int program();

namespace board {

namespace detail {

/// A call of the debugger. The number of the operation and its argument are in r0 and r1.
inline std::uint32_t call_debugger(std::uint32_t operation, const void* argument) {
    register std::uint32_t r0 asm("r0") = operation;
    register const void* r1 asm("r1") = argument;
    asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

inline volatile std::uint32_t& at(std::uint32_t address) { return *reinterpret_cast<volatile std::uint32_t*>(address); }

}  // namespace detail

inline void write(const char* text) { detail::call_debugger(0x04, text); }

[[noreturn]] inline void exit(int code) {
    const std::uint32_t block[2] = {0x20026, static_cast<std::uint32_t>(code)};  // the application has ended
    detail::call_debugger(0x20, block);
    for (;;) {
    }
}

/// The last digits of a number of any base; no printf, which would bring double arithmetic with it.
inline void write(std::uint32_t value, std::uint32_t base) {
    char text[12];
    char* digit = text + sizeof text;
    *--digit = '\0';
    do {
        *--digit = "0123456789abcdef"[value % base];
        value /= base;
    } while (value != 0);
    write(digit);
}

/// The bits of a float in hexadecimal: what the host reads is what was computed.
inline void write(float value) {
    std::uint32_t bits;
    static_assert(sizeof bits == sizeof value);
    __builtin_memcpy(&bits, &value, sizeof bits);
    write(" ");
    write(bits, 16);
}

// note [instructions]
// QEMU with -icount shift=8 lets 2^8 ns pass with each instruction, and SysTick counts down at the 25 MHz of the board: 6.4 ticks an
// instruction, so that the number of instructions is known exactly. Instructions in an IT block that are skipped count too. Cycles are
// not modelled. 24 bits of ticks are 2.6 million instructions; who asks for more is told.
inline constexpr std::uint32_t instruction_ns = 256;
inline constexpr std::uint32_t tick_ns = 40;

inline void start_ticks() {
    detail::at(0xe000e014) = 0xffffff;  // reload value
    detail::at(0xe000e018) = 0;         // current value: any write clears it
    detail::at(0xe000e010) = 5;         // on, by the clock of the processor, no interrupt
}

/// Falls by one each tick, from 0xffffff again behind zero.
inline std::uint32_t ticks() { return detail::at(0xe000e018); }

/// Whether the counter has passed zero since this was asked before.
inline bool ticks_passed_zero() { return (detail::at(0xe000e010) & 0x10000U) != 0; }

inline std::uint32_t instructions(std::uint32_t elapsed_ticks) { return (elapsed_ticks * tick_ns + instruction_ns / 2) / instruction_ns; }

}  // namespace board
