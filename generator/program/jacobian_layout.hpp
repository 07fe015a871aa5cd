// SPDX-License-Identifier: GPL-3.0-or-later
// Where the entries of a Jacobian stand in its flat array: all of them, column by column, or above 16 states the ones that are not
// zero for every motion, in compressed columns.
#pragma once

#include "graph/code.hpp"

namespace dalembert {

class JacobianLayout {
public:
    /// Rows are q (n), dq/dt (n), z. `by` says what the columns are. Of a machine with several modes what is not zero in one is stored.
    JacobianLayout(const std::vector<const Code*>& modes, Function function, By by);

    bool is_sparse() const { return is_sparse_; }
    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    /// Length of the flat array.
    std::size_t size() const { return is_sparse_ ? row_indices_.size() : rows_ * columns_; }
    /// The place of an entry in the array; nothing where it is not stored.
    std::optional<std::size_t> place(std::size_t row, std::size_t column) const;
    /// Whether a column of the accelerations' part is not zero for every motion.
    bool has_accelerations(std::size_t column) const { return has_accelerations_[column]; }
    /// Whether any entry but the ones of dq/dt depends on the column.
    bool any_accelerations() const;

    const std::vector<std::size_t>& column_starts() const { return column_starts_; }
    const std::vector<std::size_t>& row_indices() const { return row_indices_; }

private:
    bool is_sparse_;
    std::size_t rows_;
    std::size_t columns_;
    std::vector<bool> has_accelerations_;
    std::vector<std::size_t> column_starts_;
    std::vector<std::size_t> row_indices_;
};

}  // namespace dalembert
