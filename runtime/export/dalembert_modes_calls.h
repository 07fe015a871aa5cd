/* SPDX-License-Identifier: BSL-1.0 */
/* What callers call: memory, begin, events, and saved states; see dalembert_modes.h. */
#ifndef DALEMBERT_MODES_CALLS_H
#define DALEMBERT_MODES_CALLS_H

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
    m->u_half = dalembert_numbers(room, p->inputs + 1);
    m->u_whole = dalembert_numbers(room, p->inputs + 1);
    m->g_half = dalembert_numbers(room, values + 1);
    m->g_whole = dalembert_numbers(room, values + 1);
    m->s = dalembert_numbers(room, 2 * p->time_switches);
    m->dxdt = dalembert_numbers(room, p->states);
    m->before = dalembert_numbers(room, p->states);
    m->after = dalembert_numbers(room, p->states);
    if (p->is_projected) m->projection = dalembert_numbers(room, dalembert_projection_room(p));
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
    m->kept->span = span > 0 ? span : 1;
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
        dalembert_go_on(m, m->mode, x, t, since + dalembert_smallest(m->kept->span, t), 0, m->after);
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
        /* What an input that jumps takes below zero has not fallen along the motion: most of that would be longer than any step beyond. */
        if (!m->is_exact && since <= m->kept->span / 1000) dalembert_move_back(m, event, since, *t, x);
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
