/* SPDX-License-Identifier: BSL-1.0 */
/* Drives a run: a step that can be accepted, an event that is passed, an end that is named. */
#ifndef DALEMBERT_STEPS_H
#define DALEMBERT_STEPS_H

#include "dalembert_choice.h"
#include "dalembert_control.h"
#include "dalembert_dop853.h"

static inline void dalembert_make_step(dalembert_run* run, dalembert_candidate* c) {
    const dalembert_point here = dalembert_here(run);
    if (run->inside->kept->is_implicit)
        dalembert_rodas5p_take(run, &here, c);
    else
        dalembert_dop853_take(run, &here, c);
}
/* The state at t within the step that was made last. */
static inline void dalembert_within_from(dalembert_run* run, const dalembert_point* from, const dalembert_candidate* c, double t,
                                         double* x) {
    if (run->inside->kept->is_implicit)
        dalembert_rodas5p_between(run, from, c, t, x);
    else
        dalembert_dop853_between(run, from, c, t, x);
}
static inline void dalembert_within(dalembert_run* run, const dalembert_candidate* c, double t, double* x) {
    const dalembert_point here = dalembert_here(run);
    dalembert_within_from(run, &here, c, t, x);
}

#include "dalembert_events.h"
#include "dalembert_singular.h"

/* Names the state to blame: not finite itself, or else the one whose derivative is at x or a little further on. */
static inline enum dalembert_status dalembert_blame(dalembert_run* run, double further) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    memcpy(in->other, run->x, n * sizeof(double));
    run->blamed = DALEMBERT_NONE;
    for (int look = 0; look < 2 && run->blamed == DALEMBERT_NONE; ++look) {
        dalembert_rate(run, in->other, run->t + (look > 0 ? further : 0), in->difference);
        for (size_t i = n; i-- > 0;)
            if (!isfinite(in->difference[i])) run->blamed = i;
        for (size_t i = n; i-- > 0;)
            if (!isfinite(in->other[i])) run->blamed = i;
        for (size_t i = 0; i < n; ++i) in->other[i] += further * in->difference[i];
    }
    return dalembert_not_finite;
}

static inline enum dalembert_status dalembert_end_at(dalembert_run* run, enum dalembert_status status, size_t guard) {
    run->inside->event = guard;
    return status;
}

/* A step that cannot be made next to the zero of a guard that ends the run, or next to a singular position, ends because of that. */
static inline enum dalembert_status dalembert_stop(dalembert_run* run, enum dalembert_status status) {
    if ((status == dalembert_not_finite || status == dalembert_step_too_small) && run->inside->guards > 0) {
        const size_t guard = dalembert_vanishing_guard(run);
        if (guard != DALEMBERT_NONE) return dalembert_end_at(run, dalembert_range_left, guard);
    }
    if (status == dalembert_not_finite) status = dalembert_blame(run, 64 * dalembert_smallest(run->inside->kept->span, run->t));
    return dalembert_named_singular(run, status);
}

static inline void dalembert_move(dalembert_run* run, double t, const double* x) {
    run->t = t;
    if (x != run->x) memcpy(run->x, x, run->plant->states * sizeof(double));
}

/* Where the right-hand side is smooth across guards, it is not they that cut a step short that runs into an input that jumps. */
static inline int dalembert_is_sure_of_end(const dalembert_run* run) {
    return !run->inside->spares_stages && dalembert_ending_guard(run->inside) != DALEMBERT_NONE;
}

static inline int dalembert_project_in(dalembert_run* run, unsigned mode, double t, double* x) {
    if (!run->plant->is_projected) return 0;
    run->blamed = dalembert_project(run->plant, run->self, mode, t, x, run->inside->modes.projection);
    return 1;
}
static inline int dalembert_project_run(dalembert_run* run, double t, double* x) {
    return dalembert_project_in(run, run->inside->modes.mode, t, x);
}
static inline int dalembert_is_broken(const dalembert_run* run) {
    return run->plant->is_projected && run->blamed != DALEMBERT_NONE;
}

static inline void dalembert_accept(dalembert_run* run, const dalembert_candidate* c) {
    dalembert_inside* const in = run->inside;
    dalembert_run_memory* const k = in->kept;
    const size_t n = run->plant->states;
    if (c->length > 0) {
        ++run->steps;
        ++k->accepted;
        k->longest = fmax(k->longest, c->length);
        if (k->is_implicit) ++run->implicit_steps;
    }
    memcpy(in->from_x, run->x, n * sizeof(double));
    memcpy(in->from_dxdt, in->dxdt, n * sizeof(double));
    in->from_t = run->t;
    in->from_mode = in->modes.mode;
    in->was_crossed = 0;
    dalembert_move(run, c->end, c->y);
    for (size_t i = 0; i < in->guards; ++i) in->watches[i].settled = in->side[i];
    /* On the zero of a guard that ends the run the right-hand side may have no value. */
    if (in->guards > 0 && in->is_cut && dalembert_is_sure_of_end(run)) {
        memcpy(in->dxdt, c->dydt, n * sizeof(double));
        return;
    }
    const int is_moved = in->guards > 0 && in->is_cut ? 0 : dalembert_project_run(run, run->t, run->x);
    if (c->has_derivative && !is_moved)
        memcpy(in->dxdt, c->dydt, n * sizeof(double));
    else
        dalembert_rate(run, run->x, run->t, in->dxdt);
}

/* Makes the step; with guards, only up to its first event. */
static inline void dalembert_try_step(dalembert_run* run, dalembert_candidate* c) {
    dalembert_inside* const in = run->inside;
    if (in->guards == 0)
        dalembert_make_step(run, c);
    else
        dalembert_search(run, c, dalembert_tiny(&in->modes, run->t), dalembert_resolution(run, c->end));
}

#include "dalembert_passing.h"

/* Whether the rest of the run takes more than most_steps at the pace of the last 2 million, so that it ends in seconds and not in
 * minutes. */
static inline int dalembert_is_hopeless(dalembert_run* run) {
    dalembert_run_memory* const k = run->inside->kept;
    const size_t tries = run->steps + run->rejected;
    if (tries - k->tries_at_mark < 2000000) return 0;
    const double pace = (run->t - k->mark) / (double)(tries - k->tries_at_mark);
    k->mark = run->t;
    k->tries_at_mark = tries;
    return pace * (double)run->options.most_steps < run->inside->to - run->t;
}

/* The longest step where the caller does not say. */
static inline double dalembert_longest_step(const dalembert_run* run) {
    const dalembert_plant* const p = run->plant;
    if (run->options.longest_step > 0) return run->options.longest_step;
    const int may_miss = run->inside->guards > 0 || p->constraints > 0 || p->jacobian_t != NULL || run->inputs.function != NULL;
    return may_miss && run->inside->kept->has_end ? run->inside->kept->span / 500 : HUGE_VAL;
}

/* One step that can be accepted, of at most h and not beyond `target`; leaves the size of the next one in h. */
static inline enum dalembert_status dalembert_acceptable_step(dalembert_run* run, double target) {
    dalembert_inside* const in = run->inside;
    dalembert_run_memory* const k = in->kept;
    dalembert_candidate* const c = &in->c;
    const double limit = target - run->t, longest = dalembert_longest_step(run);
    int not_finite = 0;
    while (1) {
        if (run->steps + run->rejected >= run->options.most_steps || dalembert_is_hopeless(run)) return dalembert_too_many_steps;
        if (k->h > longest) k->h = longest;
        int clipped = k->h >= limit;
        c->length = clipped ? limit : k->h;
        c->end = clipped ? target : run->t + c->length;
        if (!(c->length > dalembert_smallest(k->span, run->t)) && !clipped)
            return not_finite ? dalembert_not_finite : dalembert_step_too_small;
        dalembert_choose_method(run);
        dalembert_try_step(run, c);
        clipped = clipped || in->is_cut;
        if (c->is_finite && !in->is_cut && k->is_implicit) {
            const dalembert_point here = dalembert_here(run);
            dalembert_rodas5p_check(run, &here, c);
        }
        const double e = c->is_finite ? dalembert_error_norm(run, run->x, c->y, c->error) : 0;
        if (!c->is_finite || !(e <= 1) || (in->guards > 0 && !dalembert_keeps_rest(run, c->y, c->end)) ||
            (!in->is_cut && dalembert_spoils_constraints(run, c))) {
            not_finite = not_finite || !c->is_finite;
            if (c->is_finite) run->blamed = dalembert_worst(run, c);
            ++run->rejected;
            k->h = c->length * (e <= 1 ? 0.25 : dalembert_factor_of_failure(run, e));
            continue;
        }
        /* After a step that was cut to end on a given time, the size from before is as good a guess as ever. */
        const double factor = dalembert_factor(run, e);
        k->h = clipped ? fmax(k->h, c->length * factor) : c->length * factor;
        return dalembert_good;
    }
}

/* A new beginning: after the start, an event that changes the mode, or a change from outside. */
static inline enum dalembert_status dalembert_begin_anew(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    dalembert_run_memory* const k = in->kept;
    const size_t n = run->plant->states;
    k->part_events = k->stalled = 0;
    k->last_error = 0;
    k->tried = k->accepted = k->often = k->stint = 0;
    k->longest = 0;
    in->is_prepared = 0;
    in->is_cut = 0;
    if (run->options.method != dalembert_automatic) dalembert_choose_method(run);
    if (!dalembert_all_finite(n, run->x)) return dalembert_blame(run, 0);
    (void)dalembert_project_run(run, run->t, run->x);
    if (dalembert_is_broken(run)) return dalembert_constraint_broken;
    dalembert_rate(run, run->x, run->t, in->dxdt);
    if (!dalembert_all_finite(n, run->x) || !dalembert_all_finite(n, in->dxdt)) return dalembert_blame(run, 0);
    if (in->guards > 0) {
        const size_t guard = dalembert_start_guards(run);
        if (dalembert_any_nan(in->guards, in->found)) return dalembert_not_finite;
        if (guard != DALEMBERT_NONE) return dalembert_end_at(run, dalembert_range_left, guard);
        dalembert_leave_zero(run);
    }
    k->h = dalembert_first_step(run);
    k->goes_on = 1;
    return dalembert_good;
}

/* In the present mode up to `to`, or to an event: dalembert_range_left, with its number in inside->event. */
static inline enum dalembert_status dalembert_integrate(dalembert_run* run, double to) {
    dalembert_inside* const in = run->inside;
    dalembert_run_memory* const k = in->kept;
    const size_t n = run->plant->states;
    in->to = to;
    if (!k->goes_on) {
        const enum dalembert_status status = dalembert_begin_anew(run);
        if (status != dalembert_good) return status;
    }
    while (run->t < to && !in->stops) {
        double before, behind;
        int is_anew = 0;
        dalembert_next_stop(run, &before, &behind);
        double target = fmin(to, before);
        const enum dalembert_ahead ahead = dalembert_look_ahead(run, before, &target);
        if (ahead == dalembert_ahead_stuck) return dalembert_stop(run, dalembert_singular_position);
        if (ahead == dalembert_ahead_clear) {
            enum dalembert_status status = dalembert_acceptable_step(run, target);
            if (status != dalembert_good) return dalembert_stop(run, status);
            dalembert_accept(run, &in->c);
        }
        if (run->on_step != NULL && !in->is_trial && run->t > in->from_t) in->stops = run->on_step(run->context, run) != 0;
        if (ahead == dalembert_ahead_clear) {
            const enum dalembert_status status = dalembert_pass_event(run, &is_anew);
            if (status != dalembert_good) return status == dalembert_range_left ? status : dalembert_stop(run, status);
        }
        if (!(run->t < before) && !(run->t > before) && run->t < to) {
            const enum dalembert_status status = dalembert_pass_stop(run, behind);
            if (status != dalembert_good) return status;
        }
        if (!dalembert_all_finite(n, run->x) || !dalembert_all_finite(n, in->dxdt)) return dalembert_blame(run, 0);
        if (is_anew) k->h = dalembert_first_step(run);
    }
    return dalembert_good;
}

#endif
