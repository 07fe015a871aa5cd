/* SPDX-License-Identifier: BSL-1.0 */
/* Where guards change their sign: what is remembered of them, and the search for the first change within a step.
 *
 * Values here are those of the guards times their sides: negative means changed. A guard has a side, the sign that it had last; zero
 * belongs to the side where the guard comes from, and a guard that begins at zero takes the side to which it goes. A guard that ends the
 * run, or an event, is on the side >= 0.
 *
 * note [clean steps]: The right-hand side may jump or have a kink where a guard changes its sign, so a step is only worth its order when
 * none of its stages lies on the other side, or on the zero itself. All stages are therefore watched. A step that is not clean is
 * repeated from its beginning with other lengths (on its dense output the time would be as wrong as the step) until two neighbouring
 * lengths are known, of which the shorter one is clean. That step is taken, and integration starts anew behind the zero. When only a
 * stage of the longer step was on the other side, the zero is near, but not yet reached; what is missing shrinks like the error of a
 * stage, and the next step finds it. */
#ifndef DALEMBERT_EVENTS_H
#define DALEMBERT_EVENTS_H

#include "dalembert_bracket.h"
#include "dalembert_guards.h"

enum { dalembert_parts = 4, dalembert_most_cuts = 30 }; /* of a step, to look between; cuts in a row that bring no event */

/* A stage of the step that is being made. A later stage at its beginning is the start but for an error, which tells nothing of a guard
 * that is zero there. */
static inline void dalembert_see(dalembert_run* run, const double* x, double t) {
    dalembert_inside* const in = run->inside;
    dalembert_watched(run, x, t, in->seen);
    for (size_t i = 0; i < in->guards; ++i)
        if (in->seen[i] < in->lowest[i] && (in->sees_ends || !in->ends[i]) && !(in->begins_at_zero[i] && !(t > in->begin)))
            in->lowest[i] = in->seen[i];
}

/* Makes the step c, and notes the least values of its stages. */
static inline void dalembert_watch_step(dalembert_run* run, dalembert_candidate* c, int with_ends) {
    dalembert_inside* const in = run->inside;
    for (size_t i = 0; i < in->guards; ++i) in->lowest[i] = HUGE_VAL;
    in->sees_ends = with_ends;
    in->is_watching = with_ends || in->has_kinks;
    dalembert_make_step(run, c);
    in->is_watching = 0;
}

static inline void dalembert_copy_candidate(size_t n, dalembert_candidate* to, const dalembert_candidate* from) {
    to->length = from->length;
    to->end = from->end;
    to->has_derivative = from->has_derivative;
    to->is_finite = from->is_finite;
    memcpy(to->y, from->y, n * sizeof(double));
    memcpy(to->error, from->error, n * sizeof(double));
    memcpy(to->dydt, from->dydt, n * sizeof(double));
}

/* Makes the step c; see note [clean steps]. `low` are the least values of its stages and its end; where clean steps do not lead on,
 * those of its end alone, unless there are no numbers on the other side. */
static inline int dalembert_is_clean(dalembert_run* run, dalembert_candidate* c, double tiny, double* low) {
    dalembert_inside* const in = run->inside;
    const size_t n = in->guards;
    dalembert_watch_step(run, c, !in->spares_stages);
    if (in->spares_stages && !c->is_finite) dalembert_watch_step(run, c, 1);
    dalembert_watched(run, c->y, c->end, in->at_end);
    for (size_t i = 0; i < n; ++i)
        if (in->at_end[i] < in->lowest[i]) in->lowest[i] = in->at_end[i];
    if (dalembert_any_nan(n, in->at_end)) c->is_finite = 0;
    memcpy(low, in->kept->cuts < dalembert_most_cuts || !c->is_finite ? in->lowest : in->at_end, n * sizeof(double));
    if (!dalembert_is_beyond(in, low)) return 1;
    dalembert_copy_candidate(run->plant->states, &in->behind, c);
    memcpy(in->found, in->at_end, n * sizeof(double));
    /* What ends the run is found when it is near enough, whether or not there are numbers on the other side. */
    for (size_t i = 0; i < n; ++i)
        if (in->ends[i] && !(c->length > tiny) && !(in->found[i] < 0)) in->found[i] = low[i];
    return 0;
}

/* Closes the bracket (near, at_start) to (far, low) with repeated steps, the guess first, and leaves the longest clean step in c. */
static inline void dalembert_close(dalembert_run* run, dalembert_candidate* c, double far, double guess, double tiny, double resolution) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    dalembert_bracket bracket;
    dalembert_open_bracket(in, &bracket, run->t, in->at_start, far, in->low);
    c->length = c->end = 0;
    int is_first = guess > bracket.near && guess < bracket.far;
    while (!dalembert_is_closed(&bracket, resolution)) {
        in->part.end = is_first ? guess : dalembert_next_in_bracket(in, &bracket, resolution);
        in->part.length = in->part.end - run->t;
        is_first = 0;
        if (!dalembert_is_clean(run, &in->part, tiny, in->low)) {
            bracket.far = in->part.end;
            memcpy(in->far_values, in->low, in->guards * sizeof(double));
            continue;
        }
        dalembert_copy_candidate(n, c, &in->part);
        if (!c->is_finite || !dalembert_is_accurate(run, c)) return; /* nor would a longer one be */
        bracket.near = in->part.end;
        memcpy(in->near_values, in->low, in->guards * sizeof(double));
    }
    in->is_cut = 1;
    c->end = bracket.near;
    c->length = c->end - run->t;
    if (c->end > run->t) {
        dalembert_make_step(run, c); /* the method knows the step again, for its dense output */
        return;
    }
    memcpy(c->y, run->x, n * sizeof(double));
    memcpy(c->dydt, in->dxdt, n * sizeof(double));
    memset(c->error, 0, n * sizeof(double));
    c->has_derivative = 0;
    c->is_finite = in->kept->cuts < dalembert_most_cuts || dalembert_any_negative(in->guards, in->found);
    if (!c->is_finite) c->length = in->behind.length;
}

/* Makes the step c from where the run is, and cuts it at its first event. Looks at its stages, its end and, if it is accurate, three
 * points between. What cannot be taken is left in the candidate: not finite, or not accurate enough. */
static inline void dalembert_search(dalembert_run* run, dalembert_candidate* c, double tiny, double resolution) {
    dalembert_inside* const in = run->inside;
    const size_t n = in->guards;
    const double t = run->t;
    in->is_cut = 0;
    dalembert_notice(run);
    for (size_t i = 0; i < n; ++i) in->side[i] = in->watches[i].settled;
    dalembert_watched(run, run->x, t, in->at_start);
    for (size_t i = 0; i < n; ++i) {
        in->is_strict[i] = !in->kept->may_touch && !in->ends[i] && in->at_start[i] > 0;
        in->begins_at_zero[i] = in->ends[i] && !(in->at_start[i] > 0 || in->at_start[i] < 0);
    }
    in->begin = t;
    int is_step = dalembert_is_clean(run, c, tiny, in->low);
    const int inside = c->is_finite && dalembert_is_accurate(run, c);
    double before = t;
    memcpy(in->at_before, in->at_start, n * sizeof(double));
    for (int part = inside ? 1 : dalembert_parts; part <= dalembert_parts; ++part) {
        const int is_end = part == dalembert_parts;
        const double at = is_end ? c->end : t + (c->end - t) * part / dalembert_parts;
        if (!is_end) dalembert_within(run, c, at, in->other);
        dalembert_raw(run, is_end ? c->y : in->other, at, in->sample);
        for (size_t i = 0; i < n; ++i)
            if (in->side[i] == 0) in->side[i] = dalembert_sign(in->sample[i]);
        dalembert_to_sides(in, in->sample);
        const int is_beyond = dalembert_is_beyond(in, in->sample);
        if (!is_beyond && !(is_end && !is_step)) {
            before = at;
            memcpy(in->at_before, in->sample, n * sizeof(double));
            continue;
        }
        double guess = at;
        if (inside && is_beyond) { /* the time of the change in the interpolation of the step */
            dalembert_bracket bracket;
            const double rough = c->length / 1000000;
            dalembert_open_bracket(in, &bracket, before, in->at_before, at, in->sample);
            while (!dalembert_is_closed(&bracket, rough)) {
                const double time = dalembert_next_in_bracket(in, &bracket, rough);
                dalembert_within(run, c, time, in->other);
                dalembert_watched(run, in->other, time, in->sample);
                const int is_far = dalembert_is_beyond(in, in->sample);
                *(is_far ? &bracket.far : &bracket.near) = time;
                memcpy(is_far ? in->far_values : in->near_values, in->sample, n * sizeof(double));
            }
            guess = dalembert_middle(&bracket);
        }
        dalembert_candidate* checked = c;
        if (!is_end) {
            checked = &in->part;
            checked->end = at;
            checked->length = at - t;
            is_step = dalembert_is_clean(run, checked, tiny, in->low);
        }
        if (!is_step) {
            dalembert_close(run, c, at, guess, tiny, resolution);
            return;
        }
        if (!checked->is_finite) {
            if (checked != c) dalembert_copy_candidate(run->plant->states, c, checked);
            return;
        }
        /* A false alarm: the step itself does not do what its interpolation does. The next look needs the interpolation again. */
        if (!is_end) is_step = dalembert_is_clean(run, c, tiny, in->low);
    }
    in->kept->cuts = in->kept->may_touch = 0;
}

#endif
