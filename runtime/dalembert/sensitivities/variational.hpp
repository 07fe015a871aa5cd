// SPDX-License-Identifier: BSL-1.0
// A state and its sensitivities as one motion: dS/dt = (df/dx + df/du du/dx) S + df/dp + df/du du/dp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "dalembert/input_slopes.hpp"
#include "dalembert/linear/jacobian_pattern.hpp"
#include "dalembert/run_array.hpp"
#include "dalembert/sensitivities/varied.hpp"
#include "dalembert/system_derivatives.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Blocks of the size of Plain: those on the diagonal are alike and have the pattern Base, those in the first column may be full, others
/// are zero.
template <class Plain, class Base>
struct SensitivityPattern {
    static constexpr bool is_sparse = false;
};

template <class All, class Plain, class Base>
class SensitivityMatrix {
    using Scalar = typename Plain::value_type;

public:
    SensitivityMatrix() {
        if constexpr (!has_fixed_size<All>) below_.resize((size_of<All>() - size_of<Plain>()) * size_of<Plain>());
    }
    void clear() {
        diagonal_.clear();
        std::fill(below_.begin(), below_.end(), Scalar(0));
    }
    void add(std::size_t row, std::size_t column, const Scalar& value) {
        const std::size_t n = size_of<Plain>();
        if (row < n)
            diagonal_.add(row, column, value);
        else if (column < n)
            below_[column * (size_of<All>() - n) + row - n] += value;
    }
    bool factor() { return diagonal_.factor(); }
    void solve(All& b) const {
        const std::size_t n = size_of<Plain>(), all = size_of<All>();
        Plain part;
        const auto solve_part = [&](std::size_t c) {
            std::copy_n(b.begin() + static_cast<std::ptrdiff_t>(c * n), n, part.begin());
            diagonal_.solve(part);
            std::copy_n(part.begin(), n, b.begin() + static_cast<std::ptrdiff_t>(c * n));
        };
        solve_part(0);
        for (std::size_t column = 0; column < n; ++column)
            for (std::size_t i = 0; i < all - n; ++i) b[n + i] -= below_[column * (all - n) + i] * part[column];
        for (std::size_t c = 1; c * n < all; ++c) solve_part(c);
    }

private:
    template <class Array>
    struct Below {
        using type = std::vector<Scalar>;
    };
    template <std::size_t all>
    struct Below<std::array<Scalar, all>> {
        using type = std::array<Scalar, (all - size_of<Plain>()) * size_of<Plain>()>;
    };
    typename MatrixOf<Plain, Base>::type diagonal_;
    typename Below<All>::type below_{};
};

template <class All, class Plain, class Base>
struct SensitivityMatrixOf {
    using type = SensitivityMatrix<All, Plain, Base>;
    static constexpr bool fits() {
        return MatrixOf<Plain, Base>::fits() && size_of<All>() * size_of<Plain>() * sizeof(typename Plain::value_type) <= std::size_t(1)
                                                                                                                              << 20;
    }
    static constexpr double multiplications(double solutions) {
        const std::size_t n = size_of<Plain>(), all = size_of<All>();
        return MatrixOf<Plain, Base>::multiplications(solutions * static_cast<double>(all / n)) +
               solutions * static_cast<double>((all - n) * n);
    }
};
template <class Scalar, std::size_t all, class Plain, class Base>
struct MatrixOf<std::array<Scalar, all>, SensitivityPattern<Plain, Base>> : SensitivityMatrixOf<std::array<Scalar, all>, Plain, Base> {};
template <class Size, class Scalar, class Plain, class Base>
struct MatrixOf<RunArray<Size, Scalar>, SensitivityPattern<Plain, Base>> : SensitivityMatrixOf<RunArray<Size, Scalar>, Plain, Base> {};

/// A system as it is, for Variational.
struct AsItIs {
    template <class System>
    const System& operator()(const System& system) const {
        return system;
    }
};

/// Times at which inputs have kinks or jumps rest.
struct KinksRest {
    template <class Scalar>
    int operator()(std::size_t, const Scalar&) const {
        return 0;
    }
};

/// `view` shows a system, or one of its modes, as one without modes. sides(c, t) says which of the moved systems has the same inputs at t
/// but for their slope: 1 the one ahead, -1 the one behind, 0 both. A kink moves past t in the other one, and its jump is not for here.
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
        : shown_system_(system),
          shown_(view(system)),
          inputs_(inputs),
          varied_(varied),
          moved_(moved),
          view_(view),
          sides_(sides),
          here_(shown_, inputs, scale),
          on_the_way_(shown_, inputs, scale),
          below_(Columns<List>::filled(varied, typename System::JacobianX{})) {
        std::copy_n(scale.begin(), scale_.size(), scale_.begin());
    }

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
        shown_.jacobian_p(x, u, t, by_parameters_);
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
        const Plain x = part(all, 0);
        here_.prepare(x, t);
        for (std::size_t c = 0; c < varied_.size(); ++c) {
            // Along a column of S, and the parameter with it.
            const Plain s = part(all, c + 1);
            Scalar step = moved_.distance[c];
            if (varied_[c].of == Varied::Of::start) {
                const Scalar longest = largest_part<System>(s, x, scale_);
                step = longest > Scalar(0) ? step_of_differences<Scalar>() / longest : Scalar(0);
            }
            below_[c].fill(Scalar(0));
            if (step == Scalar(0)) continue;
            typename System::JacobianX ahead{}, behind{};
            const auto at = [&](const System& system, Scalar length, typename System::JacobianX& J) {
                Plain there = x;
                for (std::size_t i = 0; i < s.size(); ++i) there[i] += length * s[i];
                view_(system).jacobian_x(there, inputs_with(inputs_, system)(there, t), t, J);
            };
            const int side = sides_(c, t);
            if (side < 0)
                at(shown_system_, Scalar(0), ahead);
            else
                at(moved_.ahead[c], step, ahead);
            if (side > 0)
                at(shown_system_, Scalar(0), behind);
            else
                at(moved_.behind[c], -step, behind);
            for (std::size_t k = 0; k < ahead.size(); ++k) below_[c][k] = (ahead[k] - behind[k]) / (Scalar(side == 0 ? 2 : 1) * step);
        }
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
    /// Of short columns the whole Jacobian, of others row by row: sums stay in registers.
    void add_products(const State& all, State& derivative) const {
        constexpr std::size_t short_column = 8;
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
        } else if constexpr (size_of<Plain>() <= short_column) {
            std::array<Plain, size_of<Plain>()> J{};
            for (std::size_t column = 0; column < n; ++column)
                for_each_in_column<typename System::PatternX>(by_state_, n, column,
                                                              [&](std::size_t row, const Scalar& value) { J[column][row] = value; });
            for (std::size_t c = n; c < end; c += n) {
                Plain sum;
                std::copy_n(rates + c, n, sum.begin());
                for (std::size_t column = 0; column < n; ++column)
                    for (std::size_t i = 0; i < n; ++i) sum[i] += J[column][i] * S[c + column];
                std::copy_n(sum.begin(), n, rates + c);
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

    /// df/d(varied) at fixed x and u.
    void put_own_rates(State& derivative) const {
        const std::size_t n = size_of<Plain>();
        std::fill(derivative.begin() + static_cast<std::ptrdiff_t>(n), derivative.end(), Scalar(0));
        for (std::size_t c = 0; c < varied_.size(); ++c)
            // The delay of an input has no column of its own.
            if (varied_[c].of == Varied::Of::parameter && varied_[c].number < System::parameter_table().size())
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

    const System& shown_system_;
    Held shown_;
    const Inputs& inputs_;
    const List& varied_;
    const MovedSystems<System, List>& moved_;
    View view_;
    Sides sides_;
    SystemDerivatives<Shown, Inputs> here_, on_the_way_;  ///< where Rodas5p has prepared, which may ask again; and at its stages
    InputSlopes<Inputs, Scalar> slopes_;
    Plain scale_;
    typename System::JacobianX by_state_{};
    Rows by_rows_;
    typename System::JacobianP by_parameters_{};
    typename System::JacobianU by_inputs_{};
    ColumnsOf<typename System::JacobianX> below_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
