// SPDX-License-Identifier: GPL-3.0-or-later
// The derivatives of a plant in C99 for tools that call functions of x, u and p and ask for Jacobians by their stored entries: CasADi,
// acados.
#pragma once

#include <map>
#include <string>

#include "export/target.hpp"

namespace dalembert {

/// What such exports have in common.
struct DerivativesInC {
    bool has_hessian = false;                    ///< the header has second derivatives
    bool has_outputs_by_parameter = false, has_outputs_by_time = false;  ///< and the derivatives of outputs by these
    bool has_time = false;                       ///< rates or outputs depend on t itself
    std::map<std::string, std::string> numbers;  ///< NAME, TITLE and sizes, for the templates of tools
    std::pair<std::filesystem::path, std::string> file;  ///< NAME_derivatives.h
};

/// The entries of a constant array, in lines.
std::string number_lines(const std::vector<std::size_t>& numbers);

/// Throws Failure (bad-option) for a machine that switches where `wish` chooses no mode, or none that it has. `tool`: in that sentence.
DerivativesInC derivatives_in_c(const ExportSubject& subject, const ExportWish& wish, const char* tool);

}  // namespace dalembert
