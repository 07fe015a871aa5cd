/* SPDX-License-Identifier: BSL-1.0 */
/* Runs of a plant: integrators with control of errors, events, modes and constraints. C99 over dalembert_plant.h; no heap after dalembert_run_new().
 *
 *     void* self = plant->create();
 *     dalembert_run* run = dalembert_run_new(plant, self);
 *     run->options.tolerance = 1e-9;
 *     status = dalembert_run_start(run, 0, 10, NULL);      from the start state of the plant, about up to 10 s
 *     status = dalembert_run_to(run, 5);                   run->t == 5, run->x, run->mode
 *     dalembert_run_free(run);
 *     plant->destroy(self);
 *
 * Several runs at a time are independent if each has its own `self`. Parameters of self, options, inputs and held input values may change between two
 * calls of dalembert_run_to(); after a change of parameters or a jump of inputs call dalembert_run_changed(). */
#ifndef DALEMBERT_RUN_H
#define DALEMBERT_RUN_H

#include "dalembert_modes.h"

enum dalembert_method {
    dalembert_automatic,  /* explicit; Rosenbrock while stability would limit the steps */
    dalembert_explicit,   /* Dormand-Prince 8(5,3) */
    dalembert_rosenbrock  /* Rodas5P, for stiff plants */
};

typedef struct dalembert_run dalembert_run;

typedef struct dalembert_options {
    enum dalembert_method method;
    double tolerance;      /* error of a step, relative to max(|x[i]|, scale[i]); 1e-9 */
    double longest_step;   /* s; 0: a 500th of the run where events or inputs could be missed, else any */
    double first_step;     /* s; 0: chosen */
    int finds_scales;      /* 1: dalembert_run_start() finds the scale of each state by a rough run with the inputs of the run; 0: scale[] stays as it is */
    size_t most_steps, most_events; /* of a run: 100000000 and 100000 */
    const double* stops;   /* s, rising: times at which inputs have jumps or kinks; no step reaches across one. The array stays the caller's */
    size_t stop_count;
} dalembert_options;

struct dalembert_run {
    /* The caller may set these. */
    dalembert_options options;
    dalembert_inputs inputs;
    void* context; /* of the callbacks */
    /* After each accepted step; not zero: stop there. dalembert_run_between() gives states within the step. */
    int (*on_step)(void* context, dalembert_run* run);
    /* After each event, with x after it in run->x. At the end of accumulated events, and for kinks, too: a kink has the number events + k, or that of the
     * guard, and changes no mode. */
    void (*on_event)(void* context, dalembert_run* run, double t, size_t event, unsigned before, unsigned after);

    /* The caller reads these. */
    const dalembert_plant* plant;
    void* self;
    double t;        /* s */
    double* x;       /* the state at t */
    double* scale;   /* of each state: smaller values count as this */
    unsigned mode;
    size_t steps, rejected, rhs_calls, jacobians, events, implicit_steps;
    size_t blamed;     /* state, with dalembert_not_finite and dalembert_step_too_small; constraint, with constraint_broken and singular_position */
    size_t last_event; /* event or guard, with range_left, no_mode, event_storm and accumulation */

    struct dalembert_run_inside* inside;
};

/* All memory at once; its size depends only on the plant. Null if there is none. `self` stays the caller's. */
static inline dalembert_run* dalembert_run_new(const dalembert_plant* plant, void* self);
static inline void dalembert_run_free(dalembert_run* run);

/* Begins at t with x (null: the start state of the plant): brings x to the constraints, makes resets that happen at the start, finds the mode.
 * `until`: the expected end, from which scales of times follow; the run may go beyond. */
static inline enum dalembert_status dalembert_run_start(dalembert_run* run, double t, double until, const double* x);

/* Integrates to t_end exactly, through all events. After another status than dalembert_good or dalembert_stopped, x is the last good state and t its
 * time; the run may only be started again. */
static inline enum dalembert_status dalembert_run_to(dalembert_run* run, double t_end);

/* The caller has changed run->x, parameters, or held inputs by a jump: the mode follows, and the next step begins anew. */
static inline enum dalembert_status dalembert_run_changed(dalembert_run* run);

/* Within on_step: the state at a time within the step that has just been made, by the dense output of the method. */
static inline void dalembert_run_between(dalembert_run* run, double t, double* x);

/* One sentence about how the run ended, with names; at most `size` characters with the final zero. */
static inline void dalembert_run_message(const dalembert_run* run, enum dalembert_status status, char* text, size_t size);

/* The state of a run in a flat block without pointers: run_load() continues with the same bits, in this or another run of the same plant with the same
 * parameters. Options, inputs and callbacks are not part of it. */
static inline size_t dalembert_run_saved_size(const dalembert_run* run);
static inline void dalembert_run_save(const dalembert_run* run, void* block);
static inline void dalembert_run_load(dalembert_run* run, const void* block);

#endif
