/* SPDX-License-Identifier: BSL-1.0 */
/* What callers call: memory, start, end, scales, and saved states of a run; see dalembert_run.h. */
#ifndef DALEMBERT_RUN_CALLS_H
#define DALEMBERT_RUN_CALLS_H

#include <stdio.h>

#include "dalembert_steps.h"

/* An event has changed the mode. */
static inline void dalembert_on_change(void* context, double t, const double* x, size_t event, unsigned before, unsigned after, int is_end) {
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
    memcpy(in->coast_x, x, run->plant->states * sizeof(double));
    in->is_ignored = is_ignored;
    ++in->is_trial;
    for (int look = 0; look < 2 && is_alone; ++look) {
        in->kept->goes_on = 0;
        is_alone = dalembert_integrate(run, end) == dalembert_good;
        if (look == 0) --in->is_trial;
        if (look > 0 && is_alone) break;
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
    double** const of_states[] = {&in->stage,   &in->other,   &in->difference, &in->from_x, &in->from_dxdt, &in->next_x,
                                  &in->start_x, &in->dfdt,    &in->prepared_x, &in->reach,  &in->rounding,
                                  &in->coast_x};
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
        in->W.exchanges = (size_t*)dalembert_take(room, n, sizeof(size_t));
    }
    if (p->modes == 0 && p->is_projected) in->projection = dalembert_numbers(room, dalembert_projection_room(p));
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

/* What the modes of a run need to know of its caller's wishes. */
static inline void dalembert_tell_modes(dalembert_run* run, double limit) {
    run->inside->modes.inputs = run->inputs;
    run->inside->modes.most_events = run->options.most_events;
    run->inside->modes.limit = limit;
}

static inline enum dalembert_status dalembert_end_call(dalembert_run* run, enum dalembert_status status) {
    dalembert_inside* const in = run->inside;
    run->mode = in->modes.mode;
    run->events = in->modes.changes + in->kept->kinks_passed;
    run->last_event = run->plant->modes == 0 && in->event != DALEMBERT_NONE ? in->event : in->modes.last_event;
    if (status != dalembert_good && status != dalembert_stopped) in->kept->is_started = 0;
    return status;
}

/* Begins at t, with what is in run->x. */
static inline enum dalembert_status dalembert_begin_run(dalembert_run* run, double t, double span) {
    const dalembert_plant* const p = run->plant;
    dalembert_inside* const in = run->inside;
    dalembert_run_memory* const k = in->kept;
    memset(k, 0, sizeof(*k));
    run->t = k->from = k->mark = t;
    k->span = span;
    k->patience = 2;
    k->now.value = 1;
    run->steps = run->rejected = run->rhs_calls = run->jacobians = run->implicit_steps = 0;
    run->blamed = in->event = DALEMBERT_NONE;
    in->is_ignored = NULL;
    in->is_watching = in->is_cut = in->is_prepared = in->stops = 0;
    in->from_t = t;
    memset(in->radius, 0, p->states * sizeof(double));
    dalembert_tell_modes(run, HUGE_VAL);
    if (dalembert_has_measure(run)) {
        memset(in->row_sizes, 0, p->constraints * sizeof(double));
        for (size_t i = 0; i < p->constraints; ++i) {
            in->is_used[i] = p->constraint_rank > 0;
            in->chosen[i] = p->constraint_table[i].solved_for_at_start;
        }
        if (p->constraint_rank > 0) p->solve_for(run->self, in->chosen);
    }
    if (run->options.method == dalembert_rosenbrock && !in->has_matrix) return dalembert_bad_options;
    if (!dalembert_all_finite(p->states, run->x)) return dalembert_blame(run, 0);
    (void)dalembert_project_run(run, t, run->x);
    if (dalembert_is_broken(run)) return dalembert_constraint_broken;
    const enum dalembert_status status = dalembert_modes_begin(&in->modes, t, span, run->x);
    k->is_started = status == dalembert_good;
    return status;
}

static inline enum dalembert_status dalembert_run_to(dalembert_run* run, double t_end) {
    dalembert_inside* const in = run->inside;
    dalembert_run_memory* const k = in->kept;
    if (!k->is_started || !(t_end >= run->t) || !isfinite(t_end) || !(run->options.tolerance > 0)) return dalembert_bad_options;
    enum dalembert_status status = dalembert_good;
    dalembert_tell_modes(run, t_end);
    in->stops = 0;
    while (status == dalembert_good && !in->stops && t_end - run->t > dalembert_tiny(&in->modes, t_end)) {
        in->event = DALEMBERT_NONE;
        status = dalembert_integrate(run, t_end);
        if (status != dalembert_range_left || run->plant->modes == 0) continue;
        k->goes_on = 0;
        status = dalembert_pass_all(&in->modes, &run->t, run->x, in->event);
    }
    if (status == dalembert_good && in->stops) status = dalembert_stopped;
    if (status == dalembert_good) run->t = t_end; /* a rounding or so away */
    return dalembert_end_call(run, status);
}

static inline enum dalembert_status dalembert_run_changed(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    if (!in->kept->is_started) return dalembert_bad_options;
    dalembert_tell_modes(run, HUGE_VAL);
    in->kept->goes_on = 0;
    (void)dalembert_project_run(run, run->t, run->x);
    if (dalembert_is_broken(run)) return dalembert_end_call(run, dalembert_constraint_broken);
    double t = run->t;
    return dalembert_end_call(run, dalembert_modes_event(&in->modes, &t, run->x));
}

static inline void dalembert_run_between(dalembert_run* run, double t, double* x) {
    dalembert_inside* const in = run->inside;
    const dalembert_point from = {in->from_x, in->from_dxdt, in->from_t};
    const size_t n = run->plant->states;
    if (!(t < run->t)) memcpy(x, run->x, n * sizeof(double));
    else if (!(t > in->from_t)) memcpy(x, in->from_x, n * sizeof(double));
    else if (in->was_crossed) dalembert_polynomial_at(&in->long_step, n, (t - in->from_t) / in->long_step.h, x);
    else {
        const size_t blamed = run->blamed;
        dalembert_within_from(run, &from, &in->c, t, x);
        if (!dalembert_is_close(run, x, t)) (void)dalembert_project_run(run, t, x);
        run->blamed = blamed;
    }
}

/* A step of a rough run: how large states become, and what rounding leaves of their rates: how much these change with the last digits of the states. */
static inline int dalembert_note_sizes(void* context, dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    (void)context;
    if (run->t < in->next_sample) return 0;
    in->next_sample = run->t + run->options.longest_step;
    dalembert_inputs_at(&in->modes, run->t, run->x, in->u);
    run->plant->rhs(run->self, in->modes.mode, run->x, in->u, run->t, in->difference);
    for (size_t i = 0; i < n; ++i)
        if (isfinite(run->x[i])) in->reach[i] = fmax(in->reach[i], fabs(run->x[i]));
    for (size_t period = 1; period <= 2; ++period) {
        for (size_t i = 0; i < n; ++i) in->other[i] = run->x[i] + (i / period % 2 == 0 ? 2 : -2) * DBL_EPSILON * run->x[i];
        run->plant->rhs(run->self, in->modes.mode, in->other, in->u, run->t, in->stage);
        for (size_t i = 0; i < n; ++i) {
            const double rounding = fabs(in->stage[i] - in->difference[i]);
            if (isfinite(rounding)) in->rounding[i] = fmax(in->rounding[i], rounding);
        }
    }
    return 0;
}

/* The scale of each state, in SI: the largest magnitude that it reaches in a rough run from run->x, where this is less than one unit. Errors are measured against
 * the larger one of this and of the present magnitude, so that a valve stroke of a tenth of a millimetre has as many digits as a way of metres. A state that
 * rests at zero but for roundings counts in whole units. Where the rough run stops, the sizes are those up to there. A size stops where the digits that the
 * tolerance asks for are no longer there: where what rounding leaves of a rate, over the longest step, would be an error that counts. */
static inline void dalembert_find_scales(dalembert_run* run, double t, double span) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    const double rest = 10000 * DBL_EPSILON;
    const dalembert_run wishes = *run;
    memcpy(in->start_x, run->x, n * sizeof(double));
    memset(in->rounding, 0, n * sizeof(double));
    for (size_t i = 0; i < n; ++i) run->scale[i] = fabs(run->x[i]) > rest ? fmin(1, fabs(run->x[i])) : 1;
    /* Against sizes that are much too large a rough run says little about small states: it is repeated with what it found. */
    for (int again = 0, is_good = 0; again < 5 && !is_good; ++again) {
        run->options.tolerance = 1e-3;
        run->options.longest_step = span / 500;
        run->options.most_steps = 100000;
        run->on_step = dalembert_note_sizes;
        run->on_event = NULL;
        in->next_sample = t;
        memcpy(run->x, in->start_x, n * sizeof(double));
        for (size_t i = 0; i < n; ++i) in->reach[i] = fabs(run->x[i]);
        if (dalembert_begin_run(run, t, span) == dalembert_good) (void)dalembert_run_to(run, t + span);
        is_good = 1;
        for (size_t i = 0; i < n; ++i) {
            const double found = in->reach[i] > rest ? fmin(1, in->reach[i]) : 1;
            is_good = is_good && found > run->scale[i] / 10;
            run->scale[i] = found;
        }
    }
    run->options = wishes.options;
    run->on_step = wishes.on_step;
    run->on_event = wishes.on_event;
    for (size_t i = 0; i < n; ++i) run->scale[i] = fmax(run->scale[i], fmin(1e-3, 4 * in->rounding[i] * (span / 500) / run->options.tolerance));
    if (dalembert_has_measure(run)) { /* bringing velocities back to constraints leaves them about twelve digits of the largest one */
        const double least = fmin(1, 1e-12 / run->options.tolerance) * dalembert_largest(n, run->scale);
        for (size_t i = 0; i < n; ++i) run->scale[i] = fmax(run->scale[i], least);
    }
    memcpy(run->x, in->start_x, n * sizeof(double));
}

static inline enum dalembert_status dalembert_run_start(dalembert_run* run, double t, double until, const double* x) {
    const size_t n = run->plant->states;
    const double span = until > t ? until - t : 1;
    if (x == NULL) run->plant->start_state(run->self, run->x);
    else if (x != run->x) memcpy(run->x, x, n * sizeof(double));
    if (!isfinite(t) || !isfinite(span) || !(run->options.tolerance > 0)) return dalembert_bad_options;
    if (run->options.finds_scales && dalembert_all_finite(n, run->x)) dalembert_find_scales(run, t, span);
    for (size_t i = 0; i < n; ++i)
        if (!(run->scale[i] > 0)) return dalembert_bad_options;
    return dalembert_end_call(run, dalembert_begin_run(run, t, span));
}

static inline void dalembert_run_message(const dalembert_run* run, enum dalembert_status status, char* text, size_t size) {
    const dalembert_plant* const p = run->plant;
    const char* what = "";
    const char* name = "";
    if ((status == dalembert_not_finite || status == dalembert_step_too_small) && run->blamed < p->states) {
        what = ": state ";
        name = p->state_table[run->blamed].name;
    } else if ((status == dalembert_constraint_broken || status == dalembert_singular_position) && run->blamed < p->constraints) {
        what = ": constraint ";
        name = p->constraint_table[run->blamed].name;
    } else if (p->modes > 0 && run->last_event < p->events && status != dalembert_good && status != dalembert_stopped) {
        what = ": event ";
        name = p->event_names[run->last_event];
    } else if (p->modes == 0 && run->last_event < p->guards && (status == dalembert_range_left || status == dalembert_event_storm)) {
        what = ": ";
        name = p->guard_table[run->last_event].doc;
    }
    (void)snprintf(text, size, "At t = %g s: %s%s%s.", run->t, dalembert_status_text(status), what, name);
}

static inline size_t dalembert_run_saved_size(const dalembert_run* run) { return run->inside->kept_size; }

static inline void dalembert_run_save(const dalembert_run* run, void* block) {
    dalembert_run_memory* const k = run->inside->kept;
    k->t = run->t;
    k->steps = run->steps;
    k->rejected = run->rejected;
    k->rhs_calls = run->rhs_calls;
    k->jacobians = run->jacobians;
    k->implicit_steps = run->implicit_steps;
    dalembert_modes_note(&run->inside->modes);
    memcpy(block, run->inside->kept_block, run->inside->kept_size);
}

static inline void dalembert_run_load(dalembert_run* run, const void* block) {
    dalembert_inside* const in = run->inside;
    memcpy(in->kept_block, block, in->kept_size);
    dalembert_modes_recall(&in->modes);
    run->t = in->kept->t;
    run->steps = in->kept->steps;
    run->rejected = in->kept->rejected;
    run->rhs_calls = in->kept->rhs_calls;
    run->jacobians = in->kept->jacobians;
    run->implicit_steps = in->kept->implicit_steps;
    for (size_t i = 0; i < in->guards; ++i) in->side[i] = in->watches[i].settled;
    in->is_prepared = in->is_cut = 0;
    if (run->plant->constraint_rank > 0 && dalembert_has_measure(run)) run->plant->solve_for(run->self, in->chosen);
    (void)dalembert_end_call(run, dalembert_good);
}

#endif
