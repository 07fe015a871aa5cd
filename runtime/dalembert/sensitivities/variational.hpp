// SPDX-License-Identifier: BSL-1.0
// A state and its sensitivities as one motion: dS/dt = (df/dx + df/du du/dx) S + df/dp + df/du du/dp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "dalembert/input_slopes.hpp"
#include "dalembert/linear/jacobian_pattern.hpp"
#include "dalembert/sensitivities/jacobian_along.hpp"
#include "dalembert/sensitivities/sensitivity_matrix.hpp"
#include "dalembert/sensitivities/varied.hpp"
#include "dalembert/system_derivatives.hpp"
#include "dalembert/unroll.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// A system as it is, for Variational.
struct AsItIs {
    template <class System>
    const System& operator()(const System& system) const {
        return system;
    }
};

/// Times at which inputs have kinks or jumps rest, and those of rates are not known.
struct KinksRest {
    template <class Scalar>
    int operator()(std::size_t, const Scalar&) const {
        return 0;
    }
    template <class State, class Input, class Scalar>
    bool mirror(State&, const Input&, const Scalar&) const {
        return false;
    }
};

/// `view` shows a system, or one of its modes, as one without modes. sides(c, t) says which of the moved systems has the same inputs at t
/// but for their slope: 1 the one ahead, -1 the one behind, 0 both. A kink moves past t in the other one, and its jump is not for here.
/// sides.mirror(x, u, t) takes a state that is beyond a kink of the rates, as by roundings, as far to the side on which the motion is, and
/// says whether it did: Jacobians are those of that side, so that they do not jump within a step.
template <class System, class Inputs, class List, class View = AsItIs, class Sides = KinksRest>
class Variational {
    using Scalar = typename System::scalar_type;
    using Plain = typename System::State;
    using Shown = std::decay_t<decltype(std::declval<const View&>()(std::declval<const System&>()))>;
    using Held = decltype(std::declval<const View&>()(std::declval<const System&>()));
    template <class T>
    using ColumnsOf = typename Columns<List>::template Of<T>;

public:
    using State = typename Columns<List>::template State<Plain>;
    using DifferentiatedState = State;
    using Pattern = SensitivityPattern<Plain, typename Shown::PatternX>;

    template <class Scale>
    Variational(const System& system, const Inputs& inputs, const List& varied, const MovedSystems<System, List>& moved, const Scale& scale,
                const View& view = {}, const Sides& sides = {})
        : shown_(view(system)),
          inputs_(inputs),
          varied_(varied),
          moved_(moved),
          sides_(sides),
          here_(shown_, inputs, scale),
          on_the_way_(shown_, inputs, scale),
          along_(system, inputs, varied, moved, scale, view, sides),
          below_(Columns<List>::filled(varied, typename System::JacobianX{})) {}

    static Plain part(const State& all, std::size_t c) {
        Plain result;
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(c * size_of<Plain>()), size_of<Plain>(), result.begin());
        return result;
    }
    static void put(State& all, std::size_t c, const Plain& values) {
        std::copy_n(values.begin(), size_of<Plain>(), all.begin() + static_cast<std::ptrdiff_t>(c * size_of<Plain>()));
    }

    void rates(const State& all, Scalar t, State& derivative) {
        const Plain x = part(all, 0);
        const auto u = inputs_(x, t);
        Plain dxdt;
        shown_.rhs_and_jacobian(x, u, t, dxdt, by_state_);
        put(derivative, 0, dxdt);
        Plain there = x;
        if (sides_.mirror(there, u, t)) shown_.jacobian_x(there, u, t, by_state_);
        shown_.jacobian_p(there, u, t, by_parameters_);
        put_own_rates(derivative);
        add_products(all, derivative);
        if constexpr (may_have_entries<typename System::Input>) {
            if (are_of_time_alone(inputs_, 0)) return;
            if (slopes_.take(inputs_, x, t)) {
                add_slopes_of_inputs(all, x, u, t, derivative);
                return;
            }
            if (on_the_way_.have_feedback(x, u, t)) add_feedback(all, x, t, derivative);
            if constexpr (follow_parameters<Inputs, System>) add_parameters_of_inputs(x, u, t, derivative);
        }
    }

    // What Rodas5p asks for.

    void prepare(const State& all, Scalar t) {
        Plain x = part(all, 0);
        sides_.mirror(x, inputs_(x, t), t);
        here_.prepare(x, t);
        for (std::size_t c = 0; c < varied_.size(); ++c) along_.differentiate(c, x, part(all, c + 1), t, here_.by_state(), below_[c]);
    }

    template <class Add>
    void for_each_entry(Add add) const {
        const std::size_t n = size_of<Plain>();
        here_.for_each_entry([&](std::size_t row, std::size_t column, const Scalar& value) {
            for (std::size_t c = 0; c <= varied_.size(); ++c) add(c * n + row, c * n + column, value);
        });
        for (std::size_t c = 0; c < varied_.size(); ++c)
            for (std::size_t column = 0; column < n; ++column)
                for_each_in_column<typename System::PatternX>(
                    below_[c], n, column, [&](std::size_t row, const Scalar& value) { add((c + 1) * n + row, column, value); });
    }

    /// That of the rates of S is, as for inputs, of the polynomial of degree 4 through equal parts of the step.
    void time_derivative(const State& all, Scalar t, Scalar length, State& dfdt) {
        constexpr int weights[] = {48, -36, 16, -3};
        State now, later;
        dfdt.fill(Scalar(0));
        rates(all, t, now);
        for (int k = 1; k <= 4; ++k) {
            rates(all, t + length * (Scalar(k) / Scalar(4)), later);
            const auto of_columns = static_cast<std::ptrdiff_t>(size_of<Plain>());
            if (k == 1 && std::equal(now.begin() + of_columns, now.end(), later.begin() + of_columns)) break;  // no time in them
            for (std::size_t i = 0; i < dfdt.size(); ++i) dfdt[i] += Scalar(weights[k - 1]) * (later[i] - now[i]) / (Scalar(3) * length);
        }
        Plain of_state;
        here_.time_derivative(part(all, 0), t, length, of_state);
        put(dfdt, 0, of_state);
    }

private:
    /// Whether Jacobians store all of their entries, and columns are so short that sums over them stay in registers.
    static constexpr bool has_short_columns = [] {
        if constexpr (has_fixed_size<Plain>)
            return size_of<Plain>() <= 8 && !System::PatternX::is_sparse && !System::PatternP::is_sparse;
        else
            return false;
    }();

    /// Adds (df/dx) S to what put_own_rates has put, but for short columns, whose own rates begin their sums: vectors that are
    /// loaded right after their entries were stored one by one would wait.
    void add_products(const State& all, State& derivative) const {
        const std::size_t n = size_of<Plain>(), end = (varied_.size() + 1) * n;
        const Scalar* const S = all.data();
        Scalar* const rates = derivative.data();
        if constexpr (!has_fixed_size<Plain>) {
            for (std::size_t c = n; c < end; c += n)
                for (std::size_t row = 0; row < n; ++row) {
                    Scalar sum = rates[c + row];
                    for (std::size_t k = by_rows_.starts[row]; k < by_rows_.starts[row + 1]; ++k)
                        sum += by_state_[by_rows_.entries[k].place] * S[c + by_rows_.entries[k].column];
                    rates[c + row] = sum;
                }
        } else if constexpr (has_short_columns) {
            constexpr Known<size_of<Plain>()> entries{};
            const typename System::JacobianX J = by_state_;
            const Plain nothing{};
            for (std::size_t c = n; c < end; c += n) {
                const Scalar* const own = has_own_rates(c / n - 1) ? by_parameters_.data() + varied_[c / n - 1].number * n : nothing.data();
                each(entries, [&](auto row) {
                    Scalar sum = own[row];
                    each(entries, [&](auto column) {
                        if (may_be_nonzero<typename System::PatternX>(row, column)) sum += J[column * n + row] * S[c + column];
                    });
                    rates[c + row] = sum;
                });
            }
        } else {
            for (std::size_t column = 0; column < n; ++column)
                for_each_in_column<typename System::PatternX>(by_state_, n, column, [&](std::size_t row, const Scalar& value) {
                    for (std::size_t c = n; c < end; c += n) rates[c + row] += value * S[c + column];
                });
        }
    }

    /// What S gets by way of inputs whose slopes are known.
    void add_slopes_of_inputs(const State& all, const Plain& x, const typename System::Input& u, Scalar t, State& derivative) {
        if (slopes_.follow_nothing()) return;
        const std::size_t n = size_of<Plain>();
        shown_.jacobian_u(x, u, t, by_inputs_);
        for (std::size_t c = 0; c < varied_.size(); ++c)
            for (std::size_t j = 0; j < u.size(); ++j) {
                const Scalar slope = slopes_.along(varied_[c], j, u.size(), all.data() + (c + 1) * n, n);
                if (slope == Scalar(0)) continue;
                for_each_in_column<typename System::PatternU>(
                    by_inputs_, n, j, [&](std::size_t row, const Scalar& value) { derivative[(c + 1) * n + row] += value * slope; });
            }
    }

    /// What S gets by way of inputs that follow the state: the whole Jacobian without that of the system.
    void add_feedback(const State& all, const Plain& x, Scalar t, State& derivative) {
        const std::size_t n = size_of<Plain>();
        on_the_way_.prepare(x, t);
        on_the_way_.for_each_feedback([&](std::size_t row, std::size_t column, const Scalar& value) {
            for (std::size_t c = 1; c <= varied_.size(); ++c) derivative[c * n + row] += value * all[c * n + column];
        });
    }

    /// And by way of inputs that follow parameters.
    void add_parameters_of_inputs(const Plain& x, const typename System::Input& u, Scalar t, State& derivative) {
        const std::size_t n = size_of<Plain>();
        bool is_made = false;
        for (std::size_t c = 0; c < varied_.size(); ++c) {
            if (varied_[c].of == Varied::Of::start) continue;
            const int side = sides_(c, t);
            const auto ahead = side < 0 ? u : inputs_with(inputs_, moved_.ahead[c])(x, t),
                       behind = side > 0 ? u : inputs_with(inputs_, moved_.behind[c])(x, t);
            for (std::size_t j = 0; j < u.size(); ++j) {
                const Scalar slope = (ahead[j] - behind[j]) / (Scalar(side == 0 ? 2 : 1) * moved_.distance[c]);
                if (slope == Scalar(0)) continue;
                if (!is_made) shown_.jacobian_u(x, u, t, by_inputs_);
                is_made = true;
                for_each_in_column<typename System::PatternU>(
                    by_inputs_, n, j, [&](std::size_t row, const Scalar& value) { derivative[(c + 1) * n + row] += value * slope; });
            }
        }
    }

    /// The delay of an input is no parameter of the system.
    bool has_own_rates(std::size_t c) const {
        return varied_[c].of == Varied::Of::parameter && varied_[c].number < System::parameter_table().size();
    }

    /// df/d(varied) at fixed x and u.
    void put_own_rates(State& derivative) const {
        if constexpr (has_short_columns) return;
        const std::size_t n = size_of<Plain>();
        std::fill(derivative.begin() + static_cast<std::ptrdiff_t>(n), derivative.end(), Scalar(0));
        for (std::size_t c = 0; c < varied_.size(); ++c)
            if (has_own_rates(c))
                for_each_in_column<typename System::PatternP>(
                    by_parameters_, n, varied_[c].number,
                    [&](std::size_t row, const Scalar& value) { derivative[(c + 1) * n + row] = value; });
    }

    /// The pattern of the Jacobian row by row, of sizes that belong to a run.
    struct Rows {
        struct Entry {
            std::size_t place, column;
        };
        struct Places {
            std::size_t operator[](std::size_t place) const { return place; }
        };
        std::vector<std::size_t> starts;
        std::vector<Entry> entries;

        Rows() {
            if constexpr (!has_fixed_size<Plain>) {
                const std::size_t n = size_of<Plain>();
                std::vector<std::vector<Entry>> rows(n);
                for (std::size_t column = 0; column < n; ++column)
                    for_each_in_column<typename System::PatternX>(
                        Places{}, n, column, [&](std::size_t row, std::size_t place) { rows[row].push_back({place, column}); });
                starts.push_back(0);
                for (const auto& row : rows) {
                    entries.insert(entries.end(), row.begin(), row.end());
                    starts.push_back(entries.size());
                }
            }
        }
    };

    Held shown_;
    const Inputs& inputs_;
    const List& varied_;
    const MovedSystems<System, List>& moved_;
    Sides sides_;
    SystemDerivatives<Shown, Inputs> here_, on_the_way_;  ///< where Rodas5p has prepared, which may ask again; and at its stages
    InputSlopes<Inputs, Scalar> slopes_;
    typename System::JacobianX by_state_{};
    Rows by_rows_;
    typename System::JacobianP by_parameters_{};
    typename System::JacobianU by_inputs_{};
    JacobianAlong<System, Inputs, List, View, Sides> along_;
    ColumnsOf<typename System::JacobianX> below_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
