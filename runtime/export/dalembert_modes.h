/* SPDX-License-Identifier: BSL-1.0 */
/* Modes and events of a plant: in which mode it begins, which functions must be watched, and what follows an event. C99 over dalembert_plant.h, for
 * whoever integrates: an importer of an FMU for model exchange, or dalembert_run.h. Plants without modes may use it, too: then there is mode 0.
 *
 *     dalembert_modes* m = dalembert_modes_new(plant, self);
 *     m->inputs = ...;                                        held numbers, or a function of t and x
 *     status = dalembert_modes_begin(m, t, span, x);          finds m->mode; may change x
 *     dalembert_modes_values(m, t, x, z);                     watch z[0] ... z[dalembert_event_values(plant) - 1] while you integrate
 *     status = dalembert_modes_event(m, &t, x);               where one of them changed its sign, or an input jumped; may change x and m->mode
 *     dalembert_modes_free(m);
 *
 * Signs. Plant with modes: z[e] belongs to event e for e < plant->events, and the event happens where z[e] falls through zero; an event that cannot
 * happen in the present mode has the value 1. The values behind belong to kinks: the right-hand side has a kink where their sign changes, in either
 * direction; integrate up to there and start anew, nothing else happens. Plant without modes: z[i] belongs to guard i. Where guard_table[i].ends, the
 * model holds only for z[i] >= 0, and dalembert_modes_event() says dalembert_range_left; the others are kinks. */
#ifndef DALEMBERT_MODES_H
#define DALEMBERT_MODES_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "dalembert_plant.h"

enum dalembert_status {
    dalembert_good,
    dalembert_stopped,            /* a callback asked for it */
    dalembert_not_finite,         /* a state or its rate is infinite or not a number */
    dalembert_step_too_small,     /* the tolerance cannot be met */
    dalembert_too_many_steps,
    dalembert_event_storm,        /* too many events, or without progress in time */
    dalembert_range_left,         /* a guard that ends the run, or an event that leads to no mode */
    dalembert_no_start_mode,      /* no mode accepts the start */
    dalembert_no_mode,            /* no mode accepts the state after an event; x and the mode are those before it */
    dalembert_accumulation,       /* infinitely many events up to a time, and the model does not say what follows */
    dalembert_constraint_broken,  /* the start violates a constraint, or the run cannot hold it any more */
    dalembert_singular_position,  /* constraints depend on each other there */
    dalembert_bad_options,
    dalembert_no_memory
};

#define DALEMBERT_NONE ((size_t)-1)

/* A phrase such as "the tolerance cannot be met". */
static inline const char* dalembert_status_text(enum dalembert_status status);

/* Inputs: a function that writes u(t, x), or numbers that are held (null: zeros). */
typedef struct dalembert_inputs {
    void (*function)(void* context, double t, const double* x, double* u);
    void* context;
    const double* held;
} dalembert_inputs;

/* Read mode, last_event and next_t; set inputs, context and on_change; leave the rest alone. */
typedef struct dalembert_modes dalembert_modes;

/* All memory at once; null if there is none. `self` stays the caller's. */
static inline dalembert_modes* dalembert_modes_new(const dalembert_plant* plant, void* self);
static inline void dalembert_modes_free(dalembert_modes* m);

/* The number of values to watch: events and kinks, or guards. */
static inline size_t dalembert_event_values(const dalembert_plant* plant);
static inline void dalembert_modes_values(dalembert_modes* m, double t, const double* x, double* z);

/* Resets that happen at the start, and the first mode that accepts it. `span`: about how long the run will be, in s. */
static inline enum dalembert_status dalembert_modes_begin(dalembert_modes* m, double t, double span, double* x);

/* At t, where a value has changed its sign, or inputs have jumped: all events that happen there, one after the other, until a mode accepts the state.
 * An integrator may have gone a little beyond the zero: the state is first moved back in front of it. Bounces that become infinitely many end at once:
 * where the sum of their intervals is known to rounding, the plant settles. t may grow by some roundings: an integrator that cannot change its time
 * ignores that. dalembert_good also where nothing happened; x, m->mode and m->changes tell. */
static inline enum dalembert_status dalembert_modes_event(dalembert_modes* m, double* t, double* x);

/* Brings x back to the constraints of the plant, and quaternions to the norm one; nothing where plant->is_projected is zero. Returns the number of the
 * constraint that cannot be met, or DALEMBERT_NONE. `work`: states + 2 * constraints + degrees numbers. */
static inline size_t dalembert_project(const dalembert_plant* plant, const void* self, unsigned mode, double t, double* x, double* work);

/* The state of the modes in a flat block, to go on from there later, in the same or another dalembert_modes of the same plant. */
static inline size_t dalembert_modes_saved_size(const dalembert_modes* m);
static inline void dalembert_modes_save(const dalembert_modes* m, void* block);
static inline void dalembert_modes_load(dalembert_modes* m, const void* block);

#endif
