/* SPDX-License-Identifier: BSL-1.0 */
/* Right-hand sides, steps of the method at work, and how long a step may be. */
#ifndef DALEMBERT_CONTROL_H
#define DALEMBERT_CONTROL_H

#include "dalembert_run.h"

static inline void dalembert_see(dalembert_run* run, const double* x, double t);

static inline void dalembert_rate(dalembert_run* run, const double* x, double t, double* dxdt) {
    dalembert_inside* const in = run->inside;
    if (in->is_watching) dalembert_see(run, x, t);
    ++run->rhs_calls;
    dalembert_inputs_at(&in->modes, t, x, in->u);
    run->plant->rhs(run->self, in->modes.mode, x, in->u, t, dxdt);
}

static inline dalembert_point dalembert_here(const dalembert_run* run) {
    const dalembert_point here = {run->x, run->inside->dxdt, run->t};
    return here;
}

/* The least distance of two times near t. */
static inline double dalembert_resolution(const dalembert_run* run, double t) {
    return DBL_EPSILON * fmax(fabs(t), DBL_EPSILON * run->inside->kept->span);
}

/* Largest error of a step from x to y relative to what is allowed; what is no number counts as infinite. */
static inline double dalembert_error_norm(const dalembert_run* run, const double* x, const double* y, const double* error) {
    double largest = 0;
    for (size_t i = 0; i < run->plant->states; ++i) {
        const double ratio = fabs(error[i]) / (run->options.tolerance * fmax(run->scale[i], fmax(fabs(x[i]), fabs(y[i]))));
        if (isnan(ratio)) return HUGE_VAL;
        if (ratio > largest) largest = ratio;
    }
    return largest;
}
static inline int dalembert_is_accurate(const dalembert_run* run, const dalembert_candidate* c) {
    return dalembert_error_norm(run, run->x, c->y, c->error) <= 1;
}

/* The state with the largest error, measured in the same way. */
static inline size_t dalembert_worst(const dalembert_run* run, const dalembert_candidate* c) {
    double largest = -1;
    size_t worst = 0;
    for (size_t i = 0; i < run->plant->states; ++i) {
        const double ratio = fabs(c->error[i]) / fmax(run->scale[i], fmax(fabs(run->x[i]), fabs(c->y[i])));
        if (!(ratio > largest)) continue;
        largest = ratio;
        worst = i;
    }
    return worst;
}

static inline int dalembert_order(const dalembert_run* run) { return run->inside->kept->is_implicit ? 5 : 8; }

/* Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I, section II.4: a first step from the sizes of x and dx/dt. */
static inline double dalembert_first_step(const dalembert_run* run) {
    const double span = run->inside->kept->span;
    if (run->options.first_step > 0) return fmin(run->options.first_step, span);
    double d0 = 0, d1 = 0;
    for (size_t i = 0; i < run->plant->states; ++i) {
        const double size = fmax(run->scale[i], fabs(run->x[i]));
        d0 = fmax(d0, fabs(run->x[i]) / size);
        d1 = fmax(d1, fabs(run->inside->dxdt[i]) / size);
    }
    const double guess = d1 > 0 ? fmax(d0, 0.01) / d1 : span;
    return fmin(pow(run->options.tolerance, 1.0 / (dalembert_order(run) + 1)) * guess, span);
}

/* The factor for the next step after one with this error (Gustafsson's PI controller): 0.9 e^(-0.7/k) e_last^(0.4/k). */
static inline double dalembert_factor(dalembert_run* run, double error) {
    const double e = log(fmax(error, 1e-4));
    const double factor = 0.9 * exp((4 * run->inside->kept->last_error - 7 * e) / (10 * dalembert_order(run)));
    run->inside->kept->last_error = e;
    return fmin(5, fmax(0.2, factor));
}
static inline double dalembert_factor_of_failure(const dalembert_run* run, double error) {
    return fmax(0.1, 0.9 * pow(error, -1.0 / dalembert_order(run)));
}

#endif
