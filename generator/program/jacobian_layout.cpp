// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/jacobian_layout.hpp"

#include <algorithm>

namespace dalembert {

namespace {
constexpr std::size_t largest_dense = 16;
}

JacobianLayout::JacobianLayout(const std::vector<const Code*>& modes, Function function, By by) {
    const System& system = modes.front()->system;
    const std::size_t n = system.symbols.degrees();
    const std::size_t m = system.symbols.states();
    const std::size_t velocities = system.symbols.positions(), states = velocities + n;
    rows_ = states + m;
    columns_ = (*modes.front())[function].right.columns;
    const bool is_core = !system.heat.fields.empty();  // of a header with loops, where the pattern decides what is a band
    is_sparse_ = (rows_ > largest_dense || is_core) && by != By::time;
    column_starts_.push_back(0);
    const auto in_any = [&](const auto& is_there) {
        return std::any_of(modes.begin(), modes.end(), [&](const Code* code) { return is_there((*code)[function]); });
    };
    for (std::size_t c = 0; c < columns_; ++c) {
        const bool any = in_any([&](const FunctionCode& f) {
            if (f.loop) return std::find(f.loop->columns.begin(), f.loop->columns.end(), c) != f.loop->columns.end();
            for (std::size_t j = 0; j < f.right.rows; ++j)
                if (!f.is_zero(f.right.at(j, c))) return true;
            for (std::size_t j = 0; f.solved.rows != f.right.rows && j < f.solved.rows; ++j)
                if (!f.is_zero(f.solved.at(j, c))) return true;
            return false;
        });
        has_accelerations_.push_back(any);
        if (by == By::state && c >= velocities && c < states && system.symbols.has_value(c - velocities))
            row_indices_.push_back(system.symbols.place(SymbolKind::coordinate, c - velocities));
        for (std::size_t j = 0; any && j < n; ++j) row_indices_.push_back(velocities + j);
        for (std::size_t i = 0; i < m; ++i)
            if (in_any([&](const FunctionCode& f) { return !f.is_zero(f.below.at(i, c)); })) row_indices_.push_back(states + i);
        column_starts_.push_back(row_indices_.size());
    }
}

std::optional<std::size_t> JacobianLayout::place(std::size_t row, std::size_t column) const {
    if (!is_sparse_) return column * rows_ + row;
    const auto begin = row_indices_.begin() + static_cast<std::ptrdiff_t>(column_starts_[column]);
    const auto end = row_indices_.begin() + static_cast<std::ptrdiff_t>(column_starts_[column + 1]);
    const auto found = std::lower_bound(begin, end, row);
    if (found == end || *found != row) return std::nullopt;
    return static_cast<std::size_t>(found - row_indices_.begin());
}

bool JacobianLayout::any_accelerations() const {
    return std::find(has_accelerations_.begin(), has_accelerations_.end(), true) != has_accelerations_.end();
}

}  // namespace dalembert
