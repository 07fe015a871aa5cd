// SPDX-License-Identifier: GPL-3.0-or-later
// The C header of a plant computes the same as its C++ header, to the last bit, at random points and parameters. HEADER: that of C++; SPACE:
// its namespace; the other side is c_side.c. Prints the number of values that were compared, or the first that differs.
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
const char* c_texts(std::size_t i);
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

std::size_t compared = 0, finite = 0;

bool is_same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b); }

void compare(const char* function, unsigned mode, const double* a, const double* b, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        ++compared;
        if (std::isfinite(a[i])) ++finite;
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
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = value_of(S::state_table()[i], plant::start_values[i]);
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = value_of(S::input_table()[i], 0.0);
        const double t = between(0, 10);
        // A member with the mode before its arguments, where the system has modes.
        const auto call = [&](auto member, auto&... arguments) {
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
        const double a[]{call(&S::kinetic_energy, x, t),      call(&S::potential_energy, x, t),    call(&S::internal_energy, x, t),    call(&S::supplied_power, x, u, t),
                         call(&S::dissipated_power, x, u, t), call(&S::prescribed_power, x, u, t), call(&S::exchanged_power, x, u, t)};
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

void compare_texts() {
    std::size_t next = 0;
    const auto table = [&](const auto& quantities) {
        for (const plant::Quantity& q : quantities)
            for (const char* text : {q.name, q.unit, q.description}) {
                const char* const other = c_texts(next++);
                if (other != nullptr && std::string(text) == other) continue;
                std::printf("text %zu of the tables: \"%s\" in C++, \"%s\" in C\n", next, text, other == nullptr ? "nothing" : other);
                std::exit(1);
            }
    };
    table(plant::state_quantities);
    table(plant::input_quantities);
    table(plant::output_quantities);
    table(plant::parameter_quantities);
}

}  // namespace

int main() {
    compare_texts();
    for (int set = 0; set < 4; ++set) {
        std::vector<double> factors(plant::parameter_count + 1, 1.0);
        for (std::size_t i = 0; set > 0 && i < plant::parameter_count; ++i) factors[i] = between(0.9, 1.1);
        c_update(factors.data());
        plant::Parameters<double> parameters;
        static_assert(plant::parameter_count == 0 || sizeof parameters == plant::parameter_count * sizeof(double), "parameters are numbers, one after the other");
        double* const all = reinterpret_cast<double*>(&parameters);
        for (std::size_t i = 0; i < plant::parameter_count; ++i) all[i] *= factors[i];
        compare_all(System(parameters), 250);
    }
    if (finite * 2 < compared && compared > 0) std::printf("only %zu of %zu values are finite\n", finite, compared);
    std::printf("%zu\n", compared);
    return compared == 0 ? 1 : 0;
}
