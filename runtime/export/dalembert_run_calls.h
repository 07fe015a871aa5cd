/* SPDX-License-Identifier: BSL-1.0 */
/* What callers call: start, end, states between, messages, and saved states of a run; see dalembert_run.h. */
#ifndef DALEMBERT_RUN_CALLS_H
#define DALEMBERT_RUN_CALLS_H

#include <stdio.h>

#include "dalembert_run_memory.h"
#include "dalembert_steps.h"

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
    /* Of what switches the mode is not known yet: dalembert_integrate() does it there. */
    if (p->modes == 0) (void)dalembert_project_run(run, t, run->x);
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
    k->has_jump = 0; /* held inputs may be others */
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
    if (!(t < run->t))
        memcpy(x, run->x, n * sizeof(double));
    else if (!(t > in->from_t))
        memcpy(x, in->from_x, n * sizeof(double));
    else if (in->was_crossed)
        dalembert_polynomial_at(&in->long_step, n, (t - in->from_t) / in->long_step.h, x);
    else {
        const size_t blamed = run->blamed;
        dalembert_within_from(run, &from, &in->c, t, x);
        if (!dalembert_is_close(run, x, t)) (void)dalembert_project_in(run, in->from_mode, t, x);
        run->blamed = blamed;
    }
}

#include "dalembert_scales.h"

static inline enum dalembert_status dalembert_run_start(dalembert_run* run, double t, double until, const double* x) {
    const size_t n = run->plant->states;
    const double span = until > t ? until - t : 1;
    if (x == NULL)
        run->plant->start_state(run->self, run->x);
    else if (x != run->x)
        memcpy(run->x, x, n * sizeof(double));
    if (!isfinite(t) || !isfinite(span) || !(run->options.tolerance > 0)) return dalembert_bad_options;
    if (run->options.finds_scales && dalembert_all_finite(n, run->x)) dalembert_find_scales(run, t, span);
    for (size_t i = 0; i < n; ++i)
        if (!(run->scale[i] > 0)) return dalembert_bad_options;
    const enum dalembert_status status = dalembert_begin_run(run, t, span);
    run->inside->kept->has_end = until > t;
    return dalembert_end_call(run, status);
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
