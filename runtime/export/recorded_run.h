/* SPDX-License-Identifier: BSL-1.0 */
/* A run that is recorded: states at given times, where steps end, and a list of its events. For languages with arrays. Dense output would
 * spare steps, but while stability limits explicit steps, it is less accurate than they are. */
#ifndef RECORDED_RUN_H
#define RECORDED_RUN_H

#include "dalembert_run.h"

typedef struct dalembert_recorded_event {
    double t;
    size_t event; /* events + k for kink k; a guard, if the plant has no modes */
    unsigned before, after;
} dalembert_recorded_event;

typedef struct dalembert_record {
    /* The caller sets these. */
    const double* times; /* s, rising; the first one is the start of the run, the last one its end */
    size_t count;
    double* x;      /* room for count states */
    unsigned* mode; /* and modes */
    /* Called every thousand steps, if not null; not zero: stop. */
    int (*ask)(void* context);
    void* ask_context;

    /* The caller reads these. */
    size_t filled; /* times that have been reached */
    dalembert_recorded_event* events;
    size_t event_count;

    size_t event_room;
    int is_full; /* no memory for an event */
} dalembert_record;

static int dalembert_record_step(void* context, dalembert_run* run) {
    dalembert_record* const r = (dalembert_record*)context;
    return r->is_full || (r->ask != NULL && run->steps % 1000 == 0 && r->ask(r->ask_context));
}

static void dalembert_record_event(void* context, dalembert_run* run, double t, size_t event, unsigned before, unsigned after) {
    dalembert_record* const r = (dalembert_record*)context;
    dalembert_recorded_event e;
    (void)run;
    if (r->event_count == r->event_room) {
        const size_t room = r->event_room > 0 ? 2 * r->event_room : 64;
        dalembert_recorded_event* const more = (dalembert_recorded_event*)realloc(r->events, room * sizeof(dalembert_recorded_event));
        if (more == NULL) {
            r->is_full = 1;
            return;
        }
        r->events = more;
        r->event_room = room;
    }
    e.t = t;
    e.event = event;
    e.before = before;
    e.after = after;
    r->events[r->event_count++] = e;
}

/* Runs from times[0] with x (null: the start state of the plant) to the last time. Options and inputs of the run are set before. Afterwards
 * r->filled times are recorded, also if the run stopped; run->x is its last state at run->t. */
static inline enum dalembert_status dalembert_record_run(dalembert_record* r, dalembert_run* run, const double* x) {
    enum dalembert_status status;
    r->filled = r->event_count = r->event_room = 0;
    r->events = NULL;
    r->is_full = 0;
    if (r->count == 0) return dalembert_bad_options;
    run->context = r;
    run->on_step = dalembert_record_step;
    run->on_event = dalembert_record_event;
    status = dalembert_run_start(run, r->times[0], r->times[r->count - 1], x);
    if (status != dalembert_good) return status;
    for (;;) {
        memcpy(r->x + r->filled * run->plant->states, run->x, run->plant->states * sizeof(double));
        r->mode[r->filled++] = run->mode;
        if (r->filled == r->count) break;
        status = dalembert_run_to(run, r->times[r->filled]);
        if (r->is_full) return dalembert_no_memory;
        if (status != dalembert_good) break;
    }
    return status;
}

/* Frees the list of events. */
static inline void dalembert_record_free(dalembert_record* r) {
    free(r->events);
    r->events = NULL;
    r->event_count = r->event_room = 0;
}

#endif
