// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors and matrices in printed equations, taken apart into equations of numbers before anything else is done with them.
#pragma once

#include "elements/model.hpp"

namespace dalembert {

/// Rows of expressions. A number is a matrix of one row and one column.
struct MatrixExpression {
    std::size_t rows = 1, columns = 1;
    std::vector<ExpressionPtr> entries;  ///< row by row

    bool is_number() const { return rows == 1 && columns == 1; }
    const ExpressionPtr& at(std::size_t row, std::size_t column) const { return entries[row * columns + column]; }
};

/// Takes equations apart: matrix(row(a, b), row(c, d)), vector(a, b, c), transpose, det, inverse, cross, sums and products; derivatives and
/// integrals entry by entry, diff(v, q) by a vector q gives a column for each of its entries. A position[BODY] without its axis is a
/// vector. Letters that stand for matrices are inserted and gone from `letters`. What has no matrices is left as it is, but for cases,
/// which become one formula. Throws Failure (size-mismatch) where sizes do not fit, and (wrong-arguments).
std::vector<Equation> without_matrices(std::vector<Equation> equations, std::vector<PrintedLetter>& letters);

/// Sets `equations` and `letters` to those of numbers that `shown` and `shown_letters` stand for; or else, where sizes do not fit, `sizes`.
void take_matrices_apart(PrintedEquation& printed);

}  // namespace dalembert
