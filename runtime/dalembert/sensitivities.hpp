// SPDX-License-Identifier: BSL-1.0
// How a run depends on parameters and start values: S = dx/dp and dx/dx0, integrated with the state.
//
// The variational equations are dS/dt = (df/dx + df/du du/dx) S + df/dp, with the exact Jacobians of the header. Methods, steps and
// guards are those of simulate(). Method::rodas5p takes the Jacobian of both together: its blocks on the diagonal are equal, so that one
// factorisation serves all, and those below are differences of Jacobians along the columns of S.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "dalembert/api.hpp"
#include "dalembert/integrate.hpp"
#include "dalembert/singular_positions.hpp"
#include "dalembert/system_derivatives.hpp"

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

template <class System, std::size_t count>
using Sensitivities = std::array<typename System::State, count>;  ///< a column dx/d(varied) for each; in units of x by units of that

/// One point of a run. References: copy what is to be kept.
template <class System, std::size_t count>
struct SensitivitySample {
    typename System::scalar_type t;
    const typename System::State& x;
    const typename System::Input& u;
    const Sensitivities<System, count>& S;
};

namespace detail {

template <class System>
using ParametersOf = std::decay_t<decltype(std::declval<const System&>().parameters())>;

template <class System>
typename System::scalar_type parameter_of(const System& system, std::size_t number) {
    using Scalar = typename System::scalar_type;
    static_assert(sizeof(ParametersOf<System>) == sizeof(Scalar) * System::parameter_table().size(),
                  "parameters have the order of their table");
    return reinterpret_cast<const Scalar*>(&system.parameters())[number];
}
template <class System>
void move_parameter(System& system, std::size_t number, const typename System::scalar_type& by) {
    ParametersOf<System> parameters = system.parameters();
    reinterpret_cast<typename System::scalar_type*>(&parameters)[number] += by;
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

/// Blocks of n rows: those on the diagonal are alike and have the pattern Base, those in the first column may be full, others are zero.
template <class Base, std::size_t n>
struct SensitivityPattern {
    static constexpr bool is_sparse = false;
};

template <class Scalar, std::size_t all, class Base, std::size_t n>
struct MatrixOf<std::array<Scalar, all>, SensitivityPattern<Base, n>> {
    using State = std::array<Scalar, n>;
    using OfState = MatrixOf<State, Base>;
    static constexpr std::size_t columns = all / n - 1;
    static constexpr bool fits() noexcept { return OfState::fits() && all * n * sizeof(Scalar) <= std::size_t(1) << 20; }
    static constexpr double multiplications(double solutions) noexcept {
        return OfState::multiplications(solutions * (1.0 + static_cast<double>(columns))) + solutions * static_cast<double>((all - n) * n);
    }

    class type {
    public:
        void clear() {
            diagonal_.clear();
            below_.fill(Scalar(0));
        }
        void add(std::size_t row, std::size_t column, const Scalar& value) {
            if (row < n)
                diagonal_.add(row, column, value);
            else if (column < n)
                below_[column * (all - n) + row - n] += value;
        }
        bool factor() { return diagonal_.factor(); }
        void solve(std::array<Scalar, all>& b) const {
            State part;
            std::copy_n(b.begin(), n, part.begin());
            diagonal_.solve(part);
            std::copy_n(part.begin(), n, b.begin());
            for (std::size_t column = 0; column < n; ++column)
                for (std::size_t i = 0; i < all - n; ++i) b[n + i] -= below_[column * (all - n) + i] * part[column];
            for (std::size_t c = 1; c <= columns; ++c) {
                std::copy_n(b.begin() + static_cast<std::ptrdiff_t>(c * n), n, part.begin());
                diagonal_.solve(part);
                std::copy_n(part.begin(), n, b.begin() + static_cast<std::ptrdiff_t>(c * n));
            }
        }

    private:
        typename OfState::type diagonal_;
        std::array<Scalar, (all - n) * n> below_{};
    };
};

/// The state and its sensitivities as one motion.
template <class System, class Inputs, std::size_t count>
class Variational {
    using Scalar = typename System::scalar_type;
    using Plain = typename System::State;
    static constexpr std::size_t n = size_of<Plain>();

public:
    using State = Longer<Plain, count * n>;
    using DifferentiatedState = State;
    using Pattern = SensitivityPattern<typename System::PatternX, n>;

    template <class Scale>
    Variational(const System& system, const Inputs& inputs, const std::array<Varied, count>& varied, const Scale& scale)
        : system_(system),
          inputs_(inputs),
          varied_(varied),
          here_(system, inputs, scale),
          on_the_way_(system, inputs, scale),
          scale_(scale) {
        for (std::size_t c = 0; c < count; ++c) {
            ahead_[c] = behind_[c] = system;
            distance_[c] = Scalar(0);
            if (varied[c].of == Varied::Of::start) continue;
            const std::size_t number = varied[c].number;
            distance_[c] = smallest() * size_of_parameter(system, number);
            move_parameter(ahead_[c], number, distance_[c]);
            move_parameter(behind_[c], number, -distance_[c]);
            distance_[c] = (parameter_of(ahead_[c], number) - parameter_of(behind_[c], number)) / Scalar(2);
        }
    }

    static Plain part(const State& all, std::size_t c) {
        Plain result;
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(c * n), n, result.begin());
        return result;
    }
    static void put(State& all, std::size_t c, const Plain& values) {
        std::copy_n(values.begin(), n, all.begin() + static_cast<std::ptrdiff_t>(c * n));
    }

    void rates(const State& all, Scalar t, State& derivative) {
        const Plain x = part(all, 0);
        const auto u = inputs_(x, t);
        Plain dxdt;
        system_.rhs_and_jacobian(x, u, t, dxdt, by_state_);
        put(derivative, 0, dxdt);
        system_.jacobian_p(x, u, t, by_parameters_);
        for (std::size_t c = 0; c < count; ++c) {
            Plain s = part(all, c + 1), rate = own_rate(c);
            for (std::size_t column = 0; column < n; ++column)
                for_each_in_column<typename System::PatternX>(
                    by_state_, n, column, [&](std::size_t row, const Scalar& value) { rate[row] += value * s[column]; });
            put(derivative, c + 1, rate);
        }
        if constexpr (may_have_entries<typename System::Input>)
            if (on_the_way_.have_feedback(x, u, t)) add_feedback(all, x, t, derivative);
    }

    // What Rodas5p asks for.

    void prepare(const State& all, Scalar t) {
        using std::abs;
        const Plain x = part(all, 0);
        here_.prepare(x, t);
        for (std::size_t c = 0; c < count; ++c) {
            // Along a column of S, and the parameter with it.
            const Plain s = part(all, c + 1);
            Scalar step = distance_[c];
            if (varied_[c].of == Varied::Of::start) {
                Scalar longest = Scalar(0);
                for (std::size_t i = 0; i < n; ++i) longest = std::max(longest, Scalar(abs(s[i]) / std::max(scale_[i], Scalar(abs(x[i])))));
                step = longest > Scalar(0) ? smallest() / longest : Scalar(0);
            }
            below_[c].fill(Scalar(0));
            if (step == Scalar(0)) continue;
            typename System::JacobianX ahead{}, behind{};
            const auto at = [&](const System& system, Scalar length, typename System::JacobianX& J) {
                Plain there = x;
                for (std::size_t i = 0; i < n; ++i) there[i] += length * s[i];
                system.jacobian_x(there, inputs_(there, t), t, J);
            };
            at(ahead_[c], step, ahead);
            at(behind_[c], -step, behind);
            for (std::size_t k = 0; k < ahead.size(); ++k) below_[c][k] = (ahead[k] - behind[k]) / (Scalar(2) * step);
        }
    }

    template <class Add>
    void for_each_entry(Add add) const {
        here_.for_each_entry([&](std::size_t row, std::size_t column, const Scalar& value) {
            for (std::size_t c = 0; c <= count; ++c) add(c * n + row, c * n + column, value);
        });
        for (std::size_t c = 0; c < count; ++c)
            for (std::size_t column = 0; column < n; ++column)
                for_each_in_column<typename System::PatternX>(
                    below_[c], n, column, [&](std::size_t row, const Scalar& value) { add((c + 1) * n + row, column, value); });
    }

    /// That of the rates of S is a difference within the step; exact where time does not appear.
    void time_derivative(const State& all, Scalar t, Scalar length, State& dfdt) {
        using std::sqrt;
        Plain of_state;
        here_.time_derivative(part(all, 0), t, length, of_state);
        const Scalar step = length * sqrt(std::numeric_limits<Scalar>::epsilon()) * Scalar(64);
        State now, later;
        rates(all, t, now);
        rates(all, t + step, later);
        for (std::size_t i = 0; i < dfdt.size(); ++i) dfdt[i] = (later[i] - now[i]) / step;
        put(dfdt, 0, of_state);
    }

private:
    /// What S gets by way of inputs that follow the state: the whole Jacobian without that of the system.
    void add_feedback(const State& all, const Plain& x, Scalar t, State& derivative) {
        on_the_way_.prepare(x, t);
        on_the_way_.for_each_feedback([&](std::size_t row, std::size_t column, const Scalar& value) {
            for (std::size_t c = 1; c <= count; ++c) derivative[c * n + row] += value * all[c * n + column];
        });
    }

    static Scalar smallest() {
        using std::cbrt;
        return cbrt(std::numeric_limits<Scalar>::epsilon());
    }
    /// df/d(varied) at fixed x.
    Plain own_rate(std::size_t c) const {
        Plain result;
        result.fill(Scalar(0));
        if (varied_[c].of == Varied::Of::parameter)
            for_each_in_column<typename System::PatternP>(by_parameters_, n, varied_[c].number,
                                                          [&](std::size_t row, const Scalar& value) { result[row] = value; });
        return result;
    }

    const System& system_;
    const Inputs& inputs_;
    std::array<Varied, count> varied_;
    SystemDerivatives<System, Inputs> here_, on_the_way_;  ///< where Rodas5p has prepared, which may ask again; and at its stages
    State scale_;
    std::array<System, count> ahead_, behind_;
    std::array<Scalar, count> distance_{};
    typename System::JacobianX by_state_{};
    typename System::JacobianP by_parameters_{};
    std::array<typename System::JacobianX, count> below_{};
};

}  // namespace detail

/// Integrates a system and the derivatives of its state, from the start x with S = dx/d(varied) there, and calls observe(sample) at the
/// output points. S at the start comes from sensitivities_at_start(). `inputs` is called as inputs(x, t) and is not varied itself; where it
/// follows x, its slopes are differences.
///
/// A number that is in no table gives Status::bad_options. The scale of an entry of S is the scale of its state, divided by the size of
/// what is varied. With controls = false the steps follow the error of the state alone.
///
/// Systems that switch, or have constraints or guards, are not taken: S would jump there. The compiler says so. It cannot see one more
/// jump: where the rates jump at a time that a varied parameter moves, as step(t - t_0) does for t_0, S lacks its jump.
template <std::size_t count, class System, class Inputs, class Observer>
Outcome simulate_sensitivities(const System& system, const Inputs& inputs, const std::array<Varied, count>& varied,
                               typename System::State& x, Sensitivities<System, count>& S, typename System::scalar_type from,
                               typename System::scalar_type to, const IntegrationOptions<typename System::State>& options,
                               Observer&& observe, bool controls = true) {
    check_api<System>();
    static_assert(!detail::is_switching<System>, "systems that switch are not taken yet");
    static_assert(!detail::needs_projection<System>, "systems with constraints or attitudes are not taken yet");
    static_assert(!detail::may_have_entries<typename System::Guards>, "systems with guards are not taken yet");
    using Scalar = typename System::scalar_type;
    using Motion = detail::Variational<System, Inputs, count>;
    using State = typename Motion::State;
    const std::size_t n = detail::size_of<typename System::State>();
    for (const Varied& one : varied)
        if (one.number >= (one.of == Varied::Of::start ? n : System::parameter_table().size())) {
            Outcome refused;
            refused.status = Status::bad_options;
            refused.t = static_cast<double>(from);
            return refused;
        }
    IntegrationOptions<State> whole;
    whole.method = options.method;
    whole.tolerance = options.tolerance;
    whole.step = options.step;
    whole.is_fixed = options.is_fixed;
    whole.max_step = options.max_step;
    whole.kinks = options.kinks;
    whole.intervals = options.intervals;
    whole.max_steps = options.max_steps;
    const auto size = [&](const Varied& one) {
        return one.of == Varied::Of::start ? options.scale[one.number] : detail::size_of_parameter(system, one.number);
    };
    for (std::size_t i = 0; i < n; ++i) {
        whole.scale[i] = options.scale[i];
        for (std::size_t c = 0; c < count; ++c)
            whole.scale[(c + 1) * n + i] = controls ? options.scale[i] / size(varied[c]) : std::numeric_limits<Scalar>::max();
    }
    Motion motion(system, inputs, varied, whole.scale);
    State all;
    Motion::put(all, 0, x);
    for (std::size_t c = 0; c < count; ++c) Motion::put(all, c + 1, S[c]);
    const auto take = [&](const State& now) {
        x = Motion::part(now, 0);
        for (std::size_t c = 0; c < count; ++c) S[c] = Motion::part(now, c + 1);
    };
    const auto watch = [&](Scalar t, const State& now) {
        take(now);
        const auto u = inputs(x, t);
        observe(SensitivitySample<System, count>{t, x, u, S});
    };
    const auto rates = [&](const State& now, Scalar t, State& derivative) { motion.rates(now, t, derivative); };
    const Outcome outcome = integrate(rates, motion, all, from, to, whole, watch);
    take(all);
    return outcome;
}

/// dx/d(varied) of a start that parameters do not move, because it was set by hand.
template <class System, std::size_t count>
Sensitivities<System, count> sensitivities_at_fixed_start(const std::array<Varied, count>& varied) {
    Sensitivities<System, count> S;
    for (std::size_t c = 0; c < count; ++c) {
        S[c].fill(typename System::scalar_type(0));
        if (varied[c].of == Varied::Of::start && varied[c].number < S[c].size()) S[c][varied[c].number] = typename System::scalar_type(1);
    }
    return S;
}

/// dx/d(varied) of system.start_state(), which may follow from parameters: by these as differences of order four, good to about 1e-11.
template <class System, std::size_t count>
Sensitivities<System, count> sensitivities_at_start(const System& system, const std::array<Varied, count>& varied) {
    using Scalar = typename System::scalar_type;
    Sensitivities<System, count> S = sensitivities_at_fixed_start<System>(varied);
    for (std::size_t c = 0; c < count; ++c) {
        if (varied[c].of == Varied::Of::start || varied[c].number >= System::parameter_table().size()) continue;
        const Scalar step = detail::size_of_parameter(system, varied[c].number) / Scalar(1024);
        const auto start_at = [&](int steps) {
            System moved = system;
            detail::move_parameter(moved, varied[c].number, Scalar(steps) * step);
            return moved.start_state();
        };
        const auto before = start_at(-2), behind = start_at(-1), ahead = start_at(1), beyond = start_at(2);
        for (std::size_t i = 0; i < S[c].size(); ++i)
            S[c][i] = (Scalar(8) * (ahead[i] - behind[i]) - (beyond[i] - before[i])) / (Scalar(12) * step);
    }
    return S;
}

}  // namespace v1
}  // namespace dalembert
