// SPDX-License-Identifier: GPL-3.0-or-later
// Second derivatives of the motion, as code: see note [Hessian].
#pragma once

#include "graph/motion_code.hpp"

namespace dalembert {

/// Fills Function::hessian.
void make_hessian(Code& code, const LoweredSystem& lowered, MotionCode& motion);

/// The lower triangle of H of note [Hessian], made of its parts. `unknowns`: their places among accelerations and multipliers.
std::vector<NodeId> hessian_of(Program& program, const FunctionCode& f, const std::vector<std::size_t>& unknowns);

}  // namespace dalembert
