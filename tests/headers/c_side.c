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

/* Every text and number of the tables, one after the other; 0 behind the last. */
const char* c_text(size_t i);
const char* c_text(size_t i) {
#define TEXTS(table, count)                                                                                                              \
    if (i < 3 * (size_t)(count)) {                                                                                                       \
        const size_t k = i / 3;                                                                                                          \
        return i % 3 == 0 ? N(table)()[k].name : i % 3 == 1 ? N(table)()[k].unit : N(table)()[k].description;                            \
    }                                                                                                                                    \
    i -= 3 * (size_t)(count);
    TEXTS(state_table, N(state_count))
    TEXTS(input_table, N(input_count))
    TEXTS(output_table, N(output_count))
    TEXTS(parameter_table, N(parameter_count))
    if (i < 2 * (size_t)N(guard_count)) return i % 2 == 0 ? N(guard_table)()[i / 2].name : N(guard_table)()[i / 2].doc;
#ifdef CONSTRAINTS
    i -= 2 * (size_t)N(guard_count);
    TEXTS(constraint_table, N(constraint_count))
#endif
    return NULL;
}

double c_number(size_t i);
double c_number(size_t i) {
#define RANGES(table, count)                                                                       \
    if (i < 2 * (size_t)(count)) return i % 2 == 0 ? N(table)()[i / 2].low : N(table)()[i / 2].high; \
    i -= 2 * (size_t)(count);
    RANGES(state_table, N(state_count))
    RANGES(input_table, N(input_count))
    RANGES(output_table, N(output_count))
    RANGES(parameter_table, N(parameter_count))
    return 0;
}

size_t c_pattern(int by, size_t i);
/* Column starts, and behind them rows; of Jacobians by states, inputs, parameters. */
size_t c_pattern(int by, size_t i) {
#define PATTERN(letter, columns)                                                 \
    {                                                                            \
        if (i <= (size_t)(columns)) return N(jacobian_##letter##_column_starts)()[i]; \
        return N(jacobian_##letter##_row_indices)()[i - (size_t)(columns)-1];    \
    }
    (void)i;
#ifdef PATTERN_X
    if (by == 0) PATTERN(x, N(state_count))
#endif
#ifdef PATTERN_U
    if (by == 1) PATTERN(u, N(input_count))
#endif
#ifdef PATTERN_P
    if (by == 2) PATTERN(p, N(parameter_count))
#endif
    return by < 0;
}

#ifdef MODES
/* -1: not watched; else the i-th mode of a list (0 next, 1 beside, 2 rest), and -2 behind its last. */
int c_transition(size_t event, unsigned mode, int list, size_t i);
int c_transition(size_t event, unsigned mode, int list, size_t i) {
    const N(transition)* const to = N(transition_of)(event, (N(mode))mode);
    const N(modes)* const modes = list == 0 ? &to->next : list == 1 ? &to->beside : &to->rest;
    return !to->is_watched ? -1 : i < modes->count ? (int)modes->modes[i] : -2;
}
#endif

#ifdef SERIES
static void set_inputs(void* data, const double* x, double t, double* u) {
    (void)x;
    (void)t;
    for (size_t i = 0; i < N(input_count); ++i) u[i] = ((const double*)data)[i];
}
static void no_slopes(void* data, size_t k, double (*x)[N(state_count) + 1], double* u) {
    (void)data;
    (void)k;
    (void)x;
    for (size_t i = 0; i < N(input_count); ++i) u[i] = 0;
}
/* With inputs that stay as they are. */
void c_series(unsigned mode, double* inputs, double t, size_t order, double* x, double* rows);
void c_series(unsigned mode, double* inputs, double t, size_t order, double* x, double* rows) {
    N(input_series) series;
    series.data = inputs;
    series.first = set_inputs;
    series.next = no_slopes;
    (void)mode;
    N(series) WITH_MODE(&series, t, order, (double (*)[N(state_count) + 1])x, rows);
}
#endif
