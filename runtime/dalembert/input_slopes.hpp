// SPDX-License-Identifier: BSL-1.0
// How inputs of a run follow the state and the parameters, where they know that themselves.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace dalembert {
inline namespace v1 {
namespace detail {

/// inputs.slopes(x, t, columns) gives du/dx, a column of inputs for each state, and behind it du/dp; it returns false where it cannot.
template <class Inputs, class Scalar, class = void>
inline constexpr bool know_slopes = false;
template <class Inputs, class Scalar>
inline constexpr bool know_slopes<Inputs, Scalar,
                                  std::void_t<decltype(std::declval<const Inputs&>().slopes(
                                      static_cast<const Scalar*>(nullptr), Scalar(), std::declval<std::vector<Scalar>&>()))>> = true;

template <class Inputs, class Scalar>
class InputSlopes {
public:
    /// Of the inputs at this point. False where these do not know them.
    template <class State>
    bool take([[maybe_unused]] const Inputs& inputs, [[maybe_unused]] const State& x, [[maybe_unused]] const Scalar& t) {
        if constexpr (know_slopes<Inputs, Scalar>)
            return inputs.slopes(x.data(), t, columns_);
        else
            return false;
    }
    /// Of an input by a state, or by the parameter `column - states`, where there are so many inputs.
    const Scalar& at(std::size_t column, std::size_t input, std::size_t inputs) const { return columns_[column * inputs + input]; }
    /// Whether any follows one of so many columns.
    bool follow(std::size_t columns, std::size_t inputs) const {
        return std::any_of(columns_.begin(), columns_.begin() + static_cast<std::ptrdiff_t>(columns * inputs),
                           [](const Scalar& slope) { return slope != Scalar(0); });
    }
    bool follow_nothing() const {
        return std::all_of(columns_.begin(), columns_.end(), [](const Scalar& slope) { return slope == Scalar(0); });
    }
    /// Along a column s of S, of so many states.
    template <class Varied>
    Scalar along(const Varied& varied, std::size_t input, std::size_t inputs, const Scalar* s, std::size_t states) const {
        Scalar sum = varied.of == Varied::Of::parameter ? at(states + varied.number, input, inputs) : Scalar(0);
        for (std::size_t i = 0; i < states; ++i) sum += at(i, input, inputs) * s[i];
        return sum;
    }

    /// Of all inputs.
    template <class Input, class Varied, class State>
    Input along(const Varied& varied, const State& s) const {
        Input slopes{};
        for (std::size_t j = 0; j < slopes.size(); ++j) slopes[j] = along(varied, j, slopes.size(), s.data(), s.size());
        return slopes;
    }

private:
    std::vector<Scalar> columns_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
