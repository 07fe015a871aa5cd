// SPDX-License-Identifier: GPL-3.0-or-later
// On the board: calls the functions of a system at every point of the table, and writes instructions, stack and results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "board/board.hpp"
#include "points.hpp"

/// Stands in for functions of the C library in a second program, which counts the instructions of generated code alone.
extern "C" inline __attribute__((used)) float library_function(float x) { return x; }

struct Cost {
    std::uint32_t instructions, stack;
};

template <class T>
struct Same {
    using type = T;
};

/// Bytes of stack that are watched below the caller; the stack of the board is twice as large.
inline constexpr std::uint32_t painted_bytes = 32 * 1024;
inline constexpr std::uint32_t paint = 0xa5c35a3c;

/// What lies between two readings of the counter, and how far down the stack was changed: the call, and what it costs to make one.
template <class Class, class... Parameters>
__attribute__((noinline)) Cost around(const Class& object, void (Class::*volatile function)(Parameters...) const noexcept,
                                      typename Same<Parameters>::type... arguments) {
    std::uint32_t bottom;
    asm volatile("mov %0, sp" : "=r"(bottom));
    auto* const lowest = reinterpret_cast<volatile std::uint32_t*>(bottom - painted_bytes);
    auto* const end = reinterpret_cast<volatile std::uint32_t*>(bottom);
    for (auto* word = lowest; word != end; ++word) *word = paint;
    const auto call = function;
    board::ticks_passed_zero();
    const std::uint32_t before = board::ticks();
    (object.*call)(arguments...);
    const std::uint32_t after = board::ticks();
    if (board::ticks_passed_zero() && after <= before) {
        board::write("a call takes more than the 2.6 million instructions that can be counted\n");
        board::exit(1);
    }
    auto* changed = lowest;
    while (changed != end && *changed == paint) ++changed;
    if (changed == lowest) {
        board::write("a call takes more than the 32 kB of stack that are watched\n");
        board::exit(1);
    }
    return {(before - after) & 0xffffffU, static_cast<std::uint32_t>(end - changed) * 4};
}

/// The system with functions of known length, called in the same way.
template <class System>
struct Probe : System {
    template <class... Parameters>
    void one(Parameters...) const noexcept {}  // returns: one instruction
    template <class... Parameters>
    void thousand(Parameters...) const noexcept {
        asm volatile(".rept 999\n nop\n .endr");
    }
    template <class... Parameters>
    void loop(Parameters...) const noexcept {
        std::uint32_t count;
        asm volatile("movw %0, #50000\n 1: subs %0, #1\n bne 1b" : "=r"(count) : : "cc");
    }
};

/// Instructions and bytes of stack of the function alone, its return included.
template <class System, class Class, class... Parameters>
Cost cost(const Probe<System>& probe, void (Class::*function)(Parameters...) const noexcept, typename Same<Parameters>::type... arguments) {
    using Function = void (Probe<System>::*)(Parameters...) const noexcept;
    const Cost least =
        around<Probe<System>, Parameters...>(probe, static_cast<Function>(&Probe<System>::template one<Parameters...>), arguments...);
    const Cost all = around<Probe<System>, Parameters...>(probe, static_cast<Function>(function), arguments...);
    return {board::instructions(all.instructions - least.instructions) + 1, all.stack - least.stack};
}

inline void report(const char* what, std::size_t point, const Cost& cost) {
    board::write(what);
    for (const std::uint32_t number : {static_cast<std::uint32_t>(point), cost.instructions, cost.stack}) {
        board::write(" ");
        board::write(number, 10);
    }
}

template <class Values>
void report_values(const Values& values) {
    for (const float value : values) board::write(value);
    board::write("\n");
}

/// `System`: as that of the points, or with the same functions.
template <class System, class OfPoints, std::size_t count>
int measure(const Point<OfPoints> (&table)[count]) {
    using State = typename System::State;
    using Input = typename System::Input;
    board::start_ticks();
    const Probe<System> probe;
    const auto use = [&probe](auto member, auto&&... arguments) { return cost(probe, member, arguments...); };

    // See note [instructions]: what is known must come out, or all else means nothing.
    using Known = void (Probe<System>::*)(const State&, const Input&, float) const noexcept;
    const Point<OfPoints>& p = table[0];
    report("known", 1000,
           cost(probe, static_cast<Known>(&Probe<System>::template thousand<const State&, const Input&, float>), p.x, p.u, p.t));
    board::write("\n");
    report("known", 100002,
           cost(probe, static_cast<Known>(&Probe<System>::template loop<const State&, const Input&, float>), p.x, p.u, p.t));
    board::write("\n");

    static State dxdt;
    static typename System::JacobianX J;
    for (std::size_t k = 0; k < count; ++k) {
        dxdt.fill(__builtin_nanf(""));  // what is not written is seen
        J.fill(__builtin_nanf(""));
        report("rhs", k, with_mode(use, &System::rhs, table[k].mode, table[k].x, table[k].u, table[k].t, dxdt));
        report_values(dxdt);
        report("jacobian", k, with_mode(use, &System::rhs_and_jacobian, table[k].mode, table[k].x, table[k].u, table[k].t, dxdt, J));
        report_values(J);
    }
    board::write("end\n");
    return 0;
}
