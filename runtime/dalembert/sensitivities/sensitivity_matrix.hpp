// SPDX-License-Identifier: BSL-1.0
// The Jacobian of a state with its sensitivities, as Rodas5p factors it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "dalembert/linear/jacobian_pattern.hpp"
#include "dalembert/run_array.hpp"
#include "dalembert/sizes.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Blocks of the size of Plain: those on the diagonal are alike and have the pattern Base, those in the first column may be full, others
/// are zero.
template <class Plain, class Base>
struct SensitivityPattern {
    static constexpr bool is_sparse = false;
};

template <class All, class Plain, class Base>
class SensitivityMatrix {
    using Scalar = typename Plain::value_type;

public:
    SensitivityMatrix() {
        if constexpr (!has_fixed_size<All>) below_.resize((size_of<All>() - size_of<Plain>()) * size_of<Plain>());
    }
    void clear() {
        diagonal_.clear();
        std::fill(below_.begin(), below_.end(), Scalar(0));
    }
    void add(std::size_t row, std::size_t column, const Scalar& value) {
        const std::size_t n = size_of<Plain>();
        if (row < n)
            diagonal_.add(row, column, value);
        else if (column < n)
            below_[column * (size_of<All>() - n) + row - n] += value;
    }
    bool factor() { return diagonal_.factor(); }
    void solve(All& b) const {
        const std::size_t n = size_of<Plain>(), all = size_of<All>();
        Plain part;
        const auto solve_part = [&](std::size_t c) {
            std::copy_n(b.begin() + static_cast<std::ptrdiff_t>(c * n), n, part.begin());
            diagonal_.solve(part);
            std::copy_n(part.begin(), n, b.begin() + static_cast<std::ptrdiff_t>(c * n));
        };
        solve_part(0);
        for (std::size_t column = 0; column < n; ++column)
            for (std::size_t i = 0; i < all - n; ++i) b[n + i] -= below_[column * (all - n) + i] * part[column];
        for (std::size_t c = 1; c * n < all; ++c) solve_part(c);
    }

private:
    template <class Array>
    struct Below {
        using type = std::vector<Scalar>;
    };
    template <std::size_t all>
    struct Below<std::array<Scalar, all>> {
        using type = std::array<Scalar, (all - size_of<Plain>()) * size_of<Plain>()>;
    };
    typename MatrixOf<Plain, Base>::type diagonal_;
    typename Below<All>::type below_{};
};

template <class All, class Plain, class Base>
struct SensitivityMatrixOf {
    using type = SensitivityMatrix<All, Plain, Base>;
    static constexpr bool fits() {
        return MatrixOf<Plain, Base>::fits() && size_of<All>() * size_of<Plain>() * sizeof(typename Plain::value_type) <= std::size_t(1)
                                                                                                                              << 20;
    }
    static constexpr double multiplications(double solutions) {
        const std::size_t n = size_of<Plain>(), all = size_of<All>();
        return MatrixOf<Plain, Base>::multiplications(solutions * static_cast<double>(all / n)) +
               solutions * static_cast<double>((all - n) * n);
    }
};
template <class Scalar, std::size_t all, class Plain, class Base>
struct MatrixOf<std::array<Scalar, all>, SensitivityPattern<Plain, Base>> : SensitivityMatrixOf<std::array<Scalar, all>, Plain, Base> {};
template <class Size, class Scalar, class Plain, class Base>
struct MatrixOf<RunArray<Size, Scalar>, SensitivityPattern<Plain, Base>> : SensitivityMatrixOf<RunArray<Size, Scalar>, Plain, Base> {};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
