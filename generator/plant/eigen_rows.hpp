// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices of Eigen as rows of numbers, and back.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include <dalembert/linearise.hpp>
#include <dalembert/plant_system.hpp>

#include "plant/equilibrium.hpp"

namespace dalembert {

/// None of a matrix without columns.
template <class Derived>
auto rows_of(const Eigen::MatrixBase<Derived>& matrix) {
    std::vector<std::vector<typename Derived::Scalar>> rows(matrix.cols() > 0 ? static_cast<std::size_t>(matrix.rows()) : 0);
    if (rows.empty()) return rows;
    for (Eigen::Index r = 0; r < matrix.rows(); ++r)
        for (Eigen::Index c = 0; c < matrix.cols(); ++c) rows[static_cast<std::size_t>(r)].push_back(matrix(r, c));
    return rows;
}

inline Eigen::MatrixXd matrix_of(const NumberRows& rows) {
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), rows.empty() ? 0 : static_cast<Eigen::Index>(rows.front().size()));
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t c = 0; c < rows[r].size(); ++c) matrix(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = rows[r][c];
    return matrix;
}

inline ConstraintRows<double> constraint_rows_of(const HeldRows& rows) { return {matrix_of(rows.of_positions), matrix_of(rows.of_rates)}; }

/// Numbers as an array of the plant in use.
template <class Array, class Numbers>
Array array_of(const Numbers& numbers) {
    Array result;
    std::copy(numbers.begin(), numbers.end(), result.begin());
    return result;
}
template <class Array>
std::vector<double> numbers_of(const Array& array) {
    return {array.begin(), array.end()};
}

}  // namespace dalembert
