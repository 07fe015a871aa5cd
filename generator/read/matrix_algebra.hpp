// SPDX-License-Identifier: GPL-3.0-or-later
// What is computed with matrices of expressions. Each takes the expression that says so, for its place.
#pragma once

#include "read/matrices.hpp"

namespace dalembert {

/// "2 by 3"
std::string size_of(const MatrixExpression& m);
ExpressionPtr with_parts(const Expression& e, std::vector<ExpressionPtr> children);
ExpressionPtr joined_parts(Expression::Kind kind, const Span& span, std::vector<ExpressionPtr> children);

MatrixExpression transposed(const MatrixExpression& m);
ExpressionPtr trace_of(const Expression& e, const MatrixExpression& m);
ExpressionPtr determinant_of(const Expression& e, const MatrixExpression& m);
MatrixExpression inverse_of(const Expression& e, const MatrixExpression& m);
MatrixExpression cross_product(const Expression& e, const MatrixExpression& a, const MatrixExpression& b);
MatrixExpression matrix_product(const Expression& e, const MatrixExpression& a, const MatrixExpression& b);
/// m m ... m of a square matrix, or of its inverse where the exponent is negative. The exponent is not zero.
MatrixExpression matrix_power(const Expression& e, const MatrixExpression& m, int exponent);

}  // namespace dalembert
