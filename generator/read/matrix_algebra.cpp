// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/matrix_algebra.hpp"

#include <fmt/format.h>

#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

ExpressionPtr product_of(const Span& span, const ExpressionPtr& a, const ExpressionPtr& b) {
    return joined_parts(Expression::Kind::multiply, span, {a, b});
}

MatrixExpression minor_of(const MatrixExpression& m, std::size_t row, std::size_t column) {
    MatrixExpression result{m.rows - 1, m.columns - 1, {}};
    for (std::size_t i = 0; i < m.rows; ++i)
        for (std::size_t j = 0; j < m.columns; ++j)
            if (i != row && j != column) result.entries.push_back(m.at(i, j));
    return result;
}

}  // namespace

std::string size_of(const MatrixExpression& m) { return fmt::format("{} by {}", m.rows, m.columns); }

ExpressionPtr with_parts(const Expression& e, std::vector<ExpressionPtr> children) {
    auto copy = std::make_shared<Expression>(e);
    copy->children = std::move(children);
    return copy;
}

ExpressionPtr joined_parts(Expression::Kind kind, const Span& span, std::vector<ExpressionPtr> children) {
    return std::make_shared<Expression>(Expression{kind, span, 0, {}, std::move(children)});
}

MatrixExpression transposed(const MatrixExpression& m) {
    MatrixExpression result{m.columns, m.rows, {}};
    for (std::size_t i = 0; i < m.columns; ++i)
        for (std::size_t j = 0; j < m.rows; ++j) result.entries.push_back(m.at(j, i));
    return result;
}

ExpressionPtr trace_of(const Expression& e, const MatrixExpression& m) {
    ExpressionPtr total = m.at(0, 0);
    for (std::size_t i = 1; i < m.rows; ++i) total = joined_parts(Expression::Kind::add, e.span, {total, m.at(i, i)});
    return total;
}

ExpressionPtr determinant_of(const Expression& e, const MatrixExpression& m) {
    if (m.is_number()) return m.entries[0];
    ExpressionPtr total;
    for (std::size_t j = 0; j < m.columns; ++j) {
        ExpressionPtr term = product_of(e.span, m.at(0, j), determinant_of(e, minor_of(m, 0, j)));
        total =
            !total ? std::move(term) : joined_parts(j % 2 == 0 ? Expression::Kind::add : Expression::Kind::subtract, e.span, {total, term});
    }
    return total;
}

/// The adjugate over the determinant.
MatrixExpression inverse_of(const Expression& e, const MatrixExpression& m) {
    const ExpressionPtr below = determinant_of(e, m);
    if (m.is_number()) return MatrixExpression{1, 1, {joined_parts(Expression::Kind::divide, e.span, {make_number(1, e.span), below})}};
    MatrixExpression result{m.rows, m.columns, {}};
    for (std::size_t i = 0; i < m.rows; ++i)
        for (std::size_t j = 0; j < m.columns; ++j) {
            ExpressionPtr cofactor = determinant_of(e, minor_of(m, j, i));
            if ((i + j) % 2 == 1) cofactor = joined_parts(Expression::Kind::negate, e.span, {cofactor});
            result.entries.push_back(joined_parts(Expression::Kind::divide, e.span, {cofactor, below}));
        }
    return result;
}

MatrixExpression cross_product(const Expression& e, const MatrixExpression& a, const MatrixExpression& b) {
    if (a.rows != 3 || b.rows != 3 || a.columns != 1 || b.columns != 1)
        fail(Id::wrong_arguments, e.span,
             fmt::format("'cross' takes two columns of three, here they are {} and {}", size_of(a), size_of(b)));
    MatrixExpression result{3, 1, {}};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        result.entries.push_back(
            joined_parts(Expression::Kind::subtract, e.span,
                         {product_of(e.span, a.entries[j], b.entries[k]), product_of(e.span, a.entries[k], b.entries[j])}));
    }
    return result;
}

MatrixExpression matrix_product(const Expression& e, const MatrixExpression& a, const MatrixExpression& b) {
    const auto scaled = [&](const MatrixExpression& m, const ExpressionPtr& factor, bool before) {
        MatrixExpression result = m;
        for (ExpressionPtr& entry : result.entries) entry = before ? with_parts(e, {factor, entry}) : with_parts(e, {entry, factor});
        return result;
    };
    if (a.is_number()) return scaled(b, a.entries[0], true);
    if (b.is_number()) return scaled(a, b.entries[0], false);
    if (a.columns != b.rows)
        fail(Id::size_mismatch, e.span,
             fmt::format("'{}' is {} and '{}' is {}: the product needs as many rows of the second as the first has columns",
                         e.children[0]->written(), size_of(a), e.children[1]->written(), size_of(b)));
    MatrixExpression result{a.rows, b.columns, {}};
    for (std::size_t i = 0; i < a.rows; ++i)
        for (std::size_t j = 0; j < b.columns; ++j) {
            ExpressionPtr total = product_of(e.span, a.at(i, 0), b.at(0, j));
            for (std::size_t k = 1; k < a.columns; ++k)
                total = joined_parts(Expression::Kind::add, e.span, {total, product_of(e.span, a.at(i, k), b.at(k, j))});
            result.entries.push_back(std::move(total));
        }
    return result;
}

MatrixExpression matrix_power(const Expression& e, const MatrixExpression& m, int exponent) {
    const MatrixExpression base = exponent < 0 ? inverse_of(e, m) : m;
    MatrixExpression result = base;
    for (int i = 1; i < std::abs(exponent); ++i) result = matrix_product(e, result, base);
    return result;
}

}  // namespace dalembert
