// SPDX-License-Identifier: BSL-1.0
// A system with modes seen from one of them: what it is there, and whether it can be there.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <type_traits>

#include "dalembert/series.hpp"
#include "dalembert/sizes.hpp"
#include "dalembert/status.hpp"
#include "dalembert/system_derivatives.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

// What a system may do without; see switching.hpp.
template <class System, class = void>
struct KinksOf {
    using type = std::array<typename System::scalar_type, 0>;
};
template <class System>
struct KinksOf<System, std::void_t<typename System::Kinks>> {
    using type = typename System::Kinks;
};

template <class System, class = void>
inline constexpr bool has_conditions = false;
template <class System>
inline constexpr bool has_conditions<System, std::void_t<decltype(&System::holds)>> = true;

template <class System, class = void>
inline constexpr bool says_what_follows_accumulation = false;
template <class System>
inline constexpr bool says_what_follows_accumulation<System, std::void_t<decltype(&System::after_accumulation)>> = true;

template <class System, class = void>
inline constexpr bool has_modes_beside = false;
template <class System>
inline constexpr bool has_modes_beside<System, std::void_t<decltype(&System::modes_beside)>> = true;

template <class System, class = void>
inline constexpr bool has_events_at_once = false;
template <class System>
inline constexpr bool has_events_at_once<System, std::void_t<decltype(System::happens_at_once(std::size_t()))>> = true;

template <class System, bool>
struct DerivativeTypes {};
template <class System>
struct DerivativeTypes<System, true> {
    using PatternX = typename System::PatternX;
    using PatternU = typename System::PatternU;
    using JacobianX = typename System::JacobianX;
    using JacobianU = typename System::JacobianU;
    using DifferentiatedState = typename detail::DifferentiatedState<System>::type;
};

/// A system with modes as one without: what it is in its present mode. Its guards are the events, and behind them the kinks.
template <class System>
class InMode : public DerivativeTypes<System, has_derivatives<System>>, public SeriesRows<System, has_series<System>> {
public:
    using scalar_type = typename System::scalar_type;
    using State = typename System::State;
    using Input = typename System::Input;
    using Mode = typename System::Mode;
    using Events = typename System::Events;
    using Kinks = typename KinksOf<System>::type;
    using Guards = Joined<Events, Kinks>;
    using Differentiated = typename detail::DifferentiatedState<System>::type;

    InMode(const System& system, Mode start) : mode(start), system_(system) {}

    Mode mode;
    Like<Events, bool> is_ignored{};  ///< events that are not looked at

    /// Where the system has one.
    template <class S = System>
    static auto state_table() -> decltype(S::state_table()) {
        return S::state_table();
    }
    void rhs(const State& x, const Input& u, scalar_type t, State& dxdt) const { system_.rhs(mode, x, u, t, dxdt); }
    template <class StateOrMore, class Inputs>
    void series(const Inputs& inputs, scalar_type t, std::size_t order, StateOrMore* x, scalar_type* rows) const {
        system_.series(mode, inputs, t, order, x, rows);
    }
    template <class Jacobian>
    void jacobian_x(const Differentiated& x, const Input& u, scalar_type t, Jacobian& J) const {
        system_.jacobian_x(mode, x, u, t, J);
    }
    template <class Jacobian>
    void rhs_and_jacobian(const Differentiated& x, const Input& u, scalar_type t, Differentiated& dxdt, Jacobian& J) const {
        system_.rhs_and_jacobian(mode, x, u, t, dxdt, J);
    }
    template <class Jacobian>
    void jacobian_p(const Differentiated& x, const Input& u, scalar_type t, Jacobian& J) const {
        system_.jacobian_p(mode, x, u, t, J);
    }
    template <class Jacobian>
    void jacobian_u(const Differentiated& x, const Input& u, scalar_type t, Jacobian& J) const {
        system_.jacobian_u(mode, x, u, t, J);
    }
    template <class Jacobian>
    void jacobian_t(const Differentiated& x, const Input& u, scalar_type t, Jacobian& J) const {
        system_.jacobian_t(mode, x, u, t, J);
    }

    void guards(const State& x, const Input& u, scalar_type t, Guards& g) const {
        Events of_events{};
        system_.guards(mode, x, u, t, of_events);
        for (std::size_t e = 0; e < of_events.size(); ++e)
            g[e] = !is_ignored[e] && System::is_watched(mode, e) ? of_events[e] : scalar_type(1);
        if constexpr (may_have_entries<Kinks>) {
            Kinks of_kinks{};
            system_.kinks(mode, x, u, t, of_kinks);
            for (std::size_t k = 0; k < of_kinks.size(); ++k) g[of_events.size() + k] = of_kinks[k];
        }
    }

private:
    const System& system_;
};

/// Whether a mode can take a state. It may be that an event happens there at once: then this is the first.
struct Acceptance {
    bool is_possible = false;
    std::size_t event = Outcome::none;
};

/// Inputs now, and half an instant and an instant later.
template <class System>
struct InputsAhead {
    typename System::Input now, half, whole;
};

/// How much a guard changes within an instant because inputs move, as its rate is that with inputs held. Of a jump, which is found where it
/// is, nothing.
template <class Scalar>
Scalar by_moving_inputs(Scalar now, Scalar half, Scalar whole) {
    using std::abs;
    const Scalar change = whole - now;
    return abs(Scalar(2) * (half - now) - change) <= abs(change) / Scalar(2) ? change : Scalar(0);
}

/// In `mode` at (t, x). What falls through zero within `instant`, in s, happens at once; where `is_late`, so does what fell within the last
/// two.
template <class System>
Acceptance acceptance(const System& system, typename System::Mode mode, const typename System::State& x, const InputsAhead<System>& inputs,
                      typename System::scalar_type t, typename System::scalar_type instant, bool is_late = false) {
    using Scalar = typename System::scalar_type;
    if constexpr (has_conditions<System>)
        if (!system.holds(mode, x, inputs.now, t)) return {};
    typename System::Events g{}, half{}, whole{}, rates{};
    system.guards(mode, x, inputs.now, t, g);
    system.guards(mode, x, inputs.half, t, half);
    system.guards(mode, x, inputs.whole, t, whole);
    system.guard_rates(mode, x, inputs.now, t, rates);
    Acceptance result{true, Outcome::none};
    for (std::size_t e = 0; e < g.size(); ++e) {
        if (!System::is_watched(mode, e)) continue;
        const Scalar moved = by_moving_inputs(g[e], half[e], whole[e]);
        const Scalar change = instant * rates[e] + moved;
        const bool fell = is_late && g[e] < Scalar(0) && g[e] >= Scalar(2) * change;
        bool is_driven = false;
        if constexpr (has_events_at_once<System>) is_driven = System::happens_at_once(e) && g[e] < Scalar(0);
        if (!(g[e] >= Scalar(0)) && !fell && !is_driven) return {};
        const Scalar slope = moved == Scalar(0) ? rates[e] : change;  // small numbers times an instant may be zero
        const bool falls = is_driven || (g[e] == Scalar(0) ? !(slope >= Scalar(0)) : g[e] + change <= Scalar(0));
        if (falls && result.event == Outcome::none) result.event = e;
    }
    return result;
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
