// SPDX-License-Identifier: BSL-1.0
// A generated system as a plant, the export of a shared library; see plant.h. It includes little, and compiles in a fraction of a
// second.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

#include "dalembert/exported_quantities.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

// What a generated system has, or has not.
namespace plant_export {

template <class S, class = void>
struct ModeOf {
    using type = unsigned;
    static constexpr bool switches = false;
};
template <class S>
struct ModeOf<S, std::void_t<typename S::Mode>> {
    using type = typename S::Mode;
    static constexpr bool switches = true;
};
template <class S, class = void>
struct ConstraintsOf {
    using type = std::array<double, 0>;
    static constexpr bool is_projected = false;
};
template <class S>
struct ConstraintsOf<S, std::void_t<typename S::Constraints>> {
    using type = typename S::Constraints;
    static constexpr bool is_projected = true;
};
template <class S, class = void>
inline constexpr bool chooses = false;
template <class S>
inline constexpr bool chooses<S, std::void_t<decltype(S::constraint_rank)>> = true;
template <class S, class = void>
inline constexpr std::size_t series_rows = 0;
template <class S>
inline constexpr std::size_t series_rows<S, std::void_t<decltype(S::series_rows)>> = S::series_rows;
template <class S, class = void>
inline constexpr bool has_series = false;
template <class S>
inline constexpr bool has_series<S, std::void_t<decltype(S::series_rows)>> = true;
template <class S, class = void>
inline constexpr bool has_output_jacobian_p = false;
template <class S>
inline constexpr bool has_output_jacobian_p<S, std::void_t<typename S::OutputJacobianP>> = true;
template <class S, class = void>
inline constexpr bool has_output_jacobian_t = false;
template <class S>
inline constexpr bool has_output_jacobian_t<S, std::void_t<typename S::OutputJacobianT>> = true;
template <class S, class = void>
inline constexpr bool has_time_switches = false;
template <class S>
inline constexpr bool has_time_switches<S, std::void_t<typename S::TimeSwitches>> = true;
template <class S, class = void>
inline constexpr bool is_separable = false;
template <class S>
inline constexpr bool is_separable<S, std::void_t<decltype(S::is_separable)>> = S::is_separable;
template <class S, class = void>
inline constexpr bool has_conditions = false;
template <class S>
inline constexpr bool has_conditions<S, std::void_t<decltype(&S::holds)>> = true;
template <class S, class = void>
inline constexpr bool has_events_at_once = false;
template <class S>
inline constexpr bool has_events_at_once<S, std::void_t<decltype(S::happens_at_once(std::size_t()))>> = true;
template <class R, class = void>
inline constexpr bool knows_input_slopes = false;
template <class R>
inline constexpr bool knows_input_slopes<R, std::void_t<decltype(&R::input_slopes)>> = true;
template <class P, class = void>
inline constexpr bool says_nonzero = false;
template <class P>
inline constexpr bool says_nonzero<P, std::void_t<decltype(P::nonzero)>> = true;

}  // namespace plant_export

/// `Run` describes the library: name, scene and title of the system, set_parameters(parameters, numbers), and inputs(system),
/// a function of (x, t) with or without series.
template <class System, class Run>
class PlantTable {
    using State = typename System::State;
    using Input = typename System::Input;
    using Mode = typename plant_export::ModeOf<System>::type;
    using Constraints = typename plant_export::ConstraintsOf<System>::type;
    using Inputs = decltype(Run::inputs(std::declval<const System&>()));
    static constexpr bool switches = plant_export::ModeOf<System>::switches,
                          is_projected = plant_export::ConstraintsOf<System>::is_projected;
    static constexpr std::size_t n = std::tuple_size<State>::value, constraint_count = std::tuple_size<Constraints>::value;

    static const System& of(const void* self) { return *static_cast<const System*>(self); }
    /// Numbers as an array of a header: both are the same bytes.
    template <class Array>
    static const Array& as(const double* numbers) {
        return *reinterpret_cast<const Array*>(numbers);
    }
    template <class Array>
    static Array& as(double* numbers) {
        return *reinterpret_cast<Array*>(numbers);
    }
    /// Calls with the mode, where the system has some.
    template <class Call>
    static decltype(auto) in_mode([[maybe_unused]] unsigned mode, Call call) {
        if constexpr (switches) return call(static_cast<Mode>(mode));
        else return call();
    }

    /// Which entries of a matrix are stored: where the header stores all, those that may be other than zero.
    template <class Pattern>
    struct Compressed {
        static constexpr bool is_full = !Pattern::is_sparse && !plant_export::says_nonzero<Pattern>;
        static constexpr bool is_masked = !Pattern::is_sparse && plant_export::says_nonzero<Pattern>;
        std::array<std::size_t, n + 1> starts{};
        std::array<std::size_t, is_masked ? n * n : 1> rows{};
        constexpr Compressed() {
            if constexpr (is_masked) {
                std::size_t next = 0;
                for (std::size_t column = 0; column < n; ++column) {
                    for (std::size_t row = 0; row < n; ++row)
                        if ((Pattern::nonzero[column] >> row & 1U) != 0) rows[next++] = row;
                    starts[column + 1] = next;
                }
            }
        }
    };
    template <class Pattern>
    static dalembert_pattern pattern() {
        if constexpr (Pattern::is_sparse) {
            return {Pattern::column_starts.data(), Pattern::row_indices.data()};
        } else if constexpr (Compressed<Pattern>::is_masked) {
            static constexpr Compressed<Pattern> compressed;
            return {compressed.starts.data(), compressed.rows.data()};
        } else {
            return {nullptr, nullptr};
        }
    }

    static void* create() { return new (std::nothrow) System(); }
    static void destroy(void* self) { delete static_cast<System*>(self); }
    static void set_parameters(void* self, const double* numbers) {
        auto parameters = of(self).parameters();
        Run::set_parameters(parameters, numbers);
        static_cast<System*>(self)->update(parameters);
    }
    static void start_state(const void* self, double* x) { as<State>(x) = of(self).start_state(); }

    static void rhs(const void* self, unsigned mode, const double* x, const double* u, double t, double* dxdt) {
        in_mode(mode, [&](auto... m) { of(self).rhs(m..., as<State>(x), as<Input>(u), t, as<State>(dxdt)); });
    }
    static void rates_and_power(const void* self, unsigned mode, const double* x, const double* u, double t, double* rates) {
        if constexpr (Run::has_inputs) {
            if (u == nullptr) {
                const Input of_run = Run::inputs(of(self))(as<State>(x), t);
                return rates_and_power(self, mode, x, of_run.data(), t, rates);
            }
        }
        rhs(self, mode, x, u, t, rates);
        rates[n] = supplied_power(self, mode, x, u, t) - dissipated_power(self, mode, x, u, t) + prescribed_power(self, mode, x, u, t) +
                   exchanged_power(self, mode, x, u, t);
    }
    static void rhs_and_jacobian(const void* self, unsigned mode, const double* x, const double* u, double t, double* dxdt, double* J) {
        using Stored = Compressed<typename System::PatternX>;
        if constexpr (Stored::is_masked) {
            typename System::JacobianX all{};
            in_mode(mode, [&](auto... m) { of(self).rhs_and_jacobian(m..., as<State>(x), as<Input>(u), t, as<State>(dxdt), all); });
            for (std::size_t column = 0; column < n; ++column)
                for (std::size_t row = 0; row < n; ++row)
                    if ((System::PatternX::nonzero[column] >> row & 1U) != 0) *J++ = all[column * n + row];
        } else {
            in_mode(mode, [&](auto... m) {
                of(self).rhs_and_jacobian(m..., as<State>(x), as<Input>(u), t, as<State>(dxdt), as<typename System::JacobianX>(J));
            });
        }
    }
    static void jacobian_u(const void* self, unsigned mode, const double* x, const double* u, double t, double* J) {
        in_mode(mode, [&](auto... m) { of(self).jacobian_u(m..., as<State>(x), as<Input>(u), t, as<typename System::JacobianU>(J)); });
    }
    static void jacobian_p(const void* self, unsigned mode, const double* x, const double* u, double t, double* J) {
        in_mode(mode, [&](auto... m) { of(self).jacobian_p(m..., as<State>(x), as<Input>(u), t, as<typename System::JacobianP>(J)); });
    }
    static void jacobian_t(const void* self, unsigned mode, const double* x, const double* u, double t, double* dfdt) {
        in_mode(mode, [&](auto... m) { of(self).jacobian_t(m..., as<State>(x), as<Input>(u), t, as<typename System::JacobianT>(dfdt)); });
    }
    static void output(const void* self, unsigned mode, const double* x, const double* u, double t, double* y) {
        in_mode(mode, [&](auto... m) { of(self).output(m..., as<State>(x), as<Input>(u), t, as<typename System::Output>(y)); });
    }
    static void output_jacobian_x(const void* self, unsigned mode, const double* x, const double* u, double t, double* C) {
        in_mode(mode, [&](auto... m) {
            of(self).output_jacobian_x(m..., as<State>(x), as<Input>(u), t, as<typename System::OutputJacobianX>(C));
        });
    }
    static void output_jacobian_u(const void* self, unsigned mode, const double* x, const double* u, double t, double* D) {
        in_mode(mode, [&](auto... m) {
            of(self).output_jacobian_u(m..., as<State>(x), as<Input>(u), t, as<typename System::OutputJacobianU>(D));
        });
    }
    // Of headers that have them.
    template <class S = System>
    static void output_jacobian_p(const void* self, unsigned mode, const double* x, const double* u, double t, double* C) {
        in_mode(mode, [&](auto... m) {
            of(self).output_jacobian_p(m..., as<State>(x), as<Input>(u), t, as<typename S::OutputJacobianP>(C));
        });
    }
    template <class S = System>
    static void output_jacobian_t(const void* self, unsigned mode, const double* x, const double* u, double t, double* dydt) {
        in_mode(mode, [&](auto... m) {
            of(self).output_jacobian_t(m..., as<State>(x), as<Input>(u), t, as<typename S::OutputJacobianT>(dydt));
        });
    }
    template <class S = System>
    static void time_switch_values(const void* self, unsigned mode, const double* x, const double* u, double t, double* s) {
        in_mode(mode, [&](auto... m) { of(self).time_switches(m..., as<State>(x), as<Input>(u), t, as<typename S::TimeSwitches>(s)); });
    }
    static void mass_matrix(const void* self, unsigned mode, const double* x, double t, double* M) {
        in_mode(mode, [&](auto... m) { of(self).mass_matrix(m..., as<State>(x), t, as<typename System::MassMatrix>(M)); });
    }
    static double kinetic_energy(const void* self, unsigned mode, const double* x, double t) {
        return in_mode(mode, [&](auto... m) { return of(self).kinetic_energy(m..., as<State>(x), t); });
    }
    static double potential_energy(const void* self, unsigned mode, const double* x, double t) {
        return in_mode(mode, [&](auto... m) { return of(self).potential_energy(m..., as<State>(x), t); });
    }
    static double internal_energy(const void* self, unsigned mode, const double* x, double t) {
        return in_mode(mode, [&](auto... m) { return of(self).internal_energy(m..., as<State>(x), t); });
    }
    static double supplied_power(const void* self, unsigned mode, const double* x, const double* u, double t) {
        return in_mode(mode, [&](auto... m) { return of(self).supplied_power(m..., as<State>(x), as<Input>(u), t); });
    }
    static double dissipated_power(const void* self, unsigned mode, const double* x, const double* u, double t) {
        return in_mode(mode, [&](auto... m) { return of(self).dissipated_power(m..., as<State>(x), as<Input>(u), t); });
    }
    static double prescribed_power(const void* self, unsigned mode, const double* x, const double* u, double t) {
        return in_mode(mode, [&](auto... m) { return of(self).prescribed_power(m..., as<State>(x), as<Input>(u), t); });
    }
    static double exchanged_power(const void* self, unsigned mode, const double* x, const double* u, double t) {
        return in_mode(mode, [&](auto... m) { return of(self).exchanged_power(m..., as<State>(x), as<Input>(u), t); });
    }

    static void guard_values(const void* self, unsigned mode, const double* x, const double* u, double t, double* g) {
        if constexpr (switches) of(self).guards(static_cast<Mode>(mode), as<State>(x), as<Input>(u), t, as<typename System::Events>(g));
        else of(self).guards(as<State>(x), as<Input>(u), t, as<typename System::Guards>(g));
    }

    static void fill_modes(dalembert_plant& table) {
        table.modes = System::mode_table().size();
        table.events = System::event_table().size();
        table.kinks = std::tuple_size<typename System::Kinks>::value;
        table.guards = 0;
        table.mode_names = System::mode_table().data();
        table.event_names = System::event_table().data();
        using Modes = std::decay_t<decltype(System::next_modes(0, Mode{}))>;
        table.most_transitions = std::tuple_size<decltype(Modes::modes)>::value;
        table.guard_rates = [](const void* self, unsigned mode, const double* x, const double* u, double t, double* rates) {
            of(self).guard_rates(static_cast<Mode>(mode), as<State>(x), as<Input>(u), t, as<typename System::Events>(rates));
        };
        table.kink_values = [](const void* self, unsigned mode, const double* x, const double* u, double t, double* k) {
            of(self).kinks(static_cast<Mode>(mode), as<State>(x), as<Input>(u), t, as<typename System::Kinks>(k));
        };
        if constexpr (plant_export::has_conditions<System>)
            table.holds = [](const void* self, unsigned mode, const double* x, const double* u, double t) -> int {
                return of(self).holds(static_cast<Mode>(mode), as<State>(x), as<Input>(u), t);
            };
        table.is_watched = [](unsigned mode, std::size_t event) -> int { return System::is_watched(static_cast<Mode>(mode), event); };
        if constexpr (plant_export::has_events_at_once<System>) {
            table.happens_at_once = [](std::size_t event) -> int { return System::happens_at_once(event); };
            table.happens_at_start = [](std::size_t event) -> int { return System::happens_at_start(event); };
        }
        table.reset = [](const void* self, std::size_t event, unsigned mode, double* x, const double* u, double t) {
            of(self).reset(event, static_cast<Mode>(mode), as<State>(x), as<Input>(u), t);
        };
        table.settle = [](const void* self, std::size_t event, unsigned mode, double* x, const double* u, double t) {
            of(self).settle(event, static_cast<Mode>(mode), as<State>(x), as<Input>(u), t);
        };
        table.transitions = [](std::size_t event, unsigned mode, dalembert_transition kind, unsigned* modes) -> std::size_t {
            const Mode from = static_cast<Mode>(mode);
            const auto& to = kind == dalembert_next     ? System::next_modes(event, from)
                             : kind == dalembert_beside ? System::modes_beside(event, from)
                                                        : System::after_accumulation(event, from);
            for (const Mode each : to) *modes++ = static_cast<unsigned>(each);
            return to.count;
        };
    }

    static void fill_constraints(dalembert_plant& table) {
        table.is_projected = 1;
        table.velocity_place = System::velocity_place;
        table.move_back = [](const void* self, double* x, const double* step) {
            of(self).move_back(as<State>(x), as<typename System::Generalised>(step));
        };
        if constexpr (constraint_count > 0) {
            static std::array<dalembert_constraint, constraint_count> list;
            for (std::size_t i = 0; i < constraint_count; ++i) {
                const auto& c = System::constraint_table()[i];
                list[i] = {c.name, c.unit, c.description, c.has_position, 0, 1};
                if constexpr (plant_export::chooses<System>) {
                    list[i].can_be_left_out = System::can_be_left_out[i];
                    list[i].solved_for_at_start = System::solved_for_at_start[i];
                }
            }
            table.constraints = constraint_count;
            table.constraint_table = list.data();
            table.constraint_positions = [](const void* self, unsigned mode, const double* x, double t, double* f) {
                in_mode(mode, [&](auto... m) { of(self).constraint_positions(m..., as<State>(x), t, as<Constraints>(f)); });
            };
            table.constraint_rates = [](const void* self, unsigned mode, const double* x, double t, double* w) {
                in_mode(mode, [&](auto... m) { of(self).constraint_rates(m..., as<State>(x), t, as<Constraints>(w)); });
            };
            table.constraint_jacobian = [](const void* self, unsigned mode, const double* x, double t, double* A) {
                in_mode(mode, [&](auto... m) {
                    of(self).constraint_jacobian(m..., as<State>(x), t, as<typename System::ConstraintJacobian>(A));
                });
            };
            table.correction = [](const void* self, unsigned mode, const double* x, double t, const double* residual, double* step) {
                in_mode(mode, [&](auto... m) {
                    of(self).correction(m..., as<State>(x), t, as<Constraints>(residual), as<typename System::Generalised>(step));
                });
            };
        }
        if constexpr (plant_export::chooses<System>) {
            table.constraint_rank = System::constraint_rank;
            table.solve_for = [](void* self, const int* chosen) {
                std::array<bool, constraint_count> flags{};
                for (std::size_t i = 0; i < constraint_count; ++i) flags[i] = chosen[i] != 0;
                static_cast<System*>(self)->solve_for(flags);
            };
        }
    }

    static void fill_run(dalembert_plant& table) {
        if constexpr (Run::has_inputs)
            table.inputs_of_run = [](const void* self, const double* x, double t, double* u) {
                as<Input>(u) = Run::inputs(of(self))(as<State>(x), t);
            };
        if constexpr (plant_export::knows_input_slopes<Run>)
            table.input_slopes = [](const void* self, const double* x, double t, double* columns) {
                Run::input_slopes(of(self).parameters(), as<State>(x), t, columns);
            };
        if constexpr (plant_export::has_series<System> && (std::tuple_size<Input>::value == 0 || plant_export::has_series<Inputs>)) {
            table.series_rows = System::series_rows + plant_export::series_rows<Inputs>;
            table.series = [](const void* self, unsigned mode, double t, std::size_t order, double* x, double* rows) {
                using StateAndWork = std::array<double, n + 1>;
                auto inputs = Run::inputs(of(self));
                in_mode(mode, [&](auto... m) { of(self).series(m..., inputs, t, order, reinterpret_cast<StateAndWork*>(x), rows); });
            };
        }
    }

public:
    static dalembert_plant make() {
        dalembert_plant table{};
        table.version = DALEMBERT_PLANT_VERSION;
        table.size = sizeof(table);
        table.name = Run::name();
        table.scene = Run::scene();
        table.title = Run::title();
        table.states = n;
        table.inputs = std::tuple_size<Input>::value;
        table.outputs = std::tuple_size<typename System::Output>::value;
        table.parameters = System::parameter_table().size();
        table.degrees = table.velocity_place = System::degrees;
        table.guards = System::guard_table().size();
        table.state_table = exported_quantities<PlantTable, 0>(System::state_table());
        table.input_table = exported_quantities<PlantTable, 1>(System::input_table());
        table.output_table = exported_quantities<PlantTable, 2>(System::output_table());
        table.parameter_table = exported_quantities<PlantTable, 3>(System::parameter_table());
        static std::array<dalembert_guard, std::tuple_size<typename System::Guards>::value + 1> guards;
        for (std::size_t i = 0; i < table.guards; ++i) {
            const auto& g = System::guard_table()[i];
            guards[i] = {g.name, g.doc, g.ends};
        }
        table.guard_table = guards.data();
        static const State start = System().start_state();
        table.start_values = start.data();
        static std::array<double, std::tuple_size<std::decay_t<decltype(System::parameter_table())>>::value + 1> defaults;
        Run::get_parameters(System().parameters(), defaults.data());
        table.parameter_defaults = defaults.data();
        table.is_separable = plant_export::is_separable<System>;
        table.pattern_x = pattern<typename System::PatternX>();
        table.pattern_u = pattern<typename System::PatternU>();
        table.pattern_p = pattern<typename System::PatternP>();
        table.create = create;
        table.destroy = destroy;
        table.set_parameters = set_parameters;
        table.start_state = start_state;
        table.rhs = rhs;
        table.rhs_and_jacobian = rhs_and_jacobian;
        table.jacobian_u = jacobian_u;
        table.jacobian_p = jacobian_p;
        table.jacobian_t = jacobian_t;
        table.output = output;
        table.output_jacobian_x = output_jacobian_x;
        table.output_jacobian_u = output_jacobian_u;
        if constexpr (plant_export::has_output_jacobian_p<System>) table.output_jacobian_p = output_jacobian_p<System>;
        if constexpr (plant_export::has_output_jacobian_t<System>) table.output_jacobian_t = output_jacobian_t<System>;
        table.mass_matrix = mass_matrix;
        table.kinetic_energy = kinetic_energy;
        table.potential_energy = potential_energy;
        table.internal_energy = internal_energy;
        table.supplied_power = supplied_power;
        table.dissipated_power = dissipated_power;
        table.prescribed_power = prescribed_power;
        table.exchanged_power = exchanged_power;
        table.rates_and_power = rates_and_power;
        table.guard_values = guard_values;
        if constexpr (plant_export::has_time_switches<System>) {
            table.time_switches = std::tuple_size<typename System::TimeSwitches>::value / 2;
            table.time_switch_values = time_switch_values<System>;
        }
        if constexpr (switches) fill_modes(table);
        if constexpr (is_projected) fill_constraints(table);
        fill_run(table);
        return table;
    }
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert

/// Defines the exported function of a plant.
#define DALEMBERT_EXPORT_PLANT(System, Run)                                                           \
    extern "C" const dalembert_plant* dalembert_plant_table(void) {                                   \
        static const dalembert_plant table = dalembert::detail::PlantTable<System, Run>::make();      \
        return &table;                                                                                \
    }
