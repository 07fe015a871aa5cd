/* SPDX-License-Identifier: BSL-1.0 */
/* A plant: a model as a shared library behind plain C functions. The library exports one function,
 *     const dalembert_plant* dalembert_plant_table(void);
 * It returns a table that stays valid as long as the library is loaded. `dalembert compile` writes such libraries. A library written by hand in C also
 * works: `dalembert simulate FILE.so`.
 *
 * The state is x = [q; v; z]: coordinates, their velocities, further states. All numbers are doubles in SI. Matrices are stored column by column, in
 * the order of their pattern. `self` is the result of create(), `mode` the number of a mode (0 if the plant has no modes), `t` the time
 * in s. Functions may change only their results, and self if it is not const. Several threads may call them with different self.
 * No argument may be the same array as a result. The pointer of a function that a plant does not have is null, except for functions marked as needed. */
#ifndef DALEMBERT_PLANT_H
#define DALEMBERT_PLANT_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this table. It grows with every change that matters to a program that reads it. */
#define DALEMBERT_PLANT_VERSION 5

/* Name in the model, SI unit, description, and declared range. */
typedef struct dalembert_quantity {
    const char* name;
    const char* unit;
    const char* description;
    double low, high;
} dalembert_quantity;

/* A function whose sign an integrator must watch. `ends`: the model holds only where it is not negative; else the right-hand side has a kink, jump or
 * infinite slope where its sign changes. */
typedef struct dalembert_guard {
    const char* name;
    const char* doc;
    int ends;
} dalembert_guard;

/* A rate that is held at zero, with the position whose rate it is. */
typedef struct dalembert_constraint {
    const char* name;
    const char* unit; /* of the position, or of the rate if there is no position */
    const char* description;
    int has_position;
    int can_be_left_out;     /* it follows from others: a run chooses the constraints to solve for */
    int solved_for_at_start; /* it is solved for until solve_for() chooses others */
} dalembert_constraint;

/* Stored entries of a matrix: those of column j have the numbers column_starts[j] to column_starts[j + 1] - 1 and the rows row_indices[...]. If
 * column_starts is null, all entries are stored. */
typedef struct dalembert_pattern {
    const size_t* column_starts;
    const size_t* row_indices;
} dalembert_pattern;

/* Modes after an event: after one event; `beside`, if its reset drives other parts out of their modes; or after infinitely many of these events. */
enum dalembert_transition { dalembert_next, dalembert_beside, dalembert_after_accumulation };

typedef struct dalembert_plant {
    int version; /* DALEMBERT_PLANT_VERSION */
    size_t size; /* sizeof(dalembert_plant), in bytes */

    const char* name;
    const char* scene;
    const char* title;

    size_t states, inputs, outputs, parameters;
    size_t degrees; /* coordinates; velocities begin at velocity_place */
    size_t velocity_place;
    size_t guards, kinks, constraints, modes, events;
    const dalembert_quantity* state_table;
    const dalembert_quantity* input_table;
    const dalembert_quantity* output_table;
    const dalembert_quantity* parameter_table;
    const dalembert_guard* guard_table;
    const dalembert_constraint* constraint_table;
    const char* const* mode_names;
    const char* const* event_names;
    const double* parameter_defaults;
    const double* start_values; /* for the default parameters */

    int is_separable;        /* accelerations depend on coordinates alone, and x = [q; v] */
    int is_projected;        /* the state needs projection: onto constraints, or of quaternions to the norm one */
    size_t constraint_rank;  /* number of constraints to solve for, if a run chooses them; else 0 */
    size_t series_rows;      /* products of series; 0 where there are no series */
    size_t most_transitions; /* the longest list of modes that transitions() writes */

    /* df/dx, df/du, df/dp: states rows each. */
    dalembert_pattern pattern_x, pattern_u, pattern_p;

    /* Needed. One instance of the plant, with the default parameters; null if there is no memory. */
    void* (*create)(void);
    void (*destroy)(void* self);
    void (*set_parameters)(void* self, const double* parameters);
    void (*start_state)(const void* self, double* x);

    /* Needed: dx/dt, and df/dx. */
    void (*rhs)(const void* self, unsigned mode, const double* x, const double* u, double t, double* dxdt);
    void (*rhs_and_jacobian)(const void* self, unsigned mode, const double* x, const double* u, double t, double* dxdt, double* J);
    /* df/du (needed if there are inputs), df/dp, and df/dt at fixed x (null: zero). */
    void (*jacobian_u)(const void* self, unsigned mode, const double* x, const double* u, double t, double* J);
    void (*jacobian_p)(const void* self, unsigned mode, const double* x, const double* u, double t, double* J);
    void (*jacobian_t)(const void* self, unsigned mode, const double* x, const double* u, double t, double* dfdt);
    /* Outputs, and their derivatives; all entries are stored. */
    void (*output)(const void* self, unsigned mode, const double* x, const double* u, double t, double* y);
    void (*output_jacobian_x)(const void* self, unsigned mode, const double* x, const double* u, double t, double* C);
    void (*output_jacobian_u)(const void* self, unsigned mode, const double* x, const double* u, double t, double* D);
    /* Of plants that were made with them (null: not known): dy/dp, and dy/dt at fixed x and u. */
    void (*output_jacobian_p)(const void* self, unsigned mode, const double* x, const double* u, double t, double* C);
    void (*output_jacobian_t)(const void* self, unsigned mode, const double* x, const double* u, double t, double* dydt);
    void (*mass_matrix)(const void* self, unsigned mode, const double* x, double t, double* M);

    /* In J and W; null: zero. d(kinetic + potential + internal)/dt = supplied - dissipated + prescribed + exchanged. */
    double (*kinetic_energy)(const void* self, unsigned mode, const double* x, double t);
    double (*potential_energy)(const void* self, unsigned mode, const double* x, double t);
    double (*internal_energy)(const void* self, unsigned mode, const double* x, double t);
    double (*supplied_power)(const void* self, unsigned mode, const double* x, const double* u, double t);
    double (*dissipated_power)(const void* self, unsigned mode, const double* x, const double* u, double t);
    double (*prescribed_power)(const void* self, unsigned mode, const double* x, const double* u, double t);
    double (*exchanged_power)(const void* self, unsigned mode, const double* x, const double* u, double t);

    /* In a plant without modes: its guards. In a plant with modes: event e happens where g[e] falls through zero, `guard_rates` are dg/dt along the
     * motion with inputs held, and `kinks` are functions where the right-hand side of the mode has a kink. */
    void (*guard_values)(const void* self, unsigned mode, const double* x, const double* u, double t, double* g);
    void (*guard_rates)(const void* self, unsigned mode, const double* x, const double* u, double t, double* rates);
    void (*kink_values)(const void* self, unsigned mode, const double* x, const double* u, double t, double* k);
    /* Whether the state meets the conditions of a mode (null: always); whether an event can happen in a mode; whether it happens at once if another one
     * takes its guard below zero; whether a run begins with its reset (null: never). */
    int (*holds)(const void* self, unsigned mode, const double* x, const double* u, double t);
    int (*is_watched)(unsigned mode, size_t event);
    int (*happens_at_once)(size_t event);
    int (*happens_at_start)(size_t event);
    /* Change x at the event, or after infinitely many of it. transitions() writes the modes that may follow and returns their number. */
    void (*reset)(const void* self, size_t event, unsigned mode, double* x, const double* u, double t);
    void (*settle)(const void* self, size_t event, unsigned mode, double* x, const double* u, double t);
    size_t (*transitions)(size_t event, unsigned mode, enum dalembert_transition kind, unsigned* modes);

    /* For plants with projection: positions and rates that are held at zero, their derivatives by the velocities (all entries), and the change of
     * coordinates or velocities that removes residuals r, M^-1 A' (A M^-1 A')^-1 r. move_back() moves the coordinates back by a step and gives
     * quaternions the norm one. */
    void (*constraint_positions)(const void* self, unsigned mode, const double* x, double t, double* f);
    void (*constraint_rates)(const void* self, unsigned mode, const double* x, double t, double* w);
    void (*constraint_jacobian)(const void* self, unsigned mode, const double* x, double t, double* A);
    void (*correction)(const void* self, unsigned mode, const double* x, double t, const double* residual, double* step);
    void (*move_back)(const void* self, double* x, const double* step);
    void (*solve_for)(void* self, const int* chosen);

    /* Inputs of the run for which the library was compiled (null: no run), as functions of x and t. */
    void (*inputs_of_run)(const void* self, const double* x, double t, double* u);
    /* How these follow the state and the parameters: du/dx, a column of inputs for each state, and behind it du/dp (null: not known). Entries that
     * are not zero are written. */
    void (*input_slopes)(const void* self, const double* x, double t, double* columns);
    /* Normalised Taylor coefficients of the motion with these inputs: x holds order + 1 vectors of states + 1 numbers: the state and the work; the
     * first vector is given. `rows` is room for 2*series_rows*order numbers. */
    void (*series)(const void* self, unsigned mode, double t, size_t order, double* x, double* rows);

    /* Functions of time, parameters and inputs: where one changes its sign, the right-hand side or a guard may have a kink or jump. What stands inside
     * another comes first. s holds their values, and behind them, for each of them, how fast the arguments of its sines and cosines rise, in rad/s. */
    size_t time_switches;
    void (*time_switch_values)(const void* self, unsigned mode, const double* x, const double* u, double t, double* s);

    /* dx/dt, and behind it supplied - dissipated + prescribed + exchanged power, in one call (null: the functions above are called one by one). If u is
     * null, the inputs are those of the run. */
    void (*rates_and_power)(const void* self, unsigned mode, const double* x, const double* u, double t, double* rates);
} dalembert_plant;

/* The function that a plant exports. Everything else may be hidden (-fvisibility=hidden): then two plants of one name do not share their symbols. */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const dalembert_plant* dalembert_plant_table(void);
typedef const dalembert_plant* (*dalembert_plant_function)(void);
#define DALEMBERT_PLANT_FUNCTION "dalembert_plant_table"

#ifdef __cplusplus
}
#endif
#endif
