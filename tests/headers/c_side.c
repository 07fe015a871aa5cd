/* SPDX-License-Identifier: GPL-3.0-or-later
   The C header of a plant behind functions with names that do not depend on it. HEADER: the file; NAME: its prefix; MODES, CONSTRAINTS,
   CHOICE: it has these. */
#include HEADER

#define PASTE_(a, b) a##_##b
#define PASTE(a, b) PASTE_(a, b)
#define N(x) PASTE(NAME, x)
static NAME plant;

void c_update(const double* values);
void c_update(const double* values) {
    N(parameters) p = N(default_parameters)();
    double* const all = (double*)&p;
    for (size_t i = 0; i < N(parameter_count); ++i) all[i] *= values[i];
    N(update)(&plant, &p);
}

void c_start_state(double* x);
void c_start_state(double* x) { N(start_state)(&plant, x); }

#ifdef MODES
#define WITH_MODE(...) (&plant, (N(mode))mode, __VA_ARGS__)
#else
#define WITH_MODE(...) (&plant, __VA_ARGS__)
#endif

#define VECTOR(name)                                                                                \
    void c_##name(unsigned mode, const double* x, const double* u, double t, double* result);      \
    void c_##name(unsigned mode, const double* x, const double* u, double t, double* result) {     \
        (void)mode;                                                                                 \
        N(name) WITH_MODE(x, u, t, result);                                                         \
    }
#define VECTOR_OF_STATE(name)                                                                       \
    void c_##name(unsigned mode, const double* x, double t, double* result);                       \
    void c_##name(unsigned mode, const double* x, double t, double* result) {                      \
        (void)mode;                                                                                 \
        N(name) WITH_MODE(x, t, result);                                                            \
    }
#define NUMBER(name)                                                                                \
    double c_##name(unsigned mode, const double* x, const double* u, double t);                    \
    double c_##name(unsigned mode, const double* x, const double* u, double t) {                   \
        (void)mode;                                                                                 \
        return N(name) WITH_MODE(x, u, t);                                                          \
    }
#define NUMBER_OF_STATE(name)                                                                       \
    double c_##name(unsigned mode, const double* x, double t);                                     \
    double c_##name(unsigned mode, const double* x, double t) {                                    \
        (void)mode;                                                                                 \
        return N(name) WITH_MODE(x, t);                                                             \
    }

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

#ifdef MODES
VECTOR(guard_rates)
VECTOR(kinks)
bool c_holds(unsigned mode, const double* x, const double* u, double t);
bool c_holds(unsigned mode, const double* x, const double* u, double t) { return N(holds)(&plant, (N(mode))mode, x, u, t); }
void c_reset(size_t event, unsigned mode, double* x, const double* u, double t);
void c_reset(size_t event, unsigned mode, double* x, const double* u, double t) { N(reset)(&plant, event, (N(mode))mode, x, u, t); }
void c_settle(size_t event, unsigned mode, double* x, const double* u, double t);
void c_settle(size_t event, unsigned mode, double* x, const double* u, double t) { N(settle)(&plant, event, (N(mode))mode, x, u, t); }
#endif

#ifdef CONSTRAINTS
VECTOR_OF_STATE(constraint_positions)
VECTOR_OF_STATE(constraint_rates)
VECTOR_OF_STATE(constraint_jacobian)
VECTOR(constraint_forces)
void c_correction(unsigned mode, const double* x, double t, const double* residual, double* step);
void c_correction(unsigned mode, const double* x, double t, const double* residual, double* step) {
    (void)mode;
    N(correction) WITH_MODE(x, t, residual, step);
}
void c_move_back(double* x, const double* step);
void c_move_back(double* x, const double* step) { N(move_back)(&plant, x, step); }
#endif

#ifdef CHOICE
void c_solve_for(const bool* chosen);
void c_solve_for(const bool* chosen) { N(solve_for)(&plant, chosen); }
#endif

const char* c_texts(size_t i);
/* Every text and number of the tables, one after the other; null behind the last. */
const char* c_texts(size_t i) {
#define TABLE(table, count) \
    if (i < 3 * (size_t)(count)) { const size_t k = i / 3; return i % 3 == 0 ? N(table)()[k].name : i % 3 == 1 ? N(table)()[k].unit : N(table)()[k].description; } \
    i -= 3 * (size_t)(count);
    TABLE(state_table, N(state_count))
    TABLE(input_table, N(input_count))
    TABLE(output_table, N(output_count))
    TABLE(parameter_table, N(parameter_count))
    return NULL;
}
