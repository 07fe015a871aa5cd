// SPDX-License-Identifier: BSL-1.0
// Taylor series of the motion of a generated system, and of its inputs. A header has them if it was generated with --taylor.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "dalembert/series_functions.hpp"
#include "dalembert/sizes.hpp"

namespace dalembert {
inline namespace v1 {

/// Inputs as functions u(x, t), together with a function that makes their series: see `series` in generated headers.
template <std::size_t rows, class Function, class Series>
struct InputsWithSeries {
    static constexpr std::size_t series_rows = rows;
    Function function;
    Series make_series;

    template <class State, class Scalar>
    auto operator()(const State& x, Scalar t) const {
        return function(x, t);
    }
    template <class State, class Scalar, class Input>
    auto series(const State* x, Scalar t, Input& u, Scalar* work) const {
        return make_series(x, t, u, work);
    }
};

template <std::size_t rows, class Function, class Series>
InputsWithSeries<rows, Function, Series> with_series(Function function, Series make_series) {
    return {std::move(function), std::move(make_series)};
}

namespace detail {

template <class System, class = void>
inline constexpr bool has_series = false;
template <class System>
inline constexpr bool has_series<System, std::void_t<decltype(System::series_rows)>> = true;

/// A loaded system has series or not; this is known only in the run.
template <class System, class = void>
inline constexpr bool tells_of_series = false;
template <class System>
inline constexpr bool tells_of_series<System, std::void_t<decltype(System::has_series_in_run())>> = true;
template <class System>
bool has_series_in_run() noexcept {
    if constexpr (tells_of_series<System>) return System::has_series_in_run();
    else return has_series<System>;
}

/// The number of rows of a system that has series, for one that is made of it.
template <class System, bool>
struct SeriesRows {};
template <class System>
struct SeriesRows<System, true> {
    static constexpr auto series_rows = System::series_rows;
    static bool has_series_in_run() noexcept { return detail::has_series_in_run<System>(); }
};

/// No inputs.
struct NoInputs {
    static constexpr std::size_t series_rows = 0;
    template <class State, class Scalar, class Input>
    auto series(const State*, Scalar, Input&, Scalar*) const {
        return [](std::size_t) { return Input{}; };
    }
};

/// Whether a system with these inputs has series.
template <class System, class Inputs>
constexpr bool can_make_series() {
    if constexpr (!has_series<System>) return false;
    else return !may_have_entries<typename System::Input> || has_series<Inputs>;
}

/// As Taylor wants it: the series of a system with its inputs.
template <class System, class Inputs>
class SystemSeries {
    static constexpr bool has_inputs = may_have_entries<typename System::Input>;
    using Source = std::conditional_t<has_inputs, Inputs, NoInputs>;

public:
    static std::size_t rows() noexcept { return System::series_rows + Source::series_rows; }

    SystemSeries(const System& system, const Inputs& inputs) : system_(system), inputs_(inputs) {}

    /// Sets x[1] to x[order]; `work` is room for 2*rows*order numbers.
    template <class State, class Scalar>
    void operator()(Scalar t, std::size_t order, State* x, Scalar* work) const {
        if constexpr (has_inputs) system_.series(inputs_, t, order, x, work);
        else system_.series(NoInputs{}, t, order, x, work);
    }

private:
    const System& system_;
    const Inputs& inputs_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
