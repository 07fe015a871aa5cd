// SPDX-License-Identifier: BSL-1.0
// What happens between reset and program(): the unit for floats is switched on, data get their start values. No object is constructed
// here and no interrupt is used; a fault ends the run with a message.
#include "board.hpp"

extern "C" {
extern std::uint32_t data_source[], data_begin[], data_end[], bss_begin[], bss_end[], stack_top[];

[[noreturn]] void reset() {
    board::detail::at(0xe000ed88) |= 0xfU << 20;  // coprocessors 10 and 11: full access
    asm volatile("dsb\n isb" : : : "memory");
    const std::uint32_t* from = data_source;
    for (std::uint32_t* to = data_begin; to != data_end; ++to, ++from) *to = *from;
    for (std::uint32_t* to = bss_begin; to != bss_end; ++to) *to = 0;
    board::exit(program());
}

[[noreturn]] void fault() {
    board::write("fault: the processor stopped\n");
    board::exit(1);
}
}

namespace {

struct Vectors {
    const void* stack;
    void (*handlers[15])();
};

__attribute__((section(".vectors"), used)) const Vectors vectors{
    stack_top, {reset, fault, fault, fault, fault, fault, nullptr, nullptr, nullptr, nullptr, fault, fault, nullptr, fault, fault}};

}  // namespace
