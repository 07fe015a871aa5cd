/* SPDX-License-Identifier: BSL-1.0 */
/* A closing bracket around the first time at which one of several functions is negative; at `near` none is, at `far` one is. ITP:
 * Oliveira, Takahashi: An enhancement of the bisection method average performance preserving minmax optimality, ACM TOMS 47 (2020),
 * article 5: regula falsi, drawn a little to the middle so that both ends move, and kept so close to the middle that a few evaluations
 * more than those of bisection are enough for whatever function. */
#ifndef DALEMBERT_BRACKET_H
#define DALEMBERT_BRACKET_H

#include "dalembert_run.h"

/* The values are in near_values and far_values of the run. */
typedef struct dalembert_bracket {
    double near, far, width, reach;
} dalembert_bracket;

static inline void dalembert_open_bracket(dalembert_inside* in, dalembert_bracket* b, double near, const double* at_near, double far,
                                          const double* at_far) {
    b->near = near;
    b->far = far;
    b->width = far - near;
    b->reach = 8 * b->width; /* three evaluations more than bisection at most */
    memcpy(in->near_values, at_near, in->guards * sizeof(double));
    memcpy(in->far_values, at_far, in->guards * sizeof(double));
}

static inline double dalembert_middle(const dalembert_bracket* b) { return b->near + (b->far - b->near) / 2; }

static inline int dalembert_is_closed(const dalembert_bracket* b, double resolution) {
    const double middle = dalembert_middle(b);
    return !(b->far - b->near > resolution) || !(middle > b->near && middle < b->far);
}

/* By regula falsi: of each function that changes its sign, the first of all. */
static inline double dalembert_first_zero(const dalembert_inside* in, const dalembert_bracket* b) {
    double first = b->far;
    for (size_t i = 0; i < in->guards; ++i) {
        if (!(in->far_values[i] <= 0 && in->near_values[i] > in->far_values[i])) continue;
        const double zero = b->near + (b->far - b->near) * (in->near_values[i] / (in->near_values[i] - in->far_values[i]));
        if (!(zero >= first)) first = zero;
    }
    return first;
}

/* The next time to look at, strictly between. */
static inline double dalembert_next_in_bracket(const dalembert_inside* in, dalembert_bracket* b, double resolution) {
    const double half = dalembert_middle(b), width = b->far - b->near;
    b->reach /= 2;
    const double zero = dalembert_first_zero(in, b), drawn = fmax(resolution, width * (width / b->width) / 100);
    double t = half;
    if (fabs(half - zero) > drawn) t = zero < half ? zero + drawn : zero - drawn; /* not so when the zero is no number */
    const double radius = fmax(0, b->reach - width / 2);
    if (fabs(t - half) > radius) t = t < half ? half - radius : half + radius;
    return t > b->near && t < b->far ? t : half;
}

#endif
