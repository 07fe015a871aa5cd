// SPDX-License-Identifier: GPL-3.0-or-later
// From an equation as it is printed, in LaTeX, to the syntax tree of the model language. Every node points into the LaTeX.
//
// note [calls from LaTeX]  Beside the functions of the vocabulary the reader makes these calls:
//   dot(e), ddot(e)                 time derivatives: \dot{x}, \frac{d}{dt} e, \frac{d^2 x}{dt^2}
//   derivative(e, x)                \frac{de}{dx}; second ones are nested
//   partial(e, x, held...)          \frac{\partial e}{\partial x}; what is held constant behind it: \left(\frac{\partial e}{\partial
//   x}\right)_{p,T} differential(e), variation(e)   de outside of an integral, \delta e integral(e, x, a, b)            \int_a^b e dx;
//   integral(e, x) without limits; integral(e, x, R) over a region, \int_R e dx limit(e, x, a)                  \lim_{x \to a} e at(e, x,
//   a)                     \left. e \right|_{x=a}, and f(a) of a function f of x product(e, k, a, b)             \prod_{k=a}^b e; \sum is
//   the `sum` of the model language sum_over(e, k), sum_over(e, k, condition), product_over(...)    \sum_k e, \sum_{k \neq i} e, without
//   limits factorial(n), average(e), mean(e), tensor(a, b)    n!, \langle e \rangle, \overline{a + b}, a \otimes b matrix(row(...), ...),
//   row(...), transpose(A), inverse(A), determinant(A), trace(A), diag(v) inner(a, b), cross(a, b), norm(v)       between what is bold or
//   has an arrow: \cdot, \times, \|v\| gradient(e), divergence(v), curl(v), laplacian(e)     \nabla e, \nabla \cdot v, \nabla \times v,
//   \nabla^2 e quantity(number, unit)          9.81\,\mathrm{m}/\mathrm{s}^2; the unit is a tree of the grammar of units cases(e,
//   condition, ..., e)     pieces with their conditions; the last one without a condition holds otherwise value(f, a, b) f(a, b), f(x_0)
//   and f(0) where nothing says what f is a function of minimum_over(e, x), maximum_over, infimum_over, supremum_over, minimiser(e, x),
//   maximiser    \min_x e, ..., \arg\min_x e integral_over(e, R), integral_over(e, R, x, y)    \int_R e, \int_R e dx dy dots() an ellipsis
//   as a term, factor or entry ket(a), bra(a), braket(a, b), braket(a, e, b), pairing(a, b)    |a\rangle, \langle a|, ..., \langle a,
//   b\rangle component(e, i), taken_at(e, a), in_frame(e, A), derivative_by_index(e, i)    (a + b)_i, e|_a, \frac{{}^A d e}{dt}, \partial_i
//   e material_rate(e), binomial(n, k), set(a, b), member(a, A)    \frac{De}{Dt}, \binom{n}{k}, \{a, b\}, a \in A equal, not_equal, less,
//   less_equal, greater, greater_equal (a, b), both(c, d), either(c, d)     conditions
// and the names `pi`, `infinity`, `constant` ("= const."), `nabla`.
#pragma once

#include "language/expression.hpp"
#include "printed/notation.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

enum class Relation {
    equal,
    approximately,
    less,
    less_equal,
    greater,
    greater_equal,
    not_equal,
    proportional,
    similar,
    much_less,
    much_greater,
    precedes,
    precedes_equal,
    succeeds,
    succeeds_equal
};

/// "=", "\approx", ...
const char* sign_of(Relation relation);

/// One printed equation or chain of them: sides with a relation between each two.
struct LatexEquation {
    Equation equation;
    std::vector<Relation> relations;         ///< one less than sides
    std::vector<ExpressionPtr> conditions;   ///< "für x > 0": where it holds
    std::vector<Span> ranges;                ///< "\forall ...", "j = 1, \dots, n", "\in [0, 1]": said beside it and not read
    std::vector<bool> has_both_signs;        ///< of each side: \pm or \mp stands there, which is + or - as the notation says
    std::size_t number = 0;                  ///< among the equations of the text, from 1
};

/// An equation among several of a text that is not read.
struct RefusedEquation {
    std::size_t number = 0;  ///< as LatexEquation::number
    Diagnostic why;
};

/// All equations of the text, in order. Throws Failure (syntax, too-deep, too-long, number-too-large) with a caret inside the text.
std::vector<LatexEquation> read_latex(const Excerpt& excerpt, const PrintedNotation& notation);
/// The same without the equations that cannot be read, which are added to `refused`: note [what an equation takes with it]. Throws where
/// nothing is read.
std::vector<LatexEquation> read_latex(const Excerpt& excerpt, const PrintedNotation& notation, std::vector<RefusedEquation>& refused);
/// The text is one expression without a relation. Throws the same.
ExpressionPtr read_latex_expression(const Excerpt& excerpt, const PrintedNotation& notation);
/// The canonical spelling of the one letter, or word that the notation knows, in the excerpt. Throws Failure (syntax).
std::string canonical_letter(const Excerpt& excerpt, const PrintedNotation& notation);
/// The same of "f", without arguments, or "f(x, t)", with the names of the model language that stand in its brackets. Throws the same.
std::pair<std::string, std::vector<std::string>> function_with_arguments(const Excerpt& excerpt, const PrintedNotation& notation);

}  // namespace dalembert
