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
    dalembert_bad_options,        /* also: a method that the plant or the memory does not allow */
    dalembert_no_memory
};

/* A phrase such as "the tolerance cannot be met". */
static inline const char* dalembert_status_text(enum dalembert_status status) {
    switch (status) {
        case dalembert_good: return "good";
        case dalembert_stopped: return "stopped by a callback";
        case dalembert_not_finite: return "a state or its rate is not finite";
        case dalembert_step_too_small: return "the tolerance cannot be met";
        case dalembert_too_many_steps: return "too many steps";
        case dalembert_event_storm: return "events follow each other again and again";
        case dalembert_range_left: return "the range of the model ends";
        case dalembert_no_start_mode: return "no mode accepts the start";
        case dalembert_no_mode: return "no mode accepts the state after an event";
        case dalembert_accumulation: return "an event happens at ever shorter intervals, and the model does not say what follows";
        case dalembert_constraint_broken: return "a constraint is violated";
        case dalembert_singular_position: return "constraints depend on each other";
        case dalembert_bad_options: return "options out of range";
        case dalembert_no_memory: return "no memory";
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

    /* The caller reads these. */
    const dalembert_plant* plant;
    void* self;
    unsigned mode;
    size_t changes;    /* events so far */
    size_t last_event; /* or the guard that ended the run; DALEMBERT_NONE: none */

    /* An integrator that can goes on to `end` without a look at some events: the last intervals of accumulated ones. False, with nothing changed, if another
     * one happens before. Null: x stays. `limit`: as far as it will go at all. */
    int (*coast)(void* context, const unsigned char* is_ignored, double end, double* t, double* x);
    double limit;

    dalembert_events_memory* kept; /* saved, with the arrays behind it */
    dalembert_times* times;        /* of each event */
    double* departures;            /* how fast the guards rose after their last events */
    size_t kept_size;
    double *u, *g, *rates, *dxdt, *before, *after; /* room to work in */
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

/* Resets that happen at the start, and the first mode that accepts it. `span`: about how long the run will be, in s. */
static inline enum dalembert_status dalembert_modes_begin(dalembert_modes* m, double t, double span, double* x);

/* At t, where a value has changed its sign, or inputs have jumped: all events that happen there, one after the other, until a mode accepts the state.
 * An integrator may have gone a little beyond the zero: the state is first moved back in front of it. Bounces that become infinitely many end at once:
 * where the sum of their intervals is known to rounding, the plant settles. t may grow by some roundings: an integrator that cannot change its time
 * ignores that. dalembert_good also where nothing happened; x, m->mode and m->changes tell. */
static inline enum dalembert_status dalembert_modes_event(dalembert_modes* m, double* t, double* x);

/* The state of the modes in a flat block, to go on from there later, in the same or another dalembert_modes of the same plant. */
static inline size_t dalembert_modes_saved_size(const dalembert_modes* m);
static inline void dalembert_modes_save(const dalembert_modes* m, void* block);
static inline void dalembert_modes_load(dalembert_modes* m, const void* block);

#include "dalembert_modes_logic.h"

/* Room in a block, one piece after the other; without a block only the size is counted. */
typedef struct dalembert_room {
    char* block;
    size_t size;
} dalembert_room;
static inline void* dalembert_take(dalembert_room* room, size_t count, size_t bytes) {
    void* const piece = room->block != NULL ? room->block + room->size : NULL;
    room->size += (count * bytes + 15) / 16 * 16;
    return piece;
}
static inline double* dalembert_numbers(dalembert_room* room, size_t count) { return (double*)dalembert_take(room, count, sizeof(double)); }

/* What is kept comes first, beside what else is kept there. */
static inline void dalembert_modes_lay_kept(dalembert_modes* m, dalembert_room* room) {
    const size_t before = room->size;
    m->kept = (dalembert_events_memory*)dalembert_take(room, 1, sizeof(dalembert_events_memory));
    m->times = (dalembert_times*)dalembert_take(room, m->plant->events, sizeof(dalembert_times));
    m->departures = dalembert_numbers(room, m->plant->events);
    m->kept_size = room->size - before;
}
static inline void dalembert_modes_lay_work(dalembert_modes* m, dalembert_room* room) {
    const dalembert_plant* const p = m->plant;
    const size_t values = dalembert_event_values(p);
    m->u = dalembert_numbers(room, p->inputs + 1);
    m->g = dalembert_numbers(room, values + 1);
    m->rates = dalembert_numbers(room, p->events + 1);
    m->dxdt = dalembert_numbers(room, p->states);
    m->before = dalembert_numbers(room, p->states);
    m->after = dalembert_numbers(room, p->states);
    m->candidates = (unsigned*)dalembert_take(room, p->most_transitions + 1, sizeof(unsigned));
    m->others = (unsigned*)dalembert_take(room, p->most_transitions + 1, sizeof(unsigned));
    m->is_over = (unsigned char*)dalembert_take(room, p->events + 1, 1);
    m->is_ignored = (unsigned char*)dalembert_take(room, p->events + 1, 1);
}
static inline void dalembert_modes_set(dalembert_modes* m, const dalembert_plant* plant, void* self) {
    memset(m, 0, sizeof(*m));
    m->plant = plant;
    m->self = self;
    m->most_events = 100000;
    m->last_event = DALEMBERT_NONE;
    m->limit = HUGE_VAL;
}

static inline dalembert_modes* dalembert_modes_new(const dalembert_plant* plant, void* self) {
    dalembert_modes m;
    dalembert_room room = {NULL, 0};
    dalembert_modes_set(&m, plant, self);
    (void)dalembert_take(&room, 1, sizeof(m));
    dalembert_modes_lay_kept(&m, &room);
    dalembert_modes_lay_work(&m, &room);
    room.block = (char*)calloc(1, room.size);
    if (room.block == NULL) return NULL;
    room.size = 0;
    dalembert_modes* const made = (dalembert_modes*)dalembert_take(&room, 1, sizeof(m));
    *made = m;
    dalembert_modes_lay_kept(made, &room);
    dalembert_modes_lay_work(made, &room);
    return made;
}
static inline void dalembert_modes_free(dalembert_modes* m) { free(m); }

static inline void dalembert_modes_values(dalembert_modes* m, double t, const double* x, double* z) {
    const dalembert_plant* const p = m->plant;
    if (dalembert_event_values(p) == 0) return;
    dalembert_inputs_at(m, t, x, m->u);
    if (p->guard_values != NULL) p->guard_values(m->self, m->mode, x, m->u, t, z);
    for (size_t e = 0; p->modes > 0 && e < p->events; ++e)
        if (!p->is_watched(m->mode, e)) z[e] = 1;
    if (p->modes > 0 && p->kinks > 0) p->kink_values(m->self, m->mode, x, m->u, t, z + p->events);
}

/* All events that happen at once, beginning with this one. */
static inline enum dalembert_status dalembert_pass_all(dalembert_modes* m, double* t, double* x, size_t event) {
    enum dalembert_status status = dalembert_good;
    while (event != DALEMBERT_NONE && status == dalembert_good) status = dalembert_pass(m, t, x, &event);
    return status;
}

/* Of a plant without modes: whether it is within its range. */
static inline enum dalembert_status dalembert_check_range(dalembert_modes* m, double t, const double* x) {
    const dalembert_plant* const p = m->plant;
    if (p->guards == 0) return dalembert_good;
    dalembert_modes_values(m, t, x, m->g);
    for (size_t i = 0; i < p->guards; ++i) {
        if (!p->guard_table[i].ends || !(m->g[i] < 0)) continue;
        m->last_event = i;
        return dalembert_range_left;
    }
    return dalembert_good;
}

static inline enum dalembert_status dalembert_modes_begin(dalembert_modes* m, double t, double span, double* x) {
    const dalembert_plant* const p = m->plant;
    memset(m->kept, 0, m->kept_size);
    m->kept->span = span;
    m->kept->last = m->kept->before_last = m->last_event = DALEMBERT_NONE;
    m->changes = 0;
    m->mode = 0;
    if (!dalembert_all_finite(p->states, x)) return dalembert_not_finite;
    if (p->modes == 0) return dalembert_check_range(m, t, x);
    for (size_t e = 0; e < p->events; ++e) {
        if (p->happens_at_start == NULL || !p->happens_at_start(e)) continue;
        dalembert_inputs_at(m, t, x, m->u);
        p->reset(m->self, e, 0, x, m->u, t);
    }
    size_t event = DALEMBERT_NONE;
    if (!dalembert_choose(m, NULL, p->modes, t, x, 0, &event)) {
        for (size_t e = 0; e < p->events && m->last_event == DALEMBERT_NONE; ++e) { /* one that has happened before, whatever the mode */
            int in_all = 1;
            for (unsigned mode = 0; in_all && mode < p->modes; ++mode) {
                p->guard_values(m->self, mode, x, m->u, t, m->g);
                in_all = p->is_watched(mode, e) && m->g[e] < 0;
            }
            if (in_all) m->last_event = e;
        }
        return dalembert_no_start_mode;
    }
    return dalembert_pass_all(m, &t, x, event);
}

/* x back along the motion to where the guard of an event that has fallen for `since` seconds is not negative. */
static inline void dalembert_move_back(dalembert_modes* m, size_t event, double since, double t, double* x) {
    const dalembert_plant* const p = m->plant;
    for (int tries = 0; tries < 3 && since > 0; ++tries) {
        const double g = m->g[event];
        dalembert_go_on(m, m->mode, x, t, since + dalembert_tiny(m, t), 0, m->after);
        p->guard_values(m->self, m->mode, m->after, m->u, t, m->g);
        if (!dalembert_all_finite(p->states, m->after) || !(m->g[event] > g / 2)) return;
        memcpy(x, m->after, p->states * sizeof(double));
        p->guard_rates(m->self, m->mode, x, m->u, t, m->rates);
        since = m->g[event] < 0 && m->rates[event] < 0 ? m->g[event] / m->rates[event] : 0;
    }
}

static inline enum dalembert_status dalembert_modes_event(dalembert_modes* m, double* t, double* x) {
    const dalembert_plant* const p = m->plant;
    if (!dalembert_all_finite(p->states, x)) return dalembert_not_finite;
    if (p->modes == 0) return dalembert_check_range(m, *t, x);
    while (1) {
        dalembert_inputs_at(m, *t, x, m->u);
        p->guard_values(m->self, m->mode, x, m->u, *t, m->g);
        p->guard_rates(m->self, m->mode, x, m->u, *t, m->rates);
        size_t event = DALEMBERT_NONE;
        double since = -1;
        for (size_t e = 0; e < p->events; ++e) {
            if (!p->is_watched(m->mode, e) || !(m->g[e] <= 0) || (!(m->g[e] < 0) && !(m->rates[e] < 0))) continue;
            const double of_this = m->rates[e] < 0 ? m->g[e] / m->rates[e] : 0;
            if (of_this > since) event = e, since = of_this;
        }
        if (event == DALEMBERT_NONE) return dalembert_good;
        dalembert_move_back(m, event, since, *t, x);
        const enum dalembert_status status = dalembert_pass_all(m, t, x, event);
        if (status != dalembert_good) return status;
    }
}

/* Numbers that callers read, to what is saved and back. */
static inline void dalembert_modes_note(const dalembert_modes* m) {
    m->kept->mode = m->mode;
    m->kept->changes = m->changes;
    m->kept->last_event = m->last_event;
}
static inline void dalembert_modes_recall(dalembert_modes* m) {
    m->mode = m->kept->mode;
    m->changes = m->kept->changes;
    m->last_event = m->kept->last_event;
}

static inline size_t dalembert_modes_saved_size(const dalembert_modes* m) { return m->kept_size; }
static inline void dalembert_modes_save(const dalembert_modes* m, void* block) {
    dalembert_modes_note(m);
    memcpy(block, m->kept, m->kept_size);
}
static inline void dalembert_modes_load(dalembert_modes* m, const void* block) {
    memcpy(m->kept, block, m->kept_size);
    dalembert_modes_recall(m);
}

#endif
