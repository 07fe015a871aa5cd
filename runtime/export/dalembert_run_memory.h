/* SPDX-License-Identifier: BSL-1.0 */
/* The memory of a run, and its first contents. */
#ifndef DALEMBERT_RUN_MEMORY_H
#define DALEMBERT_RUN_MEMORY_H

#include "dalembert_steps.h"

/* An event has changed the mode. */
static inline void dalembert_on_change(void* context, double t, const double* x, size_t event, unsigned before, unsigned after,
                                       int is_end) {
    dalembert_run* const run = (dalembert_run*)context;
    (void)x;
    (void)is_end;
    run->mode = after;
    if (run->on_event != NULL && !run->inside->is_trial) run->on_event(run->context, run, t, event, before, after);
}

/* To the end of accumulated events, first to see whether there is another one before. */
static inline int dalembert_coast(void* context, const unsigned char* is_ignored, double end, double* t, double* x) {
    dalembert_run* const run = (dalembert_run*)context;
    dalembert_inside* const in = run->inside;
    const double begin = *t;
    int is_alone = 1;
    in->kept->has_jump = 0;
    memcpy(in->coast_x, x, run->plant->states * sizeof(double));
    in->is_ignored = is_ignored;
    ++in->is_trial;
    for (int look = 0; look < 2 && is_alone; ++look) {
        in->kept->goes_on = 0;
        is_alone = dalembert_integrate(run, end) == dalembert_good;
        if (look == 0) --in->is_trial;
        if (look > 0 && is_alone) break;
        in->kept->has_jump = 0;
        *t = begin;
        memcpy(x, in->coast_x, run->plant->states * sizeof(double));
    }
    in->is_ignored = NULL;
    in->kept->goes_on = 0;
    return is_alone;
}

static inline void dalembert_lay_candidate(dalembert_candidate* c, size_t n, dalembert_room* room) {
    c->y = dalembert_numbers(room, n);
    c->error = dalembert_numbers(room, n);
    c->dydt = dalembert_numbers(room, n);
}

static inline void dalembert_lay_polynomial(dalembert_polynomial* p, size_t count, size_t n, dalembert_room* room) {
    for (size_t i = 0; i < count; ++i) p->slopes[i] = dalembert_numbers(room, n);
}

/* All arrays of a run; what is saved comes first. */
static inline void dalembert_lay_run(dalembert_run* run, dalembert_inside* in, dalembert_room* room) {
    const dalembert_plant* const p = run->plant;
    const size_t n = p->states, g = dalembert_event_values(p), m = p->modes == 0 && p->is_projected ? p->constraints : 0;
    const size_t begin = room->size;
    in->kept_block = (char*)dalembert_take(room, 0, 1);
    in->kept = (dalembert_run_memory*)dalembert_take(room, 1, sizeof(dalembert_run_memory));
    run->x = dalembert_numbers(room, n);
    run->scale = dalembert_numbers(room, n);
    in->dxdt = dalembert_numbers(room, n);
    in->radius = dalembert_numbers(room, n);
    in->watches = (dalembert_watch*)dalembert_take(room, g, sizeof(dalembert_watch));
    in->row_sizes = dalembert_numbers(room, m);
    in->is_used = (int*)dalembert_take(room, m, sizeof(int));
    in->chosen = (int*)dalembert_take(room, m, sizeof(int));
    dalembert_modes_lay_kept(&in->modes, room);
    in->kept_size = room->size - begin;

    dalembert_modes_lay_work(&in->modes, room);
    in->u = dalembert_numbers(room, p->inputs + 1);
    in->u_ahead = dalembert_numbers(room, p->inputs + 1);
    in->u_behind = dalembert_numbers(room, p->inputs + 1);
    in->prepared_u = dalembert_numbers(room, p->inputs + 1);
    for (int i = 0; i < 16; ++i) in->k[i] = dalembert_numbers(room, n);
    for (int i = 0; i < 4; ++i) in->dense[i] = dalembert_numbers(room, n);
    double** const of_states[] = {&in->stage,   &in->other, &in->difference, &in->from_x, &in->from_dxdt, &in->next_x,
                                  &in->start_x, &in->dfdt,  &in->prepared_x, &in->reach,  &in->rounding,  &in->coast_x};
    for (size_t i = 0; i < sizeof(of_states) / sizeof(of_states[0]); ++i) *of_states[i] = dalembert_numbers(room, n);
    dalembert_lay_candidate(&in->c, n, room);
    dalembert_lay_candidate(&in->part, n, room);
    dalembert_lay_candidate(&in->behind, n, room);
    in->ends = (unsigned char*)dalembert_take(room, g, 1);
    in->is_strict = (unsigned char*)dalembert_take(room, g, 1);
    in->begins_at_zero = (unsigned char*)dalembert_take(room, g, 1);
    in->side = (int*)dalembert_take(room, g, sizeof(int));
    double** const of_guards[] = {&in->at_start, &in->at_before, &in->sample,      &in->lowest,     &in->low,
                                  &in->at_end,   &in->found,     &in->near_values, &in->far_values, &in->seen};
    for (size_t i = 0; i < sizeof(of_guards) / sizeof(of_guards[0]); ++i) *of_guards[i] = dalembert_numbers(room, g);

    dalembert_find_band(p, &in->J);
    in->W = in->J;
    in->W.is_factored = 1;
    const size_t* const starts = p->pattern_x.column_starts;
    const size_t* const starts_u = p->pattern_u.column_starts;
    in->has_matrix = n > 0 && p->rhs_and_jacobian != NULL && dalembert_band_height(&in->W) <= (((size_t)1) << 22) / n;
    if (in->has_matrix) {
        in->J_values = dalembert_numbers(room, starts != NULL ? starts[n] : n * n);
        in->J_u = dalembert_numbers(room, starts_u != NULL ? starts_u[p->inputs] : n * p->inputs);
        in->J.entries = dalembert_numbers(room, n * dalembert_band_height(&in->J));
        in->W.entries = dalembert_numbers(room, n * dalembert_band_height(&in->W));
        in->W.sizes = dalembert_numbers(room, n);
        in->W.exchanges = (size_t*)dalembert_take(room, n, sizeof(size_t));
    }
    if (m > 0) {
        in->weighted = dalembert_numbers(room, 2 * m * p->degrees + p->degrees * p->degrees);
        in->gram = dalembert_numbers(room, 2 * m * m + m);
        in->pivots = dalembert_numbers(room, m);
        in->pivots_of_chosen = dalembert_numbers(room, m);
        in->order = (size_t*)dalembert_take(room, m, sizeof(size_t));
        in->order_of_chosen = (size_t*)dalembert_take(room, m, sizeof(size_t));
        in->is_held = (int*)dalembert_take(room, m, sizeof(int));
        in->is_done = (unsigned char*)dalembert_take(room, m, 1);
        dalembert_lay_polynomial(&in->guess, 3, n, room);
        dalembert_lay_polynomial(&in->long_step, 9, n, room);
        dalembert_lay_polynomial(&in->other_step, 7, n, room);
    }
}

static inline dalembert_run* dalembert_run_new(const dalembert_plant* plant, void* self) {
    dalembert_run run;
    dalembert_inside counted;
    dalembert_room room = {NULL, 0};
    memset(&run, 0, sizeof(run));
    memset(&counted, 0, sizeof(counted));
    run.plant = plant;
    dalembert_modes_set(&counted.modes, plant, self);
    (void)dalembert_take(&room, 1, sizeof(run));
    (void)dalembert_take(&room, 1, sizeof(counted));
    dalembert_lay_run(&run, &counted, &room);
    room.block = (char*)calloc(1, room.size);
    if (room.block == NULL) return NULL;
    room.size = 0;
    dalembert_run* const made = (dalembert_run*)dalembert_take(&room, 1, sizeof(run));
    dalembert_inside* const in = (dalembert_inside*)dalembert_take(&room, 1, sizeof(counted));
    made->plant = plant;
    made->self = self;
    made->inside = in;
    made->options.tolerance = 1e-9;
    made->options.finds_scales = 1;
    made->options.most_steps = 100000000;
    made->options.most_events = 100000;
    made->blamed = made->last_event = DALEMBERT_NONE;
    dalembert_modes_set(&in->modes, plant, self);
    dalembert_lay_run(made, in, &room);
    in->modes.context = made;
    in->modes.on_change = dalembert_on_change;
    in->modes.coast = dalembert_coast;
    in->modes.is_exact = 1;
    in->guards = dalembert_event_values(plant);
    in->spares_stages = plant->modes > 0;
    for (size_t i = 0; i < in->guards; ++i) {
        in->ends[i] = plant->modes > 0 ? i < plant->events : plant->guard_table[i].ends != 0;
        in->has_kinks = in->has_kinks || (plant->modes > 0 && !in->ends[i]);
    }
    for (size_t i = 0; plant->constraint_rank > 0 && in->is_held != NULL && i < plant->constraints; ++i)
        in->is_held[i] = !plant->constraint_table[i].can_be_left_out;
    for (size_t i = 0; i < plant->states; ++i) made->scale[i] = 1;
    return made;
}
static inline void dalembert_run_free(dalembert_run* run) { free(run); }

#endif
