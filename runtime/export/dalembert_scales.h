/* SPDX-License-Identifier: BSL-1.0 */
/* The sizes that errors of states are measured against, found by a rough run. */
#ifndef DALEMBERT_SCALES_H
#define DALEMBERT_SCALES_H

#include "dalembert_run_calls.h"

/* A step of a rough run: how large states become, and what rounding leaves of their rates: how much these change with the last digits of
 * the states. */
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

/* The scale of each state, in SI: the largest magnitude that it reaches in a rough run from run->x, where this is less than one unit.
 * Errors are measured against the larger one of this and of the present magnitude, so that a valve stroke of a tenth of a millimetre has
 * as many digits as a way of metres. A state that rests at zero but for roundings counts in whole units. Where the rough run stops, the
 * sizes are those up to there. A size stops where the digits that the tolerance asks for are no longer there: where what rounding leaves
 * of a rate, over the longest step, would be an error that counts. */
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
    for (size_t i = 0; i < n; ++i)
        run->scale[i] = fmax(run->scale[i], fmin(1e-3, 4 * in->rounding[i] * (span / 500) / run->options.tolerance));
    if (run->plant->is_projected && run->plant->constraints > 0) { /* bringing velocities back to constraints leaves them about twelve digits of the largest one */
        const double least = fmin(1, 1e-12 / run->options.tolerance) * dalembert_largest(n, run->scale);
        for (size_t i = 0; i < n; ++i) run->scale[i] = fmax(run->scale[i], least);
    }
    memcpy(run->x, in->start_x, n * sizeof(double));
}

#endif
