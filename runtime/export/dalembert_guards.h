/* SPDX-License-Identifier: BSL-1.0 */
/* The sides of guards, and what is remembered of them.
 *
 * note [rest]: Where the motion on both sides leads back to the zero, as with two pressures that have become equal, the sign changes
 * again and again by rounding alone. A kink that has come back several times without going anywhere rests: it is not watched, and the
 * control of errors alone keeps the motion near the zero, until the guard keeps its sign for a while. */
#ifndef DALEMBERT_GUARDS_H
#define DALEMBERT_GUARDS_H

#include "dalembert_run.h"

static inline void dalembert_raw(dalembert_run* run, const double* x, double t, double* g) {
    dalembert_inside* const in = run->inside;
    dalembert_modes_values(&in->modes, t, x, g);
    for (size_t e = 0; in->is_ignored != NULL && e < run->plant->events; ++e)
        if (in->is_ignored[e]) g[e] = 1;
}

static inline int dalembert_sign(double g) { return g > 0 ? 1 : g < 0 ? -1 : 0; }

static inline void dalembert_to_sides(const dalembert_inside* in, double* g) {
    for (size_t i = 0; i < in->guards; ++i)
        if (in->watches[i].rests)
            g[i] = 1;
        else if (!isnan(g[i]))
            g[i] = in->side[i] > 0 ? g[i] : in->side[i] < 0 ? -g[i] : 0;
}

static inline void dalembert_watched(dalembert_run* run, const double* x, double t, double* g) {
    dalembert_raw(run, x, t, g);
    dalembert_to_sides(run->inside, g);
}

static inline int dalembert_any_negative(size_t n, const double* g) {
    for (size_t i = 0; i < n; ++i)
        if (g[i] < 0) return 1;
    return 0;
}
static inline int dalembert_any_nan(size_t n, const double* g) {
    for (size_t i = 0; i < n; ++i)
        if (isnan(g[i])) return 1;
    return 0;
}
static inline int dalembert_is_beyond(const dalembert_inside* in, const double* g) {
    for (size_t i = 0; i < in->guards; ++i)
        if (g[i] < 0 || (in->is_strict[i] && !(g[i] > 0) && !isnan(g[i]))) return 1;
    return 0;
}

/* Of the guards that changed: the first one that ends the run, or DALEMBERT_NONE. */
static inline size_t dalembert_ending_guard(const dalembert_inside* in) {
    for (size_t i = 0; i < in->guards; ++i)
        if (in->ends[i] && in->found[i] < 0) return i;
    return DALEMBERT_NONE;
}

/* The sides at the start. The first guard that ends the run there and then, or DALEMBERT_NONE. */
static inline size_t dalembert_start_guards(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    memset(in->watches, 0, in->guards * sizeof(dalembert_watch));
    in->kept->cuts = in->kept->may_touch = in->kept->has_noticed = 0;
    dalembert_raw(run, run->x, run->t, in->found);
    for (size_t i = 0; i < in->guards; ++i) {
        in->watches[i].patience = 15;
        in->watches[i].settled = in->side[i] = in->ends[i] ? 1 : dalembert_sign(in->found[i]);
    }
    dalembert_to_sides(in, in->found);
    return dalembert_ending_guard(in);
}

/* The sides just behind the start of a kink on whose zero the run starts. False, with nothing changed, if none becomes known or a guard
 * would end the run. */
static inline int dalembert_leave_zero_at(dalembert_run* run, const double* x, double t) {
    dalembert_inside* const in = run->inside;
    int leaves = 0;
    dalembert_raw(run, x, t, in->seen);
    for (size_t i = 0; i < in->guards; ++i)
        if (in->ends[i] && in->seen[i] < 0) return 0;
    for (size_t i = 0; i < in->guards; ++i) {
        if (in->watches[i].settled != 0) continue;
        in->watches[i].settled = in->side[i] = dalembert_sign(in->seen[i]);
        leaves = leaves || in->side[i] != 0;
    }
    return leaves;
}

static inline void dalembert_note_change(dalembert_watch* w, double t, double tolerance, double soon) {
    w->small_changes = w->excursion <= tolerance * w->largest ? w->small_changes + 1 : 0;
    w->soon_changes = w->has_changed && t - w->last_change <= soon ? w->soon_changes + 1 : 0;
    const int is_first = w->small_changes <= 1 && w->soon_changes <= 1; /* the excursion before that led here */
    w->rest = !is_first && w->rest > w->excursion ? w->rest : w->excursion;
    w->rests = w->small_changes >= 3 || w->soon_changes >= 20;
    if (w->rests && w->patience < 1000000) w->patience *= 2;
    w->last_change = t;
    w->has_changed = 1;
    w->excursion = 0;
    w->kept = 0;
}

/* Where a step begins. */
static inline void dalembert_notice(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    if (in->kept->has_noticed && !(run->t > in->kept->noticed || run->t < in->kept->noticed)) return;
    in->kept->noticed = run->t;
    in->kept->has_noticed = 1;
    dalembert_raw(run, run->x, run->t, in->seen);
    for (size_t i = 0; i < in->guards; ++i) {
        dalembert_watch* const w = &in->watches[i];
        const double size = fabs(in->seen[i]);
        if (size > w->largest) w->largest = size;
        if (size > w->excursion) w->excursion = size;
        w->last = size;
        if (!w->rests) continue;
        const int sign = dalembert_sign(in->seen[i]);
        w->kept = sign != 0 && sign == w->sign ? w->kept + 1 : 0;
        w->sign = sign;
        if (w->kept < w->patience) continue;
        w->rests = w->small_changes = w->soon_changes = 0; /* it rests no more */
        w->settled = sign;
    }
}

/* Whether a guard has changed at (x, t). If so, that is what dalembert_pass_guards() passes. */
static inline int dalembert_has_changed_at(dalembert_run* run, const double* x, double t) {
    dalembert_inside* const in = run->inside;
    dalembert_watched(run, x, t, in->seen);
    if (!dalembert_any_negative(in->guards, in->seen)) return 0;
    memcpy(in->found, in->seen, in->guards * sizeof(double));
    return 1;
}

/* Goes on behind the event at t: other sides. How many guards changed. */
static inline size_t dalembert_pass_guards(dalembert_run* run, double t) {
    dalembert_inside* const in = run->inside;
    size_t changed = 0;
    in->kept->cuts = in->kept->may_touch = 0;
    for (size_t i = 0; i < in->guards; ++i) {
        if (!(in->found[i] < 0)) continue;
        in->watches[i].settled = -in->side[i];
        ++changed;
        if (!in->ends[i]) dalembert_note_change(&in->watches[i], t, run->options.tolerance, in->kept->span / 1000000);
    }
    return changed;
}

/* Behind a kink at a known time: kinks that changed with it need no search. How many. */
static inline size_t dalembert_pass_known(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    size_t changed = 0;
    dalembert_raw(run, run->x, run->t, in->seen);
    for (size_t i = 0; i < in->guards; ++i) {
        dalembert_watch* const w = &in->watches[i];
        const int now = dalembert_sign(in->seen[i]);
        if (in->ends[i] || w->rests || now == 0 || now == w->settled) continue;
        if (w->settled != 0) ++changed;
        w->settled = now;
        w->excursion = 0;
    }
    return changed;
}

/* Behind a kink at a known time: the guard that ends the run, or event, that has jumped below zero with it, or DALEMBERT_NONE. It needs no
 * search either. */
static inline size_t dalembert_jumped_guard(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    size_t first = DALEMBERT_NONE;
    dalembert_raw(run, run->x, run->t, in->seen);
    for (size_t i = in->guards; i-- > 0;)
        if (in->ends[i] && in->watches[i].last > 0 && in->seen[i] < -in->watches[i].largest / 1000000) first = i;
    return first;
}

/* Whether a kink that rests is still near its zero at (x, t), or leaves it to one side, no faster than twice as far in a step. Estimates
 * of errors do not see every jump. */
static inline int dalembert_keeps_rest(dalembert_run* run, const double* x, double t) {
    dalembert_inside* const in = run->inside;
    dalembert_raw(run, x, t, in->seen);
    for (size_t i = 0; i < in->guards; ++i) {
        const dalembert_watch* const w = &in->watches[i];
        const double leaving = w->kept >= 5 ? 2 * w->last : 0;
        if (w->rests && fabs(in->seen[i]) > fmax(1000 * fmax(run->options.tolerance * w->largest, w->rest), leaving)) return 0;
    }
    return 1;
}

/* The guard that ends the run and is next to nothing beside what it was, or DALEMBERT_NONE: where a step cannot be made, it is why. */
static inline size_t dalembert_vanishing_guard(dalembert_run* run) {
    dalembert_inside* const in = run->inside;
    dalembert_raw(run, run->x, run->t, in->seen);
    for (size_t i = 0; i < in->guards; ++i)
        if (in->ends[i] && !(in->seen[i] > in->watches[i].largest / 1000000) && !(in->spares_stages && !(in->watches[i].largest > 0)))
            return i;
    return DALEMBERT_NONE;
}

#endif
