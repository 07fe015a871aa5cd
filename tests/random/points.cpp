// SPDX-License-Identifier: GPL-3.0-or-later
// Prints rates and outputs of a generated header at points from the command line, one "name value change" a line: MODE t x... u...; without
// arguments the names of states and inputs.
// The change is that by the last digits of the states, which the command line rounds.
// HEADER and NAME_SPACE name it; SCALAR is float or double; with HAS_MODES machines that switch, with TOGETHER by that function.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include HEADER

using System = NAME_SPACE::System<SCALAR>;

#ifdef HAS_MODES
#define IN(...) static_cast<NAME_SPACE::Mode>(mode), __VA_ARGS__
#else
#define IN(...) __VA_ARGS__
#endif

int main(int argc, char** argv) {
    if (argc == 1) {
        for (std::size_t i = 0; i < NAME_SPACE::state_count; ++i) std::printf("state %s\n", NAME_SPACE::state_quantities[i].name);
        for (std::size_t i = 0; i < NAME_SPACE::input_count; ++i) std::printf("input %s\n", NAME_SPACE::input_quantities[i].name);
        return 0;
    }
    if (static_cast<std::size_t>(argc) != 3 + NAME_SPACE::state_count + NAME_SPACE::input_count) return 2;
    const System system;
    System::State x{}, f{};
    System::Input u{};
    System::Output y{};
    [[maybe_unused]] const int mode = std::atoi(argv[1]);
    const SCALAR t = static_cast<SCALAR>(std::atof(argv[2]));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<SCALAR>(std::atof(argv[3 + i]));
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = static_cast<SCALAR>(std::atof(argv[3 + x.size() + i]));
    const auto values = [&](const System::State& at, System::State& rates, System::Output& outputs) {
#ifdef TOGETHER
        System::JacobianX J{};
        System::Energies energies{};
        system.together(IN(at, u, t, rates, J, outputs, energies));
#else
        system.rhs(IN(at, u, t, rates));
        system.output(IN(at, u, t, outputs));
#endif
    };
    values(x, f, y);
    System::State f_change{};
    System::Output y_change{};
    for (std::size_t k = 0; k < x.size(); ++k) {
        System::State moved = x, f_moved{};
        System::Output y_moved{};
        moved[k] *= 1 + 4 * std::numeric_limits<SCALAR>::epsilon();
        values(moved, f_moved, y_moved);
        for (std::size_t i = 0; i < f.size(); ++i) f_change[i] += std::abs(f_moved[i] - f[i]);
        for (std::size_t i = 0; i < y.size(); ++i) y_change[i] += std::abs(y_moved[i] - y[i]);
    }
#ifdef HAS_MODES
    std::printf("mode %s\n", NAME_SPACE::mode_names[static_cast<std::size_t>(mode)]);
#endif
    for (std::size_t i = 0; i < f.size(); ++i) std::printf("rate %s %.17g %.3g\n", NAME_SPACE::state_quantities[i].name, static_cast<double>(f[i]), static_cast<double>(f_change[i]));
    for (std::size_t i = 0; i < y.size(); ++i) std::printf("output %s %.17g %.3g\n", NAME_SPACE::output_quantities[i].name, static_cast<double>(y[i]), static_cast<double>(y_change[i]));
}
