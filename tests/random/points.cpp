// SPDX-License-Identifier: GPL-3.0-or-later
// Prints rates and outputs of a generated header at points from the command line, one "name value" a line: MODE t x... u...
// HEADER and NAME_SPACE name it; SCALAR is float or double; with HAS_MODES machines that switch, with TOGETHER by that function.
#include <cstdio>
#include <cstdlib>

#include HEADER

using System = NAME_SPACE::System<SCALAR>;

#ifdef HAS_MODES
#define IN(...) static_cast<NAME_SPACE::Mode>(mode), __VA_ARGS__
#else
#define IN(...) __VA_ARGS__
#endif

int main(int argc, char** argv) {
    if (static_cast<std::size_t>(argc) != 3 + NAME_SPACE::state_count + NAME_SPACE::input_count) return 2;
    const System system;
    System::State x{}, f{};
    System::Input u{};
    System::Output y{};
    [[maybe_unused]] const int mode = std::atoi(argv[1]);
    const SCALAR t = static_cast<SCALAR>(std::atof(argv[2]));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<SCALAR>(std::atof(argv[3 + i]));
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = static_cast<SCALAR>(std::atof(argv[3 + x.size() + i]));
#ifdef TOGETHER
    System::JacobianX J{};
    System::Energies energies{};
    system.together(IN(x, u, t, f, J, y, energies));
#else
    system.rhs(IN(x, u, t, f));
    system.output(IN(x, u, t, y));
#endif
#ifdef HAS_MODES
    std::printf("mode %s\n", NAME_SPACE::mode_names[static_cast<std::size_t>(mode)]);
#endif
    for (std::size_t i = 0; i < f.size(); ++i) std::printf("rate %s %.17g\n", NAME_SPACE::state_quantities[i].name, static_cast<double>(f[i]));
    for (std::size_t i = 0; i < y.size(); ++i) std::printf("output %s %.17g\n", NAME_SPACE::output_quantities[i].name, static_cast<double>(y[i]));
}
