// SPDX-License-Identifier: BSL-1.0
// What a run is differentiated by, and what belongs to each of it: a column dx/d(varied), systems whose parameter is moved.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "dalembert/difference_steps.hpp"
#include "dalembert/run_array.hpp"

namespace dalembert {
inline namespace v1 {

/// What a run is differentiated by.
struct Varied {
    enum class Of { parameter, start };
    Of of;
    std::size_t number;  ///< in the table of parameters, or of states
    static constexpr Varied parameter(std::size_t number) noexcept { return {Of::parameter, number}; }
    static constexpr Varied start(std::size_t state) noexcept { return {Of::start, state}; }
};

namespace detail {

/// How many columns the run of this thread has, where that is not known when code is compiled.
inline thread_local std::size_t columns_of_run = 0;

class UseColumns {
public:
    explicit UseColumns(std::size_t count) : before_(std::exchange(columns_of_run, count)) {}
    ~UseColumns() { columns_of_run = before_; }
    UseColumns(const UseColumns&) = delete;
    UseColumns& operator=(const UseColumns&) = delete;

private:
    std::size_t before_;
};

/// A state and its columns.
template <class Size>
struct WithColumns {
    static std::size_t of_run() noexcept { return Size::of_run() * (1 + columns_of_run); }
};

/// One T for each entry of a list of Varied: in an array if the list is one, else in a vector.
template <class List>
struct Columns;
template <std::size_t count>
struct Columns<std::array<Varied, count>> {
    template <class T>
    using Of = std::array<T, count>;
    template <class Plain>
    using State = Longer<Plain, count * size_of<Plain>()>;
    template <class T>
    static Of<T> filled(const std::array<Varied, count>&, const T& each) {
        return copies(each, std::make_index_sequence<count>());
    }

private:
    template <class T, std::size_t... c>
    static Of<T> copies(const T& each, std::index_sequence<c...>) {
        return {((void)c, each)...};
    }
};
template <>
struct Columns<std::vector<Varied>> {
    template <class T>
    using Of = std::vector<T>;
    template <class Plain>
    using State = RunArray<WithColumns<typename ArrayTraits<Plain>::Size>, typename Plain::value_type>;
    template <class T>
    static Of<T> filled(const std::vector<Varied>& varied, const T& each) {
        return Of<T>(varied.size(), each);
    }
};

template <class System>
using ParametersOf = std::decay_t<decltype(std::declval<const System&>().parameters())>;

/// Parameters as numbers in the order of their table.
template <class Scalar, class Parameters>
auto* numbers_in(Parameters& parameters) {
    using Number = std::conditional_t<std::is_const_v<Parameters>, const Scalar, Scalar>;
    if constexpr (std::is_same_v<std::decay_t<Parameters>, std::vector<Scalar>>) {
        return static_cast<Number*>(parameters.data());
    } else {
        static_assert(sizeof(Parameters) % sizeof(Scalar) == 0, "parameters are numbers");
        return reinterpret_cast<Number*>(&parameters);
    }
}
template <class System>
typename System::scalar_type parameter_of(const System& system, std::size_t number) {
    return numbers_in<typename System::scalar_type>(system.parameters())[number];
}
template <class System>
void move_parameter(System& system, std::size_t number, const typename System::scalar_type& by) {
    ParametersOf<System> parameters = system.parameters();
    numbers_in<typename System::scalar_type>(parameters)[number] += by;
    system.update(parameters);
}
/// What counts as large for it.
template <class System>
typename System::scalar_type size_of_parameter(const System& system, std::size_t number) {
    using std::abs;
    using Scalar = typename System::scalar_type;
    const Scalar value = abs(parameter_of(system, number));
    return value > Scalar(0) ? value : Scalar(1);
}
/// What counts as large for one that is varied; `scale` is that of the state.
template <class System, class State>
typename System::scalar_type size_of_varied(const System& system, const Varied& varied, const State& scale) {
    return varied.of == Varied::Of::start ? scale[varied.number] : size_of_parameter(system, varied.number);
}

/// For each that is varied the system on both sides of it.
template <class System, class List>
struct MovedSystems {
    using Scalar = typename System::scalar_type;
    MovedSystems(const System& system, const List& varied)
        : ahead(Columns<List>::filled(varied, system)), behind(ahead), distance(Columns<List>::filled(varied, Scalar(0))) {
        for (std::size_t c = 0; c < varied.size(); ++c) {
            if (varied[c].of == Varied::Of::start) continue;
            const std::size_t number = varied[c].number;
            const Scalar step = step_of_differences<Scalar>() * size_of_parameter(system, number);
            move_parameter(ahead[c], number, step);
            move_parameter(behind[c], number, -step);
            distance[c] = (parameter_of(ahead[c], number) - parameter_of(behind[c], number)) / Scalar(2);
        }
    }
    typename Columns<List>::template Of<System> ahead, behind;
    typename Columns<List>::template Of<Scalar> distance;  ///< zero where a start is varied
};

/// Inputs that know the parameters of their system are asked with those of another one.
template <class Inputs, class System, class = void>
inline constexpr bool follow_parameters = false;
template <class Inputs, class System>
inline constexpr bool
    follow_parameters<Inputs, System, std::void_t<decltype(std::declval<const Inputs&>().of(std::declval<const System&>()))>> = true;
/// Whether they are known to follow the time alone.
template <class Inputs>
auto are_of_time_alone(const Inputs& inputs, int) -> decltype(inputs.of_time_alone()) {
    return inputs.of_time_alone();
}
template <class Inputs>
bool are_of_time_alone(const Inputs&, long) {
    return false;
}
template <class Inputs, class System>
decltype(auto) inputs_with(const Inputs& inputs, const System& system) {
    if constexpr (follow_parameters<Inputs, System>)
        return inputs.of(system);
    else
        return (inputs);
}

}  // namespace detail

}  // namespace v1
}  // namespace dalembert
