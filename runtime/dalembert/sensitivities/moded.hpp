// SPDX-License-Identifier: BSL-1.0
// Systems with and without modes, asked in one way.
#pragma once

#include <cstddef>

#include "dalembert/api.hpp"
#include "dalembert/events/modes.hpp"
#include "dalembert/sensitivities/variational.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// What shows systems in a mode.
template <class Mode>
struct ShowsMode {
    Mode mode;
    template <class System>
    InMode<System> operator()(const System& system) const {
        return {system, mode};
    }
};

/// The mode of a system without modes.
struct TheOnlyMode {
    friend bool operator==(TheOnlyMode, TheOnlyMode) { return true; }
    friend bool operator!=(TheOnlyMode, TheOnlyMode) { return false; }
};

/// A system by the mode of a run.
template <class System, bool = is_switching<System>>
struct Moded {
    using Mode = typename System::Mode;
    using View = ShowsMode<Mode>;
    using Kinks = typename KinksOf<System>::type;
    static View view(Mode mode) { return {mode}; }
    template <class State, class Input, class Scalar>
    static void kinks(const System& system, Mode mode, const State& x, const Input& u, const Scalar& t, Kinks& k) {
        if constexpr (may_have_entries<Kinks>)
            system.kinks(mode, x, u, t, k);
        else
            (void)system, (void)mode, (void)x, (void)u, (void)t, (void)k;
    }
    static bool is_kink(std::size_t) { return true; }
};
template <class System>
struct Moded<System, false> {
    using Mode = TheOnlyMode;
    using View = AsItIs;
    using Kinks = typename System::Guards;
    static View view(Mode) { return {}; }
    template <class State, class Input, class Scalar>
    static void kinks(const System& system, Mode, const State& x, const Input& u, const Scalar& t, Kinks& k) {
        system.guards(x, u, t, k);
    }
    /// Others end the run.
    static bool is_kink(std::size_t guard) { return !System::guard_table()[guard].ends; }
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
