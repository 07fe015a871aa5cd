// SPDX-License-Identifier: GPL-3.0-or-later
// One letter of a printed equation with all that stands on, below and beside it: \dot{\tilde{q}}_{1,x}, \Delta T, \theta_{zz}^{(A)}.
//
// note [names of letters]  What a letter is called in the model language when the notation does not say:
//   x, \varphi, \mathrm{Re}      x, phi, Re       (\varphi and \phi are both phi, \vartheta is theta, ...)
//   m_1, f_{q,j}, T_\infty       m_1, f_q_j, T_inf
//   \theta_{zz}^{(A)}, y^*, q^\circ   theta_zz_A, y_star, q_circ
//   \dot{x}, \ddot{x}_1          dot(x), ddot(x_1)
//   \mathbf{r}, \vec{r}, \mathcal{V}, \bar{x}, \hat{x}, \tilde{x}, \overline{R}, \underline{R}
//                                r_bold, r_vec, V_cal, x_bar, x_hat, x_tilde, R_over, R_under
//   \Delta T, y'                 Delta_T, y_prime
//   {}^A x, \overline{u'v'}      A_x, u_prime_v_prime_over
//   e^{x}                        exp(x)           (an e without a power is a letter)
//   m_i inside \sum_i            m[i]             (an index that is counted stands in brackets: F_{ij} is F[i, j], r_{S,i} is r_S[i])
#pragma once

#include <optional>

#include "printed/latex_lexer.hpp"

namespace dalembert {

struct LatexLetter {
    std::string base;                 ///< "x", "\\varphi", "Re"
    bool is_upright = false;
    std::vector<std::string> marks;   ///< "\\mathbf", "\\tilde", the innermost first; no dots
    int dots = 0;
    bool is_difference = false;       ///< behind \Delta
    std::vector<LatexToken> before;   ///< scripts of {}^A x
    std::vector<LatexToken> index;    ///< parts with "," between them
    std::vector<LatexToken> label;    ///< a superscript that is no power
    int primes = 0;

    /// The one spelling that notations are compared by: \dot{V}_1, f_{e,x}, T_{\infty}, \mathbf{r}, m_1^{(A)}.
    std::string canonical() const;
    /// note [names of letters], without dots.
    std::string plain_name() const;
    bool is_vector() const;
    /// What a variable of integration stands for in f(...): t for \tau, x for \tilde{x}, \bar{x}, \hat{x} and x'.
    std::optional<std::string> meant_by_dummy() const;
};

/// A script as it is spelled in a canonical letter: no blanks, no fonts.
std::string canonical_script(const std::vector<LatexToken>& script);
/// A script as part of a name: q_j of "q,j"; empty when nothing of it can stand in a name.
std::string script_name(const std::vector<LatexToken>& script);
/// Whether a token says something in a script: a letter, a digit, a word, *, \infty, ...
bool can_be_script(const LatexToken& token);
/// "phi" of "\\varphi".
std::string greek_name(std::string_view command);
/// Whether a command is a letter: Greek, \ell, \hbar.
bool is_greek(std::string_view command);

}  // namespace dalembert
