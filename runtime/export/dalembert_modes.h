/* SPDX-License-Identifier: BSL-1.0 */
/* Modes and events of a plant: in which mode it begins, which functions must be watched, and what follows an event. C99 over
 * dalembert_plant.h, for whoever integrates: an importer of an FMU for model exchange, or dalembert_run.h. Plants without modes may use
 * it, too: then there is mode 0.
 *
 *     dalembert_modes* m = dalembert_modes_new(plant, self);
 *     m->inputs = ...;                                        held numbers, or a function of t and x
 *     status = dalembert_modes_begin(m, t, span, x);          finds m->mode; may change x
 *     dalembert_modes_values(m, t, x, z);                     watch z[0] ... z[dalembert_event_values(plant) - 1] while you integrate
 *     status = dalembert_modes_event(m, &t, x);               where one of them changed its sign, or an input jumped; may change x and
 * m->mode dalembert_modes_free(m);
 *
 * Signs. Plant with modes: z[e] belongs to event e for e < plant->events, and the event happens where z[e] falls through zero; an event
 * that cannot happen in the present mode has the value 1. The values behind belong to kinks: the right-hand side has a kink where their
 * sign changes, in either direction; integrate up to there and start anew, nothing else happens. Plant without modes: z[i] belongs to
 * guard i. Where guard_table[i].ends, the model holds only for z[i] >= 0, and dalembert_modes_event() says dalembert_range_left; the
 * others are kinks. */
#ifndef DALEMBERT_MODES_H
#define DALEMBERT_MODES_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "dalembert_accumulation.h"
#include "dalembert_plant.h"
#include "dalembert_projection.h"

/* What is remembered of events; the last one and the one before with their modes. */
typedef struct dalembert_events_memory {
    double span, last_time;
    size_t last, before_last;
    unsigned last_mode, before_last_mode;
    size_t stalled; /* events in a row without progress in time */
    size_t changes, last_event;
    unsigned mode;
    int is_circle; /* the last of them are two that lead to each other */
} dalembert_events_memory;

enum dalembert_status {
    dalembert_good,
    dalembert_stopped,        /* a callback asked for it */
    dalembert_not_finite,     /* a state or its rate is infinite or not a number */
    dalembert_step_too_small, /* the tolerance cannot be met */
    dalembert_too_many_steps,
    dalembert_event_storm,       /* too many events, or without progress in time */
    dalembert_range_left,        /* a guard that ends the run, or an event that leads to no mode */
    dalembert_no_start_mode,     /* no mode accepts the start */
    dalembert_no_mode,           /* no mode accepts the state after an event; x and the mode are those before it */
    dalembert_accumulation,      /* infinitely many events up to a time, and the model does not say what follows */
    dalembert_constraint_broken, /* the start violates a constraint, or the run cannot hold it any more */
    dalembert_singular_position, /* constraints depend on each other there */
    dalembert_bad_options,       /* also: a method that the plant or the memory does not allow */
    dalembert_no_memory
};

/* A phrase such as "the tolerance cannot be met". */
static inline const char* dalembert_status_text(enum dalembert_status status) {
    switch (status) {
        case dalembert_good:
            return "good";
        case dalembert_stopped:
            return "stopped by a callback";
        case dalembert_not_finite:
            return "a state or its rate is not finite";
        case dalembert_step_too_small:
            return "the tolerance cannot be met";
        case dalembert_too_many_steps:
            return "too many steps";
        case dalembert_event_storm:
            return "events follow each other again and again";
        case dalembert_range_left:
            return "the range of the model ends";
        case dalembert_no_start_mode:
            return "no mode accepts the start";
        case dalembert_no_mode:
            return "no mode accepts the state after an event";
        case dalembert_accumulation:
            return "an event happens at ever shorter intervals, and the model does not say what follows";
        case dalembert_constraint_broken:
            return "a constraint is violated";
        case dalembert_singular_position:
            return "constraints depend on each other";
        case dalembert_bad_options:
            return "options out of range";
        case dalembert_no_memory:
            return "no memory";
    }
    return "unknown";
}

/* Inputs: a function that writes u(t, x), or numbers that are held (null: zeros). */
typedef struct dalembert_inputs {
    void (*function)(void* context, double t, const double* x, double* u);
    void* context;
    const double* held;
} dalembert_inputs;

typedef struct dalembert_modes dalembert_modes;
struct dalembert_modes {
    /* The caller may set these. on_change: an event has happened at t, with the state after it in x; `is_end`: infinitely many of them. */
    dalembert_inputs inputs;
    void* context;
    void (*on_change)(void* context, double t, const double* x, size_t event, unsigned before, unsigned after, int is_end);
    size_t most_events; /* 100000 */
    int is_exact;       /* the integrator never goes beyond a zero: dalembert_modes_event() moves no state back */

    /* The caller reads these. */
    const dalembert_plant* plant;
    void* self;
    unsigned mode;
    size_t changes;    /* events so far */
    size_t last_event; /* or the guard that ended the run; DALEMBERT_NONE: none */

    /* An integrator that can goes on to `end` without a look at some events: the last intervals of accumulated ones. False, with nothing
     * changed, if another one happens before. Null: x stays. `limit`: as far as it will go at all. */
    int (*coast)(void* context, const unsigned char* is_ignored, double end, double* t, double* x);
    double limit;

    dalembert_events_memory* kept; /* saved, with the arrays behind it */
    dalembert_times* times;        /* of each event */
    double* departures;            /* how fast the guards rose after their last events */
    size_t kept_size;
    double *u, *g, *rates, *dxdt, *before, *after; /* room to work in */
    double *u_half, *u_whole, *g_half, *g_whole;   /* with inputs of half an instant and of an instant later */
    double* s;                                     /* functions of time */
    double* projection;                            /* dalembert_projection_room() */
    unsigned *candidates, *others;
    unsigned char *is_over, *is_ignored;
};

/* All memory at once; null if there is none. `self` stays the caller's. */
static inline dalembert_modes* dalembert_modes_new(const dalembert_plant* plant, void* self);
static inline void dalembert_modes_free(dalembert_modes* m);

/* The number of values to watch: events and kinks, or guards. */
static inline size_t dalembert_event_values(const dalembert_plant* plant) {
    return plant->modes > 0 ? plant->events + plant->kinks : plant->guards;
}
static inline void dalembert_modes_values(dalembert_modes* m, double t, const double* x, double* z);

/* Resets that happen at the start, and the first mode that accepts it. `span`: about how long the run will be, in s; 0: not known. */
static inline enum dalembert_status dalembert_modes_begin(dalembert_modes* m, double t, double span, double* x);

/* At t, where a value has changed its sign, or inputs have jumped: all events that happen there, one after the other, until a mode
 * accepts the state. An integrator may have gone a little beyond the zero: the state is first moved back in front of it, by at most a
 * thousandth of `span`. Bounces that become infinitely many end at once: where the sum of their intervals is known to rounding, the
 * plant settles. t may grow by some roundings: an integrator that cannot change its time ignores that. dalembert_good also where nothing
 * happened; x, m->mode and m->changes tell. */
static inline enum dalembert_status dalembert_modes_event(dalembert_modes* m, double* t, double* x);

/* The state of the modes in a flat block, to go on from there later, in the same or another dalembert_modes of the same plant. */
static inline size_t dalembert_modes_saved_size(const dalembert_modes* m);
static inline void dalembert_modes_save(const dalembert_modes* m, void* block);
static inline void dalembert_modes_load(dalembert_modes* m, const void* block);

#include "dalembert_modes_calls.h"

#endif
