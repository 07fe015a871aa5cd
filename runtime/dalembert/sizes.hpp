// SPDX-License-Identifier: BSL-1.0
// Arrays whose size is known when code is compiled, as those of generated headers, and arrays whose size belongs to a run: see run_array.hpp. What
// integrates takes both.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "dalembert/compiler.h"

namespace dalembert {
inline namespace v1 {
namespace detail {

template <std::size_t n>
struct FixedSize {
    static constexpr std::size_t of_run() noexcept { return n; }
};

template <class Array>
struct ArrayTraits;
template <class T, std::size_t n>
struct ArrayTraits<std::array<T, n>> {
    using Size = FixedSize<n>;
    static constexpr bool is_fixed = true;
    static constexpr bool may_have_entries = n > 0;
    template <class U>
    using Like = std::array<U, n>;
    template <std::size_t more>
    using Longer = std::array<T, n + more>;
};

/// How many entries arrays of a type have: a constant where that is known when code is compiled.
template <class Array>
constexpr std::size_t size_of() noexcept {
    return ArrayTraits<Array>::Size::of_run();
}
/// Whether it can be that there are some: code for arrays that are known to be empty need not be compiled.
template <class Array>
inline constexpr bool may_have_entries = ArrayTraits<Array>::may_have_entries;
template <class Array>
inline constexpr bool has_fixed_size = ArrayTraits<Array>::is_fixed;

/// An array as long as another one.
template <class Array, class T>
using Like = typename ArrayTraits<Array>::template Like<T>;
/// An array of the same type with more entries.
template <class Array, std::size_t more = 1>
using Longer = typename ArrayTraits<Array>::template Longer<more>;

template <class First, class Second>
struct JoinedArrays;
template <class T, std::size_t n, std::size_t m>
struct JoinedArrays<std::array<T, n>, std::array<T, m>> {
    using type = std::array<T, n + m>;
};
/// An array with room for the entries of two.
template <class First, class Second>
using Joined = typename JoinedArrays<First, Second>::type;

/// By how many entries arrays of the first type are longer: 0, or that which Longer added.
template <class Array, class Shorter>
struct EntriesMore;
template <class T, std::size_t n, std::size_t m>
struct EntriesMore<std::array<T, n>, std::array<T, m>> : std::integral_constant<std::size_t, n - m> {};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
