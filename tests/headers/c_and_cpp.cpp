// SPDX-License-Identifier: GPL-3.0-or-later
// The C header of a plant computes the same as its C++ header, to the last bit, at random points and parameters. HEADER: that of C++;
// SPACE: its namespace; the other side is c_side.c. Prints the number of values that were compared, or the first that differs.
#include HEADER

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace plant = SPACE;
using System = plant::System<double>;

extern "C" {
void c_update(const double* values);
void c_start_state(double* x);
#define VECTOR(name) void c_##name(unsigned mode, const double* x, const double* u, double t, double* result);
#define VECTOR_OF_STATE(name) void c_##name(unsigned mode, const double* x, double t, double* result);
#define NUMBER(name) double c_##name(unsigned mode, const double* x, const double* u, double t);
#define NUMBER_OF_STATE(name) double c_##name(unsigned mode, const double* x, double t);
VECTOR(rhs)
VECTOR(jacobian_x)
VECTOR(jacobian_u)
VECTOR(jacobian_p)
VECTOR(jacobian_t)
VECTOR(bias)
VECTOR(generalised_force)
VECTOR(output)
VECTOR(output_jacobian_x)
VECTOR(output_jacobian_u)
VECTOR(guards)
VECTOR_OF_STATE(mass_matrix)
NUMBER(supplied_power)
NUMBER(dissipated_power)
NUMBER(prescribed_power)
NUMBER(exchanged_power)
NUMBER_OF_STATE(kinetic_energy)
NUMBER_OF_STATE(potential_energy)
NUMBER_OF_STATE(internal_energy)
VECTOR(guard_rates)
VECTOR(kinks)
bool c_holds(unsigned mode, const double* x, const double* u, double t);
void c_reset(std::size_t event, unsigned mode, double* x, const double* u, double t);
void c_settle(std::size_t event, unsigned mode, double* x, const double* u, double t);
VECTOR_OF_STATE(constraint_positions)
VECTOR_OF_STATE(constraint_rates)
VECTOR_OF_STATE(constraint_jacobian)
VECTOR(constraint_forces)
void c_correction(unsigned mode, const double* x, double t, const double* residual, double* step);
void c_move_back(double* x, const double* step);
void c_solve_for(const bool* chosen);
void c_series(unsigned mode, double* inputs, double t, std::size_t order, double* x, double* rows);
const char* c_text(std::size_t i);
double c_number(std::size_t i);
std::size_t c_pattern(int by, std::size_t i);
int c_transition(std::size_t event, unsigned mode, int list, std::size_t i);
}

namespace {

template <class S, class = void>
constexpr bool has_modes = false;
template <class S>
constexpr bool has_modes<S, std::void_t<typename S::Mode>> = true;
template <class S, class = void>
constexpr bool has_constraints = false;
template <class S>
constexpr bool has_constraints<S, std::void_t<typename S::Constraints>> = true;

std::size_t compared = 0, finite_ones = 0;

bool is_same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b); }

void compare(const char* function, unsigned mode, const double* a, const double* b, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        ++compared;
        if (std::isfinite(a[i])) ++finite_ones;
        if (is_same(a[i], b[i])) continue;
        std::printf("%s[%zu] in mode %u: %.17g in C++, %.17g in C\n", function, i, mode, a[i], b[i]);
        std::exit(1);
    }
}

std::mt19937_64 random_bits(1);
double between(double low, double high) { return low + (high - low) * std::uniform_real_distribution<double>()(random_bits); }

double value_of(const plant::Quantity& q, double about) {
    if (std::isfinite(q.low) && std::isfinite(q.high)) return between(q.low, q.high);
    const double size = std::abs(about) + 1;
    if (std::isfinite(q.low)) return q.low + between(0, size);
    if (std::isfinite(q.high)) return q.high - between(0, size);
    return about + between(-size, size);
}

/// As the series of a function with a constant value.
template <class S>
struct HeldInputs {
    typename S::Input value;
    static constexpr std::size_t series_rows = 0;
    auto series(const typename S::State&, double, typename S::Input& u, double*) const {
        u = value;
        return [](std::size_t) { return typename S::Input{}; };
    }
    template <class X>
    auto series(const X*, double, typename S::Input& u, double*) const {
        u = value;
        return [](std::size_t) { return typename S::Input{}; };
    }
};

template <class S>
void compare_all(const S& system, std::size_t points) {
    typename S::State start = system.start_state(), other_start{};
    c_start_state(other_start.data());
    compare("start_state", 0, start.data(), other_start.data(), start.size());
    unsigned modes = 1;
    if constexpr (has_modes<S>) modes = static_cast<unsigned>(S::mode_table().size());
    for (std::size_t n = 0; n < points; ++n) {
        const unsigned mode = static_cast<unsigned>(n % modes);
        typename S::State x{};
        typename S::Input u{};
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = value_of(S::state_table()[i], start[i]);
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = value_of(S::input_table()[i], 0.0);
        const double t = between(0, 10);
        // A member with the mode before its arguments, where the system has modes.
        const auto call = [&](auto member, auto&&... arguments) {
            if constexpr (has_modes<S>) return (system.*member)(static_cast<typename S::Mode>(mode), arguments...);
            else return (system.*member)(arguments...);
        };
#define CHECK_VECTOR(name, type)                               \
    {                                                          \
        typename S::type a{}, b{};                             \
        call(&S::name, x, u, t, a);                            \
        c_##name(mode, x.data(), u.data(), t, b.data());       \
        compare(#name, mode, a.data(), b.data(), a.size());    \
    }
#define CHECK_VECTOR_OF_STATE(name, type)                      \
    {                                                          \
        typename S::type a{}, b{};                             \
        call(&S::name, x, t, a);                               \
        c_##name(mode, x.data(), t, b.data());                 \
        compare(#name, mode, a.data(), b.data(), a.size());    \
    }
        CHECK_VECTOR(rhs, State)
        CHECK_VECTOR(jacobian_x, JacobianX)
        CHECK_VECTOR(jacobian_u, JacobianU)
        CHECK_VECTOR(jacobian_p, JacobianP)
        CHECK_VECTOR(jacobian_t, JacobianT)
        CHECK_VECTOR_OF_STATE(mass_matrix, MassMatrix)
        CHECK_VECTOR(bias, Generalised)
        CHECK_VECTOR(generalised_force, Generalised)
        CHECK_VECTOR(output, Output)
        CHECK_VECTOR(output_jacobian_x, OutputJacobianX)
        CHECK_VECTOR(output_jacobian_u, OutputJacobianU)
        const double a[]{call(&S::kinetic_energy, x, t),    call(&S::potential_energy, x, t),    call(&S::internal_energy, x, t),
                         call(&S::supplied_power, x, u, t), call(&S::dissipated_power, x, u, t), call(&S::prescribed_power, x, u, t),
                         call(&S::exchanged_power, x, u, t)};
        const double b[]{c_kinetic_energy(mode, x.data(), t),
                         c_potential_energy(mode, x.data(), t),
                         c_internal_energy(mode, x.data(), t),
                         c_supplied_power(mode, x.data(), u.data(), t),
                         c_dissipated_power(mode, x.data(), u.data(), t),
                         c_prescribed_power(mode, x.data(), u.data(), t),
                         c_exchanged_power(mode, x.data(), u.data(), t)};
        compare("energies and powers", mode, a, b, 7);
        if constexpr (has_modes<S>) {
            CHECK_VECTOR(guards, Events)
            CHECK_VECTOR(guard_rates, Events)
            CHECK_VECTOR(kinks, Kinks)
            const double here = call(&S::holds, x, u, t), there = c_holds(mode, x.data(), u.data(), t);
            compare("holds", mode, &here, &there, 1);
            for (std::size_t e = 0; e < S::event_table().size(); ++e) {
                typename S::State after = x, other = x;
                system.reset(e, static_cast<typename S::Mode>(mode), after, u, t);
                c_reset(e, mode, other.data(), u.data(), t);
                compare("reset", mode, after.data(), other.data(), x.size());
                after = other = x;
                system.settle(e, static_cast<typename S::Mode>(mode), after, u, t);
                c_settle(e, mode, other.data(), u.data(), t);
                compare("settle", mode, after.data(), other.data(), x.size());
            }
        } else {
            CHECK_VECTOR(guards, Guards)
        }
#ifdef SERIES
        constexpr std::size_t order = 7;
        using WithWork = std::array<double, std::tuple_size<typename S::State>::value + 1>;
        std::array<WithWork, order + 1> here{}, there{};
        std::copy(x.begin(), x.end(), here[0].begin());
        there = here;
        std::vector<double> rows(2 * S::series_rows * order + 1), other_rows(rows);
        call(&S::template series<WithWork, HeldInputs<S>>, HeldInputs<S>{u}, t, order, here.data(), rows.data());
        c_series(mode, u.data(), t, order, there[0].data(), other_rows.data());
        compare("series", mode, here[0].data(), there[0].data(), (order + 1) * std::tuple_size<WithWork>::value);
#endif
        if constexpr (has_constraints<S>) {
            CHECK_VECTOR_OF_STATE(constraint_positions, Constraints)
            CHECK_VECTOR_OF_STATE(constraint_rates, Constraints)
            CHECK_VECTOR_OF_STATE(constraint_jacobian, ConstraintJacobian)
            CHECK_VECTOR(constraint_forces, Constraints)
            typename S::Constraints residual{};
            for (double& r : residual) r = between(-1, 1);
            typename S::Generalised step{}, other_step{};
            call(&S::correction, x, t, residual, step);
            c_correction(mode, x.data(), t, residual.data(), other_step.data());
            compare("correction", mode, step.data(), other_step.data(), step.size());
            for (double& s : step) s = between(-0.1, 0.1);
            typename S::State moved = x, other = x;
            system.move_back(moved, step);
            c_move_back(other.data(), step.data());
            compare("move_back", mode, moved.data(), other.data(), x.size());
        }
    }
}

[[noreturn]] void differ(const char* what, std::size_t i) {
    std::printf("the tables differ: %s %zu\n", what, i);
    std::exit(1);
}

template <class Pattern>
void compare_pattern(const char* what, int by) {
    if constexpr (Pattern::is_sparse) {
        std::size_t next = 0;
        for (const std::size_t number : Pattern::column_starts)
            if (c_pattern(by, next++) != number) differ(what, next - 1);
        for (const std::size_t number : Pattern::row_indices)
            if (c_pattern(by, next++) != number) differ(what, next - 1);
    }
}

template <class S>
void compare_tables() {
    std::size_t texts = 0, numbers = 0;
    const auto text = [&](const char* here) {
        const char* const there = c_text(texts++);
        if (there == nullptr || std::string(here) != there) differ("text", texts - 1);
    };
    const auto table = [&](const auto& quantities) {
        for (const auto& q : quantities) {
            text(q.name), text(q.unit), text(q.description);
            if (c_number(numbers++) != q.low || c_number(numbers++) != q.high) differ("bound", numbers - 1);
        }
    };
    table(S::state_table());
    table(S::input_table());
    table(S::output_table());
    table(S::parameter_table());
    for (const auto& guard : S::guard_table()) text(guard.name), text(guard.doc);
    if constexpr (has_constraints<S>)
        for (const auto& c : S::constraint_table()) text(c.name), text(c.unit), text(c.description);
    if (c_text(texts) != nullptr) differ("text", texts);
    compare_pattern<typename S::PatternX>("place of df/dx", 0);
    compare_pattern<typename S::PatternU>("place of df/du", 1);
    compare_pattern<typename S::PatternP>("place of df/dp", 2);
    if constexpr (has_modes<S>)
        for (std::size_t e = 0; e < S::event_table().size(); ++e)
            for (unsigned m = 0; m < S::mode_table().size(); ++m) {
                const auto mode = static_cast<typename S::Mode>(m);
                if (S::is_watched(mode, e) != (c_transition(e, m, 0, 0) != -1)) differ("watch of event", e);
                const decltype(&S::next_modes(e, mode)) lists[]{&S::next_modes(e, mode), &S::modes_beside(e, mode),
                                                                &S::after_accumulation(e, mode)};
                for (int list = 0; list < 3 && S::is_watched(mode, e); ++list)
                    for (std::size_t i = 0; i <= lists[list]->count; ++i)
                        if (c_transition(e, m, list, i) != (i < lists[list]->count ? static_cast<int>(lists[list]->modes[i]) : -2))
                            differ("transition of event", e);
            }
}

}  // namespace

int main() {
    compare_tables<System>();
    for (int set = 0; set < 4; ++set) {
        std::vector<double> factors(plant::parameter_count + 1, 1.0);
        for (std::size_t i = 0; set > 0 && i < plant::parameter_count; ++i) factors[i] = between(0.9, 1.1);
        c_update(factors.data());
        plant::Parameters<double> parameters;
        static_assert(plant::parameter_count == 0 || sizeof parameters == plant::parameter_count * sizeof(double),
                      "parameters are numbers, one after the other");
        double* const all = reinterpret_cast<double*>(&parameters);
        for (std::size_t i = 0; i < plant::parameter_count; ++i) all[i] *= factors[i];
        compare_all(System(parameters), 250);
    }
    if (finite_ones * 2 < compared && compared > 0) std::printf("only %zu of %zu values are finite\n", finite_ones, compared);
    std::printf("%zu\n", compared);
    return compared == 0 ? 1 : 0;
}
