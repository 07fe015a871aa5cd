// SPDX-License-Identifier: BSL-1.0
// Whether a generated header and this runtime fit together.
#pragma once

#include <type_traits>

namespace dalembert {
inline namespace v1 {

/// The `api_version` of generated headers that this runtime works with.
inline constexpr int supported_api = 1;

/// Stops the compiler with a sentence where they do not.
template <class System>
constexpr void check_api() {
    static_assert(System::api >= supported_api,
                  "the generated header is older than this dalembert runtime: generate the header again, with the program of this runtime");
    static_assert(System::api <= supported_api,
                  "the generated header is newer than this dalembert runtime: take the runtime of the program that generated the header");
}

namespace detail {

template <class System, class = void>
inline constexpr bool is_switching = false;
template <class System>
inline constexpr bool is_switching<System, std::void_t<typename System::Mode>> = true;

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
