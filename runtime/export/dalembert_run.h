/* SPDX-License-Identifier: BSL-1.0 */
/* Runs of a plant: integrators with control of errors, events, modes and constraints. C99 over dalembert_plant.h; no heap after
 * dalembert_run_new().
 *
 *     void* self = plant->create();
 *     dalembert_run* run = dalembert_run_new(plant, self);
 *     run->options.tolerance = 1e-9;
 *     status = dalembert_run_start(run, 0, 10, NULL);      from the start state of the plant, about up to 10 s
 *     status = dalembert_run_to(run, 5);                   run->t == 5, run->x, run->mode
 *     dalembert_run_free(run);
 *     plant->destroy(self);
 *
 * Several runs at a time are independent if each has its own `self`. Parameters of self, options, inputs and held input values may
 * change between two calls of dalembert_run_to(); after a change of parameters or a jump of inputs call dalembert_run_changed(). */
#ifndef DALEMBERT_RUN_H
#define DALEMBERT_RUN_H

#include "dalembert_modes.h"

enum dalembert_method {
    dalembert_automatic, /* explicit; Rosenbrock while stability would limit the steps */
    dalembert_explicit,  /* Dormand-Prince 8(5,3) */
    dalembert_rosenbrock /* Rodas5P, for stiff plants */
};

typedef struct dalembert_run dalembert_run;

typedef struct dalembert_options {
    enum dalembert_method method;
    double tolerance;    /* error of a step, relative to max(|x[i]|, scale[i]); 1e-9 */
    double longest_step; /* s; 0: a 500th of the run where events or inputs could be missed, else any */
    double first_step;   /* s; 0: chosen */
    int finds_scales; /* 1: dalembert_run_start() finds the scale of each state by a rough run with the inputs of the run; 0: scale[] stays
                         as it is */
    size_t most_steps, most_events; /* of a run: 100000000 and 100000 */
    const double*
        stops; /* s, rising: times at which inputs have jumps or kinks; no step reaches across one. The array stays the caller's */
    size_t stop_count;
} dalembert_options;

struct dalembert_run {
    /* The caller may set these. */
    dalembert_options options;
    dalembert_inputs inputs;
    void* context; /* of the callbacks */
    /* After each accepted step; not zero: stop there. dalembert_run_between() gives states within the step. */
    int (*on_step)(void* context, dalembert_run* run);
    /* After each event, with x after it in run->x. At the end of accumulated events, and for kinks, too: a kink has the number events +
     * k, or that of the guard, and changes no mode. */
    void (*on_event)(void* context, dalembert_run* run, double t, size_t event, unsigned before, unsigned after);

    /* The caller reads these. */
    const dalembert_plant* plant;
    void* self;
    double t;      /* s */
    double* x;     /* the state at t */
    double* scale; /* of each state: smaller values count as this */
    unsigned mode;
    size_t steps, rejected, rhs_calls, jacobians, events, implicit_steps;
    size_t blamed;     /* state, with dalembert_not_finite and dalembert_step_too_small; constraint, with constraint_broken and
                          singular_position */
    size_t last_event; /* event or guard, with range_left, no_mode, event_storm and accumulation */

    struct dalembert_run_inside* inside; /* how it works */
};

/* All memory at once; its size depends only on the plant. Null if there is none. `self` stays the caller's. */
static inline dalembert_run* dalembert_run_new(const dalembert_plant* plant, void* self);
static inline void dalembert_run_free(dalembert_run* run);

/* Begins at t with x (null: the start state of the plant): brings x to the constraints, makes resets that happen at the start, finds the
 * mode. `until`: the expected end, from which scales of times and the longest step follow; the run may go beyond. Not behind t: the end
 * is not known, and one second counts for scales. */
static inline enum dalembert_status dalembert_run_start(dalembert_run* run, double t, double until, const double* x);

/* Integrates to t_end exactly, through all events. After another status than dalembert_good or dalembert_stopped, x is the last good
 * state and t its time; the run may only be started again. */
static inline enum dalembert_status dalembert_run_to(dalembert_run* run, double t_end);

/* The caller has changed run->x, parameters, or held inputs by a jump: the mode follows, and the next step begins anew. */
static inline enum dalembert_status dalembert_run_changed(dalembert_run* run);

/* Within on_step: the state at a time within the step that has just been made, by the dense output of the method. */
static inline void dalembert_run_between(dalembert_run* run, double t, double* x);

/* One sentence about how the run ended, with names; at most `size` characters with the final zero. */
static inline void dalembert_run_message(const dalembert_run* run, enum dalembert_status status, char* text, size_t size);

/* The state of a run in a flat block without pointers: run_load() continues with the same bits, in this or another run of the same plant
 * with the same parameters. Options, inputs and callbacks are not part of it. */
static inline size_t dalembert_run_saved_size(const dalembert_run* run);
static inline void dalembert_run_save(const dalembert_run* run, void* block);
static inline void dalembert_run_load(dalembert_run* run, const void* block);

/* What follows is how it works; nothing of it is for callers. */

/* A step that may or may not be taken: from where the run is to `end`. */
typedef struct dalembert_candidate {
    double length, end; /* s */
    double *y, *error, *dydt;
    int has_derivative; /* dydt is that at the end */
    int is_finite;
} dalembert_candidate;

/* Where a step begins. */
typedef struct dalembert_point {
    const double *x, *dxdt;
    double t;
} dalembert_point;

/* A square matrix whose entries lie near the diagonal, column by column; one that is factored has room for what row exchanges bring. */
typedef struct dalembert_band {
    size_t n, lower, upper;
    int is_factored;
    double *entries, *sizes; /* sizes of the diagonal: the magnitudes of all that was added to it */
    size_t* exchanges;
} dalembert_band;

/* What is remembered of a guard; see note [rest] in dalembert_guards.h. */
typedef struct dalembert_watch {
    double largest;   /* of all values */
    double excursion; /* of the values since the last change */
    double last;      /* where the last step began */
    double rest;      /* of the values between the changes that made it rest */
    double last_change;
    int has_changed, small_changes, soon_changes; /* in a row */
    int rests;
    int sign, kept; /* where it rests: the last sign, and for how many steps */
    int patience;   /* steps with one sign after which it rests no more; twice as many each time */
    int settled;    /* the side where the run is: -1, 1, or 0 when not known yet */
} dalembert_watch;

/* How independent constraints are: 1 at their best, falling to 0 in proportion to the distance from a singular position. */
typedef struct dalembert_independence {
    double value;
    size_t constraint; /* that depends most on the others */
    size_t rank;
    size_t is_chosen_anew; /* others are solved for from now on */
} dalembert_independence;

/* x(s) = x(0) + h times the integral of the polynomial that has these slopes at some points, from 0 to s; see dalembert_collocation.h. */
typedef struct dalembert_polynomial {
    const double* x;
    double h;
    size_t count;
    double points[9], nodes[9], weights[9]; /* nodes and weights are those of Gauss's quadrature */
    double* slopes[9];
} dalembert_polynomial;

/* What a run remembers from one step to the next, besides arrays. */
typedef struct dalembert_run_memory {
    double t, from, span, h, last_error; /* of step control: the logarithm of the error before */
    int has_end;                         /* `span` is that of the run, and not a guess */
    int is_started, goes_on;             /* the next step follows the last one; else integration starts anew there */
    size_t steps, rejected, rhs_calls, jacobians, kinks_passed, implicit_steps;
    double mark; /* time of the last look at the pace */
    size_t tries_at_mark;
    double last_event; /* s */
    size_t part_events, stalled;
    double noticed;
    int has_noticed, may_touch, cuts;
    int is_implicit, is_radius_begun; /* see dalembert_choice.h */
    size_t patience, often, tried, accepted, stint;
    double longest, window_begin, stint_begin, implicit_pace;
    dalembert_independence now; /* where the last usual step began */
    double measured;
    int looks;
    size_t rank;
    double jump, searched; /* the next jump of the plant at a time of its own, or the end of the search */
    int has_jump;
} dalembert_run_memory;

typedef struct dalembert_run_inside {
    dalembert_modes modes;
    size_t guards; /* values to watch */
    double to;
    const unsigned char* is_ignored; /* events that are not looked at */
    int is_trial, stops, was_crossed;
    size_t event;
    /* Kept: */
    char* kept_block;
    size_t kept_size;
    dalembert_run_memory* kept;
    double *dxdt, *radius;
    dalembert_watch* watches;
    double* row_sizes;
    int *is_used, *chosen; /* constraints */
    /* Room to work in: */
    double *u, *u_ahead, *u_behind;
    double *k[16], *dense[4], *stage, *other, *difference;
    double *from_x, *from_dxdt, from_t, *next_x, *start_x, *coast_x;
    unsigned from_mode;
    int is_dense;
    dalembert_candidate c, part, behind;
    unsigned char *ends, *is_strict, *begins_at_zero;
    int* side;
    double *at_start, *at_before, *sample, *lowest, *low, *at_end, *found, *near_values, *far_values, *seen;
    double begin; /* of the step whose stages are watched */
    int is_watching, sees_ends, spares_stages, has_kinks, is_cut;
    int has_matrix;
    dalembert_band J, W;
    double *J_values, *J_u, *dfdt, *prepared_x, *prepared_u, prepared_t;
    int is_prepared;
    double *weighted, *gram, *pivots, *pivots_of_chosen;
    size_t *order, *order_of_chosen;
    int* is_held; /* those that are never left out */
    unsigned char* is_done;
    dalembert_polynomial guess, long_step, other_step;
    double *reach, *rounding, next_sample; /* of a rough run */
} dalembert_inside;

#include "dalembert_run_calls.h"

#endif
