// SPDX-License-Identifier: GPL-3.0-or-later
// What host and board share: where a system is evaluated, and how a member is called that may take a mode.
#pragma once

#include <type_traits>

template <class System>
struct Point {
    unsigned mode;
    typename System::State x;
    typename System::Input u;
    typename System::scalar_type t;
};

template <class System, class = void>
inline constexpr bool has_modes = false;
template <class System>
inline constexpr bool has_modes<System, std::void_t<typename System::Mode>> = true;

/// use(member, arguments...), with the mode before the arguments where the member takes one: in machines that switch.
template <class Use, class Class, class Result, class First, class... Rest, class... Arguments>
decltype(auto) with_mode(Use&& use, Result (Class::*member)(First, Rest...) const noexcept, unsigned mode, Arguments&&... arguments) {
    if constexpr (std::is_enum_v<First>) return use(member, static_cast<First>(mode), arguments...);
    else return use(member, arguments...);
}
