// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>

#include "export/acados.hpp"
#include "export/casadi.hpp"
#include "export/fmi.hpp"
#include "export/octave.hpp"
#include "export/python.hpp"
#include "export/target.hpp"

namespace dalembert {

namespace {

/// The plant itself.
Exported plant_files(const ExportSubject& subject, const ExportWish&) {
    Exported result{subject.c_files, {}};
    result.files.emplace_back(subject.name + "_plant.c",
                              fmt::format("/* SPDX-License-Identifier: BSL-1.0 */\n/* Exports the plant of a shared library. */\n"
                                          "#include \"{0}_plant.h\"\n\n"
                                          "const dalembert_plant* dalembert_plant_table(void) {{ return {0}_plant_table(); }}\n",
                                          subject.name));
    return result;
}

constexpr std::array slopes_of_outputs{Function::output_jacobian_p, Function::output_jacobian_t};
constexpr std::array all_derivatives{Function::output_jacobian_p, Function::hessian, Function::output_jacobian_t};

constexpr Target table[]{
    {"c", "the model as a table of C functions, in C99: for programs of your own", plant_files},
    {"casadi", "functions for CasADi's `external`: C files and a shared library", casadi_files, true, all_derivatives},
    {"fmi2", "a functional mock-up unit (FMI 2.0) for model exchange and co-simulation", fmi2_files, false, slopes_of_outputs},
    {"fmi3", "a functional mock-up unit (FMI 3.0) for model exchange and co-simulation", fmi3_files, false, slopes_of_outputs},
    {"acados", "the functions of the dynamics for acados, what `casadi` writes, and a Python file that makes an AcadosModel", acados_files,
     true, all_derivatives},
    {"python", "a package for Python with numpy: functions for many points at once, runs, and solve_ivp", python_files, false,
     slopes_of_outputs},
    {"octave", "a MEX function for Octave and MATLAB: functions for many points at once, runs, and handles for ode45 and ode15s",
     octave_files, false, slopes_of_outputs},
};

}  // namespace

std::span<const Target> targets() { return table; }

}  // namespace dalembert
