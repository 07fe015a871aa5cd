/* SPDX-License-Identifier: BSL-1.0 */
/* Positions where constraints depend on each other, as a parallelogram with all bars in one line.
 *
 * note [singular positions]: The motion goes through such a position smoothly, but its equations cannot be solved there: at a distance
 * d, forces of constraints lose the share 1/d of their digits, and velocities that are brought back to the constraints 1/d^2. So no step
 * may end there. A run watches how independent the constraints are, sees the position come, and makes one long step of Gauss's
 * collocation over it. Its stages lie some way off, are brought back to the constraints, and are solved for together, so that errors
 * across the constraints do not spread. */
#ifndef DALEMBERT_SINGULAR_H
#define DALEMBERT_SINGULAR_H

#include "dalembert_collocation.h"
#include "dalembert_events.h"
#include "dalembert_independence.h"

/* What comes of a look ahead: nothing near, or one that a usual step comes nearer to first; the run is behind it; or one that no step
 * leads over. */
enum dalembert_ahead { dalembert_ahead_clear, dalembert_ahead_crossed, dalembert_ahead_stuck };

static const double dalembert_close_position = 0.02, dalembert_rounding_noise = 20 * DBL_EPSILON;

/* How many times the tolerance the last digits of a state may differ that was brought back to the constraints here. */
static inline double dalembert_allowance(const dalembert_run* run) {
    const double value = run->inside->kept->now.value;
    return fmax(1, dalembert_rounding_noise / (value * value * run->options.tolerance));
}
static inline double dalembert_distance(dalembert_run* run, const double* x, const double* y) {
    double* const difference = run->inside->difference;
    for (size_t i = 0; i < run->plant->states; ++i) difference[i] = y[i] - x[i];
    return dalembert_error_norm(run, x, y, difference);
}
static inline size_t dalembert_bring_back(dalembert_run* run, double t, double* x) {
    return dalembert_project(run->plant, run->self, 0, t, x, run->inside->modes.projection);
}

/* Whether a state is too near to a singular position to be brought back to the constraints. */
static inline int dalembert_is_close(dalembert_run* run, const double* x, double t) {
    return dalembert_has_measure(run) && dalembert_measure(run, x, t, 0).value <= dalembert_close_position;
}

/* A step must not end close to a singular position if it comes from further away. Constraints may move a state by about the error of the
 * step, not by more: else they are not solved well there. */
static inline int dalembert_spoils_constraints(dalembert_run* run, const dalembert_candidate* c) {
    if (!dalembert_has_measure(run)) return 0;
    const double there = dalembert_measure(run, c->y, c->end, 0).value;
    if (there <= dalembert_close_position && there <= 0.3 * run->inside->kept->now.value) return 1;
    memcpy(run->inside->other, c->y, run->plant->states * sizeof(double));
    return dalembert_bring_back(run, c->end, run->inside->other) == DALEMBERT_NONE &&
           !(dalembert_distance(run, c->y, run->inside->other) <= 1000 * dalembert_allowance(run));
}

static inline enum dalembert_status dalembert_named_singular(dalembert_run* run, enum dalembert_status status) {
    if (!dalembert_has_measure(run)) return status;
    if (status != dalembert_step_too_small && status != dalembert_not_finite && status != dalembert_singular_position) return status;
    const dalembert_independence here = dalembert_measure(run, run->x, run->t, 0);
    if (status != dalembert_singular_position && !(here.value <= 0.05)) return status;
    run->blamed = here.constraint;
    return dalembert_singular_position;
}

/* The time to a singular position that the last two points promise, if it is within reach of the next step or close; else zero. */
static inline double dalembert_singular_distance(dalembert_run* run) {
    dalembert_run_memory* const k = run->inside->kept;
    const dalembert_independence before = k->now;
    const double since = run->t - k->measured;
    k->now = dalembert_measure(run, run->x, run->t, 1);
    k->measured = run->t;
    if (k->now.is_chosen_anew) dalembert_rate(run, run->x, run->t, run->inside->dxdt);
    if (k->now.rank != before.rank || !(since > 0) || !(k->now.value < before.value)) return 0;
    const double reach = k->now.value / (before.value - k->now.value) * since;
    const double near = fmax(3 * dalembert_close_position,
                             8 * sqrt(DBL_EPSILON / run->options.tolerance)); /* the latter: rounding is as large as the tolerance */
    return reach <= 1.5 * k->h || (k->now.value <= near && reach <= 50 * k->h) ? reach : 0;
}

/* The motion for a while, from slopes here and before, as a polynomial of the time from here. */
static inline void dalembert_extrapolate(dalembert_run* run, double back, dalembert_polynomial* guess) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    double *const b = in->k[0], *const c = in->k[1], *const d = in->k[2], *const y = in->k[3], *const x = in->k[4];
    dalembert_start_polynomial(guess, run->x, 1, 3);
    memcpy(guess->slopes[0], in->dxdt, n * sizeof(double));
    memcpy(x, run->x, n * sizeof(double));
    for (int k = 0; k < 3; ++k) guess->points[k] = -back * k;
    for (int k = 1; k < 3; ++k) { /* a step of the classical Runge-Kutta method back */
        const double* const a = guess->slopes[k - 1];
        const double t = run->t + guess->points[k];
        for (size_t i = 0; i < n; ++i) y[i] = x[i] - back / 2 * a[i];
        dalembert_rate(run, y, t + back / 2, b);
        for (size_t i = 0; i < n; ++i) y[i] = x[i] - back / 2 * b[i];
        dalembert_rate(run, y, t + back / 2, c);
        for (size_t i = 0; i < n; ++i) y[i] = x[i] - back * c[i];
        dalembert_rate(run, y, t, d);
        for (size_t i = 0; i < n; ++i) x[i] -= back * ((a[i] + 2 * (b[i] + c[i]) + d[i]) / 6);
        (void)dalembert_bring_back(run, t, x);
        dalembert_rate(run, x, t, guess->slopes[k]);
    }
}

/* Of a polynomial of the time from here the place where independence is least, by golden sections. */
static inline double dalembert_place_of_least(dalembert_run* run, const dalembert_polynomial* guess, double end) {
    const double ratio = 0.6180339887498949;
    double* const x = run->inside->other;
    double a = 0, b = end, at[2], places[2];
    for (int k = 0; k < 22; ++k) {
        int now = k < 2 ? k : at[0] < at[1] ? 0 : 1; /* which of the two inner places is new */
        if (k >= 2) {
            *(now == 0 ? &b : &a) = places[1 - now];
            places[1 - now] = places[now];
            at[1 - now] = at[now];
        }
        places[now] = now == 0 ? b - ratio * (b - a) : a + ratio * (b - a);
        dalembert_polynomial_at(guess, run->plant->states, places[now], x);
        at[now] = dalembert_measure(run, x, run->t + places[now], 0).value;
    }
    return at[0] < at[1] ? places[0] : places[1];
}

static inline int dalembert_changes_guard(dalembert_run* run, const double* x, double t) {
    dalembert_inside* const in = run->inside;
    if (in->guards == 0) return 0;
    dalembert_watched(run, x, t, in->seen);
    return dalembert_any_negative(in->guards, in->seen);
}

/* The end of a long step, brought back where it lies beyond the position. */
static inline int dalembert_end_of_step(dalembert_run* run, const dalembert_polynomial* step, int is_beyond, double* x) {
    dalembert_polynomial_at(step, run->plant->states, 1, x);
    return !is_beyond || dalembert_bring_back(run, run->t + step->h, x) == DALEMBERT_NONE;
}

/* Solves for the slopes of a step of collocation from a guess, by iteration. False where it does not settle. */
static inline int dalembert_collocate(dalembert_run* run, dalembert_polynomial* step, const dalembert_polynomial* guess, int is_beyond) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    double *const before = in->k[5], *const now = in->k[6], *const x = in->k[7];
    for (size_t i = 0; i < step->count; ++i) dalembert_polynomial_slope(guess, n, step->points[i] * step->h, step->slopes[i]);
    (void)dalembert_end_of_step(run, step, is_beyond, before);
    double last = HUGE_VAL;
    for (int k = 0; k < 40; ++k) {
        for (size_t i = 0; i < step->count; ++i) {
            const double t = run->t + step->points[i] * step->h;
            dalembert_polynomial_at(step, n, step->points[i], x);
            if (dalembert_bring_back(run, t, x) != DALEMBERT_NONE) return 0;
            dalembert_rate(run, x, t, in->difference);
            if (!dalembert_all_finite(n, x) || !dalembert_all_finite(n, in->difference) || dalembert_changes_guard(run, x, t)) return 0;
            memcpy(step->slopes[i], in->difference, n * sizeof(double));
        }
        if (!dalembert_end_of_step(run, step, is_beyond, now)) return 0;
        const double change = dalembert_distance(run, before, now) / dalembert_allowance(run);
        if (change <= 0.01) return 1;
        if (!(change < HUGE_VAL) || (k > 3 && !(change < last))) return change <= 1;
        memcpy(before, now, n * sizeof(double));
        last = change;
    }
    return 0;
}

/* Of eight and nine stages those that keep further away from the middle, as those of two fewer do. */
static inline size_t dalembert_best_stages(double middle) {
    double room[2] = {1, 1}, points[9], weights[9];
    for (size_t i = 0; i < 4; ++i) {
        const size_t stages = 6 + i; /* 6 goes with 8, 7 with 9 */
        dalembert_gauss_points(stages, points, weights);
        for (size_t j = 0; j < stages; ++j) room[i % 2] = fmin(room[i % 2], fabs(points[j] - middle));
    }
    return room[0] >= room[1] ? 8 : 9;
}

/* One long step to `end`, taken if two orders agree. */
static inline int dalembert_cross(dalembert_run* run, const dalembert_polynomial* guess, double middle, double end) {
    dalembert_inside* const in = run->inside;
    const size_t n = run->plant->states;
    const double h = end - run->t;
    const int is_beyond = h >= 1.5 * middle;
    const size_t stages = dalembert_best_stages(middle / h);
    dalembert_polynomial *const step = &in->long_step, *const other = &in->other_step;
    double *const x = in->k[8], *const y = in->k[9];
    memcpy(in->from_x, run->x, n * sizeof(double));
    dalembert_start_polynomial(step, in->from_x, h, stages);
    dalembert_start_polynomial(other, in->from_x, h, stages - 2);
    if (!dalembert_collocate(run, step, guess, is_beyond) || !dalembert_collocate(run, other, guess, is_beyond)) return 0;
    if (!dalembert_end_of_step(run, step, is_beyond, x) || !dalembert_end_of_step(run, other, is_beyond, y)) return 0;
    dalembert_polynomial_at(step, n, 1, in->other);
    if (!(dalembert_distance(run, in->other, x) <= 1000 * dalembert_allowance(run))) return 0;
    if (!(dalembert_distance(run, x, y) <= 10 * dalembert_allowance(run)) || dalembert_changes_guard(run, x, end)) return 0;
    for (int quarter = 1; quarter < 4; ++quarter) { /* where someone may want to know the state */
        dalembert_polynomial_at(step, n, quarter / 4.0, in->other);
        dalembert_polynomial_at(other, n, quarter / 4.0, y);
        if (!(dalembert_distance(run, in->other, y) <= 100 * dalembert_allowance(run))) return 0;
    }
    ++run->steps;
    in->was_crossed = 1;
    in->from_t = run->t;
    run->t = end;
    memcpy(run->x, x, n * sizeof(double));
    in->kept->last_error = 0;
    dalembert_rate(run, run->x, run->t, in->dxdt);
    return 1;
}

/* Looks ahead of a usual step, not beyond `limit`. Makes the step over a singular position, if one is so near; else shortens the way to
 * `target`, if need be. */
static inline enum dalembert_ahead dalembert_look_ahead(dalembert_run* run, double limit, double* target) {
    if (!dalembert_has_measure(run)) return dalembert_ahead_clear;
    const dalembert_run_memory* const k = run->inside->kept;
    const double reach = dalembert_singular_distance(run);
    if (!(reach > 0)) return dalembert_ahead_clear;
    dalembert_polynomial* const guess = &run->inside->guess;
    dalembert_extrapolate(run, fmin(reach, k->h), guess);
    const double middle = dalembert_place_of_least(run, guess, 2.5 * reach);
    dalembert_polynomial_at(guess, run->plant->states, middle, run->inside->other);
    if (!(dalembert_measure(run, run->inside->other, run->t + middle, 0).value <= k->now.value / 10)) return dalembert_ahead_clear;
    const double end = fmin(run->t + 2 * middle, limit);
    if (!(end - run->t > middle / 2)) return dalembert_ahead_clear;
    if (dalembert_cross(run, guess, middle, end)) return dalembert_ahead_crossed;
    /* Where rounding in velocities is as large as 1e-9, or as a larger tolerance. */
    const double least = fmin(dalembert_close_position / 2, sqrt(dalembert_rounding_noise / fmax(run->options.tolerance, 1e-9)));
    if (k->now.value <= least) return dalembert_ahead_stuck;
    *target = fmin(*target, run->t + middle / 2);
    return dalembert_ahead_clear;
}

#endif
