// SPDX-License-Identifier: GPL-3.0-or-later
// Second derivatives of lambda'*dx/dt by x and u, by implicit differentiation: M is not inverted here either.
//
// note [Hessian]: With R(x, u, a) = 0 linear in the unknowns a, of the matrix A = dR/da, and w = A^-1 (d(lambda'f)/da), the function
// L = lambda'f - w'R at fixed w has the gradient of lambda'f, as dL/da = 0. So of y = (x, u)
//     H = L_yy + L_ya a_y + (L_ya a_y)',   a_y = -A^-1 R_y.
// L_aa is zero, because f and R are linear in a.
#pragma once

#include "form/jacobian.hpp"

namespace dalembert {

struct SecondPartials {
    std::vector<GiNaC::ex> adjoint;             ///< [unknown]: d(lambda'f)/da, the right side for w
    std::vector<GiNaC::ex> direct;              ///< lower triangle of L_yy, row by row
    std::vector<std::vector<GiNaC::ex>> mixed;  ///< [column of y][unknown]: L_ya
};

/// Of states, then inputs, in letters of the unknowns, of lambda (SymbolKind::costate) and of w (SymbolKind::adjoint).
SecondPartials second_partials(const System& system);
/// How long the equations are that are differentiated twice.
std::size_t parts_of_motion(const System& system);
/// The columns of y.
std::vector<const Variable*> second_order_variables(const Symbols& symbols);

}  // namespace dalembert
